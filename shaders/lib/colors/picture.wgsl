// The picture, RGBA8 as sRGB. Bound as @group(1) @binding(2).

#define_import_path cutaway::picture

@group(1) @binding(2) var<storage, read_write> picture: array<u32>;
