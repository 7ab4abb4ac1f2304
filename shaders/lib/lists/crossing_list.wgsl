// Builds a pixel's list of crossings by insertion into the pixel's own range of the buffers.
//
// Crossings of one clip-surface arrive nearest first, so an insertion is nearly always one read and one write; an array in registers would
// take its whole capacity in every pixel. Bound as @group(1) @binding(0) to (3). `need` records the longest list needed and the longest
// walk, so that the frame after an overflow has enough capacity.

#define_import_path cutaway::crossing_list

#import cutaway::frame::{is_behind, pixel_count}
#import cutaway::lanes::MOST_CROSSINGS
#import cutaway::surfaces::keeps_words

@group(1) @binding(0) var<storage, read_write> crossing_heads: array<vec2<u32>>;
@group(1) @binding(1) var<storage, read_write> crossing_z: array<f32>;
@group(1) @binding(2) var<storage, read_write> crossing_surface: array<u32>;
@group(1) @binding(3) var<storage, read_write> need: array<atomic<u32>>;

struct List {
    pixel: u32,
    capacity: u32,
    // Number of crossings found, stored or not.
    found: u32,
    // Sides where the ray starts.
    sides: u32,
    // True if crossings may be missing or wrong.
    cut_short: bool,
    // True if no crossing with the current clip-surface after the first that enters its kept side is wanted.
    is_first_enough: bool,
}

// An empty list.
fn begin_list(pixel: u32, capacity: u32, is_first_enough: bool) -> List {
    return List(pixel, capacity, 0u, 0u, false, is_first_enough);
}

// Reopens a finished list to add more crossings.
fn resume(pixel: u32, capacity: u32) -> List {
    let head = crossing_heads[pixel];
    return List(pixel, capacity, head.x & MOST_CROSSINGS, head.y, (head.x & 0x80000000u) != 0u, false);
}

fn put(at: u32, z: f32, word: u32) {
    crossing_z[at] = z;
    if keeps_words() {
        crossing_surface[at] = word;
    }
}

// The word of a listed crossing.
fn word_of(list: ptr<function, List>, index: u32) -> u32 {
    if !keeps_words() {
        return 0u;
    }
    return crossing_surface[index * pixel_count() + (*list).pixel];
}

// True if a crossing comes before the listed one.
fn comes_before(z: f32, enters_kept: bool, listed: f32) -> bool {
    return is_behind(listed, z) || !(enters_kept || is_behind(z, listed));
}

// Adds a crossing at depth-buffer value z, with its `word` (`crossing_words`). Among crossings at one depth those where the ray leaves the
// kept region come first: two cuts that share a plane leave no sheet between them.
fn add(list: ptr<function, List>, z: f32, word: u32, enters_kept: bool) {
    let stride = pixel_count();
    let stored = min(min((*list).found, (*list).capacity), MOST_CROSSINGS);
    (*list).found++;
    // Insertion from the far end; a full list drops its farthest crossing.
    var i = stored;
    if stored == (*list).capacity {
        i = stored - 1u;
        if !comes_before(z, enters_kept, crossing_z[i * stride + (*list).pixel]) {
            return;
        }
    }
    for (; i > 0u; i--) {
        let before = (i - 1u) * stride + (*list).pixel;
        let z_before = crossing_z[before];
        if !comes_before(z, enters_kept, z_before) {
            break;
        }
        var word_before = word;
        if keeps_words() {
            word_before = crossing_surface[before];
        }
        put(before + stride, z_before, word_before);
    }
    put(i * stride + (*list).pixel, z, word);
}

// Writes the head of the list.
fn finish(list: ptr<function, List>) {
    let stored = min((*list).found, (*list).capacity);
    let overflow = (*list).found > (*list).capacity || (*list).cut_short;
    crossing_heads[(*list).pixel] = vec2<u32>(stored | select(0u, 0x80000000u, overflow), (*list).sides);
    if (*list).found > (*list).capacity {
        atomicMax(&need[0], (*list).found);
    }
}
