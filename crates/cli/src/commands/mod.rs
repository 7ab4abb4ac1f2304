//! The subcommands, one file or folder each.

pub(crate) mod animate;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod demo;
pub(crate) mod doctor;
pub(crate) mod export;
pub(crate) mod inspect;
pub(crate) mod measure;
pub(crate) mod plan;
pub(crate) mod reference;
pub(crate) mod relief;
pub(crate) mod render;
pub(crate) mod report;
pub(crate) mod scene;
pub(crate) mod section;
pub(crate) mod view;
