// Draws solids without cuts. The instance index is the part number in the scene.

#import cutaway::mesh::Vertex
#import cutaway::surface::{Corner, corner_of, surface_words}

@vertex
fn vertex(v: Vertex) -> Corner {
    return corner_of(v);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) -> @location(0) vec2<u32> {
    return surface_words(corner, 0u, corner.instance, front);
}
