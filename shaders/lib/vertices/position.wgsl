// The position index of each vertex: vertices split for shading share one position, and everything that moves it.

#define_import_path cutaway::position

@group(1) @binding(2) var<storage, read> position_of_vertex: array<u32>;
