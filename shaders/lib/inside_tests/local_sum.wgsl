// The winding number of a tree of closing triangles (`closings`) within a sphere: a polynomial for what is far away for its size, and a list of
// the other triangles.
//
// Cost: some hundred nodes; work is bounded by the most nodes of a query, and by the most triangles of a list, which ends the search unless a
// bound of the derivatives still shows something.

#define_import_path cutaway::local_sum

#import cutaway::closings::{Ball, FOUR_PI, MOST_BALLS, MOST_LEAF_TRIANGLES, ROUNDING, ball_at, end_of}
#import cutaway::expansion::{Sphere, begin_expansion, bound_of_rest, dipole_of, expand_dipole, expand_quadrupole, expansion, swing_in}
#import cutaway::local_winding::{MOST_OF_RUN, MOST_RUNS, RUN_BITS}
#import cutaway::nearby::{Nearby, nearby}

// A ball or triangle is expanded where the bound of what is left out, as a share of 4 pi, is at most this.
const FAR_ERROR: f32 = 0.001;
// Most triangles that are listed: beyond, a traversal for each crossing takes less time.
const MOST_LISTED: u32 = 256u;

// Runs of triangles that are not expanded, and their number.
var<private> runs: array<u32, MOST_RUNS>;
var<private> run_count: u32;
// Number of triangles in the runs.
var<private> listed: u32;
// Solid angle and gradient of these triangles at the centre of the sphere, and bound of the second derivatives in it.
var<private> listed_sum: Nearby;

// The number at the centre of a sphere, and by how much it differs from that in the sphere, at most.
struct LocalSum {
    number: f32,
    swing: f32,
    // Whether the polynomial and the list are complete.
    is_listed: bool,
}

// Adds a triangle to the list; to the polynomial if it is so large that its dipole does not show how smooth its number is.
fn list_nearby(triangle: u32, sphere: Sphere) {
    let of_triangle = nearby(triangle, sphere);
    let rest = 0.5 * sphere.radius * sphere.radius * of_triangle.bend / FOUR_PI;
    if rest <= FAR_ERROR {
        expansion.constant += of_triangle.angle;
        expansion.gradient += of_triangle.gradient;
        expansion.error += rest;
        return;
    }
    listed_sum.angle += of_triangle.angle;
    listed_sum.gradient += of_triangle.gradient;
    listed_sum.bend += of_triangle.bend;
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
            list_nearby(ball.first + 3u * i, sphere);
        }
    }
}

fn is_listed() -> bool {
    return run_count <= MOST_RUNS && listed <= MOST_LISTED;
}

// Sums a tree: fills the polynomial and the list.
fn sum_in(tree: u32, sphere: Sphere) -> LocalSum {
    begin_expansion();
    run_count = 0u;
    listed = 0u;
    listed_sum = Nearby(0.0, vec3<f32>(0.0), 0.0);
    // Beyond this, the second derivatives alone leave no whole number.
    let most_bend = FOUR_PI / (sphere.radius * sphere.radius);
    let end = end_of(tree);
    var at = tree;
    for (var n = 0u; n < MOST_BALLS && at < end && (is_listed() || listed_sum.bend < most_bend); n++) {
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
    let number = (expansion.constant + listed_sum.angle) / FOUR_PI;
    let swing = swing_in(sphere.radius, listed_sum.gradient, listed_sum.bend) / FOUR_PI + expansion.error + ROUNDING;
    return LocalSum(number, select(1.0, swing, at >= end), at >= end && is_listed());
}
