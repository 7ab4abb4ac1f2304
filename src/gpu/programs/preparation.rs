//! Work done so far to make a device ready for its frames: shaders, pipelines, uploads.

use std::time::Duration;

/// Work that was done once and is kept for later frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Preparation {
    /// Pipelines that were made.
    pub pipelines: u32,
    /// Checking plans, for which their shaders are composed and validated.
    pub composing: Duration,
    /// The driver compiling them, or finding them in its cache.
    pub compiling: Duration,
    /// Buffers that were made with their contents; textures are not counted.
    pub uploads: u32,
    /// Bytes in them.
    pub bytes: u64,
    /// Handing these over.
    pub uploading: Duration,
}
