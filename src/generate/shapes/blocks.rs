//! Solids made of boxes: `cube`, `sponge`, `comb`.
//!
//! All three are unions of cells of a lattice; the surface consists of the faces between full and empty cells, with one
//! vertex per lattice point. Two full cells that touch only along an edge would give that edge four faces; the
//! cells of these shapes never do.

use std::collections::HashMap;

use glam::DVec3;

use super::spec::{ShapeInfo, ShapeParameter};
use super::{Mesh, Part};

/// A cube around the origin.
pub(super) const CUBE: ShapeInfo = ShapeInfo {
    name: "cube",
    summary: "a cube around the origin",
    parameters: &[
        ShapeParameter::length("size", "length of an edge", 1.0),
        ShapeParameter::count("divisions", "squares along an edge", 1, [1, 1000]),
    ],
    triangles: |v| 12.0 * v.real("divisions").powi(2),
    build: |v| {
        let (size, n) = (v.real("size"), v.count("divisions") as u32);
        let mut skin = Skin::default();
        for axis in 0..3 {
            for i in 0..n {
                for j in 0..n {
                    for (layer, far) in [(0, false), (n - 1, true)] {
                        let mut cell = [layer; 3];
                        (cell[(axis + 1) % 3], cell[(axis + 2) % 3]) = (i, j);
                        skin.face(cell, axis, far);
                    }
                }
            }
        }
        // k/n - 1/2 as (2k - n)/2n: exactly symmetric, so a plane through the middle passes exactly through vertices or misses them all.
        let along = |k: u32| (2.0 * f64::from(k) - f64::from(n)) / (2.0 * f64::from(n)) * size;
        let mesh = skin.mesh(|corner| DVec3::from_array(corner.map(along)));
        Ok(vec![Part::new("cube", mesh)])
    },
};

/// A Menger sponge.
pub(super) const SPONGE: ShapeInfo = ShapeInfo {
    name: "sponge",
    summary: "a Menger sponge: many through-holes, genus 5, 81, 1409, ...",
    parameters: &[
        ShapeParameter::length("size", "length of an edge of the whole", 1.0),
        ShapeParameter::count("level", "times every cube is drilled", 2, [0, 5]),
    ],
    // 2 * 20^n + 4 * 8^n unit squares: those of all small cubes, without the ones where two cubes join.
    triangles: |v| 4.0 * 20_f64.powf(v.real("level")) + 8.0 * 8_f64.powf(v.real("level")),
    build: |v| {
        let (size, level) = (v.real("size"), v.count("level") as u32);
        let n = 3_u32.pow(level);
        let skin = Skin::of_cells([n; 3], |cell| in_sponge(cell, level));
        let along = |k: u32| (2.0 * f64::from(k) - f64::from(n)) / (2.0 * f64::from(n)) * size;
        let mesh = skin.mesh(|corner| DVec3::from_array(corner.map(along)));
        Ok(vec![Part::new("sponge", mesh)])
    },
};

/// Many thin plates on a spine: one closed surface with high depth complexity.
pub(super) const COMB: ShapeInfo = ShapeInfo {
    name: "comb",
    summary: "thin parallel plates on a common spine: high depth complexity",
    parameters: &[
        ShapeParameter::count("teeth", "plates", 24, [1, 400_000]),
        ShapeParameter::real(
            "fill",
            "thickness of a plate as a share of the pitch",
            0.4,
            [0.01, 0.99],
        ),
        ShapeParameter::length("length", "along x, across the plates", 1.5),
        ShapeParameter::length("height", "of plates and spine", 1.0),
        ShapeParameter::length("depth", "of the plates, along z", 1.0),
        ShapeParameter::real("spine", "its share of the height", 0.15, [0.01, 0.99]),
    ],
    // Squares: 5 per plate, 3 per plate and 4 per gap on the spine, 2 at its ends.
    triangles: |v| 24.0 * v.real("teeth") - 4.0,
    build: |v| {
        let teeth = v.count("teeth") as u32;
        let skin = Skin::of_cells([2 * teeth - 1, 2, 1], |[i, j, _]| j == 0 || i % 2 == 0);
        let fill = v.real("fill");
        // `teeth` pitches minus the last gap.
        let pitch = v.real("length") / (f64::from(teeth) - 1.0 + fill);
        let (height, depth) = (v.real("height"), v.real("depth"));
        let spine = height * v.real("spine");
        let mesh = skin.mesh(|[i, j, k]| {
            let x = f64::from(i / 2) + if i % 2 == 0 { 0.0 } else { fill };
            DVec3::new(
                x * pitch - v.real("length") * 0.5,
                [0.0, spine, height][j as usize] - height * 0.5,
                (f64::from(k) - 0.5) * depth,
            )
        });
        Ok(vec![Part::new("comb", mesh)])
    },
};

