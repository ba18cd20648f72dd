//! The rows of the table of formats for CAD and drawing programs.

use super::changes::Rewriter;
use super::drawing::{Drawing, Shape, Unreadable};
use super::writing::{Manner, Marks, Written};
use super::{brep, curve_json, glif, iges, obj, step, svg, threedm};
use crate::document::Document;
use crate::geometry::PolygonKind;
use crate::io::error::WriteError;
use crate::io::format::{ExportRow, FileUnit, Format, Writing};
use crate::io::loss::{Loss, LossReport};

/// Writes a drawing of some name.
type WriteDrawing = fn(&Drawing, &str) -> Result<Vec<u8>, Unreadable>;

const NONE: Format = Format {
    name: "",
    extensions: &[],
    read: None,
    read_chosen: None,
    draw: None,
    write: None,
    write_back: None,
    rewrite: None,
    file_unit: FileUnit::Optional,
    holds_documents: false,
    exports: &[],
};

/// STEP, written by the protocol that most programs read.
pub static STEP: Format = Format {
    name: "STEP",
    extensions: &["step", "stp", "p21"],
    file_unit: FileUnit::Always,
    draw: Some(step::read),
    write: Some(|document, writing, losses| {
        written(document, writing, losses, SPLINES, |drawing, name| {
            step::write(drawing, name, step::Protocol::Ap214)
        })
    }),
    exports: &[ExportRow {
        label: "Export STEP…",
        help: "Export curves as B-splines for CAD programs",
        icon: "share",
        key: None,
        polygon: None,
    }],
    ..NONE
};

/// STEP by the newer protocol.
pub static STEP_AP242: Format = Format {
    name: "STEP AP242",
    extensions: &["ap242"],
    file_unit: FileUnit::Always,
    draw: Some(step::read),
    write: Some(|document, writing, losses| {
        written(document, writing, losses, SPLINES, |drawing, name| {
            step::write(drawing, name, step::Protocol::Ap242)
        })
    }),
    ..NONE
};

/// IGES.
pub static IGES: Format = Format {
    name: "IGES",
    extensions: &["igs", "iges"],
    file_unit: FileUnit::Always,
    draw: Some(iges::read),
    write: Some(|document, writing, losses| {
        let manner = Manner {
            hides: true,
            ..SPLINES
        };
        written(document, writing, losses, manner, iges::write)
    }),
    exports: &[ExportRow {
        label: "Export IGES…",
        help: "Export curves as B-splines for older CAD programs",
        icon: "share",
        key: None,
        polygon: None,
    }],
    ..NONE
};

/// Rhino's 3DM.
pub static THREEDM: Format = Format {
    name: "3DM",
    extensions: &["3dm"],
    file_unit: FileUnit::Always,
    draw: Some(threedm::read),
    write: Some(|document, writing, losses| {
        written(
            document,
            writing,
            losses,
            Manner {
                kept: threedm::kept_group,
                hides: true,
                as_splines: threedm::is_spline,
                ..SPLINES
            },
            threedm::write,
        )
    }),
    exports: &[ExportRow {
        label: "Export 3DM…",
        help: "Export curves with their names and colours for Rhino",
        icon: "share",
        key: None,
        polygon: None,
    }],
    ..NONE
};

/// SVG.
pub static SVG: Format = Format {
    name: "SVG",
    extensions: &["svg"],
    file_unit: FileUnit::Always,
    draw: Some(svg::read),
    write: Some(|document, writing, losses| {
        let manner = Manner {
            written: Written::Cubics(writing.tolerance),
            kept: svg::kept_group,
            holds: svg::holds,
            ..SPLINES
        };
        drawn(document, &manner, losses, svg::write)
    }),
    rewrite: Some(Rewriter {
        manner: Manner {
            written: Written::Cubics(None),
            kept: <[String]>::to_vec,
            holds: svg::holds,
            ..SPLINES
        },
        write: svg::rewrite,
    }),
    exports: &[ExportRow {
        label: "Export SVG…",
        help: "Export planar curves as Béziers, 1 : 1 in millimetres",
        icon: "share",
        key: None,
        polygon: None,
    }],
    ..NONE
};

/// Glyphs of the Unified Font Object.
pub static GLIF: Format = Format {
    name: "GLIF",
    extensions: &["glif"],
    draw: Some(glif::read),
    file_unit: FileUnit::None,
    write: Some(|document, writing, losses| {
        let manner = Manner {
            written: Written::Cubics(writing.tolerance),
            kept: none,
            holds: glif::holds,
            marks: Marks::NONE,
            ..SPLINES
        };
        let bytes = drawn(document, &manner, losses, glif::write)?;
        // The glyph has the name of its first contour.
        let mut all = losses.losses.iter();
        if let Some(first) = all.position(|(_, loss)| *loss == Loss::Unnamed) {
            losses.losses.remove(first);
        }
        Ok(bytes)
    }),
    rewrite: Some(Rewriter {
        manner: Manner {
            written: Written::Cubics(None),
            kept: <[String]>::to_vec,
            holds: glif::holds,
            ..SPLINES
        },
        write: glif::rewrite,
    }),
    ..NONE
};

