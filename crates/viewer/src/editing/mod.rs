//! The document of the window: what is shown of it as lists, changed in it and undone.

pub mod command;
pub mod cuts;
pub mod history;
pub mod link;
pub mod parts;
pub mod regions;
pub mod removal;
pub mod styles;
pub mod timeline;
