//! Names of entity types.

/// The name of an entity in reports: its type, its form where that makes a difference, and what it is.
pub(super) fn entity_name(entity: u32, form: i32) -> String {
    let name = match entity {
        106 | 402 | 404 => return form_name(entity, form),
        102 => "composite curve",
        108 => "plane",
        114 => "parametric spline surface",
        118 => "ruled surface",
        120 => "surface of revolution",
        122 => "tabulated cylinder",
        123 => "direction",
        125 => "flash",
        128 => "B-spline surface",
        130 => "offset curve",
        132 => "connect point",
        134 => "node",
        136 => "finite element",
        140 => "offset surface",
        141 => "boundary",
        142 => "curve on a surface",
        143 => "bounded surface",
        144 => "trimmed surface",
        150..=168 => "primitive solid",
        180 => "Boolean tree",
        182 => "selected component",
        184 => "solid assembly",
        186 => "manifold solid",
        190..=198 => "analytic surface",
        202..=222 => "dimension or note",
        228 => "general symbol",
        230 => "sectioned area",
        302 | 304 | 306 | 310 | 312 | 316 | 320 | 322 => "definition",
        408 => "subfigure instance",
        410 => "view",
        412 | 414 => "array of subfigures",
        416 => "external reference",
        418 => "nodal load",
        420 => "network subfigure instance",
        422 => "attribute table",
        430 => "solid instance",
        502 => "vertex list",
        504 => "edge list",
        508 => "loop",
        510 => "face",
        514 => "shell",
        600..=699 | 10_000..=99_999 => return "user-defined entity".to_owned(),
        // One name for all: a damaged file may hold thousands of them.
        _ => return "unknown entity type".to_owned(),
    };
    format!("{entity} {name}")
}

fn form_name(entity: u32, form: i32) -> String {
    match form {
        0..=99 => format!("{entity} form {form}"),
        _ => entity.to_string(),
    }
}
