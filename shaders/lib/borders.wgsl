// Borders: between which neighbouring samples of the picture a stroke belongs, and of what class. A word of a pixel has the class of
// the border on its right in bits 0-3 and of that below it in bits 4-7; 0 is none.

#define_import_path cutaway::borders

const NO_BORDER: u32 = 0u;
// One side is background.
const OUTLINE: u32 = 1u;
// One side is a cap, the other of another kind or part.
const CUT: u32 = 2u;
// Surfaces of two parts.
const PART: u32 = 3u;
// Caps of one part by two clip-surfaces.
const FACE: u32 = 4u;
// The depth of one part jumps.
const CONTOUR: u32 = 5u;
// A surface is folded.
const CREASE: u32 = 6u;

fn right_of(word: u32) -> u32 {
    return word & 15u;
}

fn below_of(word: u32) -> u32 {
    return (word >> 4u) & 15u;
}
