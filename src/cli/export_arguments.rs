//! The options of `batten convert` that say what is written and how.

use clap::Args;

use super::parsers::{polygon_parser, preset_parser, scale, tolerance, unit_parser};
use crate::document::{CurveId, Document};
use crate::geometry::PolygonKind;
use crate::geometry::expressions::LengthUnit;
use crate::io::{ExportChoice, Format, Preset, Scope};

/// What is written and how, beside the format.
#[derive(Debug, Default, PartialEq, Args)]
pub(super) struct ExportArguments {
    /// Write for a program, in the form that it takes best; its format must be that of OUT
    #[arg(long, value_name = "PROGRAM", value_parser = preset_parser())]
    preset: Option<&'static Preset>,
    /// Write only this curve or reference; may be given several times
    #[arg(long = "item", value_name = "NAME")]
    items: Vec<String>,
    /// Write only what is visible
    #[arg(long, conflicts_with = "items")]
    visible: bool,
    /// Draw this polygon beside each curve; may be given several times
    #[arg(long, value_name = "KIND", value_parser = polygon_parser())]
    with_polygon: Vec<PolygonKind>,
    /// Draw a polyline of points on each curve, within this distance of it
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = tolerance)]
    with_points: Option<f64>,
    /// Leave the curves out: only their polygons and points, and references
    #[arg(long)]
    without_curves: bool,
    /// The unit of the file: lengths are converted to it
    #[arg(long, value_name = "UNIT", value_parser = unit_parser())]
    unit: Option<LengthUnit>,
    /// How many times larger everything is in the file
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true, value_parser = scale)]
    scale: Option<f64>,
}

impl ExportArguments {
    /// Whether a program is named.
    pub(super) fn has_preset(&self) -> bool {
        self.preset.is_some()
    }

    /// The item that is named, or the first of several.
    pub(super) fn item(&self) -> Option<&str> {
        self.items.first().map(String::as_str)
    }

    /// The choice that the options make, with the items that are named; `None` without an option.
    ///
    /// # Errors
    /// If an item is not there, or the program reads another format.
    pub(super) fn choice(
        &self,
        format: &'static Format,
        document: &Document,
    ) -> anyhow::Result<Option<(ExportChoice, Vec<CurveId>)>> {
        if *self == Self::default() {
            return Ok(None);
        }
        let all = super::items::all(document);
        let named = self.items.iter().map(|name| super::items::item(&all, name));
        let named = named.collect::<anyhow::Result<Vec<CurveId>>>()?;
        let mut choice = ExportChoice::new(format);
        if let Some(preset) = self.preset {
            if preset.format != format {
                anyhow::bail!(
                    "{preset} takes {}: give OUT the extension .{}",
                    preset.format,
                    preset.format.extension()
                );
            }
            choice = choice.with_preset(preset);
        }
        choice.scope = match (self.visible, named.is_empty()) {
            (true, _) => Scope::Visible,
            (false, true) => Scope::All,
            (false, false) => Scope::Selected,
        };
        choice.polygons.clone_from(&self.with_polygon);
        choice.points = self.with_points;
        choice.curves = !self.without_curves;
        choice.unit = self.unit;
        choice.scale = self.scale.unwrap_or(1.0);
        Ok(Some((choice, named)))
    }
}
