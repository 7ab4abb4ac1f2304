// Draws removed material over a picture, as glass and as lines. One invocation owns a pixel.

#import cutaway::frame::{centre_of, frame, pixel_index, ray_through}
#import cutaway::ghost::{ghost_layers, is_gone}
#import cutaway::ghost_look::ghost
#import cutaway::layers::unpack_normal
#import cutaway::over::laid_over
#import cutaway::phantom::phantom_cover
#import cutaway::shown::first_word_of

@group(1) @binding(2) var<storage, read_write> picture: array<u32>;

// Opacity of glass: greatest at grazing angles.
fn glass_cover(at: vec2<u32>) -> f32 {
    if ghost.glass <= 0.0 || !is_gone(vec2<i32>(at)) {
        return 0.0;
    }
    let normal = unpack_normal(ghost_layers[first_word_of(at) + 1u]);
    let facing = abs(dot(normal, normalize(ray_through(centre_of(at)).direction)));
    return ghost.glass * (0.03 + 0.22 * pow(1.0 - min(facing, 1.0), 3.0));
}

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let glass = glass_cover(id.xy);
    let drawn = ghost.alpha * phantom_cover(vec2<i32>(id.xy));
    let cover = 1.0 - (1.0 - glass) * (1.0 - drawn);
    if cover <= 0.0 {
        return;
    }
    let pixel = pixel_index(id.xy);
    picture[pixel] = laid_over(picture[pixel], ghost.color.rgb, cover);
}
