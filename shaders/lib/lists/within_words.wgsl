// The last word of a listed sample within slabs. Bits 0-23 are the row of the part, bit 24 + i is set if it is within the slab of
// clip-surface i.

#define_import_path cutaway::within_words

fn within_word(row: u32, slabs: u32) -> u32 {
    return row | (slabs << 24u);
}

fn row_of_word(word: u32) -> u32 {
    return word & 0xffffffu;
}

fn slabs_of_word(word: u32) -> u32 {
    return word >> 24u;
}
