//! Work done so far to prepare a device for its frames: shaders, pipelines, uploads.

use std::time::Duration;

/// Amount of one-time work, whose results are kept for later frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Preparation {
    /// Number of pipelines created.
    pub pipelines: u32,
    /// Time to check plans, which includes composing and validating their shaders.
    pub composing: Duration,
    /// Time that the driver took to compile pipelines or to find them in its cache.
    pub compiling: Duration,
    /// Number of buffers created with their contents; textures are not counted.
    pub uploads: u32,
    /// Total size of these buffers in bytes.
    pub bytes: u64,
    /// Time to upload them.
    pub uploading: Duration,
}
