// Measures the twist of every cell of a domain. One invocation owns one cell; a workgroup reads the twists of its cells and of those
// around them once.
//
// The stored value is the greatest of |twist| / 4^d over the cells d steps away, d up to 3, and at least as large as for any cell farther
// away: so no cell's value is less than a quarter of its neighbour's, as halving below a texel requires.

#import cutaway::domain::{domain_cell, domain_texels, domains}

@group(1) @binding(10) var<storage, read_write> sheet_errors: array<f32>;

// Index of the clip-surface in the table.
override surface: u32 = 0u;

const AROUND: i32 = 3;
const ROW: u32 = 22u;

var<workgroup> twists: array<f32, 484>;

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
    @builtin(local_invocation_index) invocation: u32,
) {
    let size = domain_texels(surface);
    let low = vec2<i32>(group.xy * 16u) - AROUND;
    for (var i = invocation; i < 484u; i += 256u) {
        let cell = low + vec2<i32>(vec2<u32>(i % ROW, i / ROW));
        let is_cell = all(cell >= vec2<i32>(0)) && all(cell < vec2<i32>(size));
        var twist = 0.0;
        if is_cell {
            twist = abs(domain_cell(surface, cell).twist);
        }
        twists[i] = twist;
    }
    workgroupBarrier();
    let cell = group.xy * 16u + local.xy;
    if any(cell >= size) {
        return;
    }
    let own = vec2<i32>(local.xy) + AROUND;
    var greatest = domains.surfaces[surface].least_twist;
    for (var y = -AROUND; y <= AROUND; y++) {
        let most = AROUND - abs(y);
        for (var x = -most; x <= most; x++) {
            let at = vec2<u32>(own + vec2<i32>(x, y));
            let share = 1.0 / f32(1u << u32(2 * (abs(x) + abs(y))));
            greatest = max(greatest, twists[at.y * ROW + at.x] * share);
        }
    }
    sheet_errors[domains.surfaces[surface].first_cell + cell.y * size.x + cell.x] = greatest;
}
