// Cap normals if some clip-surface has a relief: the normal of the bilinear height field.

#define_import_path cutaway::cap_normal

#import cutaway::frame::{centre_of, ray_through}
#import cutaway::layers::pack_normal
#import cutaway::relief::cap_normal
#import cutaway::surfaces::surface_of

fn packed_cap_normal(at: vec2<u32>, word: u32, depth: f32) -> u32 {
    let ray = ray_through(centre_of(at));
    return pack_normal(cap_normal(surface_of(word), ray.origin + depth * ray.direction));
}
