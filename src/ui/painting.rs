//! Paints the scene on the canvas.

use std::f64::consts::{PI, TAU};

use eframe::egui::{Align2, Color32, Mesh, Pos2, Rect, Shape, Stroke, StrokeKind, vec2};
use glam::DVec2;

use super::brush::Brush;
use super::theme;
use super::vertex_columns::Column;
use super::{end_marks, feature_marks, guides, labels, proposal, transform_marks};
use crate::editor::{CurveScene, DragReadout, HoverScene, Mark, MeasuredFigure, Scene, VertexMark};
use crate::geometry::coordinate;

/// Half the length of the tick across a joint, in points.
const TICK: f32 = 5.0;

/// The width of the bands for rising and falling curvature.
const BAND: f32 = 7.0;

/// How strong these bands are: the curve on them is brighter.
const BAND_STRENGTH: f32 = 0.4;

/// The radius of a vertex's disc.
const DISC: f32 = 4.0;

/// The share of its size that the disc of a vertex of an inactive curve has.
const INACTIVE_DISC: f32 = 0.5;

/// The radius of a selected vertex's disc, and of the ring round it.
const SELECTED: [f32; 2] = [5.0, 8.0];

/// Half the side of the closed polygon's squares.
const SQUARE: f32 = 3.5;

/// More points of a list than this are marked by smaller discs.
const CROWD: usize = 200;

/// The strength of the teeth of a comb beside its envelope.
const TEETH_STRENGTH: f32 = 0.35;

/// How strong the evolute is beside the curve: it runs over all of the canvas.
const EVOLUTE_STRENGTH: f32 = 0.35;

/// An evolute smaller than this, in points, is marked by a disc.
const SMALL_EVOLUTE: f32 = 4.0;

/// The radius of the circle round a vertex where the flow is least even.
const EXTREME: f32 = 9.0;

/// The radius of the mark of a joint of curves.
const JOINT: f32 = 6.0;

/// The radius of an operation's handle.
const HANDLE: f32 = 6.5;

/// Half the side of the cross at a point that is left out.
const CROSS: f32 = 4.0;

/// Points of a ruler that texts are kept clear of.
const RULER_STEPS: u32 = 64;

/// The width of the halo of curves that are selected together, and its strength.
const HALO: f32 = 7.0;
const HALO_STRENGTH: f32 = 0.35;

/// How faint the curve is as it was.
const GHOST: f32 = 0.35;

/// The dash, the dot and the gap of an axis of symmetry, in points.
const AXIS_DASH: f32 = 14.0;
const AXIS_DOT: f32 = 2.0;
const AXIS_GAP: f32 = 4.0;

/// Paint everything that lies on the grid, from back to front.
pub fn paint(brush: &Brush<'_>, scene: &Scene) {
    let (active, others): (Vec<_>, Vec<_>) = scene.curves.iter().partition(|curve| curve.active);
    for curve in others.iter().chain(&active) {
        brush.derived(curve);
    }
    let ghostly = |width, colour: Color32| Stroke::new(width, colour.gamma_multiply(GHOST));
    let (curve, float) = (brush.tokens.curve, brush.tokens.float);
    brush.legs(&scene.ghost.float, false, ghostly(1.0, float));
    brush.chain(&scene.ghost.curve, ghostly(1.5, curve));
    for curve in others.iter().chain(&active) {
        brush.halo(curve);
        brush.bands(curve);
        brush.vertices(curve);
    }
    for curve in others.iter().chain(&active) {
        brush.curve(curve);
    }
    for curve in others.iter().chain(&active) {
        brush.marked(curve);
    }
    for marks in &scene.ends {
        end_marks::paint(brush, marks);
    }
    guides::paint(brush, &scene.guides);
}

/// Paint the tool's marks and the hovered item.
pub fn paint_hand(brush: &Brush<'_>, scene: &Scene) {
    proposal::paint(brush, &scene.proposal);
    let others = kept_clear(brush, scene);
    for mark in &scene.marks {
        brush.mark(mark, &others);
    }
    if let Some(hover) = &scene.hover {
        brush.hover(hover, &others);
    }
}

