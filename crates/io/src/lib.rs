//! Files of [`cutaway`]: what comes in and what goes out, without a device.
//!
//! [`load`] reads meshes, images and motions; [`document`] is the scene file: every value by its path, every slip with its place; [`save`]
//! writes meshes, images and sections.
//!
//! ```text
//! imports  load <- document
//!          cutaway <- save
//! ```

pub mod document;
pub mod load;
pub mod save;

pub use document::Document;
