//! Deformers against closed forms, and against their own derivatives.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use cutaway::scene::{Axis, Bounds, Deformer, Mesh, Part, Topology};
use glam::{DMat3, DVec3};

use super::{Scratch, at};
use crate::common::meshes;
use crate::common::numbers::Numbers;

/// Along y, across z, through a point.
fn upright(centre: DVec3) -> Axis {
    Axis {
        centre,
        along: DVec3::Y,
        across: DVec3::Z,
    }
}

/// A cube of many squares, made a bar from y = 0 to y = `length`.
fn bar(length: f64) -> Mesh {
    let cube = meshes::shape("cube?divisions=24");
    let bounds = cube.bounds();
    let scaled = glam::DAffine3::from_scale(DVec3::new(0.2, length, 0.2));
    meshes::moved(
        &cube,
        scaled * glam::DAffine3::from_translation(-DVec3::Y * bounds.min.y),
    )
}

fn deformed(mesh: Mesh, deformers: Vec<Deformer>) -> Mesh {
    let mut part = Part::new("solid", mesh);
    part.deform(deformers);
    part.posed_mesh().into_owned()
}

#[test]
fn a_twisted_bar_has_its_end_turned() {
    let length = 3.0;
    let rest = bar(length);
    let twist = Deformer::Twist {
        axis: upright(DVec3::ZERO),
        turn_per_unit: FRAC_PI_2 / length,
    };
    let twisted = deformed(rest.clone(), vec![twist]);
    let mut corners = 0;
    for (from, to) in rest.positions.iter().zip(&twisted.positions) {
        if from.y == 0.0 {
            assert_eq!(from, to, "the foot stays");
        } else if from.y >= length {
            // Right-handed about y by a right angle: z goes to x, x to -z.
            let expected = DVec3::new(from.z, from.y, -from.x);
            assert!((*to - expected).length() < 1e-12, "{from} went to {to}");
            corners += usize::from(from.x.abs() + from.z.abs() > 0.199);
        }
    }
    assert_eq!(corners, 4, "corners of the end face");
    let topology = Topology::new(&twisted);
    assert!(topology.closed, "twisted open");
    assert!(
        (topology.volume / rest.volume() - 1.0).abs() < 1e-3,
        "a twist keeps volumes: {}",
        topology.volume
    );
}

#[test]
fn a_bent_bar_keeps_the_length_of_its_middle() {
    let (length, turn) = (3.0, PI);
    let radius = length / turn;
    let bend = Deformer::Bend {
        axis: upright(DVec3::Y * (length * 0.5)),
        turn_per_unit: turn / length,
    };
    let steps = 1000;
    let middle = (0..=steps).map(|i| {
        let h = length * f64::from(i) / f64::from(steps);
        bend.apply(DVec3::Y * h, DVec3::ZERO).0
    });
    let middle: Vec<DVec3> = middle.collect();
    let arc = DVec3::new(0.0, length * 0.5, radius);
    for p in &middle {
        assert!(
            (p.distance(arc) - radius).abs() < 1e-12,
            "{p} is off the arc"
        );
    }
    let run: f64 = middle.windows(2).map(|w| w[0].distance(w[1])).sum();
    assert!((run - length).abs() < 1e-5, "the middle is {run} long");
    // Half a turn: both ends look the same way, a diameter apart.
    let ends = [middle[0], middle[steps as usize]];
    assert!(
        (ends[0].distance(ends[1]) - 2.0 * radius).abs() < 1e-12,
        "{ends:?}"
    );
    assert!(
        (ends[0].z - radius).abs() < 1e-12,
        "the ends lie beside the middle of the arc"
    );

    let bent = deformed(bar(length), vec![bend]);
    let topology = Topology::new(&bent);
    assert!(topology.closed, "bent open");
    // Pappus: the middle of the bar's section is on the neutral line.
    assert!(
        (topology.volume / bar(length).volume() - 1.0).abs() < 1e-2,
        "volume {}",
        topology.volume
    );
}

#[test]
fn a_bend_of_almost_nothing_moves_almost_nothing() {
    let point = DVec3::new(0.3, 0.7, -0.4);
    for turn_per_unit in [0.0, 1e-300, 1e-18, -1e-12, 1e-9] {
        let bend = Deformer::Bend {
            axis: upright(DVec3::ZERO),
            turn_per_unit,
        };
        let (to, _) = bend.apply(point, DVec3::Z);
        // The parabola that the arc begins as.
        let expected =
            point + turn_per_unit * DVec3::new(0.0, -point.y * point.z, point.y * point.y * 0.5);
        assert!((to - expected).length() < 1e-15, "{turn_per_unit}: {to}");
    }
}

