// Fragment lists of any length, one after the other in one buffer: the layout. Bound as @group(1) @binding(6).
//
// First one word per list. It counts the list's fragments; a prefix sum turns counts into the begin of each list; and while a list is
// filled its word advances to where the next list begins. Then the depths of all fragments, then, if lists mix fragments of several parts,
// their owners.

#define_import_path cutaway::fragment_pool

struct FragmentPool {
    // Number of lists, which is also the number of words before the first depth.
    lists: u32,
    // Capacity in fragments.
    capacity: u32,
    // 1 if each fragment has an owner.
    has_owners: u32,
    // Offset of the list numbers in passes that use only some of the lists.
    first_list: u32,
}

@group(1) @binding(6) var<uniform> pool: FragmentPool;
