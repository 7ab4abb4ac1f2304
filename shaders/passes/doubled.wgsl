// Like `surface`, the pass over solids that no cut reaches, but for groups of coincident triangles: the one that faces the eye is visible.
// The instance is the group number.

#import cutaway::cuts::parts
#import cutaway::exits::is_passed
#import cutaway::mesh::Vertex
#import cutaway::preclassified::{of_doubled, preclassified}
#import cutaway::surface::{Corner, SurfaceAt, corner_of, surface_words}

override behind: u32 = 0u;
override passes_exits: bool = false;

@vertex
fn vertex(v: Vertex) -> Corner {
    return corner_of(v);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) -> SurfaceAt {
    if passes_exits && is_passed(front) {
        discard;
    }
    let part = parts[preclassified.groups[corner.instance].place].part;
    return SurfaceAt(surface_words(corner, behind, part, front), of_doubled(corner.position.z, vec2<u32>(corner.position.xy), corner.instance, front));
}
