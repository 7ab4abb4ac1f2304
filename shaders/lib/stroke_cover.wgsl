// Strokes along borders: of a width, in ink, smooth at their edges. Bound as @group(2) @binding(1).
//
// A border is a unit segment between two samples. The distance to a stroke is that to its segment less half its width; the least over
// all borders nearby is one distance for all classes, so that lines of unlike widths join at corners.

#define_import_path cutaway::stroke_cover

#import cutaway::borders::{NO_BORDER, below_of, right_of, tiles_around, word_of_tile}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::shown::is_in_frame
#import cutaway::style::style

@group(2) @binding(1) var<storage, read> borders: array<u32>;

const FAR_AWAY: f32 = 1000.0;

fn half_px_of(border: u32) -> f32 {
    return style.stroke_halves[(border - 1u) / 4u][(border - 1u) % 4u];
}

// Distance to the stroke on a border, negative inside, of a pixel that is `off` from the centre of the border across it and along it.
fn distance_to(border: u32, across: f32, along: f32) -> f32 {
    if border == NO_BORDER {
        return FAR_AWAY;
    }
    let half_px = half_px_of(border);
    let distance = length(vec2<f32>(across, max(abs(along) - 0.5, 0.0))) - half_px;
    return select(FAR_AWAY, distance, half_px > 0.0);
}

// Whether a tile within a distance of a pixel has a border.
fn has_border_near(at: vec2<u32>, reach_px: i32) -> bool {
    let tiles = tiles_around(at, reach_px, frame.size_px);
    var found = 0u;
    for (var y = tiles.y; y <= tiles.w; y++) {
        for (var x = tiles.x; x <= tiles.z; x++) {
            found |= borders[word_of_tile(vec2<u32>(x, y), frame.size_px)];
        }
    }
    return found != 0u;
}

// The share of a pixel that strokes cover.
fn stroke_cover(at: vec2<u32>) -> f32 {
    if !has_border_near(at, style.stroke_reach_px + 1) {
        return 0.0;
    }
    var nearest = FAR_AWAY;
    for (var y = -style.stroke_reach_px - 1; y <= style.stroke_reach_px; y++) {
        for (var x = -style.stroke_reach_px - 1; x <= style.stroke_reach_px; x++) {
            let near = vec2<i32>(at) + vec2<i32>(x, y);
            if !is_in_frame(near) {
                continue;
            }
            let word = borders[pixel_index(vec2<u32>(near))];
            if word == 0u {
                continue;
            }
            let off = vec2<f32>(f32(x), f32(y));
            nearest = min(nearest, distance_to(right_of(word), off.x + 0.5, off.y));
            nearest = min(nearest, distance_to(below_of(word), off.y + 0.5, off.x));
        }
    }
    return clamp(0.5 - nearest, 0.0, 1.0);
}
