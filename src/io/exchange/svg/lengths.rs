//! Lengths, and the page that a drawing is on.

use std::str::FromStr;

use roxmltree::Node;
use svgtypes::{AspectRatio, Length, LengthUnit, ViewBox};

use super::namespaces::INKSCAPE;
use super::transforms::{fit, matrix};
use crate::io::exchange::drawing::Affine;

/// The size of type where a file does not say it; lengths in `em` refer to it.
const FONT_SIZE: f64 = 16.0;

/// A rectangle that percentages refer to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Viewport {
    pub(super) width: f64,
    pub(super) height: f64,
}

/// What percentages of a length refer to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Along {
    Width,
    Height,
    Diagonal,
}

/// The page of a drawing.
pub(super) struct Page {
    /// Places user coordinates into the result, y up.
    pub(super) place: Affine,
    /// Millimetres per unit of the result.
    pub(super) unit: Option<f64>,
    /// The outermost viewport, in user coordinates.
    pub(super) viewport: Viewport,
    /// How a missing unit can be guessed.
    pub(super) remark: Option<String>,
}

/// Read the length of an attribute, in user coordinates.
pub(super) fn length(node: Node, name: &str, along: Along, viewport: Viewport) -> Option<f64> {
    let length = Length::from_str(node.attribute(name)?.trim()).ok()?;
    Some(user_length(length, along, viewport))
}

/// Read a `viewBox` attribute.
pub(super) fn view_box(node: Node) -> Option<ViewBox> {
    ViewBox::from_str(node.attribute("viewBox")?).ok()
}

/// Read a `preserveAspectRatio` attribute.
pub(super) fn aspect_ratio(node: Node) -> AspectRatio {
    let text = node.attribute("preserveAspectRatio");
    text.and_then(|it| AspectRatio::from_str(it).ok())
        .unwrap_or_default()
}

/// Find out size, orientation and unit of a drawing by its outermost element.
pub(super) fn page(root: Node) -> Page {
    let size = ["width", "height"].map(|it| outer_length(root, it));
    let view = view_box(root);
    let resolution = Resolution::of(root);
    let measured = size.iter().flatten().any(|it| millimetres(*it, 96.0).1);
    let pixels = size
        .iter()
        .flatten()
        .any(|it| matches!(it.unit, LengthUnit::Px));
    let known = match resolution {
        Resolution::Standard => measured || pixels,
        // The view box relates millimetres and coordinates, whatever a pixel is.
        Resolution::Illustrator | Resolution::OldInkscape => measured && view.is_some(),
    };
    let dpi = resolution.per_inch();
    let scale = if known { 1.0 } else { dpi / 25.4 };
    let size = size.map(|it| it.map(|it| result_length(it, dpi, known, scale)));
    let pixel = if known { 25.4 / dpi } else { 1.0 };
    Page {
        place: placement(view, size, pixel, aspect_ratio(root)),
        unit: known.then_some(1.0),
        viewport: outer_viewport(view, size, pixel),
        remark: (!known).then(|| resolution.remark()),
    }
}

/// What a pixel is.
#[derive(Clone, Copy)]
enum Resolution {
    Standard,
    Illustrator,
    OldInkscape,
}

impl Resolution {
    fn of(root: Node) -> Self {
        if let Some(version) = root.attribute((INKSCAPE, "version")) {
            let number = version.split_whitespace().next().unwrap_or_default();
            let mut parts = number
                .split('.')
                .map(|it| it.parse::<u32>().unwrap_or_default());
            let version = (
                parts.next().unwrap_or_default(),
                parts.next().unwrap_or_default(),
            );
            return if version < (0, 92) {
                Self::OldInkscape
            } else {
                Self::Standard
            };
        }
        let document = root.document();
        let by_illustrator = document
            .root()
            .children()
            .chain(root.children().take(3))
            .filter_map(|it| it.is_comment().then(|| it.text()).flatten())
            .any(|it| it.contains("Adobe Illustrator"))
            || root
                .namespaces()
                .any(|it| it.uri().starts_with("http://ns.adobe.com/AdobeIllustrator"));
        if by_illustrator {
            Self::Illustrator
        } else {
            Self::Standard
        }
    }

