// Any number of clip-surfaces: each crossing stores its own.

#define_import_path cutaway::surfaces

#import cutaway::crossing_words::surface_of_word
#import cutaway::cuts::cut_table

// Returns true if a list stores a word for each crossing next to its depth: a single clip-surface needs none.
fn keeps_words() -> bool {
    return cut_table.surface_count > 1u || cut_table.has_normals != 0u;
}

// Clip-surface of a crossing.
fn surface_of(word: u32) -> u32 {
    return surface_of_word(word);
}