#[test]
fn a_wave_is_a_sine() {
    let wave = |phase| Deformer::Wave {
        axis: upright(DVec3::Y),
        amplitude: 0.25,
        period: 2.0,
        phase,
    };
    for (y, phase, dz) in [
        (1.0, 0.0, 0.0),
        (1.5, 0.0, 0.25),
        (2.5, 0.0, -0.25),
        (1.5, FRAC_PI_2, 0.0),
        (2.0, FRAC_PI_2, 0.25),
        (1.25, 0.0, 0.25 * 0.5_f64.sqrt()),
    ] {
        let point = DVec3::new(0.1, y, 0.2);
        let (to, _) = wave(phase).apply(point, DVec3::Z);
        assert!((to - point - DVec3::Z * dz).length() < 1e-12, "y {y}: {to}");
    }
}

#[test]
fn a_ball_inflates_to_a_larger_ball() {
    let ball = meshes::shape("sphere?radius=2&subdivisions=4");
    for by in [0.5, -0.75] {
        let grown = deformed(ball.clone(), vec![Deformer::Inflate { by }]);
        for p in &grown.positions {
            assert!(
                (p.length() - 2.0 - by).abs() < 1e-4,
                "{} from {by}",
                p.length()
            );
        }
        assert!(Topology::new(&grown).closed, "inflated open");
    }
}

/// However the faces of a cube are cut into triangles, its corners go outwards evenly.
#[test]
fn outward_is_weighted_by_angles() {
    let cube = meshes::shape("cube");
    let corner = |outward: DVec3, p: DVec3| outward - p.signum() / 3.0_f64.sqrt();
    for (p, outward) in cube.positions.iter().zip(cube.outward()) {
        assert!(corner(outward, *p).length() < 1e-12, "{outward} at {p}");
    }
    // The negative control: a plain mean of the triangles' normals leans to the faces that are cut there.
    let leaning = cube.positions.iter().enumerate().any(|(i, p)| {
        let around = (0..cube.triangles.len()).filter(|t| cube.triangles[*t].contains(&(i as u32)));
        let normals = around.map(|t| {
            let [a, b, c] = cube.corners(t);
            (b - a).cross(c - a).normalize()
        });
        corner(normals.sum::<DVec3>().normalize(), *p).length() > 0.1
    });
    assert!(leaning, "this cube tells no weights apart");
}

fn unit_vector(numbers: &mut Numbers) -> DVec3 {
    let mut part = || numbers.between(-1.0, 1.0);
    DVec3::new(part(), part(), part()).normalize_or(DVec3::X)
}

fn some_deformer(numbers: &mut Numbers) -> Deformer {
    let along = unit_vector(numbers);
    let axis = Axis {
        centre: unit_vector(numbers) * numbers.between(0.0, 3.0),
        along,
        across: along
            .cross(unit_vector(numbers))
            .normalize_or(along.any_orthonormal_vector()),
    };
    let turn_per_unit = numbers.between(-4.0, 4.0);
    match numbers.below(4) {
        0 => Deformer::Twist {
            axis,
            turn_per_unit,
        },
        1 => Deformer::Bend {
            axis,
            turn_per_unit,
        },
        2 => Deformer::Wave {
            axis,
            amplitude: numbers.between(-1.0, 1.0),
            period: numbers.between(0.2, 4.0),
            phase: numbers.between(-TAU, TAU),
        },
        _ => Deformer::Inflate {
            by: numbers.between(-1.0, 1.0),
        },
    }
}

/// What takes normals where a deformer takes points, from differences.
fn cofactors(deformer: &Deformer, at: DVec3) -> DMat3 {
    let step = 1e-5;
    let column = |axis: DVec3| {
        let side = |s: f64| deformer.apply(at + axis * (s * step), DVec3::ZERO).0;
        (side(1.0) - side(-1.0)) / (2.0 * step)
    };
    let [a, b, c] = DVec3::AXES.map(column);
    DMat3::from_cols(b.cross(c), c.cross(a), a.cross(b))
}

#[test]
fn normals_go_with_the_cofactors() {
    let mut numbers = Numbers(11);
    let mut planted = 0.0_f64;
    for _ in 0..2000 {
        let deformer = some_deformer(&mut numbers);
        let at = unit_vector(&mut numbers) * numbers.between(0.0, 2.0);
        let normal = unit_vector(&mut numbers);
        let (_, to) = deformer.apply(at, normal);
        let by_differences = cofactors(&deformer, at);
        let error = (to - by_differences * normal).length() / (1.0 + to.length());
        assert!(error < 1e-6, "{deformer:?} at {at}: {to}, off by {error}");
        planted = planted.max((normal - by_differences * normal).length());
    }
    assert!(planted > 1.0, "no deformer turned a normal");
}

