// Cap normals if all clip-surfaces are planes: the normal of the plane, pointing to the removed side.

#define_import_path cutaway::cap_normal

#import cutaway::cuts::cut_table
#import cutaway::layers::pack_normal
#import cutaway::surfaces::surface_of

fn packed_cap_normal(at: vec2<u32>, word: u32, depth: f32) -> u32 {
    return pack_normal(-cut_table.surfaces[surface_of(word)].normal.xyz);
}
