// Fills the cells around open parts with the winding number of the closing triangles, rounded, where it is the same for all points of a cell.
//
// Within a cell the number is a constant, a linear term by the sum of gradients, and a remainder. For balls and triangles at a distance, the
// gradient is that of a dipole, and the remainder is bounded as that of `winding_of`, with offsets that the radius of the cell adds to:
// 3 (sqrt(I) + radius sqrt(A))^2 / d^4. For other triangles, the gradient is the field of their edges (Biot & Savart), whose own change
// bounds the remainder. Where a triangle touches the cell, the number varies. An invocation owns a cell, a row of workgroups a grid. Cost per
// cell: as a query for a point, cut short where the number varies.

#import cutaway::closings::{FOUR_PI, MOST_BALLS, MOST_LEAF_TRIANGLES, ROUNDING, VARIES, ball_at, end_of, far_angle, floats, grid_of, solid_angle}

@group(1) @binding(6) var<storage, read_write> closing_cells: array<i32>;

// A ball is opened where the bound of its remainder, as a share of 4 pi, is greater.
const CELL_ERROR: f32 = 0.002;
const HALF_DIAGONAL: f32 = 0.8660254;
// Points this far outside of a cell have its number too: `AROUND_CELL` in `reduce`, with the diagonal.
const WIDENED: f32 = 1.05;
// Margin for the rounding of points at the sides of a cell.
const MARGIN: f32 = 4e-6;

// Gradient of the winding number of a dipole.
fn gradient_of_dipole(area: vec3<f32>, away: vec3<f32>, distance: f32) -> vec3<f32> {
    let along = away / distance;
    return (3.0 * dot(area, along) * along - area) / (distance * distance * distance * FOUR_PI);
}

// Field of an edge at the origin, and a bound of its change within `around`, negative if points of the edge may be as near.
fn field_of_edge(a: vec3<f32>, b: vec3<f32>, around: f32) -> vec4<f32> {
    let along = b - a;
    let size = length(along);
    let share = clamp(-dot(a, along) / max(size * size, 1e-30), 0.0, 1.0);
    let gap = length(a + share * along) - around;
    let la = length(a);
    let lb = length(b);
    let field = cross(a, b) * (la + lb) / max(la * lb * (la * lb + dot(a, b)), 1e-30);
    let change = 1.5 * around * around * min(size / gap, 2.0) / (gap * gap);
    return vec4<f32>(field, select(change, -1.0, gap <= 0.0)) / FOUR_PI;
}

// Gradient of a triangle's winding number, and a bound of its remainder, negative if the triangle may touch the cell.
fn change_of_triangle(first: u32, point: vec3<f32>, around: f32) -> vec4<f32> {
    let a = floats(first).xyz - point;
    let b = floats(first + 1u).xyz - point;
    let c = floats(first + 2u).xyz - point;
    let middle = (a + b + c) / 3.0;
    let squares = vec3<f32>(dot(a - middle, a - middle), dot(b - middle, b - middle), dot(c - middle, c - middle));
    let normal = cross(b - a, c - a);
    let area = 0.5 * length(normal);
    let distance = length(middle);
    let gap = distance - sqrt(max(squares.x, max(squares.y, squares.z))) - around;
    let spread = sqrt(area * (squares.x + squares.y + squares.z) / 12.0) + around * sqrt(area);
    let remainder = 3.0 * spread * spread / (gap * gap * gap * gap * FOUR_PI);
    if gap > 0.0 && remainder <= CELL_ERROR {
        return vec4<f32>(gradient_of_dipole(0.5 * normal, middle, distance), remainder);
    }
    let ab = field_of_edge(a, b, around);
    let bc = field_of_edge(b, c, around);
    let ca = field_of_edge(c, a, around);
    // The foot of the point on the plane lies on the inner side of all edges.
    let sides = vec3<f32>(dot(cross(a, b), normal), dot(cross(b, c), normal), dot(cross(c, a), normal));
    let crosses = abs(dot(a, normal)) < around * length(normal) && all(sides >= vec3<f32>(0.0));
    let touches = crosses || min(ab.w, min(bc.w, ca.w)) < 0.0;
    return select(ab + bc + ca, vec4<f32>(0.0, 0.0, 0.0, -1.0), touches);
}

fn number_in(tree: u32, point: vec3<f32>, around: f32) -> i32 {
    let end = end_of(tree);
    var angle = 0.0;
    var gradient = vec3<f32>(0.0);
    var error = ROUNDING;
    var at = tree;
    for (var n = 0u; n < MOST_BALLS && at < end && error < 0.5; n++) {
        let ball = ball_at(tree, at);
        let away = ball.centre - point;
        let distance = length(away);
        let gap = distance - ball.radius - around;
        let spread = sqrt(ball.error) + around * sqrt(3.0 * ball.size / FOUR_PI);
        let remainder = spread * spread / (gap * gap * gap * gap);
        if gap > 0.0 && remainder <= CELL_ERROR {
            angle += far_angle(ball, away, distance);
            gradient += gradient_of_dipole(ball.area, away, distance);
            error += remainder;
            at = ball.next;
        } else if ball.is_leaf {
            for (var i = 0u; i < min(ball.count, MOST_LEAF_TRIANGLES); i++) {
                let change = change_of_triangle(ball.first + 3u * i, point, around);
                angle += solid_angle(ball.first + 3u * i, point, 0.0).x;
                gradient += change.xyz;
                error += select(change.w, 1.0, change.w < 0.0);
            }
            at = ball.next;
        } else {
            at += 4u;
        }
    }
    let number = angle / FOUR_PI;
    let whole = round(number);
    let change = error + around * length(gradient);
    return select(VARIES, i32(whole), at >= end && 0.5 - abs(number - whole) > change);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let grid = grid_of(id.y);
    let counts = grid.counts;
    if id.x >= counts.x * counts.y * counts.z {
        return;
    }
    let cell = vec3<u32>(id.x % counts.x, id.x / counts.x % counts.y, id.x / (counts.x * counts.y));
    let point = grid.origin + (vec3<f32>(cell) + 0.5) * grid.cell;
    closing_cells[grid.first_cell + id.x] = number_in(grid.tree, point, WIDENED * HALF_DIAGONAL * grid.cell + MARGIN);
}
