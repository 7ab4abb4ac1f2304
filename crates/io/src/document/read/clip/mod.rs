//! Readers of the removed regions: `[[cut]]` and `[relief.NAME]`.

pub(super) mod cutaways;
pub(super) mod cuts;
pub(super) mod cutters;
pub(super) mod regions;
pub(super) mod reliefs;
