// Draws uncut solids; `draw_only` measures this pass, and it is the only one if nothing is cut.

#import cutaway::cuts::parts
#import cutaway::exits::is_passed
#import cutaway::mesh::Vertex
#import cutaway::surface::{Corner, corner_of, surface_words}

// Number of crossings in front of a surface: 0, or UNCOUNTED if a later pass counts them.
override behind: u32 = 0u;
// True without a near-plane cap; otherwise nothing is discarded, so that depth is tested early.
override passes_exits: bool = false;

@vertex
fn vertex(v: Vertex) -> Corner {
    return corner_of(v);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) -> @location(0) vec2<u32> {
    if passes_exits && is_passed(front) {
        discard;
    }
    return surface_words(corner, behind, parts[corner.instance].part, front);
}
