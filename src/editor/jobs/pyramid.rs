//! A decoded picture at several sizes, each in tiles: what the canvas shows of it is never much finer than its points.

use crate::io::Decoded;

/// The side of a tile in pixels. Larger tiles take longer to hand over in a frame, smaller ones are more to draw.
pub const TILE: u32 = 512;

/// Bytes a pixel.
const BYTES: usize = 4;

/// A picture at full size, then at half of it, and so on to one tile.
#[derive(Clone, Debug, PartialEq)]
pub struct Pyramid {
    levels: Vec<PictureLevel>,
}

/// A picture at one size.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureLevel {
    /// The width and the height in pixels.
    pub size: [u32; 2],
    /// The tiles row by row from the top; all but the last of a row and of a column have sides of [`TILE`].
    tiles: Vec<PictureTile>,
}

/// A tile of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureTile {
    /// The pixels to its left and above it.
    pub at: [u32; 2],
    /// The width and the height in pixels.
    pub size: [u32; 2],
    /// Red, green, blue, each times the opacity, and the opacity of each pixel, row by row from the top.
    pub rgba: Vec<u8>,
}

impl Pyramid {
    /// Divide a picture, and halve it until it fits into one tile.
    pub fn of(picture: Decoded) -> Self {
        let mut picture = premultiplied(picture);
        let mut levels = Vec::new();
        loop {
            levels.push(PictureLevel::of(&picture));
            if picture.size.iter().all(|side| *side <= TILE) {
                return Self { levels };
            }
            picture = halved(&picture);
        }
    }

    /// The picture at its sizes, the largest first: at least one.
    pub fn levels(&self) -> &[PictureLevel] {
        &self.levels
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.levels.first().map_or([1; 2], |level| level.size)
    }

    /// The brightness of a pixel from 0 to 1 on white ground; `None` outside of the picture. Columns are counted from
    /// the left, rows from the top.
    pub fn brightness(&self, [column, row]: [u32; 2]) -> Option<f64> {
        let level = self.levels.first()?;
        let tile = level.tile([column / TILE, row / TILE])?;
        let [x, y] = [column - tile.at[0], row - tile.at[1]];
        if x >= tile.size[0] {
            return None;
        }
        let start = BYTES * (y * tile.size[0] + x) as usize;
        let [red, green, blue, opacity] = *tile.rgba.get(start..start + BYTES)? else {
            return None;
        };
        // The weights of the eye (Rec. 601).
        let [red, green, blue] = [red, green, blue].map(f64::from);
        let light = 0.299 * red + 0.587 * green + 0.114 * blue;
        Some((light + f64::from(u8::MAX - opacity)) / f64::from(u8::MAX))
    }
}

impl PictureLevel {
    fn of(picture: &Decoded) -> Self {
        let [columns, rows] = picture.size.map(|side| side.div_ceil(TILE));
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row]));
        Self {
            size: picture.size,
            tiles: places.map(|place| tile(picture, place)).collect(),
        }
    }

    /// The number of tiles in a row and in a column.
    pub fn counts(&self) -> [u32; 2] {
        self.size.map(|side| side.div_ceil(TILE))
    }

    /// A tile by its column and its row.
    pub fn tile(&self, [column, row]: [u32; 2]) -> Option<&PictureTile> {
        let [columns, rows] = self.counts();
        let index = row as usize * columns as usize + column as usize;
        let is_inside = column < columns && row < rows;
        self.tiles.get(index).filter(|_| is_inside)
    }
}

/// Cut a tile out of a picture.
fn tile(picture: &Decoded, place: [u32; 2]) -> PictureTile {
    let at = place.map(|it| it * TILE);
    let size = [0, 1].map(|axis| (picture.size[axis] - at[axis]).min(TILE));
    let stride = BYTES * picture.size[0] as usize;
    let width = BYTES * size[0] as usize;
    let mut rgba = Vec::with_capacity(width * size[1] as usize);
    for row in picture
        .rgba
        .chunks(stride)
        .skip(at[1] as usize)
        .take(size[1] as usize)
    {
        let start = BYTES * at[0] as usize;
        rgba.extend_from_slice(row.get(start..start + width).unwrap_or_default());
    }
    PictureTile { at, size, rgba }
}

