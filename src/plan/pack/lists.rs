//! Shared structs of fragment storage.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// Lists of fragments in one buffer: `shaders/lib/lists/fragment_pool.wgsl`.
    FragmentPool {
        /// Number of lists.
        lists: u32,
        /// Total fragments in all lists.
        capacity: u32,
        /// 1 if each fragment has an owner.
        has_owners: u32,
        /// Number of the first list that the pass uses.
        first_list: u32,
    }
}

shared! {
    /// Lists of sheet fragments in one buffer: `shaders/lib/lists/sheet_pool.wgsl`.
    SheetPool {
        /// Number of lists.
        lists: u32,
        /// Total fragments in all lists.
        capacity: u32,
        /// Unused.
        padding: [u32; 2],
    }
}

shared! {
    /// The nearest fragments of each pixel and part: `shaders/lib/lists/cascade.wgsl`.
    Cascade {
        /// Number of fragments kept.
        slots: u32,
        /// Number of parts.
        lanes: u32,
        /// Unused.
        padding: [u32; 2],
    }
}
