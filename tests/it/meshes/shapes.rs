//! Built-in shapes are closed, consistently oriented, and have the volumes, areas and genera of their closed forms.

use std::f64::consts::{PI, TAU};

use cutaway::generate::shapes::{SHAPES, shape};
use cutaway::scene::Mesh;
use glam::DVec3;

/// Vertices - edges + faces of a closed surface on which every edge is passed once in either direction; else what is
/// wrong. No shape here needs the weaker rule that lets four faces share an edge.
fn euler(mesh: &Mesh) -> Result<i64, String> {
    if let Some(defect) = mesh.defect() {
        return Err(defect.to_string());
    }
    let mut directed: Vec<(u32, u32)> = Vec::with_capacity(mesh.triangles.len() * 3);
    for [a, b, c] in &mesh.triangles {
        if a == b || b == c || c == a {
            return Err(format!("triangle {a} {b} {c} is degenerate"));
        }
        directed.extend([(*a, *b), (*b, *c), (*c, *a)]);
    }
    directed.sort_unstable();
    if let Some(twice) = directed.windows(2).find(|w| w[0] == w[1]) {
        return Err(format!("edge {:?} is passed twice", twice[0]));
    }
    let open = |(a, b): &&(u32, u32)| directed.binary_search(&(*b, *a)).is_err();
    if let Some(edge) = directed.iter().find(open) {
        return Err(format!("edge {edge:?} has no partner"));
    }
    let mut used: Vec<u32> = mesh.triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    if used.len() != mesh.positions.len() {
        return Err("some positions belong to no triangle".into());
    }
    Ok(used.len() as i64 - directed.len() as i64 / 2 + mesh.triangles.len() as i64)
}

/// How many of some random chords through a mesh enter it where they are inside already, or leave it outside.
fn wrong_chords(mesh: &Mesh) -> usize {
    let bounds = mesh.bounds();
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut point = || bounds.min + bounds.size() * DVec3::from_array([(); 3].map(|()| random()));
    (0..100)
        .filter(|_| {
            let (origin, towards) = (point(), point());
            let along = towards - origin;
            let mut crossings: Vec<(f64, bool)> = (0..mesh.triangles.len())
                .filter_map(|t| {
                    let [a, b, c] = mesh.corners(t).map(|p| p - origin);
                    let sides = [b.cross(a), c.cross(b), a.cross(c)].map(|n| n.dot(along) > 0.0);
                    let normal = (b - a).cross(c - a);
                    let hit = sides == [true; 3] || sides == [false; 3];
                    hit.then(|| (normal.dot(a) / normal.dot(along), normal.dot(along) < 0.0))
                })
                .collect();
            crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
            let entries = crossings.iter().map(|(_, enters)| *enters);
            !crossings.len().is_multiple_of(2)
                || entries
                    .enumerate()
                    .any(|(i, enters)| enters != i.is_multiple_of(2))
        })
        .count()
}

fn only(spec: &str) -> Mesh {
    let parts = shape(spec).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(parts.len(), 1, "{spec} has several parts");
    (*parts[0].mesh).clone()
}

fn assert_relative(what: &str, measured: f64, expected: f64, tolerance: f64) {
    let error = measured / expected - 1.0;
    assert!(
        error.abs() <= tolerance,
        "{what}: {measured} instead of {expected}, off by {error:e}"
    );
}

/// Errors at doubled fineness must fall by four; `spec` gets the fineness 1, 2, 4.
fn assert_second_order(
    what: &str,
    expected: f64,
    measure: impl Fn(&Mesh) -> f64,
    spec: impl Fn(usize) -> String,
) {
    let errors = [1, 2, 4].map(|k| (measure(&only(&spec(k))) / expected - 1.0).abs());
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((3.6..4.4).contains(&ratio), "{what}: errors {errors:?}");
    }
    assert!(errors[2] < 0.01, "{what}: errors {errors:?}");
}

/// Area of a regular polygon with corners on the unit circle, and its circumference.
fn regular(corners: f64) -> (f64, f64) {
    (
        0.5 * corners * (TAU / corners).sin(),
        2.0 * corners * (PI / corners).sin(),
    )
}

