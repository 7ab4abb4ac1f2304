//! Meshes that nobody would make, from a fixed seed: nothing panics, what is filled is what the loops enclose, and closed meshes
//! leave nothing open.

use std::f64::consts::TAU;

use cutaway::scene::{Fill, Mesh};
use cutaway::slice::{SectionDefect, SlicePlane, Slicer};
use glam::{DVec2, DVec3};

use crate::meshes::slice::lines::fault;
use crate::meshes::slice::meshes::{shape, with_degenerate};
use crate::meshes::slice::{near, plane, section, slicer, walls};

/// Numbers without a pattern (Marsaglia's xorshift).
struct Numbers(u64);

impl Numbers {
    fn of_case(case: u64) -> Self {
        let mut numbers = Self(0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(2 * case + 1));
        (0..8).for_each(|_| _ = numbers.below(2));
        numbers
    }

    fn below(&mut self, limit: u32) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 32) as u32 % limit
    }

    fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len() as u32) as usize]
    }

    /// From -1 to 1, of a lattice where everything meets everything, or of no lattice.
    fn coordinate(&mut self, on_lattice: bool) -> f64 {
        if on_lattice {
            f64::from(self.below(5)) * 0.5 - 1.0
        } else {
            f64::from(self.below(u32::MAX)) / f64::from(u32::MAX) * 2.0 - 1.0
        }
    }

    fn point(&mut self, on_lattice: bool) -> DVec3 {
        DVec3::from([0; 3].map(|_| self.coordinate(on_lattice)))
    }
}

/// Tetrahedra over shared vertices: closed, crossing, repeating and folded flat.
fn tetrahedra(n: &mut Numbers, on_lattice: bool) -> Mesh {
    let vertices = 4 + n.below(20);
    let mut mesh = Mesh {
        positions: (0..vertices).map(|_| n.point(on_lattice)).collect(),
        ..Mesh::default()
    };
    for _ in 0..=n.below(20) {
        let [a, b, c, d] = [0; 4].map(|_| n.below(vertices));
        let faces = [[a, b, c], [a, c, d], [a, d, b], [b, d, c]];
        mesh.triangles.extend(faces);
    }
    mesh
}

/// Triangles that share nothing.
fn soup(n: &mut Numbers, on_lattice: bool) -> Mesh {
    let triangles = 1 + n.below(40);
    Mesh {
        positions: (0..3 * triangles).map(|_| n.point(on_lattice)).collect(),
        triangles: (0..triangles)
            .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
            .collect(),
        corner_normals: None,
        vertex_paint: None,
    }
}

/// Walls over one curve that crosses itself at will, or over a star.
fn curtain(n: &mut Numbers, on_lattice: bool) -> Mesh {
    let corners = 3 + n.below(40);
    let step = 1 + n.below(corners / 2 + 1);
    let is_star = n.below(2) == 0;
    let corner = |i: u32| {
        if is_star {
            let place = i * step % corners;
            DVec2::from_angle(TAU * f64::from(place) / f64::from(corners))
        } else {
            DVec2::new(n.coordinate(on_lattice), n.coordinate(on_lattice))
        }
    };
    walls(&[(0..corners).map(corner).collect()])
}

/// Few vertices of all magnitudes, and indices that name none.
fn nonsense(n: &mut Numbers) -> Mesh {
    let vertices = 3 + n.below(6);
    let sizes = [
        1.0,
        1e-300,
        1e300,
        1e-17,
        5e-324,
        1.7e308,
        f64::NAN,
        f64::INFINITY,
    ];
    let corners = |n: &mut Numbers| {
        [0; 3].map(|_| {
            let beyond = n.below(8) / 7;
            n.below(vertices + beyond)
        })
    };
    let positions = (0..vertices).map(|_| {
        let size = n.pick(&sizes);
        n.point(true) * size
    });
    Mesh {
        positions: positions.collect(),
        triangles: (0..n.below(30)).map(|_| corners(n)).collect(),
        corner_normals: None,
        vertex_paint: None,
    }
}

fn any_plane(n: &mut Numbers, on_lattice: bool, size: f64) -> SlicePlane {
    let normal = match n.below(3) {
        0 => DVec3::Z,
        1 => n.pick(&DVec3::AXES),
        _ => n.point(on_lattice),
    };
    let shift = n.pick(&[0.0, 0.5]);
    plane(n.point(on_lattice) * size * shift, normal)
}

