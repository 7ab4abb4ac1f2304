// Lists of fragments, while fragments are counted and stored. Bound as @group(1) @binding(4).
//
// A fragment beyond the capacity is dropped. The end of its list then exceeds the capacity, which reveals the overflow.

#define_import_path cutaway::fragment_lists

#import cutaway::fragment_pool::pool

@group(1) @binding(4) var<storage, read_write> fragments: array<atomic<u32>>;

fn forget(list: u32) {
    atomicStore(&fragments[pool.first_list + list], 0u);
}

fn count(list: u32) {
    atomicAdd(&fragments[pool.first_list + list], 1u);
}

fn keep(list: u32, z: f32, owner: u32) {
    let at = atomicAdd(&fragments[pool.first_list + list], 1u);
    if at < pool.capacity {
        atomicStore(&fragments[pool.lists + at], bitcast<u32>(z));
        if pool.has_owners != 0u {
            atomicStore(&fragments[pool.lists + pool.capacity + at], owner);
        }
    }
}
