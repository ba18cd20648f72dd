//! The harmony of a float polygon, in numbers: the flow of its control vertices, second-order
//! isogeometry, regularity, and the fairness of its curve (paper, section 3).

mod events;
mod fairness;
mod figures;
mod flow;
mod graph_moments;
mod isogeometry;
mod logarithmic_pieces;
mod measurement;
mod regularity;
#[cfg(test)]
mod tests;

pub use events::Event;
pub use fairness::{Fairness, SegmentFairness};
pub use figures::{HarmonyFigures, VertexFigure, unevenness};
pub use flow::{VertexFlow, VertexSequence};
pub use isogeometry::{EventCounts, Isogeometry, Match, Mismatch};
pub use logarithmic_pieces::LogarithmicPiece;
pub use measurement::Harmony;
pub use regularity::{Irregularity, IrregularityKind, Regularity};
