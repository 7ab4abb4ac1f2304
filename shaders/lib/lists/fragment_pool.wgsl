// Lists of fragments of any length, one after the other in one buffer: how it is laid out. Bound as @group(1) @binding(6).
//
// First a word for each list. It counts the fragments of the list; a prefix sum turns counts into where each list begins; and
// while a list is filled its word moves on, to end where the next list begins. Then the depths of all fragments, then, where
// fragments of several parts meet in a list, their owners.

#define_import_path cutaway::fragment_pool

struct FragmentPool {
    // Lists, and words before the first depth.
    lists: u32,
    // Fragments that there is room for.
    capacity: u32,
    // 1 where each fragment has an owner.
    has_owners: u32,
    // What passes that know only some of the lists count theirs from.
    first_list: u32,
}

@group(1) @binding(6) var<uniform> pool: FragmentPool;
