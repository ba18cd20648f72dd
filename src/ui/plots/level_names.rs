//! What plots of levels are called.

use crate::analysis::LevelPlot;

/// The label of a tab; `short` where there is little room.
pub fn tab_name(plot: LevelPlot, short: bool) -> String {
    let level_word = if short { "" } else { "level " };
    match plot {
        LevelPlot::CURVATURE => "Curvature".to_owned(),
        LevelPlot::Torsion(1) => if short { "τ" } else { "Torsion" }.to_owned(),
        LevelPlot::Logarithmic => if short { "Log" } else { "Log graph" }.to_owned(),
        LevelPlot::Curvature(level) => format!("κ {level_word}{level}"),
        LevelPlot::Torsion(level) => format!("τ {level_word}{level}"),
    }
}

/// The tooltip of a tab.
pub fn explanation(plot: LevelPlot) -> String {
    let graph_of = |quantity: &str, level: usize| {
        format!(
            "Level {level}: curvature g″/(1 + g′²)^(3/2) of the graph of {quantity} level {}",
            level - 1
        )
    };
    match plot {
        LevelPlot::CURVATURE => "The curvature over arc length".to_owned(),
        LevelPlot::Torsion(1) => "The torsion over arc length".to_owned(),
        LevelPlot::Curvature(level) => graph_of("curvature", level),
        LevelPlot::Torsion(level) => graph_of("torsion", level),
        LevelPlot::Logarithmic => {
            "|ρ ds/dρ| over ρ, both logarithmic: a straight line of slope α on a log-aesthetic curve"
                .to_owned()
        }
    }
}

/// The name of the horizontal axis.
pub fn across_name(normalised: bool, units: &str) -> String {
    match normalised {
        true => "share of the arc length".to_owned(),
        false => format!("arc length ({units})"),
    }
}

/// The name of the vertical axis.
pub fn axis_name(plot: LevelPlot, planar: bool, normalised: bool, unit: &str) -> String {
    let unit = match (plot, normalised) {
        (_, true) => ", length 1".to_owned(),
        (LevelPlot::CURVATURE | LevelPlot::Torsion(1), _) => format!(" (1/{unit})"),
        _ => String::new(),
    };
    match plot {
        LevelPlot::CURVATURE if planar => format!("signed κ{unit}"),
        LevelPlot::CURVATURE => format!("κ{unit}"),
        LevelPlot::Curvature(level) => format!("κ level {level}{unit}"),
        LevelPlot::Torsion(1) => format!("torsion τ{unit}"),
        LevelPlot::Torsion(level) => format!("τ level {level}{unit}"),
        LevelPlot::Logarithmic => "|ρ ds/dρ|".to_owned(),
    }
}
