// Cap normals if some clip-surface is a cutter and the others are planes. On a cutter: the normal of its triangle, which is stored with the
// crossing and already points to the removed side. Otherwise: the normal of the plane.

#define_import_path cutaway::cap_normal

#import cutaway::crossing_words::{has_normal, normal_of}
#import cutaway::cuts::cut_table
#import cutaway::layers::pack_normal
#import cutaway::surfaces::surface_of

fn packed_cap_normal(at: vec2<u32>, word: u32, depth: f32) -> u32 {
    if has_normal(word) {
        return pack_normal(normal_of(word));
    }
    return pack_normal(-cut_table.surfaces[surface_of(word)].normal.xyz);
}
