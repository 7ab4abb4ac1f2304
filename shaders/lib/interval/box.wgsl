// The depths between which crossings of a ray matter: in the box of the cut solids.

#define_import_path cutaway::interval

#import cutaway::asked::Interval
#import cutaway::frame::{box_interval, centre_of, ray_through}

fn interval_at(pixel: vec2<u32>, from_near: bool) -> Interval {
    let all = box_interval(ray_through(centre_of(pixel)));
    return Interval(all, all);
}
