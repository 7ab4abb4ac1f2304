// Makes the triangles of a clip-surface for one view. A workgroup owns a patch, which its 64 invocations share; a patch that would take an
// invocation too long is put on a list, for `refine_deep.wgsl`.

#import cutaway::patch_triangles::{SHARED, Share, deep_halvings, write_shares}
#import cutaway::refinement::refinements

// The patches of all clip-surfaces that take too long, and the workgroups that process them.
@group(1) @binding(13) var<storage, read_write> deep_patches: array<u32>;
@group(1) @binding(14) var<storage, read_write> deep_arguments: array<atomic<u32>>;

// Index of the clip-surface in the table, and its number among the tessellated ones.
override surface: u32 = 0u;
override slot: u32 = 0u;

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) invocation: u32) {
    let share = Share(surface, slot, vec2<i32>(group.xy), SHARED, invocation);
    let is_made = write_shares(share, invocation);
    if !is_made && invocation == 0u {
        let at = atomicAdd(&deep_arguments[3u * slot], 1u);
        atomicStore(&deep_arguments[3u * slot + 1u], 1u << (deep_halvings(surface) - SHARED));
        deep_patches[refinements.surfaces[surface].first_patch + at] = group.x | (group.y << 16u);
    }
}
