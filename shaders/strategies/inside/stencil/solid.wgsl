// Draws the part of a solid that the only plane keeps. Every kept fragment counts in the stencil, hidden or not: if the ray starts on the
// removed side these are the fragments behind the plane.

#import cutaway::cuts::parts
#import cutaway::mesh::Vertex
#import cutaway::lone_plane::{is_kept, lone_plane_at}
#import cutaway::surface::{Corner, corner_of, surface_words}

@vertex
fn vertex(v: Vertex) -> Corner {
    return corner_of(v);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) -> @location(0) vec2<u32> {
    if !is_kept(lone_plane_at(corner.position.xy), corner.position.z) {
        discard;
    }
    return surface_words(corner, 0u, parts[corner.instance].part, front);
}
