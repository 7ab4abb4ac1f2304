//! Hard cases 2, 3 and 49 as pixels: planes in faces, edges and vertices; stars, touching loops, islands in holes.

use cutaway::layers::Kind;
use cutaway::scene::{ClipSurface, Mesh, Scene};
use cutaway::strategies::Strategy;
use glam::{DVec2, DVec3};

use super::common::shares::{Share, in_shares};
use super::common::{Question, class_of, meshes, scenes};
use super::decided_differing;

/// Asks `planar`, holds it against exact and the mask, and gives back how many cap pixels there are.
fn asked(scene: &Scene, size: [u32; 2], what: &str) -> usize {
    let question = Question::new(scene, size);
    let judged = question.answer(Strategy::PLANAR);
    assert_eq!(judged.fault_of_exact(), None, "{what}");
    let mask = question.answer(Strategy::RAYCAST_MASK);
    let differing = decided_differing(&judged, &mask, |a, b| class_of(a) != class_of(b));
    assert_eq!(differing, 0, "{what}");
    judged.layers.count(Kind::Cap)
}

in_shares!(planes_in_faces_through_edges_vertices_and_diagonals, 2);

fn planes_in_faces_through_edges_vertices_and_diagonals(share: Share) {
    let through = [
        DVec3::Z,
        DVec3::X,
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::new(1.0, -1.0, 0.0),
        DVec3::new(1.0, 1.0, 1.0),
        DVec3::new(-1.0, 1.0, 1.0),
    ];
    // None looks along a face: there the depth of a snapped face differs by more than the tie, for every strategy alike.
    let from = [
        DVec3::new(1.5, 1.4, 1.9),
        DVec3::new(-1.6, 1.3, -1.7),
        DVec3::new(1.9, -1.5, 1.4),
    ];
    let mut caps = 0;
    for shape in ["cube", "cube?divisions=4", "sponge?level=1"] {
        for normal in share.part(through) {
            // In faces, through edges, vertices or the centre, by the direction of the normal.
            for at in [-0.5, 0.0, 0.5] {
                for sign in [-1.0, 1.0] {
                    let origin = normal.signum() * at * normal.abs().min(DVec3::ONE);
                    let plane = ClipSurface::plane(origin, normal * sign);
                    let mut scene = scenes::scene(shape, meshes::shape(shape), vec![plane]);
                    for eye in from {
                        scene.camera = scenes::looking(eye, DVec3::ZERO, 40.0);
                        let what = format!("{shape}, {normal} at {at}, side {sign}, from {eye}");
                        caps += asked(&scene, [64; 2], &what);
                    }
                }
            }
        }
    }
    assert!(
        caps > share.least(20_000),
        "{caps} cap pixels ask too little"
    );
}

/// A prism over closed curves: walls alone, capped by nothing but the planes far above and below that a cut never meets.
fn walls(curves: &[Vec<DVec2>]) -> Mesh {
    let mut mesh = Mesh::default();
    for curve in curves {
        let first = mesh.positions.len() as u32;
        let count = curve.len() as u32;
        for z in [-1.0, 1.0] {
            mesh.positions.extend(curve.iter().map(|p| p.extend(z)));
        }
        // Roofs to a point: every edge has two faces, whatever the curve does.
        let tips = [-1.2, 1.2].map(|z| {
            let middle = curve.iter().sum::<DVec2>() / f64::from(count);
            mesh.positions.push(middle.extend(z));
            mesh.positions.len() as u32 - 1
        });
        for i in 0..count {
            let [a, b] = [first + i, first + (i + 1) % count];
            let [c, d] = [a + count, b + count];
            mesh.triangles.extend([[a, b, d], [a, d, c]]);
            mesh.triangles.extend([[b, a, tips[0]], [c, d, tips[1]]]);
        }
    }
    mesh
}

