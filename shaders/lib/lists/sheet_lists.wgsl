// Lists of sheet fragments, while fragments are added: each fragment is prepended to its pixel's list. Bound as @group(1) @binding(4).

#define_import_path cutaway::sheet_lists

#import cutaway::sheet_pool::{ENDS, LOST, sheet_pool, words_before}

@group(1) @binding(4) var<storage, read_write> sheets: array<atomic<u32>>;

fn forget(pixel: u32) {
    atomicStore(&sheets[pixel], ENDS);
}

fn forget_count() {
    atomicStore(&sheets[sheet_pool.lists], 0u);
}

fn leave(pixel: u32, z: f32, word: u32) {
    let fragment = atomicAdd(&sheets[sheet_pool.lists], 1u);
    if fragment >= sheet_pool.capacity {
        atomicStore(&sheets[pixel], LOST);
        return;
    }
    let before = atomicExchange(&sheets[pixel], fragment);
    let first = words_before(fragment);
    atomicStore(&sheets[first], bitcast<u32>(z));
    atomicStore(&sheets[first + 1u], word);
    atomicStore(&sheets[first + 2u], before);
}
