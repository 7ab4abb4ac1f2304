// Sheet fragments as words. Bits 0-4 are the clip-surface, by its index in the table; bit 5 is set if the triangle shows its front, which
// faces the kept side: there a ray leaves the kept region. Bits 6-31 are those of a crossing's word (`crossing_words`).

#define_import_path cutaway::sheet_words

fn sheet_word(surface: u32, front: bool) -> u32 {
    return surface | select(0u, 32u, front);
}

fn sheet_of(word: u32) -> u32 {
    return word & 31u;
}

fn shows_front(word: u32) -> bool {
    return (word & 32u) != 0u;
}
