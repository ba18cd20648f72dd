use std::io::Cursor;

use glam::DVec2;
use image::codecs::jpeg::{JpegEncoder, PixelDensity, PixelDensityUnit};
use image::{ImageFormat, Rgb, RgbImage};

use super::*;

/// A picture of 40 by 20 pixels, red at the left and green at the right.
fn picture() -> RgbImage {
    RgbImage::from_fn(40, 20, |x, _| {
        if x < 20 {
            Rgb([250, 10, 10])
        } else {
            Rgb([10, 250, 10])
        }
    })
}

fn encoded(format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture().write_to(&mut bytes, format).expect("a picture");
    bytes.into_inner()
}

/// A JPEG with this number of dots per inch or centimetre.
fn jpeg(dots: u16, unit: PixelDensityUnit) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = JpegEncoder::new_with_quality(&mut bytes, 100);
    encoder.set_pixel_density(PixelDensity {
        density: (dots, dots),
        unit,
    });
    encoder.encode_image(&picture()).expect("a picture");
    bytes
}

/// Put a segment behind the beginning of a JPEG.
fn with_segment(jpeg: &[u8], marker: u8, data: &[u8]) -> Vec<u8> {
    let length = (data.len() as u16 + 2).to_be_bytes();
    [&jpeg[..2], &[0xff, marker], &length, data, &jpeg[2..]].concat()
}

/// EXIF with an orientation and a resolution of 100 pixels an inch.
fn exif_data(orientation: u16) -> Vec<u8> {
    let mut data = b"Exif\0\0MM\0\x2a\0\0\0\x08\0\x04".to_vec();
    let mut entry = |tag: u16, kind: u16, value: u32| {
        data.extend(tag.to_be_bytes());
        data.extend(kind.to_be_bytes());
        data.extend(1u32.to_be_bytes());
        data.extend(value.to_be_bytes());
    };
    // Short values stand at the left; rational ones behind the entries.
    let behind = 8 + 2 + 4 * 12 + 4;
    entry(0x0112, 3, u32::from(orientation) << 16);
    entry(0x011a, 5, behind);
    entry(0x011b, 5, behind);
    entry(0x0128, 3, 2 << 16);
    data.extend([0; 4]);
    data.extend(100u32.to_be_bytes());
    data.extend(1u32.to_be_bytes());
    data
}

/// The check sum of a chunk of a PNG (ISO 3309).
fn check_sum(chunk: &[u8]) -> [u8; 4] {
    let sum = chunk.iter().fold(u32::MAX, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| {
            (sum >> 1) ^ (0xedb8_8320 & (sum & 1).wrapping_neg())
        })
    });
    (!sum).to_be_bytes()
}

fn size(reading: &Reading) -> DVec2 {
    let [reference] = &reading.references[..] else {
        panic!("{reading:?}");
    };
    let ReferenceForm::Frame(frame) = reference.curve.form() else {
        panic!("{reference:?}");
    };
    frame.size()
}

#[test]
fn every_format_is_read_in_the_size_of_its_resolution() {
    let assumed = DVec2::new(40.0, 20.0) * 25.4 / 96.0;
    for format in [ImageFormat::Png, ImageFormat::WebP, ImageFormat::Tiff] {
        let bytes = encoded(format);
        let reading = PICTURE.read(&bytes).expect("a picture");
        assert_eq!(reading.unit, Some(LengthUnit::Millimetre));
        assert!(size(&reading).distance(assumed) < 1e-12, "{format:?}");
        assert!(!reading.remarks.is_empty());
        let decoded = decode(&bytes).expect("pixels");
        assert_eq!(decoded.size, [40, 20]);
        assert_eq!(decoded.rgba[..4], [250, 10, 10, 255]);
    }
    for (dots, unit, millimetres) in [
        (254, PixelDensityUnit::Inches, 0.1),
        (50, PixelDensityUnit::Centimeters, 0.2),
    ] {
        let reading = PICTURE.read(&jpeg(dots, unit)).expect("a picture");
        let expected = millimetres * DVec2::new(40.0, 20.0);
        assert!(size(&reading).distance(expected) < 1e-12, "{dots}");
        assert!(reading.remarks.is_empty());
    }
}

#[test]
fn a_png_says_its_resolution_in_metres() {
    let png = encoded(ImageFormat::Png);
    // Behind the signature and the chunk IHDR.
    let at = 8 + 25;
    let mut chunk = b"\0\0\0\x09pHYs".to_vec();
    chunk.extend(10_000u32.to_be_bytes());
    chunk.extend(5_000u32.to_be_bytes());
    chunk.push(1);
    let sum = check_sum(&chunk[4..]);
    chunk.extend(sum);
    let bytes = [&png[..at], &chunk, &png[at..]].concat();
    let reading = PICTURE.read(&bytes).expect("a picture");
    let found = size(&reading);
    assert!(found.distance(DVec2::new(4.0, 4.0)) < 1e-12, "{found}");
    decode(&bytes).expect("pixels");
}

#[test]
fn a_photo_is_turned_as_it_says() {
    let mut plain = jpeg(100, PixelDensityUnit::PixelAspectRatio);
    // A photo has no JFIF segment.
    plain.drain(2..20);
    for (orientation, sides, first_is_red) in [
        (1, [40, 20], true),
        (3, [40, 20], false),
        (6, [20, 40], true),
        (8, [20, 40], false),
    ] {
        let bytes = with_segment(&plain, 0xe1, &exif_data(orientation));
        let decoded = decode(&bytes).expect("pixels");
        assert_eq!(decoded.size, sides, "{orientation}");
        assert_eq!(decoded.rgba[0] > 128, first_is_red, "{orientation}");
        let reading = PICTURE.read(&bytes).expect("a picture");
        let expected = DVec2::from(sides.map(f64::from)) * 0.254;
        assert!(size(&reading).distance(expected) < 1e-12, "{orientation}");
        assert_eq!(
            reading.references[0]
                .picture
                .as_ref()
                .expect("a picture")
                .pixels,
            sides
        );
    }
}

#[test]
fn damaged_pictures_are_refused() {
    for format in [ImageFormat::Png, ImageFormat::WebP, ImageFormat::Tiff] {
        let bytes = encoded(format);
        for length in 0..bytes.len().min(600) {
            // It may be read in part, or refused; its pixels are then not to be had.
            drop(PICTURE.read(&bytes[..length]));
            drop(decode(&bytes[..length]));
        }
        for (index, by) in (0..bytes.len()).zip([1u8, 0x80, 0xff].into_iter().cycle()) {
            let mut damaged = bytes.clone();
            damaged[index] ^= by;
            drop(PICTURE.read(&damaged));
            drop(decode(&damaged));
        }
    }
    for bytes in [&b""[..], b"no picture", b"\x89PNG\r\n\x1a\n"] {
        let error = PICTURE.read(bytes).expect_err("no picture").to_string();
        assert!(error.contains("the picture cannot be read"), "{error}");
    }
}

#[test]
fn a_picture_of_too_many_pixels_is_refused_before_it_is_decoded() {
    // A PNG that says 60 000 pixels square.
    let mut bytes = encoded(ImageFormat::Png);
    bytes[16..24].copy_from_slice(&[0, 0, 0xea, 0x60, 0, 0, 0xea, 0x60]);
    let sum = check_sum(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&sum);
    assert!(matches!(decode(&bytes), Err(Problem::Picture(_))));
}