    fn per_inch(self) -> f64 {
        match self {
            Self::Standard => 96.0,
            Self::Illustrator => 72.0,
            Self::OldInkscape => 90.0,
        }
    }

    fn remark(self) -> String {
        match self {
            Self::Standard => "the file has no unit of length; pixels are 96 an inch by the standard",
            Self::Illustrator => {
                "the file is by Illustrator, which counts 72 pixels an inch, but not all programs do"
            }
            Self::OldInkscape => {
                "the file is by Inkscape before 0.92, which counts 90 pixels an inch, but not all programs do"
            }
        }
        .to_owned()
    }
}

/// A length in millimetres, and whether it has a unit other than pixels.
fn millimetres(length: Length, dpi: f64) -> (f64, bool) {
    let number = length.number;
    match length.unit {
        LengthUnit::Mm => (number, true),
        LengthUnit::Cm => (number * 10.0, true),
        LengthUnit::In => (number * 25.4, true),
        LengthUnit::Pt => (number * 25.4 / 72.0, true),
        LengthUnit::Pc => (number * 25.4 / 6.0, true),
        _ => (user_length(length, Along::Width, UNIT) * 25.4 / dpi, false),
    }
}

/// The viewport where no percentage can occur.
const UNIT: Viewport = Viewport {
    width: 0.0,
    height: 0.0,
};

fn result_length(length: Length, dpi: f64, known: bool, scale: f64) -> f64 {
    let (size, measured) = millimetres(length, dpi);
    if known || measured {
        size * scale
    } else {
        user_length(length, Along::Width, UNIT)
    }
}

fn outer_length(root: Node, name: &str) -> Option<Length> {
    let length = Length::from_str(root.attribute(name)?.trim()).ok()?;
    (length.unit != LengthUnit::Percent && length.number > 0.0).then_some(length)
}

fn user_length(length: Length, along: Along, viewport: Viewport) -> f64 {
    let number = length.number;
    match length.unit {
        LengthUnit::None | LengthUnit::Px => number,
        LengthUnit::Em => number * FONT_SIZE,
        LengthUnit::Ex => number * 0.5 * FONT_SIZE,
        LengthUnit::Percent => 0.01 * number * along.of(viewport),
        _ => millimetres(length, 96.0).0 * 96.0 / 25.4,
    }
}

impl Along {
    fn of(self, viewport: Viewport) -> f64 {
        match self {
            Self::Width => viewport.width,
            Self::Height => viewport.height,
            Self::Diagonal => viewport.width.hypot(viewport.height) / std::f64::consts::SQRT_2,
        }
    }
}

/// Complete the size of the page by the proportions of the view box.
fn whole_size(view: ViewBox, size: [Option<f64>; 2], pixel: f64) -> (f64, f64) {
    match size {
        [Some(width), Some(height)] => (width, height),
        [Some(width), None] => (width, width * view.h / view.w),
        [None, Some(height)] => (height * view.w / view.h, height),
        [None, None] => (view.w * pixel, view.h * pixel),
    }
}

fn placement(
    view: Option<ViewBox>,
    size: [Option<f64>; 2],
    pixel: f64,
    aspect: AspectRatio,
) -> Affine {
    let Some(view) = view else {
        let bottom = size[1].unwrap_or_default();
        return matrix([pixel, 0.0, 0.0, -pixel, 0.0, bottom]);
    };
    let size = whole_size(view, size, pixel);
    let fitted = fit(view, size, aspect);
    let (x, y) = (fitted.linear.x_axis.x, fitted.linear.y_axis.y);
    if view.x == 0.0 && view.y == 0.0 {
        matrix([x, 0.0, 0.0, -y, fitted.origin.x, size.1 - fitted.origin.y])
    } else {
        matrix([x, 0.0, 0.0, -y, 0.0, 0.0])
    }
}

fn outer_viewport(view: Option<ViewBox>, size: [Option<f64>; 2], pixel: f64) -> Viewport {
    let (width, height) = match view {
        Some(view) => (view.w, view.h),
        None => {
            let [width, height] = size.map(|it| it.unwrap_or_default() / pixel);
            (width, height)
        }
    };
    Viewport { width, height }
}
