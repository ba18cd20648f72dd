//! The losses of an export.

use std::collections::HashMap;
use std::fmt;

use crate::document::{Curve, Document, Group, Reference, first_quoted, quoted};
use crate::geometry::references::ReferenceForm;
use crate::geometry::{End, PolygonKind, counted, rounded_up};

/// A curve that moves by less than this share of its size has lost nothing that anybody could see or measure. Curves
/// converted to clamped knots and back move by up to about 1e-14.
const ROUNDING: f64 = 1e-12;

/// Hold the bytes of a file to write, and their losses.
#[derive(Clone, Debug, PartialEq)]
pub struct Export {
    /// The bytes of the file.
    pub bytes: Vec<u8>,
    /// The losses of the format.
    pub losses: LossReport,
}

/// List the losses of a written file. Shown as one line for each kind of loss, with the names of the first curves that
/// have it.
#[derive(Clone, Debug, PartialEq)]
pub struct LossReport {
    /// The name of the file's format.
    pub format: &'static str,
    /// The losses, each with the name of its curve or its reference.
    pub losses: Vec<(String, Loss)>,
    /// The losses of the document as a whole.
    pub of_document: Vec<DocumentLoss>,
}

/// Something that a file does not hold of a document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DocumentLoss {
    /// The unknown keys of the project.
    UnknownKeys,
    /// The guides.
    Guides,
    /// The unit: the format has none.
    Unit,
    /// That there is no unit: the format always has one.
    NoUnit,
}

impl DocumentLoss {
    fn text(self, format: &str) -> String {
        match self {
            Self::UnknownKeys => {
                format!("the project's unknown keys aren't stored in the {format}")
            }
            Self::Guides => format!("the guides aren't stored in the {format}"),
            Self::Unit => {
                format!(
                    "the unit isn't stored in the {format}, which has none: its numbers are those of the document"
                )
            }
            Self::NoUnit => {
                "the document has no unit: its numbers are written as millimetres".to_owned()
            }
        }
    }
}

/// Something that a file does not hold of a curve or a reference.
#[derive(Clone, Debug, PartialEq)]
pub enum Loss {
    /// The name, which was changed to one that the format allows.
    Name {
        /// The name written.
        written: String,
    },
    /// The name: the format has none beside that of the group.
    NoName,
    /// The format has no names of curves, or none but the first.
    Unnamed,
    /// The group, or the names of its path that the format does not allow.
    Group {
        /// The group written, if the format has groups.
        written: Option<Group>,
    },
    /// The curve's own colour.
    Colour,
    /// The curve's own colour, in whose place one is written that the format has.
    NearestColour,
    /// That the curve is hidden.
    Hidden,
    /// That the curve is locked.
    Locked,
    /// Which vertices are locked.
    LockedVertices,
    /// The targets of the ends.
    Targets,
    /// That the curve stays symmetric.
    Symmetry,
    /// A reference as a whole.
    Reference,
    /// A picture as a whole.
    Picture,
    /// How much each point of a reference counts.
    PointWeights,
    /// That no lines join the points of a reference.
    Apart,
    /// A curve as a whole.
    Curve,
    /// A curve or a reference as a whole, because of its shape.
    LeftOut {
        /// The shape, as "a spline of degree 9".
        what: String,
        /// Whether it is a curve.
        is_curve: bool,
    },
    /// A change of the name, the group or the colour: the file that is written back keeps its own.
    Kept {
        /// What it keeps.
        what: &'static str,
    },
    /// That it is a basic shape, as a circle: it is written as a path.
    AsPath {
        /// The element that it was.
        element: String,
    },
    /// That it is a circle, say: a spline of the same form is written.
    AsSpline {
        /// What it was.
        was: &'static str,
    },
    /// The attributes of the points of a contour.
    PointAttributes,
    /// That its contour closes.
    Opened,
    /// That an end is kept matched to another curve.
    Match {
        /// The end.
        end: End,
        /// The name of the other curve.
        source: String,
    },
    /// Its unknown keys.
    UnknownKeys,
    /// That the curve is periodic; it is written as an open one that ends where it begins.
    Periodic,
    /// The weights of a polygon that is drawn as plain lines.
    PolygonWeights {
        /// The polygon.
        kind: PolygonKind,
    },
    /// The curve itself: it is written as a chain of cubic Béziers.
    Cubics(CubicDifference),
    /// Digits: the float vertices that can be had back from the written polygon are off.
    Digits {
        /// The polygon written.
        kind: PolygonKind,
        /// By how much the worst one is off.
        distance: f64,
        /// A bound of how far the curve is off.
        curve: f64,
    },
    /// The way back: no usable float polygon can be had from the written polygon.
    NoWayBack {
        /// The polygon written.
        kind: PolygonKind,
    },
}

