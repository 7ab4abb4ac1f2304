//! The files of `shaders/`, embedded. A test compares this list with the folder.

macro_rules! files {
    ($($path:literal),* $(,)?) => {
        &[$(($path, include_str!(concat!("../../shaders/", $path)))),*]
    };
}

/// Modules, each after the modules it imports.
pub const LIBRARY: &[(&str, &str)] = files![
    "lib/frame.wgsl",
    "lib/layers.wgsl",
    "lib/cuts.wgsl",
    "lib/relief.wgsl",
    "lib/rays.wgsl",
    "lib/quadratic.wgsl",
    "lib/mesh.wgsl",
    "lib/mask.wgsl",
    "lib/crossings.wgsl",
    "lib/crossing_list.wgsl",
    "lib/plane_crossing.wgsl",
    "lib/decision.wgsl",
    "lib/drawn.wgsl",
    "lib/wide.wgsl",
    "lib/screen.wgsl",
    "lib/clipping.wgsl",
    "lib/span.wgsl",
    "lib/tiles.wgsl",
    "lib/sweep.wgsl",
    "lib/sample.wgsl",
    "lib/cover.wgsl",
    "lib/vds.wgsl",
];

/// Whole shaders.
pub const SHADERS: &[(&str, &str)] = files![
    "passes/surface.wgsl",
    "passes/gather.wgsl",
    "passes/shade.wgsl",
    "passes/rasterise/transform.wgsl",
    "passes/rasterise/small.wgsl",
    "passes/rasterise/large.wgsl",
    "passes/rasterise/clipped.wgsl",
    "passes/rasterise/surfaces.wgsl",
    "strategies/surface/raycast/planes.wgsl",
    "strategies/surface/raycast/reliefs.wgsl",
    "strategies/surface/grid/clip.wgsl",
    "strategies/surface/grid/cap.wgsl",
    "strategies/inside/mask/solid.wgsl",
    "strategies/inside/mask/resolve_planes.wgsl",
    "strategies/inside/mask/resolve_reliefs.wgsl",
    "strategies/inside/mask/compute/resolve_planes.wgsl",
    "strategies/inside/mask/compute/resolve_reliefs.wgsl",
    "strategies/inside/vds/clear.wgsl",
    "strategies/inside/vds/count.wgsl",
    "strategies/inside/vds/peel_first.wgsl",
    "strategies/inside/vds/peel_next.wgsl",
];

/// Both lists.
pub const FILES: [&[(&str, &str)]; 2] = [LIBRARY, SHADERS];

/// Text of a whole shader.
pub fn source(path: &str) -> Option<&'static str> {
    SHADERS
        .iter()
        .find(|(p, _)| *p == path)
        .map(|(_, text)| *text)
}
