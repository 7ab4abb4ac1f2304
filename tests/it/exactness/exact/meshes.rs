//! Meshes that make a careless rasteriser count wrong.

use cutaway::layers::Kind;
use cutaway::scene::{ClipSurface, Mesh};
use cutaway_lab::exact::Exact;
use glam::{DVec3, Vec3, dvec3};

use crate::exactness::exact::solids::{
    ball, cuboid, frame, joined, noise, odd, orbit, parallel, scene, sound, unit_cube,
};

const FRONT: DVec3 = DVec3::new(0.0, 0.0, 4.0);

/// A block whose front is a grid of `n` x `n` squares, its vertices moved in depth at will.
fn bumpy(n: u32, depth: impl Fn(u32, u32) -> f64) -> Mesh {
    let side = n + 1;
    let at = |i: u32| f64::from(i) / f64::from(n) - 0.5;
    let mut mesh = Mesh::default();
    for layer in 0..2 {
        for j in 0..side {
            for i in 0..side {
                let z = if layer == 0 { depth(i, j) } else { -0.5 };
                mesh.positions.push(dvec3(at(i), at(j), z));
            }
        }
    }
    let id = |layer: u32, i: u32, j: u32| layer * side * side + j * side + i;
    let mut quad = |a: u32, b: u32, c: u32, d: u32| mesh.triangles.extend([[a, b, c], [a, c, d]]);
    for j in 0..n {
        for i in 0..n {
            let corners = |l: u32| {
                [
                    id(l, i, j),
                    id(l, i + 1, j),
                    id(l, i + 1, j + 1),
                    id(l, i, j + 1),
                ]
            };
            let [a, b, c, d] = corners(0);
            quad(a, b, c, d);
            let [a, b, c, d] = corners(1);
            quad(a, d, c, b);
        }
    }
    for i in 0..n {
        quad(id(1, i, 0), id(1, i + 1, 0), id(0, i + 1, 0), id(0, i, 0));
        quad(id(0, i, n), id(0, i + 1, n), id(1, i + 1, n), id(1, i, n));
        quad(id(0, 0, i), id(0, 0, i + 1), id(1, 0, i + 1), id(1, 0, i));
        quad(id(1, n, i), id(1, n, i + 1), id(0, n, i + 1), id(0, n, i));
    }
    mesh
}

#[test]
fn rays_through_shared_vertices_and_edges_cross_once() {
    // 65 px over 65/32 units: pixel centres are multiples of 1/32 from the middle, and so are the vertices.
    let mut random = noise(5);
    let heights: Vec<f64> = (0..33 * 33).map(|_| random() * 0.4).collect();
    let block = bumpy(32, |i, j| heights[(j * 33 + i) as usize]);
    let camera = parallel(FRONT, DVec3::ZERO, 65.0 / 32.0);
    for cuts in [
        vec![],
        vec![vec![ClipSurface::plane(DVec3::Z * 0.2, DVec3::NEG_Z)]],
    ] {
        let exact = sound(&scene(vec![block.clone()], cuts, camera), [65, 65]);
        // Of the 33 x 33 samples on the block the top-left rule gives away the last row and column.
        assert_eq!(exact.covered_px(), 32 * 32, "the tie rule is not top-left");
        assert_ne!(
            exact.layers.at(16, 16).kind,
            Kind::Background,
            "top left is in"
        );
        assert_eq!(
            exact.layers.at(48, 30).kind,
            Kind::Background,
            "right is out"
        );
        assert_eq!(
            exact.layers.at(30, 48).kind,
            Kind::Background,
            "bottom is out"
        );
    }
}

#[test]
fn an_open_mesh_is_odd_exactly_where_it_is_open() {
    // The control of every "odd is 0" in this suite.
    let mut open = unit_cube();
    let camera = parallel(FRONT, DVec3::ZERO, 2.0);
    let z = |m: &Mesh, t: usize| m.corners(t).iter().map(|p| p.z).sum::<f64>();
    let front = (0..12).find(|t| z(&open, *t) > 1.4).unwrap();
    open.triangles.remove(front);
    let exact = frame(&scene(vec![open], vec![], camera), [64, 64]);
    let expected = 32 * 32 / 2;
    assert!(
        odd(&exact).abs_diff(expected) <= 16,
        "{} px are odd, not half of the face",
        odd(&exact)
    );
    // The answer does not depend on the parity: no pixel is in doubt.
    let unreliable = exact.layers.pixels.iter().filter(|l| l.unreliable).count();
    assert_eq!(unreliable, 0);
}

