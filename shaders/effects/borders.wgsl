// Finds the borders of a picture from its layers. An invocation processes one pixel at a time: the borders to its right and below it.
//
// Depth: on a plane, 1 / depth is linear in the picture (for parallel rays depth itself is). Each of two samples is predicted from its own
// side; a border is where both predictions and the samples themselves are off by more than a few pixel widths. So a plane at a grazing
// angle has no borders. At the silhouette of a ball, the last sample may lie far behind the one before it: there is no border either if the
// tangent plane of the farther sample accounts for the distance.
//
// If two opposite neighbours of a sample agree with each other but not with the sample, it is a sliver. It has no border, because its
// strokes would be a row of dots. Likewise, a sample whose normal differs from those of two agreeing neighbours is no fold. Between two
// samples that are both unreliable there is no stroke.

#import cutaway::borders::{CONTOUR, CREASE, CUT, FACE, NO_BORDER, OUTLINE, PART, word_of_tile}
#import cutaway::frame::{centre_of, frame, pixel_index, ray_through}
#import cutaway::layers::{BACKGROUND, CAP, SURFACE, UNRELIABLE, clip_surface_of, kind_of, part_of, unpack_normal}
#import cutaway::share::{pixel_at, turns}
#import cutaway::shown::{first_word_of, is_in_frame}
#import cutaway::style::style
#import cutaway::touched::{MOST_TURNS, TILE_PX}

@group(1) @binding(0) var<storage, read> layers: array<u32>;
@group(1) @binding(1) var<storage, read_write> borders: array<u32>;

// Bits that are equal in all samples of one surface: kind, clip-surface, part.
const LIKENESS: u32 = 0xffffff03u;

fn word_at(at: vec2<i32>) -> u32 {
    return layers[first_word_of(vec2<u32>(at))];
}

fn depth_at(at: vec2<i32>) -> f32 {
    return bitcast<f32>(layers[first_word_of(vec2<u32>(at)) + 2u]);
}

// The quantity that is linear on planes.
fn reach_at(at: vec2<i32>) -> f32 {
    let depth = depth_at(at);
    return select(1.0 / depth, depth, frame.orthographic != 0u);
}

fn is_sliver_along(at: vec2<i32>, step: vec2<i32>) -> bool {
    if !is_in_frame(at - step) || !is_in_frame(at + step) {
        return false;
    }
    let before = word_at(at - step) & LIKENESS;
    let behind = word_at(at + step) & LIKENESS;
    return before == behind && kind_of(before) != BACKGROUND && (word_at(at) & LIKENESS) != before;
}

fn is_sliver(at: vec2<i32>) -> bool {
    return is_sliver_along(at, vec2<i32>(1, 0)) || is_sliver_along(at, vec2<i32>(0, 1));
}

fn normal_at(at: vec2<i32>) -> vec3<f32> {
    return unpack_normal(layers[first_word_of(vec2<u32>(at)) + 1u]);
}

fn is_speck_along(at: vec2<i32>, step: vec2<i32>) -> bool {
    if !is_in_frame(at - step) || !is_in_frame(at + step) {
        return false;
    }
    let word = word_at(at);
    if (((word_at(at - step) ^ word) | (word_at(at + step) ^ word)) & LIKENESS) != 0u {
        return false;
    }
    let before = normal_at(at - step);
    let behind = normal_at(at + step);
    let own = normal_at(at);
    return dot(before, behind) >= style.crease_cos && max(dot(own, before), dot(own, behind)) < style.crease_cos;
}

// True if a sample's normal differs from those of both neighbours, while these agree: a fold too fine for the picture.
fn is_speck(at: vec2<i32>) -> bool {
    return is_speck_along(at, vec2<i32>(1, 0)) || is_speck_along(at, vec2<i32>(0, 1));
}

// The value that the plane through the two preceding samples predicts for a sample; the neighbour's value if there is no second one.
fn predicted(origin: vec2<i32>, step: vec2<i32>) -> f32 {
    let near = reach_at(origin);
    let behind = origin - step;
    if is_in_frame(behind) && ((word_at(behind) ^ word_at(origin)) & LIKENESS) == 0u {
        return 2.0 * near - reach_at(behind);
    }
    return near;
}

