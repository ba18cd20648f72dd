//! Icons by what they stand for, from one set.

use eframe::egui::RichText;
use lucide_icons::Icon;

use super::theme;
use crate::editor::{Command, Layer, ToolKind};

/// The icon of a tool.
pub fn of_tool(tool: ToolKind) -> Icon {
    match tool {
        ToolKind::Select => Icon::MousePointer2,
        ToolKind::AddVertex => Icon::GitBranchPlus,
        ToolKind::Insert => Icon::GitCommitHorizontal,
        ToolKind::Delete => Icon::Eraser,
        ToolKind::Draw => Icon::Waypoints,
        ToolKind::Rotate => Icon::RotateCw,
        ToolKind::Scale => Icon::Scaling,
        ToolKind::Measure => Icon::Ruler,
        ToolKind::EndFit => Icon::Goal,
    }
}

/// The icon of a layer.
pub fn of_layer(layer: Layer) -> Icon {
    match layer {
        Layer::Float => Icon::Waypoints,
        Layer::Clamped => Icon::Pentagon,
        Layer::Curve => Icon::Spline,
        Layer::Evolute => Icon::Origami,
        Layer::Comb => Icon::ChartNoAxesColumn,
        Layer::Targets => Icon::Goal,
        Layer::Grid => Icon::Grid3x3,
        Layer::Features => Icon::BadgeCheck,
    }
}

/// The icon of a command, for those that have one.
pub fn of_command(command: Command) -> Option<Icon> {
    Some(match command {
        Command::New => Icon::FilePlus,
        Command::Open => Icon::FolderOpen,
        Command::Import => Icon::Import,
        Command::Save => Icon::Save,
        Command::ExportDxf => Icon::Share,
        Command::ExportCsv(_) => Icon::Table,
        Command::OpenExample(_) => Icon::Spline,
        Command::Undo => Icon::Undo2,
        Command::Redo => Icon::Redo2,
        Command::Cut => Icon::Scissors,
        Command::Copy => Icon::Copy,
        Command::Paste => Icon::ClipboardPaste,
        Command::Duplicate => Icon::CopyPlus,
        Command::Delete | Command::DeleteCurve => Icon::Trash2,
        Command::Reverse => Icon::ArrowLeftRight,
        Command::TogglePeriodic => Icon::RefreshCw,
        Command::RaiseDegree => Icon::ChevronUp,
        Command::LowerDegree => Icon::ChevronDown,
        Command::ToggleVisible => Icon::Eye,
        Command::ToggleLocked => Icon::Lock,
        Command::Fit | Command::FitAll => Icon::Maximize,
        Command::ZoomIn => Icon::ZoomIn,
        Command::ZoomOut => Icon::ZoomOut,
        Command::ToggleSnapping => Icon::Magnet,
        Command::ToggleLayer(layer) => of_layer(layer),
        Command::Tool(tool) => of_tool(tool),
        Command::ToggleTheme => Icon::SunMoon,
        Command::TogglePlots => Icon::ChartSpline,
        Command::Palette => Icon::Search,
        Command::Keys => Icon::Keyboard,
        Command::About => Icon::Info,
        _ => return None,
    })
}

/// An icon as text in the icons' own font.
pub fn text(icon: Icon) -> RichText {
    RichText::new(String::from(char::from(icon))).font(theme::icon_font(theme::ICON))
}
