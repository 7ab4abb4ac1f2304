// Marks the pixels of parts whose section by a plane is not closed: a ray that goes from removed to kept there may miss a cap. One
// fragment owns one pixel of one triangle; it costs a walk through the list of its pixel.
//
// The mark is set, not flipped, in the plane of words behind the lanes: triangles may share pixels, and so may parts.

#import cutaway::crossings::{head_of, surface_at}
#import cutaway::cuts::{MAX_SURFACES, is_removed, parts}
#import cutaway::frame::{pixel_count, pixel_index}
#import cutaway::mask::mask
#import cutaway::mesh::drawn_position

struct Corner {
    @builtin(position) position: vec4<f32>,
    // Bits of the cuts that apply to the part, and the plane's index among the clip-surfaces.
    @location(0) @interpolate(flat) cuts: u32,
    @location(1) @interpolate(flat) surface: u32,
}

// The instance is the part's table index times MAX_SURFACES, plus the clip-surface's.
@vertex
fn vertex(@location(0) position: vec3<f32>, @builtin(instance_index) instance: u32) -> Corner {
    return Corner(drawn_position(position), parts[instance / MAX_SURFACES].cuts, instance % MAX_SURFACES);
}

@fragment
fn fragment(corner: Corner) {
    let at = vec2<u32>(corner.position.xy);
    let pixel = pixel_index(at);
    let head = head_of(at);
    var sides = head.sides;
    for (var i = 0u; i < head.count; i++) {
        let surface = surface_at(head, i, at);
        let after = sides ^ (1u << surface);
        if surface == corner.surface {
            // A ray crosses a plane once.
            if is_removed(sides, corner.cuts) && !is_removed(after, corner.cuts) {
                let doubt_plane = arrayLength(&mask) / pixel_count() - 1u;
                atomicOr(&mask[doubt_plane * pixel_count() + pixel], 1u);
            }
            return;
        }
        sides = after;
    }
}
