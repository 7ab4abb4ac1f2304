// Coverage of pixels by strokes along borders, with antialiased edges. Bound as @group(2) @binding(1).
//
// A stroke is a segment on a border, between two samples, with its ends where `strokes.wgsl` placed them. The distance to a stroke is that
// to its segment less half its width; the least over all borders nearby is one distance for all classes, so that lines of different widths
// join at corners. Strokes are filtered by a tent two pixels wide, as one integral: with a box filter a line thinner than a pixel is a row
// of beads, dark where it lies in one pixel and pale where it lies in two (Chan and Durand 2005, "Fast prefiltered lines").

#define_import_path cutaway::stroke_cover

#import cutaway::borders::{MOST_REACH_PX, MOST_TILES_AROUND, NO_BORDER, below_of, right_of, tiles_around, word_of_tile}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::shown::is_in_frame
#import cutaway::stroke_place::ends_of
#import cutaway::style::style

@group(2) @binding(1) var<storage, read> strokes: array<u32>;

const FAR_AWAY: f32 = 1000.0;

fn half_px_of(border: u32) -> f32 {
    return style.stroke_halves[(border - 1u) / 4u][(border - 1u) % 4u];
}

// The stroke nearest to a point: half its width, and the distance to its edge, negative inside the stroke.
struct Nearest {
    edge: f32,
    half_px: f32,
}

// The nearer of a stroke and a border's stroke. `off` is the offset of the point from the border's middle, across and along the border.
fn nearer(nearest: Nearest, border: u32, ends: array<vec2<f32>, 2>, off: vec2<f32>) -> Nearest {
    if border == NO_BORDER {
        return nearest;
    }
    let half_px = half_px_of(border);
    let from_first = off - ends[0];
    let way = ends[1] - ends[0];
    let share = clamp(dot(from_first, way) / max(dot(way, way), 1e-6), 0.0, 1.0);
    let edge = length(from_first - share * way) - half_px;
    if half_px <= 0.0 || edge >= nearest.edge {
        return nearest;
    }
    return Nearest(edge, half_px);
}

// True if a tile within a distance of a pixel contains a border.
fn has_border_near(at: vec2<u32>, reach_px: i32) -> bool {
    let tiles = tiles_around(at, reach_px, frame.size_px);
    var found = 0u;
    let across = min(tiles.zw - tiles.xy + 1u, vec2<u32>(MOST_TILES_AROUND));
    for (var v = 0u; v < across.y; v++) {
        for (var u = 0u; u < across.x; u++) {
            let tile = tiles.xy + vec2<u32>(u, v);
            found |= strokes[word_of_tile(tile)];
        }
    }
    return found != 0u;
}

// Fraction of the filter's weight within a distance.
fn weight_up_to(distance: f32) -> f32 {
    let within = 1.0 - min(abs(distance), 1.0);
    return 0.5 + sign(distance) * 0.5 * (1.0 - within * within);
}

// The fraction of a pixel that strokes cover.
fn stroke_cover(at: vec2<u32>) -> f32 {
    if !has_border_near(at, style.stroke_reach_px + 1) {
        return 0.0;
    }
    var nearest = Nearest(FAR_AWAY, 0.0);
    let reach_px = min(style.stroke_reach_px, MOST_REACH_PX);
    for (var y = -reach_px - 1; y <= reach_px; y++) {
        for (var x = -reach_px - 1; x <= reach_px; x++) {
            let near = vec2<i32>(at) + vec2<i32>(x, y);
            if !is_in_frame(near) {
                continue;
            }
            let word = strokes[pixel_index(vec2<u32>(near))];
            if word == 0u {
                continue;
            }
            let off = -vec2<f32>(f32(x), f32(y));
            nearest = nearer(nearest, right_of(word), ends_of(word, true), off - vec2<f32>(0.5, 0.0));
            nearest = nearer(nearest, below_of(word), ends_of(word, false), off.yx - vec2<f32>(0.5, 0.0));
        }
    }
    return weight_up_to(nearest.edge + 2.0 * nearest.half_px) - weight_up_to(nearest.edge);
}