/// What boxes of text are to keep clear of: points of the active curve and of rulers.
fn kept_clear(brush: &Brush<'_>, scene: &Scene) -> Vec<Pos2> {
    if scene.hover.is_none() && scene.marks.is_empty() {
        return Vec::new();
    }
    let active = scene.curves.iter().filter(|curve| curve.active);
    let curve = active.flat_map(|curve| &curve.curve);
    let mut points: Vec<Pos2> = curve.filter_map(|at| brush.screen.point(*at)).collect();
    for mark in &scene.marks {
        if let Mark::Ruler([from, to]) = mark {
            let steps = (0..=RULER_STEPS).map(|step| f64::from(step) / f64::from(RULER_STEPS));
            points.extend(steps.filter_map(|share| brush.screen.point(from.lerp(*to, share))));
        }
    }
    points
}

impl Brush<'_> {
    /// Paint the evolute, then the comb and both polygons, behind the curve.
    fn derived(&self, curve: &CurveScene) {
        let fade = fading(curve);
        let tokens = self.tokens;
        let evolute = fade(tokens.evolute).gamma_multiply(EVOLUTE_STRENGTH);
        self.evolute(&curve.evolute, evolute);
        // Combs of several curves are compared: they fade as their curves do. Each has the colour of its curve, but for
        // that of the active one.
        let own = tokens.of_item(curve.id, curve.colour, curve.is_reference);
        let colour = match curve.active {
            true => tokens.comb,
            false => own,
        };
        let colour = colour.gamma_multiply(own_strength(curve));
        let teeth = colour.gamma_multiply(TEETH_STRENGTH);
        self.hairs(&curve.teeth, 1.0, teeth);
        self.chain(&curve.comb, Stroke::new(1.0, colour));
        self.legs(&curve.clamped, true, Stroke::new(1.0, fade(tokens.clamped)));
        let float = if curve.active { 1.25 } else { 1.0 };
        self.legs(&curve.float, false, Stroke::new(float, fade(tokens.float)));
    }

    /// The evolute of an arc of nearly constant curvature is hardly more than a point: it gets a
    /// disc, so that it is seen where it lies.
    fn evolute(&self, evolute: &[DVec2], colour: Color32) {
        for line in self.screen.lines(evolute) {
            let around = Rect::from_points(&line);
            if around.size().max_elem() < SMALL_EVOLUTE {
                let radius = 0.75 * SMALL_EVOLUTE;
                self.painter.circle_filled(around.center(), radius, colour);
            }
            self.painter
                .add(Shape::line(line, Stroke::new(1.0, colour)));
        }
    }

    /// Paint what tells curves that are selected together from the others.
    fn halo(&self, curve: &CurveScene) {
        if curve.selected {
            let colour = self.tokens.accent.gamma_multiply(HALO_STRENGTH);
            self.chain(&curve.curve, Stroke::new(HALO, colour));
        }
    }

    /// Paint bands of rising and falling curvature; the curve on them keeps its colour.
    fn bands(&self, curve: &CurveScene) {
        let tokens = self.tokens;
        let trends = [tokens.rising, tokens.falling, tokens.undecided];
        for (chain, trend) in curve.pieces.iter().zip(trends) {
            let colour = trend.gamma_multiply(BAND_STRENGTH);
            self.chain(chain, Stroke::new(BAND, colour));
        }
    }

    fn curve(&self, curve: &CurveScene) {
        let fade = fading(curve);
        let own = self
            .tokens
            .of_item(curve.id, curve.colour, curve.is_reference);
        if curve.is_reference {
            return self.reference(curve, own);
        }
        let colour = own.gamma_multiply(own_strength(curve));
        let width = if curve.active { 2.0 } else { 1.5 };
        let stroke = Stroke::new(width, colour);
        match curve.unreached {
            true => self.dashed_chain(&curve.curve, stroke),
            false => self.chain(&curve.curve, stroke),
        }
        let tick = Stroke::new(1.5, fade(self.tokens.joints));
        for [point, normal] in &curve.joints {
            if let Some(at) = self.screen.point(*point) {
                let across = vec2(normal.x as f32, -normal.y as f32) * TICK;
                self.painter.line_segment([at - across, at + across], tick);
            }
        }
    }

    /// References are thinner than curves; of lists of points it is the points that count.
    fn reference(&self, reference: &CurveScene, colour: Color32) {
        let strength = match (reference.active, reference.locked) {
            (true, _) => 1.0,
            (false, false) => 0.75,
            (false, true) => 0.55,
        };
        let colour = colour.gamma_multiply(strength);
        let is_list = !reference.points.is_empty();
        let width = if reference.active { 1.75 } else { 1.25 };
        let line = match is_list {
            true => Stroke::new(1.0, colour.gamma_multiply(0.5)),
            false => Stroke::new(width, colour),
        };
        self.chain(&reference.curve, line);
        let radius = match (reference.active, reference.points.len() > CROWD) {
            (_, true) => 1.5,
            (false, false) => 2.0,
            (true, false) => 2.5,
        };
        for point in &reference.points {
            self.disc(*point, radius, colour, Stroke::NONE);
        }
    }

    /// The vertices of both polygons, under the curve: where they crowd it is the curve that is seen.
    fn vertices(&self, curve: &CurveScene) {
        let fade = fading(curve);
        for vertex in &curve.clamped_vertices {
            let width = 1.25 * vertex.size.max(0.5);
            let outline = Stroke::new(width, fade(self.tokens.clamped));
            let side = 2.0 * SQUARE * vertex.size;
            self.square(vertex.at, side, Color32::TRANSPARENT, outline);
        }
        let colour = fade(self.tokens.float);
        let size = if curve.active { 1.0 } else { INACTIVE_DISC };
        for vertex in curve.vertices.iter().filter(|vertex| !is_marked(vertex)) {
            let size = size * vertex.size;
            self.vertex(&VertexMark { size, ..*vertex }, colour, curve.locked);
        }
    }

    /// Selected and locked vertices and features, on the curve.
    fn marked(&self, curve: &CurveScene) {
        let colour = fading(curve)(self.tokens.float);
        for vertex in curve.vertices.iter().filter(|vertex| is_marked(vertex)) {
            self.vertex(vertex, colour, curve.locked);
        }
        for mark in &curve.features {
            feature_marks::paint(self, mark);
        }
    }

    fn vertex(&self, vertex: &VertexMark, colour: Color32, locked: bool) {
        let (at, size) = (vertex.at, vertex.size);
        if vertex.locked {
            self.locked_vertex(vertex, colour);
        } else if vertex.selected {
            let [disc, ring] = SELECTED.map(|radius| radius * size);
            let stroke = Stroke::new(1.5 * size, self.tokens.strong_text);
            self.disc(at, disc, colour, Stroke::NONE);
            self.disc(at, ring, Color32::TRANSPARENT, stroke);
        } else if locked {
            let stroke = Stroke::new(1.25 * size, colour);
            self.disc(at, (DISC - 0.5) * size, self.tokens.background, stroke);
        } else {
            self.disc(at, DISC * size, colour, Stroke::NONE);
        }
    }

    /// A locked vertex has a square ring, a free one none or a round one.
    fn locked_vertex(&self, vertex: &VertexMark, colour: Color32) {
        let (radius, side, ring) = if vertex.selected {
            (5.0, 16.0, self.tokens.strong_text)
        } else {
            (3.0, 13.0, colour)
        };
        self.disc(vertex.at, radius, colour, Stroke::NONE);
        let outline = Stroke::new(1.5, ring);
        self.square(vertex.at, side, Color32::TRANSPARENT, outline);
    }

    /// Paint many thin lines, so many pixels wide, as one mesh: a shape for each would cost half the frame rate.
    fn hairs(&self, segments: &[[DVec2; 2]], width: f32, colour: Color32) {
        let mut mesh = Mesh::default();
        let feather = width / self.painter.pixels_per_point();
        for segment in segments {
            if let Some([from, to]) = self.screen.segment(*segment) {
                hair(&mut mesh, from, to, feather, colour);
            }
        }
        if !mesh.is_empty() {
            self.painter.add(Shape::mesh(mesh));
        }
    }

    /// Mark a place by a ring, with a remark on its free side, if it has one.
    fn ringed(&self, at: DVec2, radius: f32, text: &str, colour: Color32) {
        let Some(at) = self.screen.point(at) else {
            return;
        };
        self.painter
            .circle_stroke(at, radius, Stroke::new(1.5, colour));
        if text.is_empty() {
            return;
        }
        let font = theme::small_font();
        let size = labels::size(self.painter, text, font.clone());
        let sides = [
            (Align2::LEFT_BOTTOM, vec2(radius, -radius)),
            (Align2::RIGHT_BOTTOM, vec2(-radius, -radius)),
            (Align2::LEFT_TOP, vec2(radius, radius)),
            (Align2::RIGHT_TOP, vec2(-radius, radius)),
        ];
        let boxes = sides.map(|(align, by)| align.anchor_size(at + by, size));
        if let Some(free) = boxes.into_iter().find(|rect| self.keep_text(*rect)) {
            let (place, align) = (free.left_top(), Align2::LEFT_TOP);
            labels::paint(self, place, align, text, font, colour);
        }
    }

    /// Draw an axis as drawings show it: long dashes and dots.
    fn axis_of_symmetry(&self, ends: [DVec2; 2]) {
        let stroke = Stroke::new(1.0, self.tokens.faint_text);
        for line in self.screen.lines(&ends) {
            let (dashes, gaps) = ([AXIS_DASH, AXIS_DOT], [AXIS_GAP; 2]);
            let shapes = Shape::dashed_line_with_offset(&line, stroke, &dashes, &gaps, 0.0);
            self.painter.extend(shapes);
        }
    }

    fn mark(&self, mark: &Mark, others: &[Pos2]) {
        let tokens = self.tokens;
        let accent = Stroke::new(1.5, tokens.accent);
        match mark {
            Mark::Guide(ends) => self.dashed_chain(ends, Stroke::new(1.0, tokens.float)),
            Mark::SymmetryAxis(ends) => self.axis_of_symmetry(*ends),
            Mark::GuideLine(ends) => self.segment(*ends, Stroke::new(1.0, tokens.guide)),
            Mark::Ruler(segment) => self.ruler(*segment),
            Mark::SelectionBox([a, b]) => self.selection_box(*a, *b),
            Mark::NewVertex(at) => {
                self.disc(*at, 4.5, tokens.background, Stroke::new(1.5, tokens.float));
            }
            Mark::Pivot(at) => self.pivot(*at),
            Mark::Ring {
                centre,
                handle,
                swept,
            } => transform_marks::ring(self, *centre, *handle, *swept),
            Mark::Corners { corners, sides } => transform_marks::corners(self, corners, sides),
            Mark::Frame { corners, arm } => transform_marks::frame(self, corners, *arm),
            Mark::Snap(at) => self.square(*at, 14.0, Color32::TRANSPARENT, accent),
            Mark::Name(at, name) => {
                if let Some(at) = self.screen.point(*at) {
                    labels::name(self, at, name);
                }
            }
            Mark::Axis { ends, axis } => {
                let own = axis.and_then(|axis| tokens.model_axes.get(axis).copied());
                let stroke = Stroke::new(1.0, own.unwrap_or(tokens.accent));
                self.segment(*ends, stroke);
            }
            Mark::Measured(at, figures) => {
                let pixel = 1.0 / self.screen.scale();
                let line =
                    |figure: &MeasuredFigure| figure.text(|length| coordinate(length, pixel));
                let lines: Vec<String> = figures.iter().map(line).collect();
                self.text_beside(*at, &lines.join("\n"), others);
            }
            Mark::Drag(readout) => self.drag_readout(readout, others),
            Mark::Extreme { at, text } => self.ringed(*at, EXTREME, text, tokens.warning),
            Mark::Joint { at, name } => {
                self.ringed(*at, JOINT, name.unwrap_or_default(), tokens.joints);
            }
            Mark::Handle { at, marked } => {
                let fill = match marked {
                    true => tokens.accent,
                    false => tokens.background,
                };
                self.disc(*at, HANDLE, fill, Stroke::new(2.0, tokens.accent));
            }
            Mark::Label(at, text) => self.text_beside(*at, text, others),
            Mark::Whiskers { lines, beyond } => {
                // Those beyond the limit differ by their strength too: colours alone are told apart by few.
                match beyond {
                    true => self.hairs(lines, 2.0, tokens.error),
                    false => self.hairs(lines, 1.0, tokens.target),
                }
            }
            Mark::Points {
                kept,
                left_out,
                hovered,
            } => {
                self.fitted_points(kept, left_out);
                if let Some(at) = hovered {
                    self.disc(*at, SELECTED[1], Color32::TRANSPARENT, accent);
                }
            }
        }
    }

    /// Points that count are discs, those that are left out crosses.
    fn fitted_points(&self, kept: &[DVec2], left_out: &[DVec2]) {
        let (radius, rim) = match kept.len() > CROWD {
            true => (1.5, Stroke::NONE),
            false => (3.0, Stroke::new(1.0, self.tokens.background)),
        };
        for at in kept {
            self.disc(*at, radius, self.tokens.target, rim);
        }
        let stroke = Stroke::new(2.0, self.tokens.error);
        for at in left_out.iter().filter_map(|at| self.screen.point(*at)) {
            let ground = self.tokens.background;
            self.painter.circle_filled(at, 1.5 * CROSS, ground);
            for across in [vec2(CROSS, CROSS), vec2(CROSS, -CROSS)] {
                self.painter
                    .line_segment([at - across, at + across], stroke);
            }
        }
    }

    /// Show some lines beside a place.
    fn text_beside(&self, at: DVec2, text: &str, others: &[Pos2]) {
        if let Some(at) = self.screen.point(at) {
            labels::tooltip(self, others, at, text);
        }
    }

    /// Write the figures of a drag on the side away from its direction.
    fn drag_readout(&self, readout: &DragReadout, others: &[Pos2]) {
        let Some(at) = self.screen.point(readout.at) else {
            return;
        };
        let pixel = 1.0 / self.screen.scale();
        let text = drag_text(readout, pixel);
        let way = vec2(readout.way.x as f32, -readout.way.y as f32);
        labels::behind(self, others, (at, way), &text);
    }

    fn ruler(&self, segment: [DVec2; 2]) {
        let stroke = Stroke::new(1.5, self.tokens.accent);
        let Some([from, to]) = self.screen.segment(segment) else {
            return;
        };
        self.painter.line_segment([from, to], stroke);
        let across = (to - from).normalized().rot90() * 6.0;
        for end in [from, to] {
            let tick = [end - across, end + across];
            self.painter.line_segment(tick, stroke);
        }
    }

    fn selection_box(&self, a: DVec2, b: DVec2) {
        let rect = Rect::from_two_pos(self.screen.pos(a), self.screen.pos(b));
        let accent = self.tokens.accent;
        let (fill, stroke) = (accent.gamma_multiply(0.12), Stroke::new(1.0, accent));
        self.painter.rect(rect, 0, fill, stroke, StrokeKind::Middle);
    }

    fn pivot(&self, at: DVec2) {
        let Some(at) = self.screen.point(at) else {
            return;
        };
        let stroke = Stroke::new(1.5, self.tokens.accent);
        self.painter.circle(at, 6.0, self.tokens.background, stroke);
        for arm in [vec2(10.0, 0.0), vec2(0.0, 10.0)] {
            self.painter.line_segment([at - arm, at + arm], stroke);
        }
    }

    fn hover(&self, hover: &HoverScene, others: &[Pos2]) {
        let tokens = self.tokens;
        let ring = Stroke::new(1.5, tokens.accent);
        match hover {
            HoverScene::Vertex { at, text, .. } | HoverScene::Handle { at, text } => {
                if matches!(hover, HoverScene::Vertex { .. }) {
                    // In a crowd it may have no disc otherwise.
                    self.disc(*at, DISC, tokens.float, Stroke::NONE);
                }
                self.disc(*at, 8.0, Color32::TRANSPARENT, ring);
                if !text.is_empty() {
                    self.text_beside(*at, text, others);
                }
            }
            HoverScene::Curve {
                at,
                centre,
                circle,
                text,
                ..
            } => {
                let hair = Stroke::new(1.0, tokens.evolute.gamma_multiply(0.7));
                self.chain(circle, hair);
                if let Some(centre) = centre {
                    self.osculating_circle(*at, *centre);
                }
                self.disc(*at, 4.0, tokens.background, ring);
                self.text_beside(*at, text, others);
            }
        }
    }

    /// Paint the circle of curvature; of a large one only the part near its point.
    fn osculating_circle(&self, at: DVec2, centre: DVec2) {
        let radius = at.distance(centre);
        let reach = 4.0 * f64::from(self.rect.width() + self.rect.height()) / self.screen.scale();
        let half = (reach / radius).min(PI);
        if !(radius > 0.0 && half > 0.0) {
            return;
        }
        let start = (at - centre).to_angle();
        let steps = if half < PI { 256 } else { 128 };
        let chain: Vec<DVec2> = (0..=steps)
            .map(|step| start + half * (2.0 * f64::from(step) / f64::from(steps) - 1.0))
            .map(|angle| centre + radius * DVec2::from_angle(angle % TAU))
            .collect();
        let faint = self.tokens.evolute.gamma_multiply(0.6);
        self.chain(&chain, Stroke::new(1.0, faint));
        self.dashed_chain(&[at, centre], Stroke::new(1.0, faint));
        self.disc(centre, 2.5, self.tokens.evolute, Stroke::NONE);
    }
}

