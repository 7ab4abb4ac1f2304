// Expands the number of an open part's closing triangles in each square of pixels, around the crossings at which the part begins to be kept.
//
// Around the centre c of a sphere, the number of triangles at a distance is a polynomial in x = point - c. With y the offset of area from
// the centre of its ball, the number depends on x - y alone; terms up to the second order are kept, except that of y twice, which needs a
// moment that balls do not store. What is left out is at most 3 I / d^4 for that term and 4 |x - y|^3 / g^5 for all later ones, per area, as
// the (k + 1)-th derivative of 1/r is at most (k + 1)! / r^(k + 2); d is the distance of the centres, g that of the sphere from the ball, I
// the integral of y^2 over the area. Triangles for which this is too much are listed, and summed for each point.
//
// An invocation owns a square. Cost: for a square with a crossing to be decided, some hundred nodes; among too many triangles no expansion.

#import cutaway::closings::{Ball, FOUR_PI, MOST_BALLS, MOST_LEAF_TRIANGLES, NO_CLOSING, ball_at, closing_of, end_of, floats}
#import cutaway::crossings::{cappable, depth_at, head_of, surface_at}
#import cutaway::cuts::{is_removed, parts}
#import cutaway::frame::{centre_of, frame, ray_through}
#import cutaway::lanes::{MOST_CROSSINGS, MOST_LANES}
#import cutaway::local_winding::{MOST_OF_RUN, MOST_RUNS, NO_EXPANSION, RUN_BITS, SQUARE_PX, VECTORS_OF_POLYNOMIAL, doubt_at, expansion_at}
#import cutaway::share::{pixel_at, turns}

@group(1) @binding(6) var<storage, read_write> expansions: array<vec4<u32>>;

override lane_count: u32 = 1u;
override near_inside: bool = false;
// Number of open parts.
override closing_count: u32 = 1u;
// Distance to which rasterisers snap vertices, in pixels.
override snapped_px: f32 = 0.0625;

// A ball or triangle is expanded where the bound of what is left out, as a share of 4 pi, is at most this.
const FAR_ERROR: f32 = 0.001;
// Most triangles that are listed: beyond, a traversal for each crossing takes less time.
const MOST_LISTED: u32 = 256u;
// Squares of a tile.
const SQUARES: u32 = 4u;

struct Sphere {
    centre: vec3<f32>,
    radius: f32,
}

// A polynomial of second order, times 4 pi, and a bound of its error as a share of 4 pi.
struct Expansion {
    constant: f32,
    gradient: vec3<f32>,
    // Of the second derivatives, a matrix without trace: two elements of the diagonal, and doubled other elements.
    diagonal: vec2<f32>,
    others: vec3<f32>,
    error: f32,
}

var<private> expansion: Expansion;
// Runs of triangles that are not expanded, and their number.
var<private> runs: array<u32, MOST_RUNS>;
var<private> run_count: u32;
// Number of triangles in the runs.
var<private> listed: u32;

fn bound_of_rest(size: f32, inertia: f32, radius: f32, distance: f32, around: f32) -> f32 {
    let gap = distance - radius - around;
    let spread = sqrt(inertia) + around * sqrt(size);
    let later = 4.0 * (radius + around) * spread * spread / (gap * gap * gap * gap * gap);
    let square = distance * distance;
    return select(1.0, (3.0 * inertia / (square * square) + later) / FOUR_PI, gap > 0.0);
}

fn expand_dipole(area: vec3<f32>, along: vec3<f32>, distance: f32) {
    let facing = dot(area, along);
    let square = distance * distance;
    expansion.constant += facing / square;
    expansion.gradient += (3.0 * facing * along - area) / (square * distance);
    let squares = along * along;
    let diagonal = 15.0 * facing * squares - 6.0 * area * along - 3.0 * facing;
    let others = 30.0 * facing * along.xxy * along.yzz - 6.0 * (area.xxy * along.yzz + along.xxy * area.yzz);
    expansion.diagonal += diagonal.xy / (square * square);
    expansion.others += others / (square * square);
}

