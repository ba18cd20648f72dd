//! Bringing up to date all that panels, plots and canvas read.

use crate::editor::Editor;

impl Editor {
    /// Bring up to date all that is derived from the document and how it is seen: analyses, features,
    /// harmony, distances, guides, the scene and what is hovered, and the plot that is shown. Whoever reads any of it
    /// does so after this.
    pub fn refresh(&mut self) {
        self.analyse();
        self.prove();
        self.measure();
        self.compare_distances();
        self.guide();
        self.draw();
        self.plot();
    }

    /// Bring up to date what hit tests look at.
    pub(in crate::editor) fn analyse(&mut self) {
        self.analyses.update(self.workspace.document());
        let orientation = self.view.viewport.orientation;
        self.view.outlines.update(&self.analyses, orientation);
    }
}
