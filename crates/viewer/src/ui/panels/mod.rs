//! The panels around the picture.

pub(super) mod compare;
pub(super) mod cost;
pub(super) mod defects;
pub(super) mod properties;
pub(super) mod scene;
pub(super) mod style;
pub(super) mod survey;
pub(super) mod time;
pub(super) mod value;
