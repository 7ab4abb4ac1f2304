//! Automatically placed cutaways (Diepstraten, Weiskopf and Ertl 2003): which parts are interior, the axis to cut around, and the
//! opening through which interior parts are seen.

mod axes;
mod breakaway;
mod kept_hulls;
mod open;
mod roles;
mod whole;

pub use axes::{AxisRule, CutoutFrame, MainAxes};
pub use breakaway::{Breakaway, BreakawayView, Clusters};
pub use kept_hulls::KeptHulls;
pub use roles::{Sight, sights};
pub(crate) use whole::is_removed_whole;