#[test]
fn every_part_is_closed_oriented_and_of_the_right_genus() {
    // Euler characteristic of each part: 2 for a ball, 0 for a ring, 2 - 2g in general.
    for (spec, expected) in [
        ("cube", vec![2]),
        ("cube?divisions=5&size=3", vec![2]),
        ("sphere?subdivisions=0", vec![2]),
        ("sphere", vec![2]),
        ("torus", vec![0]),
        ("torus?segments=3&sides=3", vec![0]),
        ("knot", vec![0]),
        ("knot?p=3&q=4&tube=0.06", vec![0]),
        ("knot?p=1&q=1", vec![0]),
        ("conduit", vec![0]),
        ("conduit?angle=250&segments=3&sides=3&leg=0.1", vec![0]),
        ("gears", vec![0, 0]),
        ("gears?wheel=60&pinion=17&flank=1", vec![0, 0]),
        ("earth?subdivisions=3", vec![2, 2, 2]),
        ("shells?subdivisions=3", vec![4]),
        ("shells?subdivisions=3&flip_inner=0", vec![4]),
        ("sponge?level=0", vec![2]),
        ("sponge?level=1", vec![2 - 2 * 5]),
        ("sponge", vec![2 - 2 * 81]),
        ("sponge?level=3", vec![2 - 2 * 1409]),
        ("comb", vec![2]),
        ("comb?teeth=1", vec![2]),
        ("slivers", vec![2]),
        ("conduit?inside=2", vec![0, 2, 2]),
        ("column", vec![2]),
        ("column?flutes=5&detail=2", vec![2]),
        ("house", vec![2; 7]),
        // Four bores, and a jacket around four liners; then head, case and crank, three parts for each cylinder, and ten bolts.
        ("engine", of_engine()),
        ("engine?detail=16", of_engine()),
        // Bores through each pin, each main journal, and six bolt holes.
        ("crank", vec![2 - 2 * (4 + 5 + 6)]),
        ("crank?detail=16", vec![2 - 2 * (4 + 5 + 6)]),
        ("crank?throws=1&detail=41", vec![2 - 2 * (1 + 2 + 6)]),
        ("crank?throws=6&detail=23", vec![2 - 2 * (6 + 7 + 6)]),
        ("crank?throws=5&detail=200", vec![2 - 2 * (5 + 6 + 6)]),
    ] {
        let parts = shape(spec).unwrap();
        let found: Vec<_> = parts.iter().map(|p| euler(&p.mesh)).collect();
        let expected: Vec<_> = expected.into_iter().map(Ok).collect();
        assert_eq!(found, expected, "{spec}");
        for part in parts {
            assert!(part.mesh.volume() > 0.0, "{spec}: {}", part.name);
        }
    }
}

fn of_engine() -> Vec<i64> {
    let solids = [2 - 2 * 4 + 2 - 2 * 4, 2, 2, 2 - 2 * (4 + 5 + 6)];
    let cylinders = [2 - 2 * 2, 2, 2].repeat(4);
    [&solids[..], &cylinders, &[2; 10]].concat()
}

#[test]
fn no_part_overlaps_itself() {
    for spec in [
        "engine?detail=24",
        "column",
        "house",
        "crank",
        "crank?detail=16",
        "crank?throws=3&detail=50",
        "gears",
        "knot",
        "knot?p=3&q=5&tube=0.05",
        "conduit?angle=250&segments=3&leg=0.1",
        "conduit?angle=300&leg=0.05",
        "sponge",
        "comb",
        "shells",
    ] {
        for part in shape(spec).unwrap() {
            assert_eq!(wrong_chords(&part.mesh), 0, "{spec}: {}", part.name);
        }
    }
    let overlapping = wrong_chords(&only("shells?flip_inner=0"));
    assert!(overlapping > 10, "control: {overlapping} of 100 chords");
}

#[test]
fn every_shape_of_the_list_can_be_asked_for() {
    for info in SHAPES {
        let parts = shape(&format!("shape:{}", info.name)).unwrap();
        let again = shape(info.name).unwrap();
        for (a, b) in parts.iter().zip(&again) {
            assert_eq!(a.mesh, b.mesh, "{} is not deterministic", info.name);
        }
        for p in info.parameters {
            assert!(
                (p.min..=p.max).contains(&p.default),
                "{}: default of {}",
                info.name,
                p.name
            );
        }
    }
}