/// The difference between a curve and the cubic Béziers that are written, or between several and theirs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubicDifference {
    /// The number of Béziers.
    pub count: usize,
    /// How far they are off, measured.
    pub off: f64,
    /// The inflections of the curve, and as written.
    pub inflections: [usize; 2],
    /// The curvature extrema of the curve, and as written.
    pub curvature_extrema: [usize; 2],
    /// Whether the curvature jumps at joints.
    pub jumps: bool,
}

impl CubicDifference {
    /// Whether it is of the same kind: then sums say what becomes of each.
    fn is_like(&self, other: &Self) -> bool {
        let kind = |it: &Self| {
            let kinds = [it.inflections, it.curvature_extrema];
            (kinds.map(|[before, now]| before.cmp(&now)), it.jumps)
        };
        kind(self) == kind(other)
    }

    /// Add another one.
    fn add(&mut self, other: &Self) {
        self.count += other.count;
        self.off = self.off.max(other.off);
        for side in 0..2 {
            self.inflections[side] += other.inflections[side];
            self.curvature_extrema[side] += other.curvature_extrema[side];
        }
    }
}

impl fmt::Display for CubicDifference {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cubics = counted(self.count, "cubic Bézier", "cubic Béziers");
        let off = rounded_up(self.off);
        write!(formatter, "written as {cubics}, up to {off} off")?;
        let counts = [
            ("curvature extrema", self.curvature_extrema),
            ("inflections", self.inflections),
        ];
        for (kind, [before, now]) in counts
            .into_iter()
            .filter(|(_, [before, now])| before != now)
        {
            write!(formatter, "; {kind}: {before} before, {now} as written")?;
        }
        match self.jumps {
            true => formatter.write_str("; the curvature jumps at the joints"),
            false => Ok(()),
        }
    }
}

impl LossReport {
    /// Begin a report without losses.
    pub fn new(format: &'static str) -> Self {
        Self {
            format,
            losses: Vec::new(),
            of_document: Vec::new(),
        }
    }

    /// Whether nothing is lost.
    pub fn is_empty(&self) -> bool {
        self.losses.is_empty() && self.of_document.is_empty()
    }

    /// Take out the digits that the curves of a document lose by rounding alone, as a report of their own.
    pub fn take_rounding(&mut self, document: &Document) -> Self {
        // Of curves that share a name the smallest counts.
        let mut sizes: HashMap<&str, f64> = HashMap::new();
        for (_, curve) in document.curves() {
            let size = curve.polygon.size();
            let least = sizes.entry(curve.name.as_str()).or_insert(size);
            *least = least.min(size);
        }
        let is_rounding = |name: &str, loss: &Loss| match loss {
            Loss::Digits { curve, .. } => {
                *curve <= ROUNDING * sizes.get(name).copied().unwrap_or_default()
            }
            _ => false,
        };
        let all = std::mem::take(&mut self.losses).into_iter();
        let (rounding, lost) = all.partition(|(name, loss)| is_rounding(name, loss));
        self.losses = lost;
        Self {
            losses: rounding,
            ..Self::new(self.format)
        }
    }

    /// Add what a document has beside its curves and references.
    pub(super) fn add_document(&mut self, document: &Document) {
        let keys = (!document.extras().is_empty()).then_some(DocumentLoss::UnknownKeys);
        let guides = (!document.guide_lines().is_empty()).then_some(DocumentLoss::Guides);
        self.of_document
            .extend([keys, guides].into_iter().flatten());
    }

