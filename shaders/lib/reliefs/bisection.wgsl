// Right triangles, halved at the middle of their longest edge, the hypotenuse: the apex is at the right angle, and a to b is the
// hypotenuse. Vertices are in steps of a domain.
//
// The two triangles of a patch have depth 0. At even depths the legs lie along the axes and the hypotenuse is the diagonal of a square; at
// odd depths the hypotenuse lies along an axis, an edge between two squares. Diagonals of patches alternate like the squares of a
// chessboard, as those of the halves do automatically: diagonals run through points whose coordinates, counted in sides, are both odd or
// both even. All triangles have the same winding.

#define_import_path cutaway::bisection

struct Triangle {
    apex: vec2<i32>,
    a: vec2<i32>,
    b: vec2<i32>,
}

// One of the two triangles of a patch: the first is the one below the diagonal.
fn root_of(patch_at: vec2<i32>, second: bool, size: i32) -> Triangle {
    let low = patch_at * size;
    let high = low + size;
    let right = vec2<i32>(high.x, low.y);
    let top = vec2<i32>(low.x, high.y);
    if ((patch_at.x + patch_at.y) & 1) == 0 {
        if second {
            return Triangle(top, low, high);
        }
        return Triangle(right, high, low);
    }
    if second {
        return Triangle(high, top, right);
    }
    return Triangle(low, right, top);
}

// Middle of the hypotenuse.
fn middle_of(triangle: Triangle) -> vec2<i32> {
    return (triangle.a + triangle.b) / 2;
}

// The first half, which contains a, or the second, which contains b.
fn half_of(triangle: Triangle, second: bool) -> Triangle {
    let middle = middle_of(triangle);
    if second {
        return Triangle(middle, triangle.b, triangle.apex);
    }
    return Triangle(middle, triangle.apex, triangle.a);
}

// The triangle of which the given one is the first or the second half.
fn whole_of(triangle: Triangle, second: bool) -> Triangle {
    if second {
        return Triangle(triangle.b, 2 * triangle.apex - triangle.a, triangle.a);
    }
    return Triangle(triangle.a, triangle.b, 2 * triangle.apex - triangle.b);
}
