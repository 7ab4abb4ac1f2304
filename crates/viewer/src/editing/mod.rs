//! The document of the window: lists of its contents, changes and undo.

pub mod command;
pub mod cuts;
pub mod history;
pub mod link;
pub mod parts;
pub mod regions;
pub mod removal;
pub mod styles;
pub mod timeline;
