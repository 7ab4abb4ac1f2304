// Cap normals if some clip-surface is a cutter and some has a relief. On a cutter: the normal of its triangle, which is stored with the
// crossing and already points to the removed side. Otherwise: the normal of the bilinear height field.

#define_import_path cutaway::cap_normal

#import cutaway::crossing_words::{has_normal, normal_of}
#import cutaway::frame::{centre_of, ray_through}
#import cutaway::layers::pack_normal
#import cutaway::relief::cap_normal
#import cutaway::surfaces::surface_of

fn packed_cap_normal(at: vec2<u32>, word: u32, depth: f32) -> u32 {
    if has_normal(word) {
        return pack_normal(normal_of(word));
    }
    let ray = ray_through(centre_of(at));
    return pack_normal(cap_normal(surface_of(word), ray.origin + depth * ray.direction));
}