/// Free-form curves of OBJ.
pub static OBJ: Format = Format {
    name: "OBJ",
    extensions: &["obj"],
    draw: Some(obj::read),
    write: Some(|document, writing, losses| {
        written(
            document,
            writing,
            losses,
            Manner {
                kept: obj::kept_group,
                marks: Marks::NAMES,
                as_splines: |shape| matches!(shape, Shape::Conic(_)),
                chains: false,
                ..SPLINES
            },
            obj::write,
        )
    }),
    ..NONE
};

/// OpenCascade's BREP, always in millimetres.
pub static BREP: Format = Format {
    name: "BREP",
    extensions: &["brep", "brp"],
    file_unit: FileUnit::Always,
    draw: Some(brep::read),
    write: Some(|document, writing, losses| {
        written(
            document,
            writing,
            losses,
            Manner {
                kept: none,
                marks: Marks::NONE,
                ..SPLINES
            },
            |drawing, name| brep::write(&drawing.in_millimetres(), name),
        )
    }),
    ..NONE
};

/// Control points, knots and weights in JSON.
pub static CURVE_JSON: Format = Format {
    name: "JSON",
    extensions: &["json"],
    draw: Some(curve_json::read),
    write: Some(|document, writing, losses| {
        let manner = Manner {
            kept: <[String]>::to_vec,
            holds: curve_json::holds,
            marks: Marks::NAMES,
            as_splines: |shape| matches!(shape, Shape::Conic(_) | Shape::Polyline { .. }),
            chains: false,
            ..SPLINES
        };
        written(document, writing, losses, manner, curve_json::write)
    }),
    ..NONE
};

/// Write curves and references as the data of one SVG path, with the losses: numbers are those of the document, y goes
/// down.
///
/// # Errors
/// [`WriteError`] if there is nothing to write, or a curve is not in the plane.
pub fn svg_path(document: &Document) -> Result<(String, LossReport), WriteError> {
    let mut losses = LossReport::new(SVG.name);
    let manner = Manner {
        written: Written::Cubics(None),
        kept: none,
        holds: svg::holds,
        ..SPLINES
    };
    let drawing = Drawing::of(document, &manner, &mut losses)?;
    let data = svg::path_data(&drawing);
    let data = data.map_err(|Unreadable { reason, .. }| WriteError::Refused {
        format: SVG.name,
        reason,
    })?;
    // A path has no attributes that could be lost.
    losses.losses.retain(|(_, loss)| {
        matches!(
            loss,
            Loss::Cubics(_) | Loss::Reference | Loss::LeftOut { .. }
        )
    });
    Ok((data, losses))
}

/// The path that formats keep whose layers have one name, with `/` between the names of groups.
fn joined(path: &[String]) -> Vec<String> {
    path.join("/").split('/').map(str::to_owned).collect()
}

/// The path that formats without layers keep.
fn none(_: &[String]) -> Vec<String> {
    Vec::new()
}

/// Write a document on the knots of a polygon; without a choice on clamped ones.
fn written(
    document: &Document,
    writing: &Writing,
    losses: &mut LossReport,
    manner: Manner,
    write: WriteDrawing,
) -> Result<Vec<u8>, WriteError> {
    let manner = Manner {
        written: Written::Knots(writing.polygon.unwrap_or(PolygonKind::Clamped)),
        ..manner
    };
    drawn(document, &manner, losses, write)
}

/// What formats make that hold every item, with names, colours and the names of layers.
const SPLINES: Manner = Manner {
    written: Written::Knots(PolygonKind::Clamped),
    kept: joined,
    holds: |_| Ok(()),
    marks: Marks::ALL,
    as_splines: |_| false,
    hides: false,
    chains: true,
};

fn drawn(
    document: &Document,
    manner: &Manner,
    losses: &mut LossReport,
    write: WriteDrawing,
) -> Result<Vec<u8>, WriteError> {
    let format = losses.format;
    let drawing = Drawing::of(document, manner, losses)?;
    let name = drawing.items.first().and_then(|item| item.name.clone());
    let bytes = write(&drawing, name.as_deref().unwrap_or("curves"));
    bytes.map_err(|Unreadable { reason, .. }| WriteError::Refused { format, reason })
}
