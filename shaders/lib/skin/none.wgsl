// No skin: the placement moves all vertices alike.

#define_import_path cutaway::skin

#import cutaway::pose::Standing

fn skinned(at: Standing, vertex: u32) -> Standing {
    return at;
}
