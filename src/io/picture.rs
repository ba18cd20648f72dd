//! Pictures to trace: PNG, JPEG, WebP and TIFF.

use std::io::Cursor;
use std::sync::Arc;

use exif::{In, Tag, Value};
use glam::DVec2;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::metadata::Orientation;
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder, ImageReader, Limits};

use super::error::{Problem, ReadError};
use super::format::{FileUnit, Format};
use super::reading::{Reading, Remark};
use crate::document::{Picture, PictureSource, Reference};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::{Frame, ReferenceCurve, ReferenceForm};

/// The resolution of a picture that names none, in pixels an inch.
const ASSUMED: f64 = 96.0;

/// Lengths of an inch, of a centimetre and of a metre, in millimetres.
const INCH: f64 = 25.4;
const CENTIMETRE: f64 = 10.0;
const METRE: f64 = 1000.0;

/// The most bytes that decoding a picture may take: 16 000 pixels square.
const MOST_BYTES: u64 = 1 << 30;

/// The row of the table of formats.
pub static PICTURE: Format = Format {
    name: "picture",
    extensions: &["png", "jpg", "jpeg", "webp", "tif", "tiff"],
    read: Some(read),
    write: None,
    write_back: None,
    rewrite: None,
    read_chosen: None,
    draw: None,
    file_unit: FileUnit::Optional,
    holds_documents: false,
    exports: &[],
};

/// A picture's pixels, as it is shown.
#[derive(Clone, Debug)]
pub struct Decoded {
    /// The width and the height in pixels.
    pub size: [u32; 2],
    /// Red, green, blue and opacity of each pixel, row by row from the top.
    pub rgba: Vec<u8>,
}

/// Decode a picture and turn it as its file says.
///
/// # Errors
/// [`Problem::Picture`] if the bytes are no such picture, or too many pixels.
pub fn decode(bytes: &[u8]) -> Result<Decoded, Problem> {
    let mut decoder = decoder(bytes)?;
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    // The decoder's limits are those of its own buffers.
    if decoder.total_bytes() > MOST_BYTES {
        let [width, height] = <[u32; 2]>::from(decoder.dimensions());
        let reason = format!("{width} × {height} pixels are too many");
        return Err(Problem::Picture(reason));
    }
    let mut picture = DynamicImage::from_decoder(decoder).map_err(unreadable)?;
    picture.apply_orientation(orientation);
    let picture = picture.into_rgba8();
    Ok(Decoded {
        size: picture.dimensions().into(),
        rgba: picture.into_raw(),
    })
}

impl Decoded {
    /// Write the pixels as a PNG, quickly rather than small.
    ///
    /// # Errors
    /// [`Problem::Picture`] if there are none, or fewer than the size says.
    pub fn to_png(&self) -> Result<Vec<u8>, Problem> {
        let mut bytes = Vec::new();
        let encoder =
            PngEncoder::new_with_quality(&mut bytes, CompressionType::Fast, FilterType::Adaptive);
        let [width, height] = self.size;
        let is_whole = self.rgba.len() as u64 == 4 * u64::from(width) * u64::from(height);
        if !is_whole || self.rgba.is_empty() {
            return Err(Problem::Picture("it has no pixels".to_owned()));
        }
        let written = encoder.write_image(&self.rgba, width, height, ExtendedColorType::Rgba8);
        written.map_err(unreadable)?;
        Ok(bytes)
    }
}

/// Read a picture as a reference: a frame of the size that its resolution gives, with the picture embedded.
fn read(bytes: &[u8]) -> Result<Reading, ReadError> {
    let mut decoder = decoder(bytes)?;
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    let (width, height) = decoder.dimensions();
    let given = resolution(bytes);
    let mut scale = given.unwrap_or(DVec2::splat(INCH / ASSUMED));
    let mut pixels = [width, height];
    if is_on_its_side(orientation) {
        pixels.reverse();
        scale = DVec2::new(scale.y, scale.x);
    }
    let size = scale * DVec2::from(pixels.map(f64::from));
    let form = ReferenceForm::Frame(Frame::new(size).map_err(Problem::from)?);
    let curve = ReferenceCurve::of(form).map_err(Problem::from)?;
    let picture = Picture::new(PictureSource::Embedded(bytes.into()), pixels);
    let mut reading = Reading {
        references: vec![Arc::new(
            Reference::new("picture", curve).with_picture(picture),
        )],
        unit: Some(LengthUnit::Millimetre),
        ..Reading::default()
    };
    if given.is_none() {
        reading.remarks.add(Remark::Drawn(format!(
            "The picture names no resolution: {ASSUMED} dpi are assumed. Scale it by two points"
        )));
    }
    Ok(reading)
}

