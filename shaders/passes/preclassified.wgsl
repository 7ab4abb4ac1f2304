// Like the pass over the mesh (`solid`), but for groups of preclassified triangles: their rasterised depth is corrected before it decides
// anything, and the corrected depth goes to the depth buffer. The instance is the group number.

#import cutaway::crossings::crossings_before
#import cutaway::cuts::{is_removed, parts}
#import cutaway::exits::is_passed
#import cutaway::frame::pixel_index
#import cutaway::lanes::{Fragment, Lane}
#import cutaway::layers::UNCOUNTED
#import cutaway::mesh::Vertex
#import cutaway::preclassified::preclassified
#import cutaway::preclassified_depth::preclassified_z
#import cutaway::store::store
#import cutaway::surface::{Corner, SurfaceAt, corner_of, surface_words}

override lane_bits: u32 = 32u;

@vertex
fn vertex(v: Vertex) -> Corner {
    return corner_of(v);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) -> SurfaceAt {
    let at = vec2<u32>(corner.position.xy);
    let pixel = pixel_index(at);
    let z = preclassified_z(corner.position.z, at, corner.instance, front);
    let before = crossings_before(z, at);
    let place = preclassified.groups[corner.instance].place;
    let part = parts[place];
    let lane = Lane(part.lane_word, part.lane_shift, lane_bits);
    store(Fragment(pixel, lane, place, z, before.behind, front));
    if is_removed(before.sides, part.cuts) || is_passed(front) {
        discard;
    }
    return SurfaceAt(surface_words(corner, min(before.behind, UNCOUNTED), part.part, front), z);
}