fn ring(count: u32, step: u32, radius: impl Fn(u32) -> f64, centre: DVec2) -> Vec<DVec2> {
    (0..count)
        .map(|i| {
            let turn = std::f64::consts::TAU * f64::from(i * step % count) / f64::from(count);
            centre + DVec2::from_angle(turn) * radius(i)
        })
        .collect()
}

#[test]
fn stars_touching_loops_and_islands_in_holes() {
    let square = |half: f64, x: f64| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(u, v)| DVec2::new(x + u * half, v * half))
            .to_vec()
    };
    let cases: [(&str, Vec<Vec<DVec2>>); 7] = [
        (
            "a star of spikes",
            vec![ring(
                40,
                1,
                |i| if i % 2 == 0 { 0.9 } else { 0.2 },
                DVec2::ZERO,
            )],
        ),
        ("a pentagram", vec![ring(5, 2, |_| 0.9, DVec2::ZERO)]),
        ("a star of eleven", vec![ring(11, 5, |_| 0.9, DVec2::ZERO)]),
        (
            "squares that touch in a corner",
            vec![square(0.3, -0.3), {
                square(0.3, 0.3)
                    .iter()
                    .map(|p| *p + DVec2::Y * 0.6)
                    .collect()
            }],
        ),
        (
            "squares that share an edge",
            vec![square(0.3, -0.3), square(0.3, 0.3)],
        ),
        (
            "islands in holes",
            (1..6)
                .map(|i| ring(60, 1, |_| 0.17 * f64::from(i), DVec2::ZERO))
                .collect(),
        ),
        (
            "rings that overlap",
            vec![
                ring(50, 1, |_| 0.6, DVec2::new(-0.3, 0.0)),
                ring(50, 1, |_| 0.6, DVec2::new(0.3, 0.1)),
                ring(50, 1, |_| 0.6, DVec2::new(0.0, -0.3)),
            ],
        ),
    ];
    for (name, curves) in cases {
        let plane = ClipSurface::plane(DVec3::Z * 0.03, DVec3::new(0.05, -0.1, -1.0));
        let mut scene = scenes::scene(name, walls(&curves), vec![plane]);
        for camera in [
            scenes::looking(DVec3::new(0.4, 0.7, 4.0), DVec3::ZERO, 40.0),
            scenes::parallel(DVec3::new(-0.6, 0.3, 3.0), DVec3::ZERO, 2.4),
        ] {
            scene.camera = camera;
            let caps = asked(&scene, [128; 2], name);
            assert!(caps > 500, "{name}: {caps} cap pixels");
        }
    }
}

#[test]
fn a_loop_of_a_hundred_thousand_points() {
    let count = 100_000;
    let spiky = ring(
        count,
        1,
        |i| if i % 2 == 0 { 0.9 } else { 0.88 },
        DVec2::ZERO,
    );
    let plane = ClipSurface::plane(DVec3::Z * 0.03, DVec3::NEG_Z);
    let mut scene = scenes::scene("spiky", walls(&[spiky]), vec![plane]);
    scene.camera = scenes::looking(DVec3::new(0.4, 0.7, 4.0), DVec3::ZERO, 40.0);
    let question = Question::new(&scene, [128; 2]);
    let judged = question.answer(Strategy::PLANAR);
    // Spikes are thinner than the snapping of corners to 1/256 px: along the rim anything may be hit.
    let rim = |i: usize| {
        let at = DVec2::new((i % 128) as f64 + 0.5, (i / 128) as f64 + 0.5);
        let (origin, direction) = question.view.ray(at);
        let plane = &question.model.prepared.surfaces[0];
        let depth =
            (plane.origin - origin).dot(plane.frame.normal) / direction.dot(plane.frame.normal);
        let p = (origin + direction * depth) / question.model.prepared.scale
            + question.model.prepared.centre_in_world;
        (0.85..0.93).contains(&p.truncate().length())
    };
    let wrong = judged.decided_wrong().filter(|i| !rim(*i)).count();
    assert_eq!(wrong, 0, "inside the rim");
    assert!(judged.layers.count(Kind::Cap) > 3000, "a cap");
}
