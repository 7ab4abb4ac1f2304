// Empties the list of sheet fragments of every processed pixel. An invocation owns a pixel at a time.

#import cutaway::frame::{frame, pixel_index}
#import cutaway::share::{pixel_at, turns}
#import cutaway::sheet_lists::{forget, forget_count}

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    if all(group == vec3<u32>(0u)) && all(local == vec3<u32>(0u)) {
        forget_count();
    }
    let end = turns(group, groups);
    for (var turn = 0u; turn < end; turn++) {
        let xy = pixel_at(turn, group, groups, local);
        if all(xy < frame.size_px) {
            forget(pixel_index(xy));
        }
    }
}