/// The figures of a drag in lines: difference, then place, with the digits of the vertex table.
fn drag_text(readout: &DragReadout, pixel: f64) -> String {
    let axes = if readout.in_space { 3 } else { 2 };
    let cell = |axis: usize, value: f64| Column::Axis(axis).shown(value, pixel).0;
    let columns = (0..axes).map(|axis| {
        let texts = [readout.by, readout.to].map(|vector| cell(axis, vector[axis]));
        let width = texts.iter().map(|text| text.chars().count()).max();
        (["x", "y", "z"][axis], texts, width.unwrap_or(0))
    });
    let columns: Vec<_> = columns.collect();
    let line = |row: usize, sign: &str| {
        let cells = columns.iter().map(|(name, texts, width)| {
            let text = &texts[row];
            format!("{sign}{name} {text:>width$}")
        });
        cells.collect::<Vec<String>>().join("  ")
    };
    let lines = [line(0, "Δ"), line(1, " ")].into_iter();
    let lines = lines.chain(readout.remarks.iter().cloned());
    lines.collect::<Vec<String>>().join("\n")
}

/// Whether a vertex is more than a disc of its polygon.
fn is_marked(vertex: &VertexMark) -> bool {
    vertex.selected || vertex.locked
}

/// The strength of what tells a curve from others, which fades less than what belongs to it.
fn own_strength(curve: &CurveScene) -> f32 {
    match (curve.active || curve.selected, curve.locked) {
        (true, false) => 1.0,
        (true, true) | (false, false) => 0.75,
        (false, true) => 0.5,
    }
}

/// How a curve steps back: inactive ones most, locked ones too.
fn fading(curve: &CurveScene) -> impl Fn(Color32) -> Color32 {
    let strength = match (curve.active, curve.locked) {
        (true, false) => 1.0,
        (true, true) => 0.65,
        (false, _) => 0.3,
    };
    move |colour| match strength < 1.0 {
        true => colour.gamma_multiply(strength),
        false => colour,
    }
}

/// Append a line that fades to both sides within `feather`.
fn hair(mesh: &mut Mesh, from: Pos2, to: Pos2, feather: f32, colour: Color32) {
    let along = to - from;
    if along.length_sq() < 0.01 {
        return;
    }
    let side = along.normalized().rot90() * feather;
    let first = mesh.vertices.len() as u32;
    for end in [from, to] {
        mesh.colored_vertex(end - side, Color32::TRANSPARENT);
        mesh.colored_vertex(end, colour);
        mesh.colored_vertex(end + side, Color32::TRANSPARENT);
    }
    for strip in [0, 1] {
        let [a, b, c, d] = [strip, strip + 1, strip + 3, strip + 4].map(|corner| first + corner);
        mesh.add_triangle(a, b, c);
        mesh.add_triangle(b, d, c);
    }
}
