//! File input and output for [`cutaway`]. No GPU device is needed.
//!
//! [`load`] reads meshes, images and motions. [`document`] is the scene file, in which every value has a path and every error a position.
//! [`save`] writes meshes, images and sections.
//!
//! ```text
//! imports  load <- document
//!          cutaway <- save
//! ```

pub mod document;
pub mod load;
pub mod save;

pub use document::Document;
