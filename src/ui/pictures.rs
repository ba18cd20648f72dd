//! Paints pictures to trace, over the grid and behind the curves, from tiles that are handed to the graphics card.

use std::collections::HashMap;
use std::sync::Arc;

use eframe::egui::{
    Align2, Color32, ColorImage, Context, Mesh, Pos2, Rect, Shape, TextureHandle, TextureOptions,
    pos2,
};
use glam::DVec2;

use super::brush::Brush;
use super::theme;
use crate::editor::{PictureScene, PictureTile, Pyramid, TILE};
use crate::io::Decoded;

/// The most tiles that are handed over in a frame, so that none takes long.
const MOST_A_FRAME: usize = 4;

/// The most tiles that are kept on the graphics card: 256 MB.
const MOST_KEPT: usize = 256;

/// The tiles on the graphics card.
#[derive(Default)]
pub struct PictureTextures {
    kept: HashMap<TileId, KeptTile>,
    /// The number of the frame.
    frame: u64,
    /// How many tiles this frame has handed over.
    handed: usize,
}

/// The address of a picture, a level and a tile of it.
type TileId = (usize, usize, [u32; 2]);

struct KeptTile {
    texture: TextureHandle,
    /// Keeps the address its own.
    _picture: Arc<Pyramid>,
    used: u64,
}

/// A picture in its frame on the screen.
struct Placed<'a> {
    picture: &'a Arc<Pyramid>,
    /// The upper left corner.
    corner: DVec2,
    /// The vectors along the upper and along the left side, downwards.
    sides: [DVec2; 2],
    tint: Color32,
}

impl PictureTextures {
    /// Begin a frame, in which each pane paints pictures: forget tiles that none used in the last one, if there are many.
    pub fn begin_frame(&mut self) {
        if self.kept.len() > MOST_KEPT {
            let last = self.frame;
            self.kept.retain(|_, tile| tile.used == last);
        }
        self.frame += 1;
        self.handed = 0;
    }

    /// Paint pictures from back to front.
    pub fn paint(&mut self, brush: &Brush<'_>, pictures: &[PictureScene]) {
        for scene in pictures {
            let [across, up] = scene.sides;
            let corner = brush.screen.exact(scene.corner + up);
            let to_screen = |side: DVec2| brush.screen.exact(scene.corner + up + side) - corner;
            let sides = [to_screen(across), to_screen(-up)];
            match &scene.picture {
                Ok(picture) => {
                    let strength = (scene.opacity * f64::from(u8::MAX)).round() as u8;
                    let placed = Placed {
                        picture,
                        corner,
                        sides,
                        tint: Color32::from_white_alpha(strength),
                    };
                    self.paint_picture(brush, &placed);
                }
                Err(reason) => paint_reason(brush, corner + 0.5 * (sides[0] + sides[1]), reason),
            }
        }
    }

    fn paint_picture(&mut self, brush: &Brush<'_>, placed: &Placed<'_>) {
        let levels = placed.picture.levels();
        let Some(seen) = placed.seen(brush.rect) else {
            return;
        };
        let level = placed.level(brush.painter.ctx().pixels_per_point());
        let Some(counts) = levels.get(level).map(|level| level.counts()) else {
            return;
        };
        let range = |axis: usize| {
            let tiles = f64::from(levels[level].size[axis]) / f64::from(TILE);
            let [from, to] = seen[axis].map(|share| share * tiles);
            (from.floor() as u32)..(to.ceil() as u32).min(counts[axis])
        };
        for row in range(1) {
            for column in range(0) {
                self.paint_tile(brush, placed, level, [column, row]);
            }
        }
    }

    /// Paint a tile, or as long as it is not on the graphics card the part of a coarser one.
    fn paint_tile(
        &mut self,
        brush: &Brush<'_>,
        placed: &Placed<'_>,
        level: usize,
        place: [u32; 2],
    ) {
        let levels = placed.picture.levels();
        let Some(tile) = levels.get(level).and_then(|level| level.tile(place)) else {
            return;
        };
        let shares = shares(tile, levels[level].size);
        for (above, coarser) in levels.iter().enumerate().skip(level) {
            let place = place.map(|it| it >> (above - level));
            let Some(found) = coarser.tile(place) else {
                return;
            };
            let id = (Arc::as_ptr(placed.picture) as usize, above, place);
            let is_last = above + 1 == levels.len();
            let texture = self.texture(brush.painter.ctx(), (id, placed.picture), found, is_last);
            if let Some(texture) = texture {
                let pixels = coarser.size.map(f64::from);
                let uv = shares.map(|share| {
                    let [x, y] = [0, 1].map(|axis| {
                        let pixel = share[axis] * pixels[axis] - f64::from(found.at[axis]);
                        (pixel / f64::from(found.size[axis])) as f32
                    });
                    pos2(x, y)
                });
                placed.paint(brush, &texture, shares, uv);
                return;
            }
        }
    }

