//! What it took to make a device ready for its frames so far: shaders, pipelines, uploads.

use std::time::Duration;

use web_time::Instant;

/// Work that was done once and is kept for later frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Preparation {
    /// Pipelines that were made.
    pub pipelines: u32,
    /// Composing and validating shaders, of all devices of the process.
    pub composing: Duration,
    /// The driver compiling them, or finding them in its cache.
    pub compiling: Duration,
    /// Buffers that were made with their contents.
    pub uploads: u32,
    /// Bytes in them.
    pub bytes: u64,
    /// Handing these over.
    pub uploading: Duration,
}

/// Does something, and adds the time it took.
pub(super) fn timed<T>(time: &mut Duration, work: impl FnOnce() -> T) -> T {
    let began = Instant::now();
    let done = work();
    *time += began.elapsed();
    done
}