#[test]
fn a_missing_or_flipped_triangle_is_noticed() {
    let whole = only("torus?segments=8&sides=6");
    assert_eq!(euler(&whole), Ok(0), "the control itself");
    let mut missing = whole.clone();
    missing.triangles.remove(17);
    assert!(
        euler(&missing).is_err(),
        "a missing triangle went unnoticed"
    );
    let mut flipped = whole.clone();
    flipped.triangles[17].swap(0, 1);
    assert!(
        euler(&flipped).is_err(),
        "a flipped triangle went unnoticed"
    );
    let mut split = whole;
    let corner = split.triangles[17][0];
    split.positions.push(split.positions[corner as usize]);
    split.triangles[17][0] = split.positions.len() as u32 - 1;
    assert!(euler(&split).is_err(), "a split vertex went unnoticed");
}

#[test]
fn polyhedra_have_their_volumes_and_areas_exactly() {
    let exact = 1e-12;
    let cube = only("cube?size=1.5&divisions=6");
    assert_relative("cube", cube.volume(), 1.5_f64.powi(3), exact);
    assert_relative("cube's area", cube.area(), 6.0 * 1.5 * 1.5, exact);

    for level in 0..=3 {
        let sponge = only(&format!("sponge?level={level}"));
        let volume = (20.0_f64 / 27.0).powi(level);
        let area = 2.0 * (20.0_f64 / 9.0).powi(level) + 4.0 * (8.0_f64 / 9.0).powi(level);
        assert_relative("sponge", sponge.volume(), volume, exact);
        assert_relative("sponge's area", sponge.area(), area, exact);
    }

    let comb = only("comb?teeth=7&fill=0.25&length=2&height=1&depth=3&spine=0.2");
    let plate = 0.25 * 2.0 / 6.25;
    let profile = 2.0 * 0.2 + 7.0 * plate * 0.8;
    assert_relative("comb", comb.volume(), profile * 3.0, exact);
    let around = 2.0 * 2.0 + 2.0 * 0.2 + 14.0 * 0.8;
    let area = 2.0 * profile + around * 3.0;
    assert_relative("comb's area", comb.area(), area, exact);

    let (n, r, h) = (1000.0, 0.5, 0.25);
    let (disc, _) = regular(n);
    let slivers = only("slivers?needles=1000&radius=0.5&height=0.5");
    let volume = 2.0 / 3.0 * disc * r * r * h;
    assert_relative("slivers", slivers.volume(), volume, exact);

    // Trapezoids between half planes through the axis: see the header of the tubes.
    let (m, n): (f64, f64) = (24.0, 17.0);
    let (disc, rim) = regular(n);
    let torus = only("torus?major=2&minor=0.5&segments=24&sides=17");
    let volume = m * (TAU / m).sin() * 2.0 * disc * 0.25;
    assert_relative("torus", torus.volume(), volume, exact);

    let conduit = only("conduit?bend=2&angle=120&leg=0.7&outer=0.5&inner=0.3&segments=24&sides=17");
    let turn = TAU / 3.0;
    let section = disc * (0.25 - 0.09);
    let volume = section * (m * (turn / m).sin() * 2.0 + 1.4);
    assert_relative("conduit", conduit.volume(), volume, exact);
    let straight = only("conduit?bend=2&angle=1&leg=5&outer=0.5&inner=0.3&segments=1&sides=17");
    let legs = rim * (0.5 + 0.3) * 10.0 + 2.0 * section;
    // The bend itself is a degree long; its walls are those of a straight piece to second order.
    let bend = rim * 0.8 * 2.0 * 1_f64.to_radians();
    assert_relative("conduit's area", straight.area(), legs + bend, 1e-4);
}

#[test]
fn round_shapes_converge_with_second_order() {
    let (volume, area) = (Mesh::volume, Mesh::area);
    let ball = |k: usize| format!("sphere?radius=2&subdivisions={}", 2 + k.ilog2());
    assert_second_order("ball", 32.0 / 3.0 * PI, volume, ball);
    assert_second_order("sphere", 16.0 * PI, area, ball);

    let torus = |k| {
        format!(
            "torus?major=2&minor=0.5&segments={}&sides={}",
            48 * k,
            24 * k
        )
    };
    assert_second_order("solid torus", 2.0 * PI * PI * 2.0 * 0.25, volume, torus);
    assert_second_order("torus", 4.0 * PI * PI * 2.0 * 0.5, area, torus);

    let pipe = |k| format!("conduit?segments={}&sides={}", 12 * k, 24 * k);
    let length = 0.5 * PI * 0.5 + 0.8;
    let section = PI * (0.04 - 0.0225);
    assert_second_order("conduit", section * length, volume, pipe);
    let walls = TAU * 0.35 * length + 2.0 * section;
    assert_second_order("conduit's area", walls, area, pipe);

    // Pappus: a tube around a curve through the middle of its sections.
    for (p, q, tube) in [(2.0, 3.0, 0.1), (3.0, 5.0, 0.05)] {
        let length = torus_knot_length(p, q, 0.5, 0.25);
        let knot = |k| {
            let (segments, sides) = (240 * k, 16 * k);
            format!("knot?p={p}&q={q}&tube={tube}&segments={segments}&sides={sides}")
        };
        assert_second_order("knot", PI * tube * tube * length, volume, knot);
        assert_second_order("knot's area", TAU * tube * length, area, knot);
    }
}

