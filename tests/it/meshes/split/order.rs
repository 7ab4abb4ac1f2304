//! Bodies that touch all over are told apart by the order of their triangles, where files write one after the other.

use cutaway::scene::{Bodies, Topology};

use super::*;

/// A cup with six sides and what fills it, far from the origin, in coordinates of f32: walls that touch are turned against each other by
/// rounding. Triangles of the cup first.
fn cup_and_filling() -> (Vec<[DVec3; 3]>, usize) {
    let point = |radius: f64, corner: usize, height: f64| {
        let (sin, cos) = (std::f64::consts::TAU * corner as f64 / 6.0 + 0.3).sin_cos();
        let (y, lean) = (radius * sin, 0.3_f64);
        let at = [
            radius * cos,
            y * lean.cos() - height * lean.sin(),
            y * lean.sin() + height * lean.cos(),
        ];
        DVec3::from(at.map(|c| f64::from((c + 4096.0) as f32)))
    };
    let mut all: Vec<[DVec3; 3]> = Vec::new();
    for k in 0..6 {
        let n = (k + 1) % 6;
        let quad = |all: &mut Vec<_>, [a, b, c, d]: [DVec3; 4]| all.extend([[a, b, c], [a, c, d]]);
        quad(
            &mut all,
            [
                point(3.0, k, 0.0),
                point(3.0, n, 0.0),
                point(3.0, n, 1.0),
                point(3.0, k, 1.0),
            ],
        );
        quad(
            &mut all,
            [
                point(3.0, k, 1.0),
                point(3.0, n, 1.0),
                point(1.0, n, 1.0),
                point(1.0, k, 1.0),
            ],
        );
        quad(
            &mut all,
            [
                point(1.0, n, 0.6),
                point(1.0, k, 0.6),
                point(1.0, k, 1.0),
                point(1.0, n, 1.0),
            ],
        );
    }
    for k in 1..5 {
        all.push([
            point(3.0, 0, 0.0),
            point(3.0, k + 1, 0.0),
            point(3.0, k, 0.0),
        ]);
        all.push([
            point(1.0, 0, 0.6),
            point(1.0, k, 0.6),
            point(1.0, k + 1, 0.6),
        ]);
    }
    let of_cup = all.len();
    for k in 1..5 {
        all.push([
            point(1.0, 0, 1.0),
            point(1.0, k, 1.0),
            point(1.0, k + 1, 1.0),
        ]);
        all.push([
            point(1.0, 1, 0.6),
            point(1.0, (k + 2) % 6, 0.6),
            point(1.0, k + 1, 0.6),
        ]);
    }
    for k in 0..6 {
        let n = (k + 1) % 6;
        all.push([point(1.0, k, 0.6), point(1.0, n, 0.6), point(1.0, k, 1.0)]);
        all.push([point(1.0, n, 0.6), point(1.0, n, 1.0), point(1.0, k, 1.0)]);
    }
    (all, of_cup)
}

#[test]
fn closed_runs_of_triangles_are_bodies() {
    let (triangles, of_cup) = cup_and_filling();
    let mut stl = vec![b' '; 80];
    stl.extend((triangles.len() as u32).to_le_bytes());
    for corners in &triangles {
        stl.extend([0; 12]);
        let numbers = corners.iter().flat_map(|p| p.to_array());
        numbers.for_each(|c| stl.extend((c as f32).to_le_bytes()));
        stl.extend([0; 2]);
    }
    let folder = Scratch::new("split-order");
    let path = folder.write("inlay.stl", stl);
    let loaded = cutaway_io::load::load_mesh_file(&path).expect("a mesh");
    let whole = &loaded.parts[0];
    assert_eq!(loaded.parts.len(), 1);
    assert!(
        Topology::from_parts(&loaded.parts).non_manifold_edges > 0,
        "they share edges"
    );
    let bodies = Bodies::of(&whole.mesh);
    assert_eq!((bodies.count(), bodies.open()), (2, 0));
    let own = bodies.of_triangles();
    assert!(own[..of_cup].iter().all(|body| *body == 0), "{own:?}");
    assert!(own[of_cup..].iter().all(|body| *body == 1), "{own:?}");
}