fn expand_quadrupole(ball: Ball, along: vec3<f32>, distance: f32) {
    let squares = along * along;
    let moment = dot(ball.diagonal, squares.xy - squares.z) + dot(ball.others, along.xxy * along.yzz);
    let diagonal = vec3<f32>(ball.diagonal, -ball.diagonal.x - ball.diagonal.y);
    let crossed = vec3<f32>(
        dot(ball.others.xy, along.yz),
        dot(ball.others.xz, along.xz),
        dot(ball.others.yz, along.xy),
    );
    let square = distance * distance;
    expansion.constant -= 3.0 * moment / (square * distance);
    expansion.gradient += (6.0 * diagonal * along + 3.0 * crossed - 15.0 * moment * along) / (square * square);
}

// Adds a triangle to the list.
fn list_nearby(triangle: u32) {
    listed++;
    if run_count > 0u && run_count <= MOST_RUNS {
        let run = runs[run_count - 1u];
        let count = run & MOST_OF_RUN;
        if count < MOST_OF_RUN && triangle == (run >> RUN_BITS) + 3u * count {
            runs[run_count - 1u] = run + 1u;
            return;
        }
    }
    if run_count < MOST_RUNS {
        runs[run_count] = (triangle << RUN_BITS) + 1u;
    }
    run_count++;
}

// A triangle as seen from the centre of a sphere.
struct Dipole {
    area: vec3<f32>,
    middle: vec3<f32>,
    rest: f32,
}

fn dipole_of(triangle: u32, sphere: Sphere) -> Dipole {
    let a = floats(triangle).xyz - sphere.centre;
    let b = floats(triangle + 1u).xyz - sphere.centre;
    let c = floats(triangle + 2u).xyz - sphere.centre;
    let middle = (a + b + c) / 3.0;
    let squares = vec3<f32>(dot(a - middle, a - middle), dot(b - middle, b - middle), dot(c - middle, c - middle));
    let area = 0.5 * cross(b - a, c - a);
    let size = length(area);
    let radius = sqrt(max(squares.x, max(squares.y, squares.z)));
    let inertia = size * (squares.x + squares.y + squares.z) / 12.0;
    return Dipole(area, middle, bound_of_rest(size, inertia, radius, length(middle), sphere.radius));
}

// Expands the triangles of a leaf, or lists them. All of them are listed if half of them must be: a run takes the place of one triangle.
fn visit_leaf(ball: Ball, sphere: Sphere) {
    let count = min(ball.count, MOST_LEAF_TRIANGLES);
    var near_count = 0u;
    for (var i = 0u; i < count; i++) {
        near_count += select(1u, 0u, dipole_of(ball.first + 3u * i, sphere).rest <= FAR_ERROR);
    }
    for (var i = 0u; i < count; i++) {
        let dipole = dipole_of(ball.first + 3u * i, sphere);
        if dipole.rest <= FAR_ERROR && 2u * near_count < count {
            let distance = length(dipole.middle);
            expand_dipole(dipole.area, dipole.middle / distance, distance);
            expansion.error += dipole.rest;
        } else {
            list_nearby(ball.first + 3u * i);
        }
    }
}

