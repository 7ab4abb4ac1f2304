// Winding numbers of the triangles that close open parts: their solid angles over 4 pi, summed over a tree of balls in depth-first order. A
// ball that is far away for its size counts by its dipole and quadrupole, and adds the bound of its error; a leaf counts triangle by
// triangle. Derivation and bounds: `src/scene/winding`. Bound as @group(1) @binding(5).

#define_import_path cutaway::closings

// Heads of all open parts, then their trees, of nodes of four vectors: centre and radius; area vector and bound of the error; two elements of
// the diagonal of the traceless moment, the sum of areas, and the address of the next node that is not below this one; doubled other elements
// of the moment, and for a leaf the address and number of its triangles, of three vectors each. Addresses count vectors from the start of a
// tree.
@group(1) @binding(5) var<storage, read> closings: array<vec4<u32>>;

// Number of the closing of a part that is closed.
const NO_CLOSING: u32 = 0xffffffffu;
const LEAF_COUNT_BITS: u32 = 3u;
const MOST_LEAF_TRIANGLES: u32 = 7u;
// Most nodes that one query visits; a number that would need more is in doubt.
const MOST_BALLS: u32 = 4096u;
// Bound of the error of sums in f32.
const ROUNDING: f32 = 1e-4;
// Bound of the error of a volume, as a share of the product of its edges.
const VOLUME_ROUNDING: f32 = 1e-6;
// Greatest reach, as a share of the product of the edges, of a point that counts as above a triangle.
const BESIDE: f32 = 0.02;
// Half of a solid angle that counts as 0.
const LEAST_ANGLE: f32 = 1e-7;
const FOUR_PI: f32 = 12.566370614;

const VECTORS_OF_HEAD: u32 = 2u;

// An open part: its box, outside of which nothing is inside; the address of its tree, and whether its mesh lies in a plane and so encloses
// nothing.
struct Closing {
    least: vec3<f32>,
    greatest: vec3<f32>,
    tree: u32,
    is_flat: bool,
}

fn closing_of(number: u32) -> Closing {
    let head = VECTORS_OF_HEAD * number;
    return Closing(floats(head).xyz, floats(head + 1u).xyz, closings[head].w, closings[head + 1u].w != 0u);
}

// Winding number of some triangles around a point.
struct Winding {
    number: f32,
    // Bound of its error.
    error: f32,
    // True if the point is so near to a triangle that it may be on either side, or too many nodes would have to be visited.
    is_unsure: bool,
}

// Nodes and triangles that this invocation may still visit: work is bounded, whatever the scene. When none is left, all numbers are in doubt.
var<private> visits_left: u32 = 40000u;

fn floats(at: u32) -> vec4<f32> {
    return bitcast<vec4<f32>>(closings[at]);
}

// Solid angle of a triangle, positive from inside (van Oosterom & Strackee 1983), and 1 if the point is within `near` of it.
fn solid_angle(first: u32, point: vec3<f32>, near: f32) -> vec2<f32> {
    let a = floats(first).xyz - point;
    let b = floats(first + 1u).xyz - point;
    let c = floats(first + 2u).xyz - point;
    let la = length(a);
    let lb = length(b);
    let lc = length(c);
    let volume = dot(a, cross(b, c));
    let reach = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    let least = max(near * length(cross(b - a, c - a)), VOLUME_ROUNDING * la * lb * lc);
    // An angle of about pi or more: the point is above the triangle or right beside it.
    let is_near = reach < BESIDE * la * lb * lc + 1e-30 && abs(volume) <= least;
    // In the plane of the triangle, beside it, the angle is 0; one driver's atan2 gave pi there.
    let angle = select(0.0, 2.0 * atan2(volume, reach), reach < 0.0 || abs(volume) > LEAST_ANGLE * reach);
    return vec2<f32>(angle, select(0.0, 1.0, is_near));
}

// A node of a tree.
struct Ball {
    centre: vec3<f32>,
    radius: f32,
    area: vec3<f32>,
    error: f32,
    // Two elements of the diagonal of the traceless moment, and doubled other elements.
    diagonal: vec2<f32>,
    others: vec3<f32>,
    // Sum of areas.
    size: f32,
    // Address of the next node that is not below this one.
    next: u32,
    // For a leaf, the address and number of its triangles.
    is_leaf: bool,
    first: u32,
    count: u32,
}

fn ball_at(tree: u32, at: u32) -> Ball {
    let ball = floats(at);
    let flux = floats(at + 1u);
    let diagonal = closings[at + 2u];
    let others = closings[at + 3u];
    return Ball(
        ball.xyz,
        ball.w,
        flux.xyz,
        flux.w,
        bitcast<vec2<f32>>(diagonal.xy),
        bitcast<vec3<f32>>(others.xyz),
        bitcast<f32>(diagonal.z),
        tree + diagonal.w,
        others.w != 0u,
        tree + (others.w >> LEAF_COUNT_BITS),
        others.w & MOST_LEAF_TRIANGLES,
    );
}

// Address after the last node of a tree.
fn end_of(tree: u32) -> u32 {
    return tree + closings[tree + 2u].w;
}

// Solid angle of the triangles of a ball from far away: its dipole and its quadrupole.
fn far_angle(ball: Ball, away: vec3<f32>, distance: f32) -> f32 {
    let along = away / distance;
    let squares = along * along;
    let moment = dot(ball.diagonal, squares.xy - squares.z) + dot(ball.others, along.xxy * along.yzz);
    return (dot(ball.area, along) - 3.0 * moment / distance) / (distance * distance);
}

// Winding number of the triangles of a tree. `near` is a distance within which a point may be on either side of a
// triangle. A ball is opened where the bound of its error is greater than `ball_error`.
fn winding_of(tree: u32, point: vec3<f32>, near: f32, ball_error: f32) -> Winding {
    let end = end_of(tree);
    var angle = 0.0;
    var error = ROUNDING;
    var is_unsure = false;
    var at = tree;
    for (var n = 0u; n < MOST_BALLS && at < end && visits_left > 0u; n++) {
        visits_left--;
        let ball = ball_at(tree, at);
        let away = ball.centre - point;
        let distance = length(away);
        let gap = distance - ball.radius;
        let of_ball = ball.error / (gap * gap * gap * gap);
        if gap > 0.0 && of_ball <= ball_error {
            angle += far_angle(ball, away, distance);
            error += of_ball;
            at = ball.next;
        } else if ball.is_leaf {
            for (var i = 0u; i < min(ball.count, MOST_LEAF_TRIANGLES); i++) {
                let of_triangle = solid_angle(ball.first + 3u * i, point, near);
                angle += of_triangle.x;
                is_unsure |= of_triangle.y > 0.0;
            }
            visits_left -= min(visits_left, MOST_LEAF_TRIANGLES);
            at = ball.next;
        } else {
            at += 4u;
        }
    }
    return Winding(angle / FOUR_PI, error, is_unsure || at < end);
}