/// Speed of the curve, integrated over the period, where the trapezoidal rule converges faster than any power.
fn torus_knot_length(p: f64, q: f64, major: f64, minor: f64) -> f64 {
    let n = 4000;
    let speed = |t: f64| {
        let out = major + minor * (q * t).cos();
        (p * p * out * out + q * q * minor * minor).sqrt()
    };
    (0..n)
        .map(|i| speed(TAU * f64::from(i) / f64::from(n)))
        .sum::<f64>()
        * TAU
        / f64::from(n)
}

#[test]
fn shells_are_hollow_by_orientation_or_by_parity() {
    let ball = |r: f64| only(&format!("sphere?radius={r}")).volume();
    let flipped = only("shells").volume();
    assert_relative("shells", flipped, ball(0.5) - ball(0.3), 1e-12);
    let unflipped = only("shells?flip_inner=0").volume();
    assert_relative("both outward", unflipped, ball(0.5) + ball(0.3), 1e-12);
}

#[test]
fn the_layers_of_the_earth_are_nested_balls_the_smaller_first() {
    let earth = shape("earth").unwrap();
    let names: Vec<_> = earth.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["core", "mantle", "crust"]);
    for pair in earth.windows(2) {
        assert!(
            pair[0].mesh.volume() < pair[1].mesh.volume() && pair[0].priority.is_none(),
            "{} is ranked by size alone",
            pair[0].name
        );
    }
}

#[test]
fn the_default_crank_has_a_hundred_thousand_faces() {
    let crank = only("crank");
    let faces = crank.triangles.len();
    assert!((99_900..=100_100).contains(&faces), "{faces} faces");
    let size = crank.bounds().size();
    assert!((2.0..3.0).contains(&size.x), "length {}", size.x);
    // Counterweights of both throws reach 0.4 beyond the axis, twice over.
    assert_relative("height", size.y, 0.8, 1e-3);
}

#[test]
fn bad_specs_are_refused_by_name() {
    for (spec, culprit, help) in [
        ("cubee", "shape:cubee", "did you mean `cube`"),
        ("shape:", "shape:", "use one of"),
        ("cube?sise=2", "cube?sise", "did you mean `size`"),
        ("cube?size", "cube?size", "=value"),
        ("cube?size=0", "cube?size=0", "from"),
        ("cube?size=NaN", "cube?size=NaN", "from"),
        ("cube?size=inf", "cube?size=inf", "from"),
        ("cube?size=1,5", "cube?size=1,5", "number"),
        ("cube?divisions=2.5", "cube?divisions=2.5", "whole"),
        ("cube?size=1&size=2", "cube?size=2", "keep one"),
        ("sphere?subdivisions=40", "sphere?subdivisions=40", "0 to 9"),
        (
            "torus?segments=90000&sides=90000",
            "segments=90000",
            "20 million",
        ),
        ("crank?throws=12&detail=1600", "detail=1600", "20 million"),
        ("torus?minor=0.6", "minor=0.6", "minor < major"),
        ("knot?p=2&q=4", "p=2&q=4", "common divisor"),
        ("knot?tube=0.3", "tube=0.3", "intersect itself"),
        ("conduit?inner=0.3", "inner=0.3", "inner < outer"),
        ("conduit?angle=300&leg=2", "leg=2", "shorten"),
        ("conduit?angle=250&segments=2", "segments=2", "120"),
        ("knot?segments=40", "segments=40", "16 segments"),
        ("earth?core=0.9", "core=0.9", "core < mantle"),
        ("shells?inner=0.5", "inner=0.5", "inner < radius"),
    ] {
        let message = match shape(spec) {
            Ok(_) => panic!("{spec} was accepted"),
            Err(error) => error.to_string(),
        };
        assert!(
            message.contains(culprit) && message.contains(help),
            "{spec}: {message}"
        );
    }
}
