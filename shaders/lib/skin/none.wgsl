// No skin: the placement moves all vertices together.

#define_import_path cutaway::skin

#import cutaway::pose::Standing

fn skinned(at: Standing, vertex: u32) -> Standing {
    return at;
}
