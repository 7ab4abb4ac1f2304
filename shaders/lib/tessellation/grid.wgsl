// The vertices of a refined quad, displaced by the offset map (Trapp & Döllner 2013, section 5). The surface lies at -f Sz along
// N, so that is the displacement; the paper's text leaves the sign open. Triangles turn with U and V: they show their front to the
// kept side.

#define_import_path cutaway::tessellation

#import cutaway::cuts::cut_table
#import cutaway::facets::{CapVertex, surface_of}
#import cutaway::quads::{plane_point, quads, relief_over}

// The index counts vertices row by row.
fn cap_vertex(index: u32, instance: u32) -> CapVertex {
    let surface = surface_of(instance);
    let row = quads[surface].cells.x + 1u;
    let point = plane_point(surface, vec2<f32>(f32(index % row), f32(index / row)));
    let moved = point - relief_over(surface, point) * cut_table.surfaces[surface].normal.xyz;
    return CapVertex(moved, surface);
}
