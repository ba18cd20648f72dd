//! The icons of tools, layers and actions, from one set.

use eframe::egui::RichText;
use lucide_icons::Icon;

use super::action::Action;
use super::theme;
use crate::editor::{Command, Follow, Layer, ToolKind};
use crate::operations::Operation;

/// The icon of a tool.
pub fn of_tool(tool: ToolKind) -> Icon {
    named(tool.row().icon)
}

/// The icon of a layer.
pub fn of_layer(layer: Layer) -> Icon {
    named(layer.row().icon)
}

/// The icon that a row of a table names.
fn named(name: &str) -> Icon {
    Icon::try_from(name).unwrap_or(Icon::CircleQuestionMark)
}

/// The icon of an action, for those that have one.
pub fn of_action(action: Action) -> Option<Icon> {
    Some(match action {
        Action::Command(command) => return of_command(command),
        Action::New => Icon::FilePlus,
        Action::Open => Icon::FolderOpen,
        Action::Import => Icon::Import,
        Action::Picture => Icon::Image,
        Action::Save => Icon::Save,
        Action::ExportLast => Icon::Share,
        Action::Export(exporter) => named(exporter.row.icon),
        Action::OpenExample(_) => Icon::Spline,
        Action::Cut => Icon::Scissors,
        Action::Copy => Icon::Copy,
        Action::Paste => Icon::ClipboardPaste,
        Action::Rename => Icon::TextCursorInput,
        Action::ToggleTheme => Icon::SunMoon,
        Action::TogglePlots => Icon::ChartSpline,
        Action::FitPlot => Icon::Maximize,
        Action::Palette => Icon::Search,
        Action::Keys => Icon::Keyboard,
        Action::About => Icon::Info,
        _ => return None,
    })
}

fn of_command(command: Command) -> Option<Icon> {
    Some(match command {
        Command::Undo => Icon::Undo2,
        Command::Redo => Icon::Redo2,
        Command::Duplicate => Icon::CopyPlus,
        Command::Delete | Command::DeleteCurve => Icon::Trash2,
        Command::TogglePeriodic => Icon::RefreshCw,
        Command::ToggleSymmetric => Icon::FlipHorizontal2,
        Command::Operation(operation) => of_operation(operation),
        Command::ToggleVisible => Icon::Eye,
        Command::ToggleLocked => Icon::Lock,
        Command::Fit | Command::FitAll => Icon::Maximize,
        Command::ZoomIn => Icon::ZoomIn,
        Command::ZoomOut => Icon::ZoomOut,
        Command::ToggleSnapping => Icon::Magnet,
        Command::Follow(Follow::InHarmony) => Icon::Waves,
        Command::ToggleClosedFollow => Icon::Link,
        Command::Follow(Follow::Softly) => Icon::Blend,
        Command::ToggleKeepShape => Icon::Spline,
        Command::ToggleKeeping => Icon::ShieldCheck,
        Command::ToggleLayer(layer) => of_layer(layer),
        Command::Tool(tool) => of_tool(tool),
        _ => return None,
    })
}

/// The icon of an operation: those that stand on the rail have one of their own.
fn of_operation(operation: &Operation) -> Icon {
    match operation.name {
        "mineur-farin" => Icon::Shell,
        "between" => Icon::Tangent,
        _ => Icon::Wand,
    }
}

/// An icon as text in the icons' own font.
pub fn text(icon: Icon) -> RichText {
    RichText::new(String::from(char::from(icon))).font(theme::icon_font(theme::ICON))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tool_has_an_icon() {
        for tool in ToolKind::ALL {
            let name = tool.row().icon;
            assert!(Icon::try_from(name).is_ok(), "{name}");
        }
    }

    #[test]
    fn every_layer_has_an_icon_and_a_colour() {
        let tokens = theme::Tokens::of_theme(true);
        for layer in Layer::ALL {
            let row = layer.row();
            assert!(Icon::try_from(row.icon).is_ok(), "{}", row.icon);
            assert_ne!(tokens.named(row.colour), tokens.text, "{}", row.colour);
        }
    }
}
