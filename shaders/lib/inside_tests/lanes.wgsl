// Lanes: the bits or counts of one part among the words of a pixel. Several lanes of bits share a word; a lane of more than 32 bits
// consists of whole words: bit i is bit i % 32 of word i / 32.

#define_import_path cutaway::lanes

// Maximum number of crossings in a list, whose head counts them in ten bits.
const MOST_CROSSINGS: u32 = 1023u;
// Maximum number of lane words per pixel, and of parts that have a lane; also in `src/passes/frame/lanes.rs`.
const MOST_LANE_WORDS: u32 = 1024u;
const MOST_LANES: u32 = 16384u;

// Crossings that a lane within one word has bits for.
const CROSSINGS_OF_A_WORD: u32 = 31u;

// Value that replaces a shift if the part is filled by the nonzero rule, so that its lane consists of words of counts.
const WINDING: u32 = 32u;

// Location and number of a part's bits: up to 32, or a multiple of 32.
struct Lane {
    // The lane's word; its first word if there are several.
    word: u32,
    shift: u32,
    bits: u32,
}

// A fragment of a part that needs an inside test.
struct Fragment {
    pixel: u32,
    lane: Lane,
    // Part-table index of the part.
    place: u32,
    // Value of the depth buffer.
    z: f32,
    // Number of crossings in front of the fragment.
    behind: u32,
    // True if the fragment shows the front of its triangle.
    front: bool,
}

// The bits of the first `count` crossings that are in word `word` of a lane.
fn thermometer(count: u32, word: u32) -> u32 {
    let here = min(max(count, 32u * word) - 32u * word, 32u);
    return select(0xffffffffu >> (32u - here), 0u, here == 0u);
}

// The layout of lanes, and a flag for a near plane that meets a solid: then an odd total means that the ray starts inside, not that the
// mesh is open. `overlaps` requests that caps shared by several parts are marked.
struct Lanes {
    bits: u32,
    count: u32,
    near_inside: bool,
    overlaps: bool,
}

// The lowest bit of every lane in a word, for lanes of at most 32 bits.
fn lowest_bits(lane_bits: u32) -> u32 {
    return select(0xffffffffu / ((1u << (lane_bits % 32u)) - 1u), 1u, lane_bits == 32u);
}
