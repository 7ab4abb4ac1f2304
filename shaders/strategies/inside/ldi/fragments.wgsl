// Draws parts into their layered depth images: each fragment stores the data of the open module `store` in its texel's list.

#import cutaway::lanes::{Fragment, Lane}
#import cutaway::ldi::{list_of, sprites}
#import cutaway::sprite::sprite_position
#import cutaway::store::store

struct Corner {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) @interpolate(flat) place: u32,
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @builtin(instance_index) place: u32) -> Corner {
    return Corner(sprite_position(sprites[place], position), place);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) {
    let list = list_of(sprites[corner.place], vec2<u32>(corner.position.xy));
    // Lists of texels replace lists of pixels, and there is no mask lane.
    store(Fragment(list, Lane(0u, 0u, 1u), corner.place, corner.position.z, 0u, front));
}