#[test]
fn whatever_is_cut_the_fill_is_what_the_loops_enclose() {
    let (mut crossing, mut open, mut filled) = (0, 0, 0);
    for case in 0..4000 {
        let n = &mut Numbers::of_case(case);
        let on_lattice = n.below(3) == 0;
        let kind = n.below(3);
        let mut mesh = match kind {
            0 => tetrahedra(n, on_lattice),
            1 => soup(n, on_lattice),
            _ => curtain(n, on_lattice),
        };
        let size = n.pick(&[1.0, 1.0, 1e-300, 1e-20, 1e17, 1e140, 1e299]);
        mesh.positions.iter_mut().for_each(|p| *p *= size);
        let plane = any_plane(n, on_lattice, size);
        let slicer = slicer(&mesh);
        for rule in [Fill::EvenOdd, Fill::Nonzero] {
            let section = slicer.section_by(&plane, rule);
            for defect in &section.defects {
                crossing += usize::from(matches!(defect, SectionDefect::Crossing { .. }));
                open += usize::from(matches!(defect, SectionDefect::Open { .. }));
                let is_known = !matches!(
                    defect,
                    SectionDefect::Unusable { .. } | SectionDefect::LeftOut { .. }
                );
                assert!(is_known, "case {case}: {defect}");
            }
            filled += usize::from(!section.triangles.is_empty());
            let is_closed = section.open.is_empty();
            assert!(is_closed || kind != 0, "case {case}: a closed mesh is open");
            // Beyond this the square of a size is no f64.
            if (1e-150..1e150).contains(&size) {
                assert_eq!(
                    fault(&section, rule),
                    None,
                    "case {case}, {size:e} {rule:?}"
                );
            }
        }
    }
    assert!(
        crossing > 500 && open > 500 && filled > 2000,
        "too tame: {crossing} cross, {open} are open, {filled} are filled"
    );
}

#[test]
fn nonsense_is_left_out_and_reported() {
    let mut left_out = 0;
    for case in 0..4000 {
        let n = &mut Numbers::of_case(case);
        let mesh = nonsense(n);
        let size = n.pick(&[1.0, 1e-300, 1e300]);
        let mut plane = any_plane(n, true, size);
        if n.below(20) == 0 {
            plane.frame.normal = n.pick(&[DVec3::NAN, DVec3::ZERO, DVec3::INFINITY]);
        }
        let section = slicer(&mesh).section(&plane);
        assert!(section.points.iter().all(|p| p.is_finite()), "case {case}");
        left_out += usize::from(!section.is_whole());
        let _ = (section.area(), section.perimeter());
    }
    assert!(left_out > 1000, "too tame: {left_out} are not whole");
}

#[test]
fn nothing_has_no_section() {
    for (positions, triangles) in [
        (vec![], vec![]),
        (vec![DVec3::ZERO], vec![[0, 0, 0]]),
        (vec![], vec![[0, 1, 2]]),
    ] {
        let section = Slicer::new(positions, &triangles).section(&plane(DVec3::ZERO, DVec3::Z));
        assert!(
            section.is_empty() && section.triangles.is_empty(),
            "nothing"
        );
        assert_eq!((section.area(), section.perimeter()), (0.0, 0.0), "nothing");
    }
}

/// A triangle without area names the edge of two others: it took the place of one of them, and the outline was open by an ulp.
#[test]
fn a_triangle_without_area_opens_no_outline() {
    let cube = shape("cube");
    let flawed = with_degenerate(&cube);
    let step = DVec3::new(0.754_877_666, 0.569_840_291, 0.322_185_355);
    let normals = (1..400).map(|i| (step * f64::from(i)).fract() - 0.5);
    for normal in normals.chain([DVec3::new(-0.2, -0.1, -1.0)]) {
        let whole = section(&cube, DVec3::ZERO, normal);
        let found = section(&flawed, DVec3::ZERO, normal);
        near(found.area(), whole.area(), &format!("area across {normal}"));
        for chain in &found.open {
            let [first, last] = [chain[0], chain[chain.len() - 1]];
            let apart = found.points[first as usize].distance(found.points[last as usize]);
            assert!(chain.len() == 2 && apart < 1e-12, "{normal}: {apart}");
        }
    }
}
