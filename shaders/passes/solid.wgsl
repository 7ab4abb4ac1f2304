// The only pass over the mesh: every fragment counts the crossings in front of it, stores the data for the inside test (the open module
// `store`), and survives if it lies on a kept side. The number of crossings in front of the nearest survivor is stored instead of being
// recomputed later, so this pass alone makes these decisions.

#import cutaway::crossings::crossings_before
#import cutaway::cuts::{is_removed, parts}
#import cutaway::exits::is_passed
#import cutaway::frame::pixel_index
#import cutaway::lanes::{Fragment, Lane}
#import cutaway::layers::UNCOUNTED
#import cutaway::mesh::Vertex
#import cutaway::store::store
#import cutaway::surface::{Corner, corner_of, surface_words}

override lane_bits: u32 = 32u;

@vertex
fn vertex(v: Vertex) -> Corner {
    return corner_of(v);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) -> @location(0) vec2<u32> {
    let at = vec2<u32>(corner.position.xy);
    let pixel = pixel_index(at);
    let before = crossings_before(corner.position.z, at);
    let part = parts[corner.instance];
    let lane = Lane(part.lane_word, part.lane_shift, lane_bits);
    store(Fragment(pixel, lane, corner.instance, corner.position.z, before.behind, front));
    if is_removed(before.sides, part.cuts) || is_passed(front) {
        discard;
    }
    // A number too large for its bits is searched for again by the deciding pass.
    return surface_words(corner, min(before.behind, UNCOUNTED), part.part, front);
}