/// Returns true if a cell survives the drilling: at no level may two of its coordinates lie in the middle third.
fn in_sponge(mut cell: [u32; 3], level: u32) -> bool {
    for _ in 0..level {
        if cell.iter().filter(|c| **c % 3 == 1).count() > 1 {
            return false;
        }
        cell = cell.map(|c| c / 3);
    }
    true
}

/// Faces of lattice cells with shared corners.
#[derive(Default)]
struct Skin {
    corners: Vec<[u32; 3]>,
    index_of: HashMap<[u32; 3], u32>,
    triangles: Vec<[u32; 3]>,
}

impl Skin {
    /// The boundary of a set of cells.
    fn of_cells(size: [u32; 3], full: impl Fn([u32; 3]) -> bool) -> Self {
        let mut skin = Self::default();
        for z in 0..size[2] {
            for y in 0..size[1] {
                for x in 0..size[0] {
                    let cell = [x, y, z];
                    if !full(cell) {
                        continue;
                    }
                    for axis in 0..3 {
                        let (mut before, mut after) = (cell, cell);
                        before[axis] = before[axis].wrapping_sub(1);
                        after[axis] += 1;
                        if cell[axis] == 0 || !full(before) {
                            skin.face(cell, axis, false);
                        }
                        if after[axis] == size[axis] || !full(after) {
                            skin.face(cell, axis, true);
                        }
                    }
                }
            }
        }
        skin
    }

    /// Adds a cell's face perpendicular to an axis, counter-clockwise seen from outside the cell.
    fn face(&mut self, cell: [u32; 3], axis: usize, far: bool) {
        let corner = |du: u32, dv: u32| {
            let mut c = cell;
            c[axis] += u32::from(far);
            c[(axis + 1) % 3] += du;
            c[(axis + 2) % 3] += dv;
            c
        };
        let ring = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        let [a, b, c, d] = ring.map(|key| {
            *self.index_of.entry(key).or_insert_with(|| {
                self.corners.push(key);
                self.corners.len() as u32 - 1
            })
        });
        self.triangles.extend(if far {
            [[a, b, c], [a, c, d]]
        } else {
            [[a, c, b], [a, d, c]]
        });
    }

    fn mesh(self, position: impl Fn([u32; 3]) -> DVec3) -> Mesh {
        Mesh {
            positions: self.corners.into_iter().map(position).collect(),
            triangles: self.triangles,
            corner_normals: None,
            vertex_paint: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::in_sponge;

    #[test]
    fn no_two_cells_of_a_sponge_touch_only_along_an_edge() {
        let level = 3;
        let n = 3_u32.pow(level);
        for z in 0..n {
            for y in 0..n - 1 {
                for x in 0..n - 1 {
                    let full = |dx, dy| in_sponge([x + dx, y + dy, z], level);
                    let cross = full(0, 0) && full(1, 1) && !full(0, 1) && !full(1, 0);
                    let other = !full(0, 0) && !full(1, 1) && full(0, 1) && full(1, 0);
                    assert!(!cross && !other, "edge at {x}, {y}, {z} has four faces");
                }
            }
        }
    }
}
