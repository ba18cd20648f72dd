//! The writer: a product whose shape is a set of curves, with layers and colours.

use super::output::{Output, list, real, refs, string};
use super::shapes::add_item;
use crate::io::exchange::drawing::{Drawing, Item, Kind, Unreadable};

/// The application protocol of a file to write.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Protocol {
    /// AUTOMOTIVE_DESIGN: every program reads it.
    #[default]
    Ap214,
    /// Managed model-based 3D engineering.
    Ap242,
}

/// Write all items of a drawing as free curves and points.
pub fn write(drawing: &Drawing, name: &str, protocol: Protocol) -> Result<Vec<u8>, Unreadable> {
    if drawing.items.is_empty() {
        return Err(unreadable("there is no curve to write".to_owned()));
    }
    let mut out = Output::new(header(name, protocol));
    let (context, shape) = product(&mut out, name, protocol, drawing.unit)?;
    let mut written = Vec::new();
    for (place, item) in drawing.items.iter().enumerate() {
        let entities = add_item(&mut out, item).map_err(|reason| refused(item, place, &reason))?;
        written.push((item, entities));
    }
    let all: Vec<u64> = written
        .iter()
        .flat_map(|(_, entities)| entities)
        .copied()
        .collect();
    let has_points = written.iter().any(|(item, _)| item.kind == Kind::Point);
    let (set, representation) = if has_points {
        (
            "GEOMETRIC_SET",
            "GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION",
        )
    } else {
        (
            "GEOMETRIC_CURVE_SET",
            "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION",
        )
    };
    let set = out.add(&format!("{set}('',{})", refs(&all)));
    let representation = out.add(&format!("{representation}('',(#{set}),#{context})"));
    out.add(&format!(
        "SHAPE_DEFINITION_REPRESENTATION(#{shape},#{representation})"
    ));
    layers(&mut out, &written);
    colours(&mut out, &written, context);
    Ok(out.finish())
}

type Written<'d> = Vec<(&'d Item, Vec<u64>)>;

fn header(name: &str, protocol: Protocol) -> String {
    let schema = match protocol {
        Protocol::Ap214 => "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }",
        Protocol::Ap242 => {
            "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }"
        }
    };
    format!(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n\
         FILE_NAME({},'1970-01-01T00:00:00',(''),(''),'Batten','Batten','');\n\
         FILE_SCHEMA(('{schema}'));\nENDSEC;\nDATA;\n",
        string(name)
    )
}

/// Add the product; returns its context and its PRODUCT_DEFINITION_SHAPE.
fn product(
    out: &mut Output,
    name: &str,
    protocol: Protocol,
    unit: Option<f64>,
) -> Result<(u64, u64), Unreadable> {
    let (application, standard, year) = match protocol {
        Protocol::Ap214 => (
            "core data for automotive mechanical design processes",
            "automotive_design",
            2000,
        ),
        Protocol::Ap242 => (
            "managed model based 3d engineering",
            "ap242_managed_model_based_3d_engineering",
            2011,
        ),
    };
    let name = string(name);
    let application = out.add(&format!("APPLICATION_CONTEXT('{application}')"));
    out.add(&format!(
        "APPLICATION_PROTOCOL_DEFINITION('international standard','{standard}',{year},#{application})"
    ));
    let context = out.add(&format!("PRODUCT_CONTEXT('',#{application},'mechanical')"));
    let product = out.add(&format!("PRODUCT({name},{name},'',(#{context}))"));
    out.add(&format!(
        "PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(#{product}))"
    ));
    let formation = out.add(&format!("PRODUCT_DEFINITION_FORMATION('','',#{product})"));
    let context = out.add(&format!(
        "PRODUCT_DEFINITION_CONTEXT('part definition',#{application},'design')"
    ));
    let definition = out.add(&format!(
        "PRODUCT_DEFINITION('design','',#{formation},#{context})"
    ));
    let shape = out.add(&format!("PRODUCT_DEFINITION_SHAPE('','',#{definition})"));
    let length = length_unit(out, unit.unwrap_or(1.0))?;
    let angle = out.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    let solid = out.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    let tolerance = out.add(&format!(
        "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),#{length},'distance_accuracy_value','')"
    ));
    let context = out.add(&format!(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{tolerance}))\
         GLOBAL_UNIT_ASSIGNED_CONTEXT((#{length},#{angle},#{solid}))REPRESENTATION_CONTEXT('',''))"
    ));
    Ok((context, shape))
}

