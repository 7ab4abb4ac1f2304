// Caps that several solids share are hatched in a colour of their own, over that of the part that is shown: stripes of the
// picture, so that they are seen whatever the solid's size. Bound as @group(1) @binding(4).

#define_import_path cutaway::overlap

#import cutaway::frame::frame
#import cutaway::layers::OVERLAP

// Linear light.
@group(1) @binding(4) var<uniform> interference: vec4<f32>;

// Pixels from stripe to stripe along a row; a stripe takes three fifths of the period.
const STRIPE_PX: u32 = 10u;

fn cap_base(base: vec3<f32>, word: u32, at: vec2<u32>) -> vec3<f32> {
    let striped = (at.x + at.y + frame.band.x) % STRIPE_PX < STRIPE_PX * 3u / 5u;
    return select(base, interference.rgb, (word & OVERLAP) != 0u && striped);
}
