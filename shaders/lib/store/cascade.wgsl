// A fragment's contribution to the inside test `kbuffer`: it is counted, and its depth is inserted among the nearest.
//
// A slot keeps the greater of its value and the offered one, and offers the other to the next. So the first slot ends with the nearest of
// all, the second with the next, and so on, in any fragment order, equal depths included. Bound as @group(1) @binding(4).

#define_import_path cutaway::store

#import cutaway::cascade::{MOST_SLOTS, cascade, first_word}
#import cutaway::frame::pixel_count
#import cutaway::lanes::{Fragment, MOST_LANES}

@group(1) @binding(4) var<storage, read_write> slots: array<atomic<u32>>;

fn store(fragment: Fragment) {
    let stride = pixel_count();
    let first = first_word(fragment.place, fragment.pixel);
    atomicAdd(&slots[first], 1u);
    var offered = bitcast<u32>(fragment.z);
    for (var slot = 1u; slot <= min(cascade.slots, MOST_SLOTS) && offered != 0u; slot++) {
        offered = min(offered, atomicMax(&slots[first + slot * stride], offered));
    }
}

fn begin(pixel: u32) {
    let stride = pixel_count();
    let words = min(cascade.lanes * (cascade.slots + 1u), MOST_LANES);
    for (var word = 0u; word < words; word++) {
        atomicStore(&slots[word * stride + pixel], 0u);
    }
}
