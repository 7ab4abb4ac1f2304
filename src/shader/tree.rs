//! The files of `shaders/`, embedded. A test compares this list with the folder.

macro_rules! files {
    ($($path:literal),* $(,)?) => {
        &[$(($path, include_str!(concat!("../../shaders/", $path)))),*]
    };
}

/// Modules. A module path that several files define is *open*: who composes a shader says which of them fills it.
pub const LIBRARY: &[(&str, &str)] = files![
    "lib/frame.wgsl",
    "lib/layers.wgsl",
    "lib/cuts.wgsl",
    "lib/relief.wgsl",
    "lib/rays.wgsl",
    "lib/quadratic.wgsl",
    "lib/mesh.wgsl",
    "lib/surface.wgsl",
    "lib/background.wgsl",
    "lib/light.wgsl",
    "lib/lanes.wgsl",
    "lib/mask.wgsl",
    "lib/fragment_pool.wgsl",
    "lib/fragment_lists.wgsl",
    "lib/fragment_runs.wgsl",
    "lib/cascade.wgsl",
    "lib/reduced.wgsl",
    "lib/winding.wgsl",
    "lib/store/mask.wgsl",
    "lib/store/count.wgsl",
    "lib/store/keep.wgsl",
    "lib/store/cascade.wgsl",
    "lib/store/nothing.wgsl",
    "lib/store/winding.wgsl",
    "lib/parity.wgsl",
    "lib/inside/mask.wgsl",
    "lib/inside/winding.wgsl",
    "lib/crossings.wgsl",
    "lib/crossing_list.wgsl",
    "lib/plane_crossing.wgsl",
    "lib/decision.wgsl",
    "lib/overlap/plain.wgsl",
    "lib/overlap/hatched.wgsl",
    "lib/drawn/targets.wgsl",
    "lib/cap_normal/planes.wgsl",
    "lib/cap_normal/reliefs.wgsl",
    "lib/cap_normal/cutters.wgsl",
    "lib/cap_normal/cutters_reliefs.wgsl",
    "lib/crossing_words.wgsl",
    "lib/wide.wgsl",
    "lib/screen.wgsl",
    "lib/clipping.wgsl",
    "lib/flat.wgsl",
    "lib/span.wgsl",
    "lib/tiles.wgsl",
    "lib/sweep.wgsl",
    "lib/claims.wgsl",
    "lib/ranking.wgsl",
    "lib/nearest.wgsl",
    "lib/nearest_wide.wgsl",
    "lib/sample/ranked.wgsl",
    "lib/sample/bare.wgsl",
    "lib/sample/fused.wgsl",
    "lib/fresh/frame.wgsl",
    "lib/fresh/nothing.wgsl",
    "lib/cover.wgsl",
    "lib/scan.wgsl",
    "lib/sprite.wgsl",
    "lib/vds.wgsl",
    "lib/ldi.wgsl",
    "lib/volume/vds.wgsl",
    "lib/volume/ldi.wgsl",
    "lib/pose.wgsl",
    "lib/position.wgsl",
    "lib/morph/none.wgsl",
    "lib/morph/targets.wgsl",
    "lib/skin/none.wgsl",
    "lib/skin/linear.wgsl",
    "lib/trig.wgsl",
    "lib/deformers.wgsl",
    "lib/deform/none.wgsl",
    "lib/deform/space.wgsl",
    "lib/deform/mesh.wgsl",
    "lib/full_screen.wgsl",
    "lib/lone_plane.wgsl",
    "lib/facets.wgsl",
    "lib/quads.wgsl",
    "lib/tessellation/grid.wgsl",
    "lib/sheet_words.wgsl",
    "lib/sheet_side/grid.wgsl",
    "lib/sheet_side/none.wgsl",
    "lib/sheet_store/count.wgsl",
    "lib/sheet_store/keep.wgsl",
];

/// Whole shaders.
pub const SHADERS: &[(&str, &str)] = files![
    "passes/pose.wgsl",
    "passes/surface.wgsl",
    "passes/gather.wgsl",
    "passes/shade.wgsl",
    "passes/solid.wgsl",
    "passes/fragments.wgsl",
    "passes/probe.wgsl",
    "passes/sheet/clear.wgsl",
    "passes/sheet/draw.wgsl",
    "passes/sheet/merge.wgsl",
    "passes/resolve.wgsl",
    "passes/scan/sums.wgsl",
    "passes/scan/top.wgsl",
    "passes/scan/blocks.wgsl",
    "passes/rasterise/transform.wgsl",
    "passes/rasterise/small.wgsl",
    "passes/rasterise/large.wgsl",
    "passes/rasterise/clipped.wgsl",
    "passes/rasterise/decide.wgsl",
    "passes/rasterise/paint.wgsl",
    "strategies/surface/raycast/planes.wgsl",
    "strategies/surface/raycast/reliefs.wgsl",
    "strategies/surface/cutter/draw.wgsl",
    "strategies/surface/paper/clip.wgsl",
    "strategies/surface/paper/cap.wgsl",
    "strategies/inside/abuffer/reduce.wgsl",
    "strategies/inside/kbuffer/reduce.wgsl",
    "strategies/inside/ldi/clear.wgsl",
    "strategies/inside/ldi/fragments.wgsl",
    "strategies/inside/stencil/lay.wgsl",
    "strategies/inside/stencil/mark.wgsl",
    "strategies/inside/stencil/take.wgsl",
    "strategies/inside/stencil/solid.wgsl",
    "strategies/inside/stencil/cap.wgsl",
    "strategies/inside/vds/clear.wgsl",
    "strategies/inside/vds/count.wgsl",
    "strategies/inside/vds/peel_first.wgsl",
    "strategies/inside/vds/peel_next.wgsl",
];

/// Files that core WebGPU does not run, and why there is another way without them: shaders that they are part of are validated
/// with atomics of 64 bits, and plans with such a shader are held to adapters that have them.
pub const NATIVE: &[(&str, &str)] = &[(
    "lib/nearest_wide.wgsl",
    "depth and triangle in one atomic maximum; lib/nearest.wgsl takes two sweeps instead",
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
