// Between which depths crossings of a ray matter: in the box of the cut solids.

#define_import_path cutaway::interval

#import cutaway::frame::{box_interval, centre_of, ray_through}

struct Interval {
    // Empty where x >= y.
    all: vec2<f32>,
    // The part of it in which crossings are asked for; what is found there hangs on all of it alone.
    part: vec2<f32>,
}

fn interval_at(pixel: vec2<u32>, from_near: bool) -> Interval {
    let all = box_interval(ray_through(centre_of(pixel)));
    return Interval(all, all);
}
