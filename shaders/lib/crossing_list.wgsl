// Building the list of crossings of one pixel: insertion into a sorted array in registers, then one write.
//
// Bound as @group(1) @binding(0) to (3). `need` keeps the longest list asked for, so that a frame that overflowed tells the
// next one how much to provide.

#define_import_path cutaway::crossing_list

#import cutaway::frame::{frame, is_behind, pixel_count}
#import cutaway::cuts::cut_table

// Bits 0-30 of a mask lane name crossings.
const MOST: u32 = 31u;

@group(1) @binding(0) var<storage, read_write> crossing_heads: array<vec2<u32>>;
@group(1) @binding(1) var<storage, read_write> crossing_z: array<f32>;
@group(1) @binding(2) var<storage, read_write> crossing_surface: array<u32>;
@group(1) @binding(3) var<storage, read_write> need: array<atomic<u32>>;

struct List {
    // All crossings found, stored or not.
    found: u32,
    // Sides where the ray starts.
    sides: u32,
    z: array<f32, 31>,
    surface: array<u32, 31>,
}

// Adds a crossing at depth-buffer value z. The kept side owns a tie: where the ray enters it the crossing moves towards the
// eye, where the ray leaves it away, by more than the rounding of rasterised depths. A face that lies in the clip-surface
// is thus kept as a whole, whatever the rounding of each of its fragments.
fn add(list: ptr<function, List>, capacity: u32, z: f32, surface: u32, enters_kept: bool) {
    let tie = z * frame.tie.x + frame.tie.y;
    let moved = select(z - tie, z + tie, enters_kept);
    let stored = min((*list).found, capacity);
    (*list).found++;
    // Insertion from the far end; a full list drops its farthest crossing.
    var i = stored;
    if stored == capacity {
        if !is_behind((*list).z[capacity - 1u], moved) {
            return;
        }
        i = capacity - 1u;
    }
    for (; i > 0u && is_behind((*list).z[i - 1u], moved); i--) {
        (*list).z[i] = (*list).z[i - 1u];
        (*list).surface[i] = (*list).surface[i - 1u];
    }
    (*list).z[i] = moved;
    (*list).surface[i] = surface;
}

fn store(list: ptr<function, List>, capacity: u32, pixel: u32) {
    let stored = min((*list).found, capacity);
    let overflow = select(0u, 0x80000000u, (*list).found > capacity);
    crossing_heads[pixel] = vec2<u32>(stored | overflow, (*list).sides);
    for (var i = 0u; i < stored; i++) {
        crossing_z[i * pixel_count() + pixel] = (*list).z[i];
        if cut_table.surface_count > 1u {
            crossing_surface[i * pixel_count() + pixel] = (*list).surface[i];
        }
    }
    if overflow != 0u {
        atomicMax(&need[0], (*list).found);
    }
}
