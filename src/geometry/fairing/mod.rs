//! Reshaping curves under conditions: the least disturbance that corrects ends, and the least
//! change that restores harmony.
//!
//! Both make a sum of squares of the vertices as small as possible while conditions on points and
//! derivatives hold. Residuals and conditions are local, so the equations are banded, and the
//! conditions, a few at each end, are eliminated: with H = JᵀJ, the gradient g and the rows A of the
//! linearised conditions c, a step is d = −H⁻¹(g + Aᵀλ) with A d = −c.

pub mod bends;
pub mod bridging;
mod condition;
pub mod counts;
mod displaced_inflection;
mod dual;
mod flow;
pub mod following;
mod harmonised;
pub mod harmonising;
mod jet_weights;
pub mod joint_correction;
pub mod kept_jets;
pub mod least_change;
mod least_squares;
pub mod mirrored_half;
pub mod near_end;
pub(super) mod near_points;
mod objective;
pub(super) mod point_fit;
mod problem;
mod refitting;
pub mod requirement;
mod slope_signs;
mod through_ends;
mod through_points;
mod unknowns;
mod walk;
