//! Cutaways that place themselves (Diepstraten, Weiskopf and Ertl 2003): which parts are inside, the axis to cut around, and the opening
//! through which what is inside is seen.

mod axes;
mod breakaway;
mod open;
mod roles;
mod whole;

pub use axes::{AxisRule, CutoutFrame, MainAxes};
pub use breakaway::{Breakaway, BreakawayView, Clusters};
pub use roles::{Sight, sights};
pub(crate) use whole::is_removed_whole;
