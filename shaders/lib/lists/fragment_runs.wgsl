// Filled lists of fragments: unordered runs of the pool. Bound as @group(1) @binding(5).

#define_import_path cutaway::fragment_runs

#import cutaway::fragment_pool::pool

@group(1) @binding(5) var<storage, read> fragments: array<u32>;

// Maximum number of fragments of a list that are read: more count as an overflow.
const MOST_FRAGMENTS: u32 = 4096u;

struct Run {
    // Range of stored fragments: from `first` up to but not including `end`.
    first: u32,
    end: u32,
    // True if the whole list fits the capacity.
    fits: bool,
}

fn run_of(list: u32) -> Run {
    var first = 0u;
    if list > 0u {
        first = fragments[list - 1u];
    }
    let end = fragments[list];
    let fits = (end <= pool.capacity && end - first <= MOST_FRAGMENTS) || first == end;
    // A list that begins beyond the capacity is empty; without the clamp its length would wrap around.
    return Run(min(first, pool.capacity), min(end, pool.capacity), fits);
}

fn depth_of(fragment: u32) -> f32 {
    return bitcast<f32>(fragments[pool.lists + fragment]);
}

// Part-table index of a fragment's part.
fn owner_of(fragment: u32) -> u32 {
    if pool.has_owners == 0u {
        return 0u;
    }
    return fragments[pool.lists + pool.capacity + fragment];
}
