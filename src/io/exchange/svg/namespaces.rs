//! The namespaces of the format.

/// The namespace of SVG.
pub const SVG: &str = "http://www.w3.org/2000/svg";
/// The namespace of Inkscape's own attributes.
pub const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
/// The namespace of references, before SVG 2.
pub const XLINK: &str = "http://www.w3.org/1999/xlink";
/// The namespace of the attributes that Inkscape has from its predecessor.
pub const SODIPODI: &str = "http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd";
