//! The files of `shaders/`, embedded by the build script.

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

/// Files that core WebGPU cannot run, each with its alternative. Shaders that contain such a file are validated with 64-bit
/// atomics, and plans with such a shader require an adapter that has these.
pub const NATIVE: &[(&str, &str)] = &[(
    "lib/rasterise/nearest_wide.wgsl",
    "depth and triangle in one atomic maximum; lib/rasterise/nearest.wgsl takes two sweeps instead",
)];

/// The library files, and the whole shaders.
pub const FILES: [&[(&str, &str)]; 2] = [LIBRARY, SHADERS];

/// Text of a whole shader.
pub fn source(path: &str) -> Option<&'static str> {
    SHADERS
        .iter()
        .find(|(p, _)| *p == path)
        .map(|(_, text)| *text)
}
