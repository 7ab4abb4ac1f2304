//! Comparison of hand-made frames whose every wrong pixel is known.

use cutaway::layers::{Kind, Layer, Layers};
use cutaway::scene::{Bounds, Camera, Projection, View};
use cutaway_lab::compare::{Class, Comparison, compare, heatmap, legend};
use cutaway_lab::exact::Exact;
use glam::{DVec3, Vec3};

const SIZE: [u32; 2] = [16, 12];

fn view() -> View {
    let camera = Camera {
        projection: Projection::Orthographic { height: Some(6.0) },
        ..Camera::default()
    };
    let bounds = Bounds {
        min: DVec3::splat(-0.5),
        max: DVec3::splat(0.5),
    };
    camera.view(|p| p, 1.0, bounds, SIZE)
}

fn layer(kind: Kind, part: u16) -> Layer {
    Layer {
        kind,
        part,
        depth: 2.0,
        normal: Vec3::Z,
        ..Layer::default()
    }
}

/// Columns 0..4 background, 4..10 a cap of part 1 by surface 3, 10..16 a surface of part 0.
fn truth() -> Exact {
    let mut layers = Layers::background(SIZE);
    for (i, pixel) in layers.pixels.iter_mut().enumerate() {
        match i as u32 % SIZE[0] {
            0..4 => {}
            4..10 => {
                *pixel = Layer {
                    clip_surface: 3,
                    ..layer(Kind::Cap, 1)
                }
            }
            _ => *pixel = layer(Kind::Surface, 0),
        }
    }
    let count = layers.pixels.len();
    Exact {
        layers,
        undecided: vec![false; count],
        depth_open: vec![false; count],
        overlap_open: vec![false; count],
        odd_parity: vec![false; count],
    }
}

fn with(x: u32, y: u32, change: impl FnOnce(&mut Layer)) -> Layers {
    let mut layers = truth().layers;
    change(&mut layers.pixels[(y * SIZE[0] + x) as usize]);
    layers
}

fn compared(layers: &Layers) -> Comparison {
    compare(&truth(), layers, &view(), 0.5)
}

#[test]
fn a_frame_equals_itself() {
    let same = compared(&truth().layers);
    assert_eq!(same, Comparison::default(), "nothing is wrong");
    assert_eq!(same.wrong_px(), 0, "nothing is wrong");
}

#[test]
fn each_class_counts_its_own() {
    let background = Layer {
        depth: f64::INFINITY,
        ..Layer::default()
    };
    let one = Comparison {
        interior_wrong_px: 1,
        decided_wrong_px: 1,
        unmarked_wrong_px: 1,
        ..Comparison::default()
    };
    let cases: [(&str, Layers, Comparison); 9] = [
        (
            "cap drawn as a surface",
            with(7, 5, |l| *l = layer(Kind::Surface, 1)),
            Comparison {
                missed_cap_px: 1,
                ..one
            },
        ),
        (
            "cap drawn as background",
            with(7, 5, |l| *l = background),
            Comparison {
                missed_cap_px: 1,
                crack_px: 1,
                ..one
            },
        ),
        (
            "cap drawn as the inside of the shell",
            with(7, 5, |l| {
                *l = Layer {
                    back_face: true,
                    ..layer(Kind::Surface, 1)
                }
            }),
            Comparison {
                missed_cap_px: 1,
                crack_px: 1,
                ..one
            },
        ),
        (
            "cap over background",
            with(1, 5, |l| *l = layer(Kind::Cap, 1)),
            Comparison {
                leaked_cap_px: 1,
                ..one
            },
        ),
        (
            "cap over a surface",
            with(13, 5, |l| *l = layer(Kind::Cap, 0)),
            Comparison {
                leaked_cap_px: 1,
                ..one
            },
        ),
        (
            "cap of another part",
            with(7, 5, |l| l.part = 0),
            Comparison {
                wrong_part_px: 1,
                ..one
            },
        ),
        (
            "cap by another clip-surface",
            with(7, 5, |l| l.clip_surface = 4),
            Comparison {
                wrong_part_px: 1,
                ..one
            },
        ),
        (
            "inner side of the right part",
            with(13, 5, |l| l.back_face = true),
            Comparison { crack_px: 1, ..one },
        ),
        (
            "surface over background",
            with(1, 5, |l| *l = layer(Kind::Surface, 0)),
            one,
        ),
    ];
    for (name, layers, expected) in cases {
        assert_eq!(compared(&layers), expected, "{name}");
    }
}