fn jumps(at: vec2<i32>, next: vec2<i32>, step: vec2<i32>) -> bool {
    let here = reach_at(at);
    let there = reach_at(next);
    let missed = min(abs(predicted(at, step) - there), abs(predicted(next, -step) - here));
    let pixel = length(frame.ray_step[0].xyz) * select(min(here, there), 1.0, frame.orthographic != 0u);
    return min(missed, abs(here - there)) > style.depth_px * pixel;
}

// True if the tangent plane of the farther of two samples explains most of the distance between them, or is edge-on between them.
fn is_one_surface(at: vec2<i32>, next: vec2<i32>) -> bool {
    let depths = vec2<f32>(depth_at(at), depth_at(next));
    let is_first = depths.x > depths.y;
    let far = select(next, at, is_first);
    let far_ray = ray_through(centre_of(vec2<u32>(far)));
    let near_ray = ray_through(centre_of(vec2<u32>(select(at, next, is_first))));
    let normal = normal_at(far);
    let towards = vec2<f32>(dot(normal, far_ray.direction), dot(normal, near_ray.direction));
    // A smoothed normal may face away from the eye at the silhouette.
    if max(towards.x, towards.y) >= 0.0 {
        return true;
    }
    let depth = max(depths.x, depths.y);
    let met = dot(normal, far_ray.origin + depth * far_ray.direction - near_ray.origin) / towards.y;
    return depth - met > 0.67 * abs(depths.x - depths.y);
}

// The border class that the difference between two neighbouring samples implies.
fn difference(at: vec2<i32>, step: vec2<i32>) -> u32 {
    let next = at + step;
    if !is_in_frame(next) {
        return NO_BORDER;
    }
    let here = word_at(at);
    let there = word_at(next);
    let kinds = vec2<u32>(kind_of(here), kind_of(there));
    if (here & there & UNRELIABLE) != 0u || all(kinds == vec2<u32>(BACKGROUND)) {
        return NO_BORDER;
    }
    if any(kinds == vec2<u32>(BACKGROUND)) {
        return OUTLINE;
    }
    let differ = part_of(here) != part_of(there);
    if any(kinds == vec2<u32>(CAP)) {
        if kinds.x != kinds.y || differ {
            return CUT;
        }
        if clip_surface_of(here) != clip_surface_of(there) {
            return FACE;
        }
    } else if differ {
        return PART;
    }
    if jumps(at, next, step) && !is_one_surface(at, next) {
        return CONTOUR;
    }
    if kinds.x == SURFACE {
        let is_folded = dot(normal_at(at), normal_at(next)) < style.crease_cos;
        if is_folded && !is_speck(at) && !is_speck(next) {
            return CREASE;
        }
    }
    return NO_BORDER;
}

// The class of the border between a sample and the next one. Most samples have none, which is tested first.
fn border(at: vec2<i32>, step: vec2<i32>) -> u32 {
    let class_of = difference(at, step);
    if class_of == NO_BORDER || is_sliver(at) || is_sliver(at + step) {
        return NO_BORDER;
    }
    return class_of;
}

var<workgroup> found: atomic<u32>;
var<workgroup> turns_of_group: u32;

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let is_first = all(local == vec3<u32>(0u));
    if is_first {
        turns_of_group = turns(group, groups);
    }
    let end = min(workgroupUniformLoad(&turns_of_group), MOST_TURNS);
    for (var turn = 0u; turn < end; turn++) {
        if is_first {
            atomicStore(&found, 0u);
        }
        workgroupBarrier();
        let xy = pixel_at(turn, group, groups, local);
        if all(xy < frame.size_px) {
            let at = vec2<i32>(xy);
            let word = border(at, vec2<i32>(1, 0)) | (border(at, vec2<i32>(0, 1)) << 4u);
            borders[pixel_index(xy)] = word;
            if word != 0u {
                atomicOr(&found, word);
            }
        }
        workgroupBarrier();
        if is_first {
            borders[word_of_tile(xy / TILE_PX)] = atomicLoad(&found);
        }
    }
}
