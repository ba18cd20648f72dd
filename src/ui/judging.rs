//! How the curves of a document are judged: what they are compared with, up to which limit, and whose combs are drawn.

use serde::{Deserialize, Serialize};

use crate::document::CurveId;
use crate::editor::{CombsOf, Editor, Whiskers};

/// What settings keep of the judging of one document.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Judging {
    /// The curves and references that are compared with others, by their places in the document.
    comparisons: Vec<[usize; 2]>,
    limit: Option<f64>,
    scale: Option<f64>,
    within_ends: bool,
    combs_of: String,
}

impl Judging {
    /// Take what an editor shows.
    pub fn of(editor: &Editor) -> Self {
        let (document, view) = (editor.document(), editor.view());
        let place = |id| document.all_ids().position(|it| it == id);
        let places = view.comparisons().map(|pair| pair.map(place));
        let comparisons = places.filter_map(|[one, other]| Some([one?, other?]));
        Self {
            comparisons: comparisons.collect(),
            limit: view.whiskers.limit,
            scale: view.whiskers.scale,
            within_ends: view.whiskers.within_ends,
            combs_of: view.combs_of.name().to_owned(),
        }
    }

    /// Let an editor show it again.
    pub fn restore(&self, editor: &mut Editor) {
        let ids: Vec<CurveId> = editor.document().all_ids().collect();
        let view = editor.view_mut();
        for places in &self.comparisons {
            if let [Some(one), Some(other)] = places.map(|place| ids.get(place)) {
                view.compare(*one, Some(*other));
            }
        }
        view.whiskers = Whiskers {
            limit: self.limit.filter(|it| *it > 0.0 && it.is_finite()),
            scale: self.scale.filter(|it| Whiskers::SCALES.contains(it)),
            within_ends: self.within_ends,
            ..view.whiskers
        };
        let mut all = CombsOf::ALL.into_iter();
        view.combs_of = all
            .find(|it| it.name() == self.combs_of)
            .unwrap_or_default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Curve, Document};
    use crate::geometry::FloatPolygon;

    fn editor() -> Editor {
        let curve = |name: &str, height: f64| {
            let points = [(0.0, 0.0), (1.0, height), (2.0, height), (3.0, 0.0)];
            Curve::new(name, FloatPolygon::planar(2, &points).expect("a polygon"))
        };
        Editor::with_document(Document::from_curves([curve("a", 1.0), curve("b", 2.0)]))
    }

    #[test]
    fn a_document_is_judged_as_before() {
        let mut before = editor();
        let ids: Vec<CurveId> = before.document().all_ids().collect();
        let view = before.view_mut();
        view.compare(ids[0], Some(ids[1]));
        view.whiskers.limit = Some(0.1);
        view.whiskers.within_ends = true;
        view.combs_of = CombsOf::Visible;
        let judging = Judging::of(&before);
        let text = serde_json::to_string(&judging).expect("settings");
        let read: Judging = serde_json::from_str(&text).expect("settings");
        assert_eq!(read, judging);
        let mut after = editor();
        assert_ne!(Judging::of(&after), judging);
        read.restore(&mut after);
        assert_eq!(Judging::of(&after), judging);
        assert_eq!(after.view().compared(ids[0]), Some(ids[1]));
        let mut empty = Editor::with_document(Document::default());
        read.restore(&mut empty);
        assert_eq!(empty.view().comparisons().count(), 0);
    }
}
