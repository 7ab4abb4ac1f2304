// Pyramids while they are built: all of a frame in one buffer, level after level, rows of nodes in each. Bound as @group(1)
// @binding(0).

#define_import_path cutaway::pyramid_built

// Least and greatest height.
@group(1) @binding(0) var<storage, read_write> built: array<vec2<f32>>;