// Expands a tree's number in a sphere, and stores it.
fn expand(tree: u32, sphere: Sphere, address: u32) {
    expansion = Expansion(0.0, vec3<f32>(0.0), vec2<f32>(0.0), vec3<f32>(0.0), 0.0);
    run_count = 0u;
    listed = 0u;
    let end = end_of(tree);
    var at = tree;
    for (var n = 0u; n < MOST_BALLS && at < end && run_count <= MOST_RUNS && listed <= MOST_LISTED; n++) {
        let ball = ball_at(tree, at);
        let away = ball.centre - sphere.centre;
        let distance = length(away);
        let rest = bound_of_rest(ball.size, ball.error * (FOUR_PI / 3.0), ball.radius, distance, sphere.radius);
        if rest <= FAR_ERROR {
            expand_dipole(ball.area, away / distance, distance);
            expand_quadrupole(ball, away / distance, distance);
            expansion.error += rest;
            at = ball.next;
        } else if ball.is_leaf {
            visit_leaf(ball, sphere);
            at = ball.next;
        } else {
            at += 4u;
        }
    }
    let is_whole = at >= end && run_count <= MOST_RUNS && listed <= MOST_LISTED;
    let count = select(NO_EXPANSION, run_count, is_whole);
    expansions[address] = bitcast<vec4<u32>>(vec4<f32>(expansion.gradient, expansion.constant));
    expansions[address + 1u] = bitcast<vec4<u32>>(vec4<f32>(expansion.others, expansion.error));
    expansions[address + 2u] = vec4<u32>(bitcast<vec2<u32>>(expansion.diagonal), count, 0u);
    expansions[address + 3u] = vec4<u32>(bitcast<vec3<u32>>(sphere.centre), 0u);
    for (var i = 0u; i < min(run_count, MOST_RUNS); i += 4u) {
        expansions[address + VECTORS_OF_POLYNOMIAL + i / 4u] = vec4<u32>(runs[i], runs[i + 1u], runs[i + 2u], runs[i + 3u]);
    }
}

// A sphere around the points of a square of pixels between two depths.
fn sphere_around(first: vec2<u32>, nearest: f32, farthest: f32) -> Sphere {
    var corners: array<vec3<f32>, 8>;
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < 8u; i++) {
        let corner = vec2<u32>(i & 1u, (i >> 1u) & 1u) * (SQUARE_PX - 1u);
        let ray = ray_through(centre_of(first + corner));
        corners[i] = ray.origin + select(nearest, farthest, i >= 4u) * ray.direction;
        sum += corners[i];
    }
    let centre = sum / 8.0;
    var radius = 0.0;
    for (var i = 0u; i < 8u; i++) {
        radius = max(radius, distance(centre, corners[i]));
    }
    return Sphere(centre, 1.0001 * radius + doubt_at(farthest, snapped_px));
}

// The least and greatest depth of the crossings in a square at which a part begins to be kept; the first is greater if there is none.
fn depths_in(first: vec2<u32>, cuts: u32) -> vec2<f32> {
    var depths = vec2<f32>(1.0, -1.0) * 3e38;
    for (var pixel = 0u; pixel < SQUARE_PX * SQUARE_PX; pixel++) {
        let at = first + vec2<u32>(pixel % SQUARE_PX, pixel / SQUARE_PX);
        if any(at >= frame.size_px) {
            continue;
        }
        var sides = head_of(at).y;
        let crossings = min(cappable(at), MOST_CROSSINGS);
        for (var i = 0u; i < crossings; i++) {
            let after = sides ^ (1u << surface_at(i, at));
            if is_removed(sides, cuts) && !is_removed(after, cuts) {
                let depth = depth_at(i, at);
                depths = vec2<f32>(min(depths.x, depth), max(depths.y, depth));
            }
            sides = after;
        }
    }
    return depths;
}

// A workgroup has at most 16 tiles.
@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) invocation: u32,
) {
    let turn = invocation / SQUARES;
    if turn >= turns(group, groups) {
        return;
    }
    let corner = SQUARE_PX * vec2<u32>(invocation % 2u, invocation / 2u % 2u);
    let first = pixel_at(turn, group, groups, vec3<u32>(corner, 0u));
    if any(first >= frame.size_px) {
        return;
    }
    for (var place = 0u; place < min(lane_count, MOST_LANES); place++) {
        let part = parts[place];
        if part.closing == NO_CLOSING {
            continue;
        }
        let closing = closing_of(part.closing);
        if closing.is_flat {
            continue;
        }
        let depths = depths_in(first, part.cuts);
        if depths.x <= depths.y {
            expand(closing.tree, sphere_around(first, depths.x, depths.y), expansion_at(part.closing, closing_count, first, false));
        }
        if near_inside {
            expand(closing.tree, sphere_around(first, frame.near, frame.near), expansion_at(part.closing, closing_count, first, true));
        }
    }
}