    /// How many curves and references are not written at all.
    pub fn left_out(&self) -> [usize; 2] {
        let is_left_out = |loss: &Loss, of_curves: bool| match loss {
            Loss::Curve => of_curves,
            Loss::Reference | Loss::Picture => !of_curves,
            Loss::LeftOut { is_curve, .. } => *is_curve == of_curves,
            _ => false,
        };
        [true, false].map(|of_curves| {
            let losses = self.losses.iter();
            losses
                .filter(|(_, loss)| is_left_out(loss, of_curves))
                .count()
        })
    }

    /// Which curve or reference was left out first because of its shape, and why.
    pub(super) fn first_left_out(&self) -> Option<String> {
        self.losses.iter().find_map(|(name, loss)| match loss {
            Loss::LeftOut { what, .. } => Some(format!(
                "{} is {what}, which {} cannot hold",
                quoted(name),
                self.format
            )),
            _ => None,
        })
    }

    /// Add a loss of one curve.
    pub fn add(&mut self, curve: &Curve, loss: Loss) {
        self.losses.push((curve.name.clone(), loss));
    }

    /// Add losses of one curve.
    pub fn extend(&mut self, curve: &Curve, losses: impl IntoIterator<Item = Loss>) {
        for loss in losses {
            self.add(curve, loss);
        }
    }

    /// Add what every format but Batten's own loses of a curve.
    pub fn add_attributes(&mut self, curve: &Curve) {
        self.add_if(curve.colour.is_some(), curve, Loss::Colour);
        self.add_own_attributes(curve);
    }

    /// Add what every format but Batten's own loses of a curve, the colour apart.
    pub fn add_own_attributes(&mut self, curve: &Curve) {
        let has_locks = !curve.locked_vertices.is_empty();
        self.add_if(has_locks, curve, Loss::LockedVertices);
        let has_targets = !curve.targets.list().is_empty();
        self.add_if(has_targets, curve, Loss::Targets);
        self.add_if(curve.symmetry.is_some(), curve, Loss::Symmetry);
        self.add_if(!curve.extras.is_empty(), curve, Loss::UnknownKeys);
    }

    /// Add the loss of the group of a curve or a reference of which a file holds other names.
    pub fn add_group(&mut self, name: &str, group: &Group, written: Group) {
        if *group != written {
            let written = Some(written).filter(|written| !written.is_none());
            self.losses.push((name.to_owned(), Loss::Group { written }));
        }
    }

    /// Add that a curve is not written.
    pub fn add_curve(&mut self, curve: &Curve) {
        self.add(curve, Loss::Curve);
    }

    /// Add that a reference is not written.
    pub fn add_reference(&mut self, reference: &Reference) {
        self.losses.push((reference.name.clone(), Loss::Reference));
    }

    /// Add what every format but Batten's own loses of a list of points.
    pub fn add_point_weights(&mut self, reference: &Reference) {
        if reference.weights().is_some() {
            self.losses
                .push((reference.name.clone(), Loss::PointWeights));
        }
    }

    /// Add that a curve or a reference is hidden or locked.
    pub fn add_state(&mut self, name: &str, visible: bool, locked: bool) {
        self.add_where(name, [(!visible, Loss::Hidden), (locked, Loss::Locked)]);
    }

    fn add_where(&mut self, name: &str, losses: [(bool, Loss); 2]) {
        let lost = losses.into_iter().filter(|(is_lost, _)| *is_lost);
        let lost = lost.map(|(_, loss)| (name.to_owned(), loss));
        self.losses.extend(lost);
    }

    /// Add what tables lose of a list of points.
    pub fn add_list(&mut self, reference: &Reference) {
        self.add_point_weights(reference);
        let name = &reference.name;
        let form = reference.curve.form();
        let is_apart = matches!(form, ReferenceForm::Points(list) if list.is_apart());
        let is_coloured = reference.colour.is_some();
        self.add_where(name, [(is_coloured, Loss::Colour), (is_apart, Loss::Apart)]);
        self.add_state(name, reference.visible, reference.locked);
        self.add_group(name, &reference.group, Group::default());
    }

