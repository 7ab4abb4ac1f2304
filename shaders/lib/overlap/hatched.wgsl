// Caps shared by several solids get stripes in a separate colour over the visible part's colour. Stripes are defined in picture space, so
// that they are visible whatever the solid's size. Bound as @group(1) @binding(4).

#define_import_path cutaway::overlap

#import cutaway::frame::frame
#import cutaway::layers::OVERLAP

// Linear light.
@group(1) @binding(4) var<uniform> interference: vec4<f32>;

// Period of the stripes along a row, in pixels; a stripe takes three fifths of the period.
const STRIPE_PX: u32 = 10u;

fn cap_base(base: vec3<f32>, word: u32, at: vec2<u32>) -> vec3<f32> {
    let striped = (at.x + at.y + frame.band.x) % STRIPE_PX < STRIPE_PX * 3u / 5u;
    return select(base, interference.rgb, (word & OVERLAP) != 0u && striped);
}
