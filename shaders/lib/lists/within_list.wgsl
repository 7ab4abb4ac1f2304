// The samples within slabs, which wait for their pixel's crossings. Bound as @group(1) @binding(6).

#define_import_path cutaway::within_list

#import cutaway::within_words::within_word

struct WithinList {
    // Number of samples found, listed or not.
    count: atomic<u32>,
    padding: array<u32, 3>,
    // Pixel (x and y, 16 bits each), bits of the depth-buffer value, code of the triangle, row of the part and slabs
    // (`within_words`).
    samples: array<vec4<u32>>,
}

@group(1) @binding(6) var<storage, read_write> within_list: WithinList;

// Returns false if the list is full.
fn list_within(at: vec2<u32>, z: f32, code: u32, row: u32, slabs: u32) -> bool {
    let place = atomicAdd(&within_list.count, 1u);
    if place >= arrayLength(&within_list.samples) {
        return false;
    }
    within_list.samples[place] = vec4<u32>(at.x | (at.y << 16u), bitcast<u32>(z), code, within_word(row, slabs));
    return true;
}
