// The visible points of a picture, for effects that read neighbouring pixels.

#define_import_path cutaway::shown

#import cutaway::frame::{centre_of, frame, pixel_index, ray_through}
#import cutaway::layers::{BACKGROUND, WORDS_PER_PIXEL, kind_of}

// The visible point in scene space; `w` is 1 for a point, 0 for background.
fn shown_point(at: vec2<u32>, word: u32, depth: f32) -> vec4<f32> {
    if kind_of(word) == BACKGROUND {
        return vec4<f32>(0.0);
    }
    let ray = ray_through(centre_of(at));
    return vec4<f32>(ray.origin + depth * ray.direction, 1.0);
}

fn is_in_frame(at: vec2<i32>) -> bool {
    return all(at >= vec2<i32>(0)) && all(at < vec2<i32>(frame.size_px));
}

// Width of a pixel at a depth, in scene units.
fn pixel_width(depth: f32) -> f32 {
    return length(frame.ray_step[0].xyz) * select(depth, 1.0, frame.orthographic != 0u);
}

fn first_word_of(at: vec2<u32>) -> u32 {
    return pixel_index(at) * WORDS_PER_PIXEL;
}
