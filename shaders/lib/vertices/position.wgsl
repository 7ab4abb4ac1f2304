// The position index of each vertex. Vertices split for shading share one position, so they move together.

#define_import_path cutaway::position

@group(1) @binding(2) var<storage, read> position_of_vertex: array<u32>;
