// The winding number of triangles within a sphere around c, as far as it is a polynomial in x = point - c, times 4 pi.
//
// With y the offset of area from the centre of its ball, the number depends on x - y alone; terms up to the second order are kept, except that
// of y twice, which needs a moment that balls do not store. What is left out is at most 3 I / d^4 for that term and 4 |x - y|^3 / g^5 for all
// later ones, per area, as the (k + 1)-th derivative of 1/r is at most (k + 1)! / r^(k + 2); d is the distance of the centres, g that of the
// sphere from the ball, I the integral of y^2 over the area.

#define_import_path cutaway::expansion

#import cutaway::closings::{Ball, FOUR_PI, floats}

struct Sphere {
    centre: vec3<f32>,
    radius: f32,
}

struct Expansion {
    constant: f32,
    gradient: vec3<f32>,
    // Of the second derivatives, a matrix without trace: two elements of the diagonal, and doubled other elements.
    diagonal: vec2<f32>,
    others: vec3<f32>,
    // Bound of what is left out, as a share of 4 pi.
    error: f32,
}

var<private> expansion: Expansion;

fn begin_expansion() {
    expansion = Expansion(0.0, vec3<f32>(0.0), vec2<f32>(0.0), vec3<f32>(0.0), 0.0);
}

// Bound of what is left out of an area of a given size, integral of y^2, and radius of its ball, in a sphere with radius `around`.
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

// Most by which the polynomial, with triangles of another gradient and bound of second derivatives, differs in a sphere from its centre.
fn swing_in(radius: f32, gradient: vec3<f32>, bend: f32) -> f32 {
    let diagonal = vec3<f32>(expansion.diagonal, expansion.diagonal.x + expansion.diagonal.y);
    let own_bend = sqrt(dot(diagonal, diagonal) + 0.5 * dot(expansion.others, expansion.others));
    return radius * (length(expansion.gradient + gradient) + 0.5 * radius * (own_bend + bend));
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
