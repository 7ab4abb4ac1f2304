// Which position each vertex is at: vertices that shading split share one, and with it all that moves it.

#define_import_path cutaway::position

@group(1) @binding(2) var<storage, read> position_of_vertex: array<u32>;