#[test]
fn an_outline_that_moved_is_no_crack_and_a_back_face_always_is_one() {
    // The background of exact ends with column 3.
    let sky = |x| with(x, 5, |l| *l = Layer::default());
    for (x, cracks) in [(4, 0), (5, 1), (6, 1), (15, 1)] {
        let found = compared(&sky(x));
        let seen = [found.crack_px, found.outline_px];
        assert_eq!(seen, [cracks, 1 - cracks], "background in column {x}");
        assert_eq!(found.wrong_px(), 1, "wrong all the same in column {x}");
        let back = compared(&with(x, 5, |l| {
            *l = Layer {
                back_face: true,
                ..layer(Kind::Surface, 0)
            }
        }));
        assert_eq!(back.crack_px, 1, "a back face in column {x}");
    }
    // What moved by two pixels shows as holes.
    let mut moved = truth().layers;
    for (i, pixel) in moved.pixels.iter_mut().enumerate() {
        if (4..6).contains(&(i as u32 % SIZE[0])) {
            *pixel = Layer::default();
        }
    }
    let found = compared(&moved);
    assert_eq!(
        (found.crack_px, found.missed_cap_px),
        (12, 24),
        "two columns of 12 pixels"
    );
}

#[test]
fn the_clip_surface_of_what_is_no_cap_is_nobodys_business() {
    let layers = with(13, 5, |l| l.clip_surface = 9);
    assert_eq!(compared(&layers).wrong_px(), 0, "only caps have one");
}

#[test]
fn edges_reach_one_pixel_from_a_boundary() {
    // The boundaries lie between columns 3 and 4 and between 9 and 10.
    for (x, edge) in [
        (0, 0),
        (2, 0),
        (3, 1),
        (4, 1),
        (5, 0),
        (9, 1),
        (10, 1),
        (11, 0),
        (15, 0),
    ] {
        let layers = with(x, 0, |l| {
            l.kind = if l.kind == Kind::Cap {
                Kind::Surface
            } else {
                Kind::Cap
            }
        });
        let found = compared(&layers);
        assert_eq!(
            (found.edge_wrong_px, found.interior_wrong_px),
            (edge, 1 - edge),
            "column {x}"
        );
    }
}

#[test]
fn undecided_pixels_are_wrong_but_not_decided() {
    let layers = with(7, 5, |l| {
        l.part = 0;
        l.depth = 9.0;
    });
    let mut exact = truth();
    exact.undecided[5 * 16 + 7] = true;
    let found = compare(&exact, &layers, &view(), 0.5);
    assert_eq!(
        (found.interior_wrong_px, found.decided_wrong_px),
        (1, 0),
        "wrong, but excused"
    );
    let deep = with(7, 5, |l| l.depth = 9.0);
    assert!(compared(&deep).depth_error_max > 1.0, "where it is decided");
    for mask in [false, true] {
        let mut exact = truth();
        exact.undecided[5 * 16 + 7] = mask;
        exact.depth_open[5 * 16 + 7] = !mask;
        let found = compare(&exact, &deep, &view(), 0.5);
        assert_eq!(found.depth_error_max, 0.0, "both answers are right");
    }
    let found = compare(&exact, &deep, &view(), 0.5);
    assert_eq!(
        found.depth_error_max, 0.0,
        "a jump in depth where both answers are right"
    );
}

