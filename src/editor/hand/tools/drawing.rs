//! What those tools have in common that set vertices: the leg that is drawn, what is locked of it,
//! and the curve that would result.

use glam::DVec3;

use super::tool::{Context, Effect};
use crate::editor::hand::drawing_plane::LegLocks;
use crate::editor::hand::typed_point::{EntryError, TypedPoint};
use crate::geometry::FloatPolygon;

/// A tool that sets vertices.
pub trait DrawingTool {
    /// The leg that is drawn: from the vertex before to the one that would be set now, at what is
    /// typed or at the pointer. The first is missing while there is none, the second while nothing
    /// says where it would be.
    fn leg(&self, context: &Context) -> (Option<DVec3>, Option<DVec3>);

    /// What is locked of the leg.
    fn locks(&self) -> LegLocks;

    /// Lock other figures of the leg, or none.
    fn set_locks(&mut self, locks: LegLocks);

    /// Set the vertex that was typed.
    ///
    /// # Errors
    /// [`EntryError`] if it counts from a vertex that there is not, or nothing can be set there.
    fn enter(&mut self, typed: TypedPoint, context: &Context) -> Result<Vec<Effect>, EntryError>;

    /// The polygon that there would be if the vertex was set now; none while the document shows it
    /// already, or there is too little for one.
    fn proposal(&self, context: &Context) -> Option<FloatPolygon>;
}
