// Makes the triangles of patches that would take one workgroup too long: each is shared by enough workgroups that no invocation exceeds its
// visit limit.

#import cutaway::patch_triangles::{Share, deep_halvings, write_shares}
#import cutaway::refinement::refinements

@group(1) @binding(13) var<storage, read> deep_patches: array<u32>;

// Index of the clip-surface in the table, and its number among the tessellated ones.
override surface: u32 = 0u;
override slot: u32 = 0u;

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let word = deep_patches[refinements.surfaces[surface].first_patch + group.x];
    let patch_at = vec2<i32>(vec2<u32>(word & 0xffffu, word >> 16u));
    let share = Share(surface, slot, patch_at, deep_halvings(surface), group.y * 64u + local);
    write_shares(share, local);
}
