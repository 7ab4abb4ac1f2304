//! The files of `shaders/`, embedded by the build script.

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

/// Files that core WebGPU does not run, and why there is another way without them: shaders that they are part of are validated
/// with atomics of 64 bits, and plans with such a shader are held to adapters that have them.
pub const NATIVE: &[(&str, &str)] = &[(
    "lib/rasterise/nearest_wide.wgsl",
    "depth and triangle in one atomic maximum; lib/rasterise/nearest.wgsl takes two sweeps instead",
)];

/// Both lists.
pub const FILES: [&[(&str, &str)]; 2] = [LIBRARY, SHADERS];

/// Text of a whole shader.
pub fn source(path: &str) -> Option<&'static str> {
    SHADERS
        .iter()
        .find(|(p, _)| *p == path)
        .map(|(_, text)| *text)
}
