// Every fragment of the cut parts stores the data for the inside test (the open module `store`), without drawing: for data that must be
// known before the pass that draws surfaces.

#import cutaway::cuts::parts
#import cutaway::frame::pixel_index
#import cutaway::lanes::{Fragment, Lane}
#import cutaway::mesh::drawn_position
#import cutaway::store::store

override lane_bits: u32 = 32u;

struct Corner {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) @interpolate(flat) place: u32,
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @builtin(instance_index) place: u32) -> Corner {
    return Corner(drawn_position(position), place);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) {
    let lane = Lane(parts[corner.place].lane_word, parts[corner.place].lane_shift, lane_bits);
    // Crossings are irrelevant here: the number in front is unknown.
    store(Fragment(pixel_index(vec2<u32>(corner.position.xy)), lane, corner.place, corner.position.z, 0u, front));
}