    /// Add the matches of a document's curves, of those that are written: every format but Batten's own
    /// loses them.
    pub fn add_matches(&mut self, document: &Document, is_written: impl Fn(&Curve) -> bool) {
        for matched in document.matches() {
            let pair = document
                .curve(matched.curve)
                .zip(document.name(matched.source));
            if let Some((curve, source)) = pair.filter(|(curve, _)| is_written(curve)) {
                let (end, source) = (matched.end, source.to_owned());
                self.add(curve, Loss::Match { end, source });
            }
        }
    }

    /// Add a loss of one curve where `is_lost`.
    pub fn add_if(&mut self, is_lost: bool, curve: &Curve, loss: Loss) {
        if is_lost {
            self.add(curve, loss);
        }
    }
}

impl fmt::Display for LossReport {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let format = self.format;
        let mut groups: Vec<Alike> = Vec::new();
        for (name, loss) in &self.losses {
            if !groups.iter_mut().any(|group| group.takes(name, loss)) {
                groups.push(Alike::new(name, loss));
            }
        }
        let of_curves = groups.iter().map(|group| {
            format!(
                "{}: {}",
                first_quoted(&group.names),
                group.loss.text(format, group.differs)
            )
        });
        let of_document = self.of_document.iter();
        let of_document = of_document.map(|loss| loss.text(format));
        let lines: Vec<String> = of_curves.chain(of_document).collect();
        formatter.write_str(&lines.join("\n"))
    }
}

/// Losses of one kind, told in one line.
struct Alike<'l> {
    names: Vec<&'l str>,
    /// The loss, with the largest figures of all.
    loss: Loss,
    /// Whether they differ in names.
    differs: bool,
}

impl<'l> Alike<'l> {
    fn new(name: &'l str, loss: &Loss) -> Self {
        Self {
            names: vec![name],
            loss: loss.clone(),
            differs: false,
        }
    }

    /// Add a loss of the same kind. Returns whether it is one.
    fn takes(&mut self, name: &'l str, loss: &Loss) -> bool {
        match (&mut self.loss, loss) {
            (
                Loss::Digits {
                    kind,
                    distance,
                    curve,
                },
                Loss::Digits {
                    kind: other,
                    distance: farther,
                    curve: off,
                },
            ) if kind == other => {
                *distance = distance.max(*farther);
                *curve = curve.max(*off);
            }
            (Loss::Cubics(own), Loss::Cubics(other)) if own.is_like(other) => own.add(other),
            (Loss::Name { written }, Loss::Name { written: other }) => {
                self.differs |= written != other;
            }
            (
                Loss::Group {
                    written: Some(written),
                },
                Loss::Group {
                    written: Some(other),
                },
            ) => self.differs |= written != other,
            (own @ Loss::Match { .. }, Loss::Match { .. }) => self.differs |= own != loss,
            (own, _) if own == loss => {}
            _ => return false,
        }
        if self.names.last() != Some(&name) {
            self.names.push(name);
        }
        true
    }
}