/// A decoder for what the bytes begin with, within the limit of memory.
fn decoder(bytes: &[u8]) -> Result<impl ImageDecoder + '_, Problem> {
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format();
    let mut reader = reader.map_err(|error| Problem::Picture(error.to_string()))?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    reader.into_decoder().map_err(unreadable)
}

fn unreadable(error: image::ImageError) -> Problem {
    Problem::Picture(error.to_string())
}

fn is_on_its_side(orientation: Orientation) -> bool {
    matches!(
        orientation,
        Orientation::Rotate90
            | Orientation::Rotate270
            | Orientation::Rotate90FlipH
            | Orientation::Rotate270FlipH
    )
}

/// The width and the height of a pixel in millimetres, if the file says them.
fn resolution(bytes: &[u8]) -> Option<DVec2> {
    let found = png_resolution(bytes).or_else(|| jfif_resolution(bytes));
    let found = found.or_else(|| exif_resolution(bytes))?;
    (found.is_finite() && found.min_element() > 0.0).then_some(found)
}

/// The chunk pHYs of a PNG: pixels a metre.
fn png_resolution(bytes: &[u8]) -> Option<DVec2> {
    let mut rest = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n")?;
    loop {
        let (length, behind) = rest.split_at_checked(4)?;
        let (kind, behind) = behind.split_at_checked(4)?;
        let length = u32::from_be_bytes(length.try_into().ok()?) as usize;
        let (data, behind) = behind.split_at_checked(length)?;
        match (kind, data) {
            (b"pHYs", [x @ .., _, _, _, _, 1]) => {
                let y = data.get(4..8)?;
                let [x, y] = [x, y].map(|it| it.try_into().map(u32::from_be_bytes));
                return Some(METRE / DVec2::new(x.ok()?.into(), y.ok()?.into()));
            }
            (b"IDAT", _) => return None,
            // Behind each chunk stands a check sum.
            _ => rest = behind.get(4..)?,
        }
    }
}

/// The first segment of a JFIF: pixels an inch or a centimetre.
fn jfif_resolution(bytes: &[u8]) -> Option<DVec2> {
    let header = bytes.strip_prefix(b"\xff\xd8\xff\xe0")?.get(2..14)?;
    let [b'J', b'F', b'I', b'F', 0, _, _, unit, x1, x0, y1, y0] = *header else {
        return None;
    };
    let pixels = DVec2::new(
        u16::from_be_bytes([x1, x0]).into(),
        u16::from_be_bytes([y1, y0]).into(),
    );
    match unit {
        1 => Some(INCH / pixels),
        2 => Some(CENTIMETRE / pixels),
        _ => None,
    }
}

/// The resolution in the EXIF of a JPEG, WebP or PNG, or in the tags of a TIFF.
fn exif_resolution(bytes: &[u8]) -> Option<DVec2> {
    let found = exif::Reader::new().read_from_container(&mut Cursor::new(bytes));
    let found = found.ok()?;
    let number = |tag: Tag| match &found.get_field(tag, In::PRIMARY)?.value {
        Value::Rational(values) => values.first().map(|it| it.to_f64()),
        Value::Short(values) => values.first().map(|it| f64::from(*it)),
        _ => None,
    };
    let pixels = DVec2::new(number(Tag::XResolution)?, number(Tag::YResolution)?);
    match number(Tag::ResolutionUnit) {
        Some(3.0) => Some(CENTIMETRE / pixels),
        Some(2.0) | None => Some(INCH / pixels),
        Some(_) => None,
    }
}

#[cfg(test)]
mod tests;
