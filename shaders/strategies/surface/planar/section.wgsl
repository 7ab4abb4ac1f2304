// Draws the sections of parts by planes, triangulated on the CPU, into the mask: where a section is, the plane's crossing is inside the
// part. One fragment owns one pixel of one triangle.
//
// The bit is flipped, not set: triangles that share their corners cover each pixel of their polygon an odd number of times, even if
// rounding has inverted one of them, and each pixel outside the polygon an even number.

#import cutaway::crossings::{head_of, surface_at}
#import cutaway::cuts::{MAX_SURFACES, parts}
#import cutaway::frame::{pixel_count, pixel_index}
#import cutaway::mask::mask
#import cutaway::mesh::drawn_position

struct Corner {
    @builtin(position) position: vec4<f32>,
    // Location of the part's bits: word and shift; and the plane's index among the clip-surfaces.
    @location(0) @interpolate(flat) lane: vec2<u32>,
    @location(1) @interpolate(flat) surface: u32,
}

// The instance is the part's table index times MAX_SURFACES, plus the clip-surface's.
@vertex
fn vertex(@location(0) position: vec3<f32>, @builtin(instance_index) instance: u32) -> Corner {
    let part = parts[instance / MAX_SURFACES];
    let lane = vec2<u32>(part.lane_word, part.lane_shift);
    return Corner(drawn_position(position), lane, instance % MAX_SURFACES);
}

@fragment
fn fragment(corner: Corner) {
    let at = vec2<u32>(corner.position.xy);
    let pixel = pixel_index(at);
    let head = head_of(at);
    for (var i = 0u; i < head.count; i++) {
        if surface_at(head, i, at) == corner.surface {
            // A ray crosses a plane once.
            atomicXor(&mask[corner.lane.x * pixel_count() + pixel], 1u << (corner.lane.y + i));
            return;
        }
    }
}
