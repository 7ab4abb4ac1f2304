//! Axes of real meshes, beside those of another library.

use cutaway::scene::MainAxes;

use super::*;

/// Angle between two lines, in degrees.
fn apart_deg(a: DVec3, b: DVec3) -> f64 {
    a.dot(b).abs().min(1.0).acos().to_degrees()
}

fn eigen(matrix: nalgebra::Matrix3<f64>) -> Vec<(f64, DVec3)> {
    let found = nalgebra::SymmetricEigen::new(matrix);
    let mut all: Vec<(f64, DVec3)> = (0..3)
        .map(|i| {
            let v = found.eigenvectors.column(i);
            (found.eigenvalues[i], DVec3::new(v[0], v[1], v[2]))
        })
        .collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all
}

/// Covariance of points.
fn covariance(points: &[DVec3]) -> nalgebra::Matrix3<f64> {
    let mean = points.iter().sum::<DVec3>() / points.len() as f64;
    let mut sum = nalgebra::Matrix3::zeros();
    for point in points {
        let d = nalgebra::Vector3::from((*point - mean).to_array());
        sum += d * d.transpose();
    }
    sum / points.len() as f64
}

#[test]
fn the_axis_of_gears_is_that_of_their_hull_and_not_of_their_vertices() {
    for file in real::files(&["assembly"]) {
        if !file.ends_with("cube_gears.glb") {
            continue;
        }
        let scene = real::cut(&file, None);
        let points: Vec<DVec3> = (scene.parts.iter())
            .flat_map(|p| {
                let place = p.world_from_part;
                p.mesh
                    .positions
                    .iter()
                    .map(move |v| place.transform_point3(*v))
                    .collect::<Vec<_>>()
            })
            .collect();
        let axes = MainAxes::of(&points).expect("a solid");
        let by_vertices = eigen(covariance(&points))[0].1;
        let apart = apart_deg(axes.axes[0], by_vertices);
        println!(
            "cube_gears: vertices are {apart:.1} degrees off, spreads {:?}",
            axes.spreads
        );
        assert!(apart > 10.0, "vertices would do: {apart}");
    }
}

#[test]
fn eigenvalues_are_those_of_another_library() {
    // Points on the surface of a hull, as dense everywhere: what the integral is the limit of.
    let size = DVec3::new(2.0, 1.3, 0.4);
    let turn = glam::DMat3::from_rotation_y(0.5) * glam::DMat3::from_rotation_z(1.1);
    let n = 400;
    let mut points = Vec::new();
    for axis in 0..3 {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let count = |i: usize| (f64::from(n) * size[i]).round() as u32;
        for (i, j) in (0..count(a)).flat_map(|i| (0..count(b)).map(move |j| (i, j))) {
            for side in [-0.5, 0.5] {
                let mut p = DVec3::ZERO;
                p[axis] = side * size[axis];
                p[a] = ((f64::from(i) + 0.5) / f64::from(count(a)) - 0.5) * size[a];
                p[b] = ((f64::from(j) + 0.5) / f64::from(count(b)) - 0.5) * size[b];
                points.push(turn * p);
            }
        }
    }
    let theirs = eigen(covariance(&points));
    let corners: Vec<DVec3> = (0..8)
        .map(|i| {
            turn * ((DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)) - 0.5)
                * size)
        })
        .collect();
    let ours = MainAxes::of(&corners).expect("a solid");
    for (i, theirs) in theirs.into_iter().enumerate() {
        assert!(
            (ours.spreads[i] - theirs.0).abs() < 1e-5,
            "{} and {}",
            ours.spreads[i],
            theirs.0
        );
        assert!(apart_deg(ours.axes[i], theirs.1) < 1e-4, "axis {i}");
    }
}

#[test]
fn axes_turn_with_what_they_are_of() {
    let points: Vec<DVec3> = (0..200)
        .map(|i| {
            let at = |k: f64| (f64::from(i) * k).fract() - 0.5;
            DVec3::new(at(0.618_034) * 3.0, at(0.414_214) * 1.5, at(0.732_051))
        })
        .collect();
    let own = MainAxes::of(&points).expect("a solid");
    for turn in (1..8).map(|i| {
        glam::DQuat::from_rotation_y(f64::from(i))
            * glam::DQuat::from_rotation_x(f64::from(i) * 1.7)
    }) {
        let turned: Vec<DVec3> = points.iter().map(|p| turn * *p).collect();
        let other = MainAxes::of(&turned).expect("a solid");
        for i in 0..3 {
            assert!(
                (own.spreads[i] - other.spreads[i]).abs() < 1e-6,
                "spread {i}"
            );
            assert!(
                apart_deg(turn * own.axes[i], other.axes[i]) < 1e-4,
                "axis {i}"
            );
        }
        // Points within the hull, as a finer mesh has them, change nothing.
        let middles = turned.windows(2).map(|pair| (pair[0] + pair[1]) / 2.0);
        let finer: Vec<DVec3> = turned.iter().copied().chain(middles).collect();
        let finer = MainAxes::of(&finer).expect("a solid");
        for i in 0..3 {
            assert!(
                (finer.spreads[i] - other.spreads[i]).abs() < 1e-6,
                "spread {i}"
            );
        }
    }
}
