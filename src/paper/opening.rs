//! Opening a page in the editor.

use super::{PaperPage, documents};
use crate::editor::{Command, Editor, NamedView, Refusal, Reply, ToolKind};

impl PaperPage {
    /// Open the page's document in place of the present one, with the tool and the view that suit it.
    ///
    /// # Errors
    /// None: the pages' curves are valid.
    pub fn open(self, editor: &mut Editor) -> Reply {
        let document = documents::of(self).map_err(|error| Refusal(error.to_string()));
        editor.open_document(document)?;
        let document = editor.document();
        // The active curve is the one to edit; the plots compare it with the reference, or else another
        // curve.
        let active = usize::from(matches!(self, Self::Rounding | Self::Spiral { .. }));
        let active = document.ids().nth(active);
        let references = document.references().map(|(id, _)| id);
        let others: Vec<_> = references.chain(document.ids()).collect();
        let other = others.into_iter().find(|id| Some(*id) != active);
        // A whole is not compared with its parts.
        let compared = other.filter(|_| self != Self::Composite);
        if let Some(active) = active {
            editor.activate(active);
        }
        editor.execute(Command::Compare(compared))?;
        let (tool, view) = match self {
            Self::Steps => (ToolKind::EndFit, NamedView::Xy),
            Self::Spiral { .. } => (ToolKind::Select, NamedView::Isometric),
            _ => (ToolKind::Select, NamedView::Xy),
        };
        editor.execute(Command::Tool(tool))?;
        editor.execute(Command::View(view))?;
        editor.execute(Command::FitAll)
    }
}
