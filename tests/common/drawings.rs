//! Drawings of other programs, made for tests.

/// A DXF with straight lines on layers, and hatches, which Batten does not understand. `unit` is the number of
/// `$INSUNITS`, which is left out without one.
pub fn dxf(unit: Option<u8>, lines: &[(&str, [f64; 2])], hatches: usize) -> String {
    let header = unit.map_or_else(String::new, |unit| format!("  9\n$INSUNITS\n 70\n{unit}\n"));
    let line = |(layer, [x, y]): &(&str, [f64; 2])| {
        format!("  0\nLINE\n  8\n{layer}\n 10\n0\n 20\n0\n 11\n{x}\n 21\n{y}\n")
    };
    let lines: String = lines.iter().map(line).collect();
    let hatches = "  0\nHATCH\n  8\n0\n".repeat(hatches);
    format!(
        "  0\nSECTION\n  2\nHEADER\n{header}  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n{lines}{hatches}  0\nENDSEC\n  0\nEOF\n"
    )
}

/// A DXF in millimetres with a cubic on uneven knots, which no float polygon holds exactly.
#[allow(dead_code)] // Each test uses a part of it.
pub fn uneven_spline() -> String {
    let knots = [0, 0, 0, 0, 1, 4, 5, 5, 5, 5];
    let knots: String = knots.iter().map(|knot| format!(" 40\n{knot}\n")).collect();
    let points = [(0, 0), (10, 30), (40, 40), (70, 20), (90, 35), (120, 30)];
    let points: String = points
        .iter()
        .map(|(x, y)| format!(" 10\n{x}\n 20\n{y}\n 30\n0\n"))
        .collect();
    let spline =
        format!("  0\nSPLINE\n  8\n0\n 70\n8\n 71\n3\n 72\n10\n 73\n6\n 74\n0\n{knots}{points}");
    format!(
        "  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n4\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n{spline}  0\nENDSEC\n  0\nEOF\n"
    )
}
