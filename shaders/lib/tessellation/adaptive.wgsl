// Vertices of an adaptive tessellation: an index holds the two coordinates of a vertex, 16 bits each.

#define_import_path cutaway::tessellation

#import cutaway::domain::point_at
#import cutaway::facets::{CapVertex, surface_of}

fn cap_vertex(index: u32, instance: u32) -> CapVertex {
    let surface = surface_of(instance);
    return CapVertex(point_at(surface, vec2<i32>(vec2<u32>(index & 0xffffu, index >> 16u))), surface);
}
