//! Work done so far to prepare a device for its frames: shaders, pipelines, uploads.

use std::time::Duration;

/// One-time work whose results are kept for later frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Preparation {
    /// Number of pipelines created.
    pub pipelines: u32,
    /// Time to check plans, for which their shaders are composed and validated.
    pub composing: Duration,
    /// Time the driver takes to compile pipelines or to find them in its cache.
    pub compiling: Duration,
    /// Number of buffers created with their contents; textures are not counted.
    pub uploads: u32,
    /// Bytes in these buffers.
    pub bytes: u64,
    /// Time to upload them.
    pub uploading: Duration,
}
