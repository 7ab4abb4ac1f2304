// Surfaces have the colours of their parts.

#define_import_path cutaway::coat

fn coat_at(at: vec2<u32>, word: u32) -> u32 {
    return 0u;
}