/// Multiply colours by the opacity.
fn premultiplied(mut picture: Decoded) -> Decoded {
    for pixel in picture.rgba.chunks_exact_mut(BYTES) {
        if let [colours @ .., opacity] = pixel
            && *opacity != u8::MAX
        {
            for colour in colours {
                let product = u16::from(*colour) * u16::from(*opacity);
                *colour = ((product + 127) / 255) as u8;
            }
        }
    }
    picture
}

/// Halve both sides: each pixel is the mean of four, at an odd edge of two or one.
fn halved(picture: &Decoded) -> Decoded {
    let size = picture.size.map(|side| side.div_ceil(2));
    let stride = BYTES * picture.size[0] as usize;
    let mut rgba = Vec::with_capacity(BYTES * size[0] as usize * size[1] as usize);
    for rows in picture.rgba.chunks(2 * stride) {
        let (upper, lower) = rows.split_at(stride.min(rows.len()));
        let lower = if lower.is_empty() { upper } else { lower };
        for (upper, lower) in upper.chunks(2 * BYTES).zip(lower.chunks(2 * BYTES)) {
            let last = upper.len() - BYTES;
            for channel in 0..BYTES {
                let of = |row: &[u8]| u16::from(row[channel]) + u16::from(row[last + channel]);
                rgba.push(((of(upper) + of(lower) + 2) / 4) as u8);
            }
        }
    }
    Decoded { size, rgba }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture whose pixels tell their places.
    fn picture([width, height]: [u32; 2]) -> Decoded {
        let rows = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        let rgba = rows.flat_map(|[x, y]| [x as u8, y as u8, (x >> 8) as u8, u8::MAX]);
        Decoded {
            size: [width, height],
            rgba: rgba.collect(),
        }
    }

    #[test]
    fn tiles_are_the_picture() {
        for size in [[1, 1], [512, 512], [513, 511], [1500, 700]] {
            let whole = picture(size);
            let pyramid = Pyramid::of(whole.clone());
            assert_eq!(pyramid.size(), size);
            let level = &pyramid.levels()[0];
            for y in 0..size[1] {
                for x in 0..size[0] {
                    let tile = level.tile([x / TILE, y / TILE]).expect("a tile");
                    let at = 4 * ((y - tile.at[1]) * tile.size[0] + x - tile.at[0]) as usize;
                    let there = 4 * (y * size[0] + x) as usize;
                    assert_eq!(tile.rgba[at..at + 4], whole.rgba[there..there + 4]);
                }
            }
            let last = pyramid.levels().last().expect("a level");
            assert_eq!(last.counts(), [1, 1]);
            assert_eq!(level.tile([size[0], 0]), None);
        }
    }

    #[test]
    fn each_size_has_the_mean_of_the_one_before() {
        let size = [1025, 3];
        let mut even = picture(size);
        even.rgba.fill(200);
        for level in Pyramid::of(even).levels() {
            let tiles = (0..level.counts()[0]).filter_map(|column| level.tile([column, 0]));
            // 200 times 200 / 255.
            let is_even = |tile: &PictureTile| {
                let mut pixels = tile.rgba.chunks(4);
                pixels.all(|pixel| *pixel == [157, 157, 157, 200])
            };
            assert!(tiles.into_iter().all(is_even));
        }
        let widths = Pyramid::of(picture(size));
        let widths = widths.levels().iter().map(|it| it.size);
        assert_eq!(widths.collect::<Vec<_>>(), [[1025, 3], [513, 2], [257, 1]]);
    }

    #[test]
    fn brightness_is_that_of_the_pixel_on_white() {
        let rgba = vec![0, 0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 0, 255, 0, 0, 255];
        let size = [2, 2];
        let pyramid = Pyramid::of(Decoded { size, rgba });
        let at = |place| pyramid.brightness(place);
        assert_eq!(at([0, 0]), Some(0.0));
        assert!((at([1, 0]).expect("white") - 1.0).abs() < 1e-12);
        assert!((at([0, 1]).expect("nothing") - 1.0).abs() < 1e-12);
        assert_eq!(at([1, 1]), Some(0.299));
        assert_eq!((at([2, 0]), at([0, 2])), (None, None));
    }
}