#[test]
fn bounds_hold_all_that_is_moved() {
    let mut numbers = Numbers(5);
    let mut close = 0;
    for _ in 0..3000 {
        let deformer = some_deformer(&mut numbers);
        let corners = [0; 2].map(|_| unit_vector(&mut numbers) * numbers.between(0.0, 3.0));
        let of = Bounds::from_points(corners);
        let to = deformer.bounds(of);
        let mut reached = Bounds::EMPTY;
        for _ in 0..60 {
            // Corners and edges are where extremes are.
            let mut share = || match numbers.below(4) {
                0 => 0.0,
                1 => 1.0,
                _ => numbers.unit(),
            };
            let p = of.min + of.size() * DVec3::new(share(), share(), share());
            let (q, _) = deformer.apply(p, unit_vector(&mut numbers));
            assert!(
                q.cmpge(to.min).all() && q.cmple(to.max).all(),
                "{deformer:?}: {p} of {of:?} went to {q}, outside of {to:?}"
            );
            reached = reached.union(Bounds::from_points([q]));
        }
        close += usize::from(reached.radius() * 2.5 > to.radius());
    }
    assert!(
        close > 2400,
        "only {close} boxes of 3000 are not far too large"
    );
    assert!(
        Deformer::Inflate { by: 1.0 }
            .bounds(Bounds::EMPTY)
            .is_empty(),
        "nothing stays nothing"
    );
}

#[test]
fn deformers_of_a_scene_file_are_those_it_says() {
    let folder = Scratch::new("deform");
    let text = r#"
[[part]]
name = "bar"
shape = "cube"
scale = [2, 2, 2]
deform = [
  { kind = "twist", axis = "x", turn_deg = 90 },
  { kind = "bend", axis = [0, 2, 0], across = [1, 1, 0], turn_deg = -180, centre = [0, 0.5, 0] },
  { kind = "wave", axis = "-z", amplitude = 0.1, period = "50%", phase_deg = 90 },
  { kind = "inflate", by = "10%" },
]
"#;
    let scene = at(&folder.timeline(text), 0.0);
    let diagonal = 3.0_f64.sqrt();
    let expected = [
        Deformer::Twist {
            axis: Axis {
                centre: DVec3::ZERO,
                along: DVec3::X,
                across: DVec3::Y,
            },
            turn_per_unit: FRAC_PI_2,
        },
        Deformer::Bend {
            axis: Axis {
                centre: DVec3::Y * 0.5,
                along: DVec3::Y,
                across: DVec3::X,
            },
            turn_per_unit: -PI,
        },
        Deformer::Wave {
            axis: Axis {
                centre: DVec3::ZERO,
                along: DVec3::NEG_Z,
                across: DVec3::X,
            },
            amplitude: 0.1,
            period: diagonal * 50.0 / 100.0,
            phase: FRAC_PI_2,
        },
        Deformer::Inflate {
            by: diagonal * 10.0 / 100.0,
        },
    ];
    assert_eq!(scene.parts[0].pose.deformers, expected, "as written");
    let same = scene.posed().parts[0].mesh.positions.clone();
    let rest = &scene.parts[0].mesh.positions;
    assert!(same != *rest, "nothing was deformed");
}

/// Normals for shading stay at right angles to the deformed surface.
#[test]
fn corner_normals_go_with_the_surface() {
    let mut ball = meshes::shape("sphere?radius=1&subdivisions=5");
    let smooth = |t: &[u32; 3]| t.map(|i| ball.positions[i as usize].normalize().as_vec3());
    ball.corner_normals = Some(ball.triangles.iter().map(smooth).collect());
    let bent = deformed(
        ball.clone(),
        vec![
            Deformer::Inflate { by: 0.1 },
            Deformer::Twist {
                axis: upright(DVec3::ZERO),
                turn_per_unit: 0.8,
            },
            Deformer::Bend {
                axis: upright(DVec3::X),
                turn_per_unit: 0.6,
            },
        ],
    );
    let worst = |normals: &[[glam::Vec3; 3]]| {
        let faces = normals.iter().enumerate().map(|(t, corners)| {
            let [a, b, c] = bent.corners(t);
            let face = (b - a).cross(c - a).normalize();
            let off = corners.map(|n| 1.0 - n.as_dvec3().dot(face));
            off.into_iter().fold(0.0, f64::max)
        });
        faces.fold(0.0, f64::max)
    };
    let carried = bent.corner_normals.as_ref().expect("normals");
    assert!(worst(carried) < 0.01, "off by {}", worst(carried));
    let rest = ball.corner_normals.as_ref().expect("normals");
    assert!(worst(rest) > 0.1, "the planted fault: normals at rest");
}
