// Makes the list of sheet fragments of every pixel empty. An invocation owns a pixel.

#import cutaway::fragment_lists::forget
#import cutaway::frame::{frame, pixel_index}

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    forget(pixel_index(id.xy));
}