impl Loss {
    /// What is lost in a format; `differs` where curves lose it with different names.
    fn text(&self, format: &str, differs: bool) -> String {
        let lost = |what: &str| format!("{what} stored in the {format}");
        match self {
            Self::Name { .. } if differs => format!("names are written as {format} allows"),
            Self::Name { written } => {
                let written = quoted(written);
                format!("the name is written as {written}, which {format} allows")
            }
            Self::NoName => lost("the name of a curve in a group isn't"),
            Self::Unnamed => lost("the name isn't"),
            Self::Group { written: None } => lost("the group isn't"),
            Self::Group { .. } if differs => format!("groups are written as {format} allows"),
            Self::Group {
                written: Some(written),
            } => {
                let written = quoted(&written.to_string());
                format!("the group is written as {written}, which {format} allows")
            }
            Self::Digits {
                kind,
                distance,
                curve,
            } => format!(
                "converted back from the {kind} polygon written, the float vertices are off by up to {}, the curve by up to {}",
                rounded_up(*distance),
                rounded_up(*curve)
            ),
            Self::NoWayBack { kind } => {
                format!("the {kind} polygon written cannot be converted back to a float polygon")
            }
            Self::Cubics(difference) => difference.to_string(),
            Self::Periodic => "written as an open curve that ends where it begins".to_owned(),
            Self::PolygonWeights { kind } => {
                format!("the {kind} polygon is drawn without its weights")
            }
            Self::Reference => lost("references aren't"),
            Self::Picture => lost("pictures aren't"),
            Self::PointWeights => lost("weights of points aren't"),
            Self::Apart => {
                format!("points that stand apart are joined by lines when the {format} is read")
            }
            Self::Curve => lost("curves aren't"),
            // A curve of any degree is written as cubics.
            Self::LeftOut { what, is_curve } if !is_curve && what.contains("spline") => format!(
                "left out: {what}, which {format} cannot hold; a float polygon made of it can be written"
            ),
            Self::LeftOut { what, .. } => {
                format!("left out: {what}, which {format} cannot hold")
            }
            Self::Kept { what } => format!("the {format} keeps the old {what}"),
            Self::AsPath { element } => format!("the {element} becomes a path"),
            Self::AsSpline { was } => {
                format!("the {was} becomes a spline of the same form in the {format}")
            }
            Self::Opened => "its contour does not close any more".to_owned(),
            Self::PointAttributes => "names and smoothness of its points are lost".to_owned(),
            Self::Colour => lost("the colour isn't"),
            Self::NearestColour => {
                format!("the colour is written as the nearest that {format} has")
            }
            Self::Hidden => lost("visibility isn't"),
            Self::Locked => lost("the lock isn't"),
            Self::LockedVertices => lost("vertex locks aren't"),
            Self::Targets => lost("end targets aren't"),
            Self::Symmetry => lost("the rule of symmetry isn't"),
            Self::Match { .. } if differs => lost("matches of ends aren't"),
            Self::Match { end, source } => {
                let (end, source) = (end.name(), quoted(source));
                lost(&format!("the match of its {end} to {source} isn't"))
            }
            Self::UnknownKeys => lost("unknown keys aren't"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Colour;
    use crate::geometry::FloatPolygon;
    use crate::geometry::references::{PointList, ReferenceCurve};
    use crate::io::formats;
    use glam::DVec3;

    #[test]
    fn losses_of_one_kind_are_one_line_with_the_first_names_and_the_largest_figures() {
        let mut report = LossReport::new("SVG");
        for index in 1..=60 {
            let name = format!("c{index}");
            report.losses.push((name.clone(), Loss::Colour));
            let difference = CubicDifference {
                count: index,
                off: f64::from(index as u8) / 1024.0,
                ..KEPT
            };
            report.losses.push((name, Loss::Cubics(difference)));
        }
        let written = |name: &str| Loss::Name {
            written: name.to_owned(),
        };
        report.losses.push(("a/b".to_owned(), written("a_b")));
        assert_eq!(
            report.to_string(),
            "“c1”, “c2”, “c3” and 57 others: the colour isn't stored in the SVG\n\
             “c1”, “c2”, “c3” and 57 others: written as 1830 cubic Béziers, up to 0.059 off\n\
             “a/b”: the name is written as “a_b”, which SVG allows"
        );
        report.losses.push(("c/d".to_owned(), written("c_d")));
        let told = report.to_string();
        assert!(
            told.ends_with("\n“a/b” and “c/d”: names are written as SVG allows"),
            "{told}"
        );
    }

    /// A difference without a change of features.
    const KEPT: CubicDifference = CubicDifference {
        count: 1,
        off: 0.0,
        inflections: [1; 2],
        curvature_extrema: [2; 2],
        jumps: false,
    };

    #[test]
    fn curves_whose_features_change_alike_are_told_together() {
        let mut report = LossReport::new("SVG");
        let mut add = |name: &str, curvature_extrema, jumps| {
            let difference = CubicDifference {
                curvature_extrema,
                jumps,
                ..KEPT
            };
            let loss = Loss::Cubics(difference);
            report.losses.push((name.to_owned(), loss));
        };
        add("more", [2, 5], true);
        add("kept", [3, 3], false);
        add("fewer", [3, 1], true);
        add("more too", [0, 2], true);
        assert_eq!(
            report.to_string(),
            "“more” and “more too”: written as 2 cubic Béziers, up to 0 off; \
             curvature extrema: 2 before, 7 as written; the curvature jumps at the joints\n\
             “kept”: written as 1 cubic Bézier, up to 0 off\n\
             “fewer”: written as 1 cubic Bézier, up to 0 off; \
             curvature extrema: 3 before, 1 as written; the curvature jumps at the joints"
        );
    }

    #[test]
    fn what_is_not_written_is_counted() {
        let mut report = LossReport::new("SVG");
        let left_out = |is_curve| Loss::LeftOut {
            what: "a spline of degree 9".to_owned(),
            is_curve,
        };
        for loss in [Loss::Curve, left_out(true), Loss::Reference, Loss::Colour] {
            report.losses.push(("a".to_owned(), loss));
        }
        assert_eq!(report.left_out(), [2, 1]);
        let why = "“a” is a spline of degree 9, which SVG cannot hold";
        assert_eq!(report.first_left_out().as_deref(), Some(why));
    }

    #[test]
    fn shapes_that_a_format_has_not_are_told() {
        let made = |form: &str| {
            let curve = ReferenceCurve::from_text(form).expect("a curve");
            Reference::new(form, curve)
        };
        let corners = PointList::new(vec![DVec3::ZERO, DVec3::X, DVec3::ONE]).expect("a list");
        let polyline = ReferenceCurve::of(ReferenceForm::Points(corners)).expect("a polyline");
        let references = [
            made("circle"),
            made("ellipse:a=2,b=1"),
            Reference::new("polyline", polyline),
        ];
        let document = Document::default().with_references(references);
        for (extension, expected) in [
            ("json", &["circle", "ellipse", "polyline"][..]),
            ("obj", &["circle", "ellipse"]),
            ("3dm", &["ellipse"]),
            ("step", &[]),
            ("igs", &[]),
            ("brep", &[]),
            ("dxf", &[]),
        ] {
            let format = formats::find(extension).expect("a format");
            let export = format.write(&document, None).expect("written");
            let losses = export.losses.losses.iter();
            let told: Vec<&str> = losses
                .filter_map(|(_, loss)| match loss {
                    Loss::AsSpline { was } => Some(*was),
                    _ => None,
                })
                .collect();
            assert_eq!(told, expected, "{extension}");
        }
    }

    #[test]
    fn names_and_colours_that_a_format_has_not_are_told() {
        let vertices = [(0.0, 0.0), (1.0, 2.0), (3.0, 1.0), (4.0, 4.0)];
        let polygon = FloatPolygon::planar(3, &vertices).expect("a polygon");
        let curves = ["hull", "deck"].map(|name| Curve {
            colour: Some(Colour([200, 30, 30])),
            ..Curve::new(name, polygon.clone())
        });
        let document = Document::from_curves(curves);
        for (extension, names, colours) in [
            ("brep", false, false),
            ("glif", false, false),
            ("obj", true, false),
            ("json", true, false),
            ("dxf", true, true),
            ("step", true, true),
            ("igs", true, true),
            ("3dm", true, true),
            ("svg", true, true),
        ] {
            let format = formats::find(extension).expect("a format");
            let export = format.write(&document, None).expect("written");
            let told = export.losses.to_string();
            let tells = |what: &str| told.contains(&format!("“hull” and “deck”: {what}"));
            let is_told = match extension {
                "glif" => {
                    told.contains("“deck”: the name isn't stored")
                        && !told.contains("“hull”: the name")
                }
                _ => tells("the name isn't stored"),
            };
            assert_eq!(is_told, !names, "{extension}: {told}");
            assert_eq!(
                tells("the colour isn't stored"),
                !colours,
                "{extension}: {told}"
            );
        }
    }
}