/// A hole in the back of a cube. Who counts the crossings behind the cap that shows finds one more or one fewer at the rim of the hole; who
/// sees the front does not.
#[test]
fn the_rim_of_a_hole_is_undecided_behind_a_cap() {
    let camera = parallel(FRONT, DVec3::ZERO, 2.0);
    let mut cube = unit_cube();
    let z = |m: &Mesh, t: usize| m.corners(t).iter().map(|p| p.z).sum::<f64>();
    let back = (0..12).find(|t| z(&cube, *t) < -1.4).unwrap();
    let cut = || vec![vec![ClipSurface::plane(DVec3::ZERO, -DVec3::Z)]];
    // Samples lie on the diagonal of the back.
    let undecided = |mesh: &Mesh, cut: Vec<Vec<ClipSurface>>| {
        let exact = frame(&scene(vec![mesh.clone()], cut, camera), [64, 64]);
        let is_undecided = |i: &usize| {
            let [down, up] = [16 + i, 47 - i].map(|row| row * 64 + 16 + i);
            exact.undecided[down] || exact.undecided[up]
        };
        (0..32).filter(is_undecided).count()
    };
    assert!(undecided(&cube, cut()) <= 2, "the corners alone");
    cube.triangles.remove(back);
    assert!(undecided(&cube, vec![]) <= 2, "the front hangs on no rim");
    assert!(undecided(&cube, cut()) >= 30);
}

#[test]
fn a_fan_of_slivers_meeting_at_a_sample_is_crossed_an_even_number_of_times() {
    let n = 1000;
    for middle in [dvec3(0.0, 0.0, 0.5), dvec3(1e-9, -1e-9, 0.5)] {
        let mut mesh = Mesh {
            positions: vec![middle, dvec3(0.0, 0.0, -0.5)],
            ..Mesh::default()
        };
        for i in 0..n {
            let turn = std::f64::consts::TAU * f64::from(i) / f64::from(n);
            mesh.positions.push(dvec3(turn.cos(), turn.sin(), 0.0));
        }
        for i in 0..n {
            let (a, b) = (2 + i, 2 + (i + 1) % n);
            mesh.triangles.extend([[0, a, b], [1, b, a]]);
        }
        for camera in [
            parallel(FRONT, DVec3::ZERO, 65.0 / 32.0),
            crate::exactness::exact::solids::eye(FRONT, DVec3::ZERO, 30.0),
        ] {
            let exact = sound(&scene(vec![mesh.clone()], vec![], camera), [65, 65]);
            assert_eq!(
                exact.layers.at(32, 32).kind,
                Kind::Surface,
                "the sample at the hub is lost"
            );
        }
    }
}

#[test]
fn degenerate_triangles_change_nothing() {
    let clean = ball(0.8, 24, 32);
    let mut soiled = clean.clone();
    let (a, b) = (clean.triangles[40][0], clean.triangles[40][1]);
    // Twice the same corner, all the same corner, and no area between two vertices and their midpoint, there and back.
    soiled.triangles.extend([[a, a, b], [b, b, b], [a, b, a]]);
    let m = soiled.positions.len() as u32;
    let midpoint = (soiled.positions[a as usize] + soiled.positions[b as usize]) * 0.5;
    soiled.positions.push(midpoint);
    soiled.triangles.extend([[a, m, b], [b, m, a]]);
    // A closed needle of aspect 1e6 deep inside: it changes parity only on itself, too thin for any sample.
    let mut clean_needle = clean.clone();
    let needle = cuboid(dvec3(-0.5, 0.1, 0.1), dvec3(0.5, 0.1 + 1e-6, 0.1 + 1e-6));
    clean_needle = joined(clean_needle, needle.clone());
    soiled = joined(soiled, needle);
    let cut = || vec![vec![ClipSurface::plane(DVec3::ZERO, dvec3(0.3, 0.2, -1.0))]];
    for camera in [orbit(20.0, 30.0), parallel(FRONT, DVec3::ZERO, 2.0)] {
        let a = sound(&scene(vec![clean_needle.clone()], cut(), camera), [96, 96]);
        let b = sound(&scene(vec![soiled.clone()], cut(), camera), [96, 96]);
        assert_eq!(a.layers, b.layers, "degenerate triangles are seen");
    }
}

#[test]
fn doubled_vertices_are_no_rim() {
    // A mesh of separate triangles, as STL files hold them, has the same undecided pixels as the indexed one.
    let mesh = ball(0.8, 24, 32);
    let mut soup = Mesh::default();
    for t in 0..mesh.triangles.len() {
        let first = soup.positions.len() as u32;
        soup.positions.extend(mesh.corners(t));
        soup.triangles.push([first, first + 1, first + 2]);
    }
    let [a, b] =
        [mesh, soup].map(|m| sound(&scene(vec![m], vec![], orbit(20.0, 30.0)), [128, 128]));
    // Separate triangles are shaded flat; all but the normals is the same.
    let unshaded = |e: &Exact| {
        let mut layers = e.layers.clone();
        layers.pixels.iter_mut().for_each(|p| p.normal = Vec3::ZERO);
        layers
    };
    assert_eq!(unshaded(&a), unshaded(&b), "the same triangles");
    assert_eq!(a.undecided, b.undecided, "an edge counts by where it is");
}
