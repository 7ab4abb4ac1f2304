// There is one clip-surface, a plane or a relief: its number is fixed, which saves a lookup for each lane at each use.

#define_import_path cutaway::surfaces

fn keeps_words() -> bool {
    return false;
}

fn surface_of(word: u32) -> u32 {
    return 0u;
}
