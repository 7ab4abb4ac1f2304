//! Removed regions: planes, height maps, boxes and wedges, cutters, and the cuts that combine them.

pub(super) mod clip_surface;
pub(super) mod cut;
pub(super) mod cutter;
pub(super) mod height_filter;
pub(super) mod offset_map;
pub(super) mod plane_spec;
pub(super) mod regions;
mod upright;
