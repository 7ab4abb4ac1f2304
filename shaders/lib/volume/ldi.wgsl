// Tests whether a point is inside a part by its layered depth image: true if an odd number of the texel's depths lies behind the point.

#define_import_path cutaway::volume

#import cutaway::fragment_runs::{MOST_FRAGMENTS, depth_of, run_of}
#import cutaway::ldi::{list_of, sprites}
#import cutaway::sprite::{Probe, is_beside, sprite_from_scene, texel_of}

fn probe(place: u32, point: vec3<f32>) -> Probe {
    let sprite = sprites[place];
    let at = sprite_from_scene(sprite, point);
    if is_beside(at) {
        return Probe(false, false);
    }
    let run = run_of(list_of(sprite, texel_of(sprite, at)));
    var is_inside = false;
    for (var n = 0u; n < min(run.end - run.first, MOST_FRAGMENTS); n++) {
        let i = run.first + n;
        if at.z < depth_of(i) {
            is_inside = !is_inside;
        }
    }
    return Probe(is_inside, !run.fits);
}
