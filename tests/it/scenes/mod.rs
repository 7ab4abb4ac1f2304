//! Scene documents, what moves in them, and how they look.

pub(crate) mod cutaways;
pub(crate) mod documents;
pub(crate) mod framing;
pub(crate) mod hidden_parts;
pub(crate) mod hostile_scenes;
pub(crate) mod motions;
pub(crate) mod moving;
pub(crate) mod paths;
pub(crate) mod places;
pub(crate) mod scene_files;
pub(crate) mod style;
pub(crate) mod timelines;
