// A clip-surface as triangles: the open module `tessellation` makes a vertex from an index and an instance. Its function is
// `cap_vertex(index: u32, instance: u32) -> CapVertex`; the same arguments give the same bits in every pass.

#define_import_path cutaway::facets

struct CapVertex {
    // On the clip-surface, in scene space.
    point: vec3<f32>,
    // Index in the table of clip-surfaces.
    surface: u32,
}

// An instance is a pair of part and clip-surface: 32 times the part's table index plus the clip-surface's index.
fn surface_of(instance: u32) -> u32 {
    return instance % 32u;
}

fn place_of(instance: u32) -> u32 {
    return instance / 32u;
}
