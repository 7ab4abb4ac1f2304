//! Input of a frame, and the data that its passes share: the active cuts, buffers and lists.

pub(crate) mod active_cuts;
pub(crate) mod buffers;
pub(crate) mod closings;
pub(crate) mod crossings;
pub(crate) mod dispatch;
pub(crate) mod fragments;
pub(crate) mod height_filter;
pub(crate) mod input;
pub(crate) mod lanes;
pub(crate) mod need;
pub(crate) mod on_screen;
pub(crate) mod pose;
pub(crate) mod preclassified;
pub(crate) mod pyramid;
pub(crate) mod rasteriser;
pub(crate) mod refusal;
pub(crate) mod relief_walk;
pub(crate) mod sections;
pub(crate) mod touched;
