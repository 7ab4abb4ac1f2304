// Layers of the uncut scene, from which removed material is found. Bound as @group(1) @binding(0) and (1).

#define_import_path cutaway::ghost

#import cutaway::layers::{BACKGROUND, kind_of}
#import cutaway::shown::{first_word_of, is_in_frame, pixel_width}

@group(1) @binding(0) var<storage, read> layers: array<u32>;
@group(1) @binding(1) var<storage, read> ghost_layers: array<u32>;

// Least distance between removed material and the visible surface, in pixel widths: anything closer is that surface itself.
const APART_PX: f32 = 3.0;

// True if material in front of the visible surface was removed.
fn is_gone(at: vec2<i32>) -> bool {
    if !is_in_frame(at) {
        return false;
    }
    let first = first_word_of(vec2<u32>(at));
    if kind_of(ghost_layers[first]) == BACKGROUND {
        return false;
    }
    if kind_of(layers[first]) == BACKGROUND {
        return true;
    }
    let depth = bitcast<f32>(ghost_layers[first + 2u]);
    return depth + APART_PX * pixel_width(depth) < bitcast<f32>(layers[first + 2u]);
}
