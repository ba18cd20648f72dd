//! A tour of the paper behind Batten: *Techniques for modeling a high-quality B-spline curves by S-polygons
//! in a float format* (R. Ziatdinov et al.). Each page opens one figure or table as a document and explains
//! it. Beyond the paper, the pages check its printed figures.

mod documents;
mod figures;
mod opening;
mod page;
mod rounding;

pub use documents::{PaperError, spiral_deviations};
pub use figures::{Figures, scientific};
pub use page::{Block, PaperPage};
pub use rounding::{has_shortened, show_shortened};