fn length_unit(out: &mut Output, unit: f64) -> Result<u64, Unreadable> {
    const PREFIXES: [(f64, &str); 8] = [
        (1e-6, ".NANO."),
        (1e-3, ".MICRO."),
        (1.0, ".MILLI."),
        (10.0, ".CENTI."),
        (100.0, ".DECI."),
        (1e3, "$"),
        (1e5, ".HECTO."),
        (1e6, ".KILO."),
    ];
    if !unit.is_normal() || unit < 0.0 {
        return Err(unreadable(
            "the length of the unit is no positive number".to_owned(),
        ));
    }
    let si = |prefix: &str| format!("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({prefix},.METRE.))");
    if let Some((_, prefix)) = PREFIXES.iter().find(|(size, _)| *size == unit) {
        return Ok(out.add(&si(prefix)));
    }
    let name = if unit == 25.4 {
        "INCH"
    } else if unit == 304.8 {
        "FOOT"
    } else {
        "UNIT"
    };
    let milli = out.add(&si(".MILLI."));
    let measure = out.add(&format!(
        "LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),#{milli})",
        real(unit)
    ));
    let exponents = out.add("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
    Ok(out.add(&format!(
        "(CONVERSION_BASED_UNIT('{name}',#{measure})LENGTH_UNIT()NAMED_UNIT(#{exponents}))"
    )))
}

fn layers(out: &mut Output, written: &Written) {
    let mut layers: Vec<(String, Vec<u64>)> = Vec::new();
    for (item, entities) in written.iter().filter(|(item, _)| !item.group.is_empty()) {
        let name = item.group.join("/");
        match layers.iter_mut().find(|(own, _)| *own == name) {
            Some((_, items)) => items.extend(entities),
            None => layers.push((name, entities.clone())),
        }
    }
    for (name, items) in layers {
        out.add(&format!(
            "PRESENTATION_LAYER_ASSIGNMENT({},'',{})",
            string(&name),
            refs(&items)
        ));
    }
}

fn colours(out: &mut Output, written: &Written, context: u64) {
    let mut styles: Vec<(([u8; 3], bool), u64)> = Vec::new();
    let mut styled = Vec::new();
    for (item, entities) in written {
        let Some(colour) = item.colour else {
            continue;
        };
        let key = (colour, item.kind == Kind::Point);
        let known = styles
            .iter()
            .find(|(own, _)| *own == key)
            .map(|(_, style)| *style);
        let style = known.unwrap_or_else(|| {
            let style = add_style(out, colour, key.1);
            styles.push((key, style));
            style
        });
        for entity in entities {
            styled.push(out.add(&format!("STYLED_ITEM('',(#{style}),#{entity})")));
        }
    }
    if !styled.is_empty() {
        out.add(&format!(
            "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',{},#{context})",
            refs(&styled)
        ));
    }
}

fn add_style(out: &mut Output, colour: [u8; 3], of_point: bool) -> u64 {
    let shares = list(colour.map(|byte| real(f64::from(byte) / 255.0)));
    let shares = shares.trim_matches(['(', ')']);
    let colour = out.add(&format!("COLOUR_RGB('',{shares})"));
    let style = if of_point {
        format!("POINT_STYLE('',MARKER_TYPE(.DOT.),POSITIVE_LENGTH_MEASURE(0.1),#{colour})")
    } else {
        let font = out.add("DRAUGHTING_PRE_DEFINED_CURVE_FONT('continuous')");
        format!("CURVE_STYLE('',#{font},POSITIVE_LENGTH_MEASURE(0.1),#{colour})")
    };
    let style = out.add(&style);
    out.add(&format!("PRESENTATION_STYLE_ASSIGNMENT((#{style}))"))
}

fn refused(item: &Item, place: usize, reason: &str) -> Unreadable {
    let name = item
        .name
        .as_deref()
        .map(|name| format!(" '{name}'"))
        .unwrap_or_default();
    unreadable(format!(
        "item {}{name} ({}): {reason}",
        place + 1,
        item.kind.name()
    ))
}

fn unreadable(reason: String) -> Unreadable {
    Unreadable { at: None, reason }
}