    /// The tile on the graphics card; hands it over if this frame may, or must.
    fn texture(
        &mut self,
        context: &Context,
        (id, picture): (TileId, &Arc<Pyramid>),
        tile: &PictureTile,
        must: bool,
    ) -> Option<TextureHandle> {
        let frame = self.frame;
        if let Some(kept) = self.kept.get_mut(&id) {
            kept.used = frame;
            return Some(kept.texture.clone());
        }
        if self.handed >= MOST_A_FRAME && !must {
            context.request_repaint();
            return None;
        }
        self.handed += 1;
        let size = tile.size.map(|side| side as usize);
        let image = ColorImage::from_rgba_premultiplied(size, &tile.rgba);
        let texture = context.load_texture("picture", image, TextureOptions::LINEAR);
        let kept = KeptTile {
            texture: texture.clone(),
            _picture: picture.clone(),
            used: frame,
        };
        self.kept.insert(id, kept);
        Some(texture)
    }
}

impl Placed<'_> {
    /// The shares of the width and of the height between which the picture is seen; `None` if it is not, or from its edge.
    fn seen(&self, rect: Rect) -> Option<[[f64; 2]; 2]> {
        let [across, down] = self.sides;
        let area = across.perp_dot(down);
        if !(area.abs() >= 1.0) {
            return None;
        }
        let corners = [
            rect.left_top(),
            rect.right_top(),
            rect.right_bottom(),
            rect.left_bottom(),
        ];
        let shares = corners.map(|corner| {
            let by = DVec2::new(corner.x.into(), corner.y.into()) - self.corner;
            [by.perp_dot(down) / area, across.perp_dot(by) / area]
        });
        let seen = [0, 1].map(|axis| {
            let own = shares.map(|share| share[axis]);
            let low = own.into_iter().fold(f64::INFINITY, f64::min);
            let high = own.into_iter().fold(f64::NEG_INFINITY, f64::max);
            [low.clamp(0.0, 1.0), high.clamp(0.0, 1.0)]
        });
        seen.iter().all(|[low, high]| low < high).then_some(seen)
    }

    /// The largest size whose pixels are hardly smaller than the screen's.
    fn level(&self, pixels_per_point: f32) -> usize {
        let pixels = self.picture.size().map(f64::from);
        let shown = self
            .sides
            .map(|side| side.length() * f64::from(pixels_per_point));
        let times = (pixels[0] / shown[0]).min(pixels[1] / shown[1]);
        let halvings = times.log2().floor().max(0.0) as usize;
        halvings.min(self.picture.levels().len() - 1)
    }

    fn paint(
        &self,
        brush: &Brush<'_>,
        texture: &TextureHandle,
        shares: [[f64; 2]; 2],
        [low, high]: [Pos2; 2],
    ) {
        let [[left, top], [right, bottom]] = shares;
        let at = |x: f64, y: f64| {
            let place = self.corner + x * self.sides[0] + y * self.sides[1];
            pos2(place.x as f32, place.y as f32)
        };
        let mut mesh = Mesh::with_texture(texture.id());
        let corners = [
            (at(left, top), low),
            (at(right, top), pos2(high.x, low.y)),
            (at(right, bottom), high),
            (at(left, bottom), pos2(low.x, high.y)),
        ];
        for (pos, uv) in corners {
            mesh.vertices.push(eframe::egui::epaint::Vertex {
                pos,
                uv,
                color: self.tint,
            });
        }
        mesh.indices.extend([0, 1, 2, 0, 2, 3]);
        brush.painter.add(Shape::mesh(mesh));
    }
}

/// The corners of a tile as shares of the width and of the height of its picture.
fn shares(tile: &PictureTile, size: [u32; 2]) -> [[f64; 2]; 2] {
    let share =
        |pixels: [u32; 2]| [0, 1].map(|axis| f64::from(pixels[axis]) / f64::from(size[axis]));
    [
        share(tile.at),
        share([0, 1].map(|axis| tile.at[axis] + tile.size[axis])),
    ]
}

/// Say in the middle of a frame why it shows no picture.
fn paint_reason(brush: &Brush<'_>, middle: DVec2, reason: &str) {
    let at = pos2(middle.x as f32, middle.y as f32);
    let colour = brush.tokens.faint_text;
    if brush.rect.contains(at) {
        let painter = brush.painter;
        painter.text(
            at,
            Align2::CENTER_CENTER,
            reason,
            theme::small_font(),
            colour,
        );
    }
}

/// The pixels of a picture of the clipboard.
pub fn decoded(image: &ColorImage) -> Decoded {
    let pixels = image.pixels.iter().flat_map(Color32::to_srgba_unmultiplied);
    Decoded {
        size: image.size.map(|side| side as u32),
        rgba: pixels.collect(),
    }
}