#[test]
fn errors_are_in_world_units_pixels_and_degrees() {
    let tilt = 0.001f32;
    let layers = with(7, 5, |l| {
        l.depth += 0.25;
        l.normal = Vec3::new(tilt.sin(), 0.0, tilt.cos());
    });
    let found = compared(&layers);
    assert_eq!(found.wrong_px(), 0, "the answer itself is right");
    // Scale 0.5: scene space is half as large. The picture is 6 units and 12 px high.
    assert!((found.depth_error_max - 0.5).abs() < 1e-12, "{found:?}");
    assert!((found.depth_error_px_max - 0.5).abs() < 1e-12, "{found:?}");
    let covered = 12.0 * 12.0;
    assert!(
        (found.depth_error_mean - 0.5 / covered).abs() < 1e-12,
        "{found:?}"
    );
    let angle = f64::from(tilt).to_degrees();
    assert!(
        (found.normal_error_deg_max - angle).abs() < 1e-5,
        "{found:?}"
    );
    assert!(
        (found.normal_error_deg_mean - angle / 72.0).abs() < 1e-6,
        "{found:?}"
    );
    // Normals of surfaces are no business of a capping strategy.
    let surface = with(13, 5, |l| l.normal = Vec3::X);
    assert_eq!(compared(&surface), Comparison::default(), "no cap");
}

#[test]
fn broken_numbers_show() {
    let depth = compared(&with(7, 5, |l| l.depth = f64::NAN));
    assert!(
        depth.depth_error_max == f64::MAX,
        "a NaN depth must not vanish"
    );
    let normal = compared(&with(7, 5, |l| l.normal = Vec3::NAN));
    assert!(
        !normal.normal_error_deg_max.is_nan(),
        "a NaN normal must not poison the mean"
    );
    assert!(
        normal.normal_error_deg_max > 1.0,
        "a NaN normal must not vanish"
    );
}

#[test]
fn unreliable_pixels_are_counted_and_excuse_nothing() {
    let layers = with(7, 5, |l| {
        l.unreliable = true;
        l.part = 0;
    });
    let found = compared(&layers);
    assert_eq!(
        (
            found.odd_parity_px,
            found.decided_wrong_px,
            found.unmarked_wrong_px
        ),
        (1, 1, 0),
        "{found:?}"
    );
}

#[test]
fn json_has_the_fields_of_the_command() {
    let json = serde_json::to_value(compared(&truth().layers)).unwrap();
    for field in [
        "missed_cap_px",
        "leaked_cap_px",
        "wrong_part_px",
        "crack_px",
        "outline_px",
        "interior_wrong_px",
        "edge_wrong_px",
        "decided_wrong_px",
        "unmarked_wrong_px",
        "odd_parity_px",
        "depth_error_max",
        "depth_error_mean",
        "normal_error_deg_max",
        "normal_error_deg_mean",
    ] {
        assert!(
            json.get(field).is_some_and(serde_json::Value::is_number),
            "{field} is missing"
        );
    }
}

#[test]
fn the_heat_map_shows_single_pixels_with_a_ring() {
    let rgb = |class| legend().iter().find(|e| e.class == class).unwrap().rgb;
    let clean = heatmap(&truth(), &truth().layers);
    let is_grey = |p: &image::Rgba<u8>| p[0] == p[1] && p[1] == p[2];
    assert!(clean.pixels().all(is_grey), "nothing to colour");
    let layers = with(7, 5, |l| *l = layer(Kind::Surface, 1));
    let picture = heatmap(&truth(), &layers);
    assert_eq!(
        picture.get_pixel(7, 5).0[..3],
        rgb(Class::MissedCap),
        "the pixel itself"
    );
    let ring = picture
        .enumerate_pixels()
        .filter(|(_, _, p)| !is_grey(p))
        .count();
    assert_eq!(ring, 9, "a ring of one pixel");
    let mut exact = truth();
    exact.undecided[0] = true;
    let picture = heatmap(&exact, &truth().layers);
    assert_eq!(
        picture.get_pixel(0, 0).0[..3],
        rgb(Class::Undecided),
        "undecided"
    );
    let coloured = picture.pixels().filter(|p| !is_grey(p)).count();
    assert_eq!(coloured, 1, "what is not wrong gets no ring");
}

#[test]
fn classes_have_colours_of_their_own() {
    let entries = legend();
    for (i, a) in entries.iter().enumerate() {
        for b in &entries[i + 1..] {
            let apart: u32 = (0..3).map(|c| u32::from(a.rgb[c].abs_diff(b.rgb[c]))).sum();
            assert!(apart > 60, "{} and {} look alike", a.name, b.name);
        }
    }
}
