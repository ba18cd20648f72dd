//! Colours by AutoCAD's index (ACI) or as red, green and blue.

use super::groups::Trouble;
use super::records::Record;

/// The index of the colour that contrasts with the background: no colour of its own.
const CONTRAST: i64 = 7;

/// Where an entity has its colour from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paint {
    /// From its layer.
    Layer,
    /// From the insert of its block.
    Block,
    /// Its own, if it is more than a contrast with the background.
    Own(Option<[u8; 3]>),
}

/// Take the colour of an entity or of a layer.
///
/// # Errors
/// [`Trouble`] if a number is damaged.
pub fn paint(record: &Record<'_>) -> Result<Paint, Trouble> {
    if record.find(420).is_some() {
        let [_, red, green, blue] = (record.integer(420)? as u32).to_be_bytes();
        return Ok(Paint::Own(Some([red, green, blue])));
    }
    let Some(_) = record.find(62) else {
        return Ok(Paint::Layer);
    };
    Ok(match record.integer(62)?.saturating_abs() {
        0 => Paint::Block,
        index @ 1..=255 => Paint::Own(of_index(index)),
        _ => Paint::Layer,
    })
}

/// The index of the colour that is nearest to one, and whether it is the same.
pub(in crate::io) fn nearest_index(colour: [u8; 3]) -> (i64, bool) {
    let apart = |index: i64| {
        let squares = of_index(index)?.into_iter().zip(colour);
        let squares = squares.map(|(a, b)| i64::from(a.abs_diff(b)).pow(2));
        Some((squares.sum::<i64>(), index))
    };
    let nearest = (1..=255).filter_map(apart).min();
    nearest.map_or((CONTRAST, false), |(apart, index)| (index, apart == 0))
}

/// The colour of an index from 1 to 255.
fn of_index(index: i64) -> Option<[u8; 3]> {
    Some(match index {
        1 => [255, 0, 0],
        2 => [255, 255, 0],
        3 => [0, 255, 0],
        4 => [0, 255, 255],
        5 => [0, 0, 255],
        6 => [255, 0, 255],
        CONTRAST => return None,
        8 => [128; 3],
        9 => [192; 3],
        10..=249 => of_wheel(index),
        250 => [51; 3],
        251 => [80; 3],
        252 => [105; 3],
        253 => [130; 3],
        254 => [190; 3],
        _ => [255; 3],
    })
}

/// The tens are hues of 15 degrees from red on; the units five values, odd ones half as saturated.
fn of_wheel(index: i64) -> [u8; 3] {
    let value = match (index % 10) / 2 {
        0 => 255.0,
        1 => 165.0,
        2 => 127.0,
        3 => 76.0,
        _ => 38.0,
    };
    let hue = (index / 10 - 1) * 15;
    [0, 120, 240].map(|primary| {
        let apart = (hue - primary).rem_euclid(360);
        let apart = apart.min(360 - apart) as f64;
        let share = (2.0 - apart / 60.0).clamp(0.0, 1.0);
        let share = if index % 2 == 1 {
            (1.0 + share) / 2.0
        } else {
            share
        };
        (value * share) as u8
    })
}
