//! Reliefs and cutters cut closed meshes: what is written is closed, and holds the points that the definition keeps.

use cutaway::Scene;
use cutaway::scene::Mesh;
use cutaway_io::document::{Document, cut, part, section};
use cutaway_io::load::Assets;
use glam::DVec3;

use super::*;

/// How often a mesh winds around a point: its solid angle (van Oosterom and Strackee 1983).
fn winding(mesh: &Mesh, point: DVec3) -> f64 {
    let angle = |t: usize| {
        let [a, b, c] = mesh.corners(t).map(|p| p - point);
        let [la, lb, lc] = [a, b, c].map(DVec3::length);
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    (0..mesh.triangles.len()).map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

/// Points without a pattern in a box: the fractions of multiples of irrational numbers.
fn scattered(mesh: &Mesh, count: u32) -> impl Iterator<Item = DVec3> {
    let bounds = mesh.bounds();
    let step = DVec3::new(0.754_877_666, 0.569_840_291, 0.322_185_355);
    (1..=count).map(move |i| bounds.min + bounds.size() * (step * f64::from(i)).fract())
}

fn scene(document: &Document) -> Scene {
    document.resolve(0.0, &mut Assets::default()).unwrap()
}

#[test]
fn what_is_left_holds_the_points_that_are_kept() {
    let mut document = Document::new();
    document.add_part(part("shape:crank")).unwrap();
    let surfaces = [
        section("-z=50%").relief("fractal:amplitude=8%,seed=7"),
        section("x=55%"),
    ];
    document.add_cut(cut(surfaces)).unwrap();
    document
        .add_cut(cut([section("-y=80%").relief("waves:amplitude=3%")]))
        .unwrap();
    let scene = scene(&document);
    let parts = cutaway::slice::capped_with(&scene, 48).unwrap();
    let (whole, part) = (&scene.parts[0].mesh, &parts[0]);
    assert!(part.relief_off > 0.0 && part.relief_off < 0.02 * whole.bounds().radius());
    let halves = [&part.halves.kept.mesh, &part.halves.removed.mesh];
    let volume: f64 = halves.iter().map(|m| m.volume()).sum();
    assert!(
        (volume - whole.volume()).abs() < 1e-9 * whole.volume(),
        "{volume}"
    );
    let [mut left, mut gone] = [0, 0];
    // Of what is left there is little in the box around the whole.
    let points = scattered(whole, 300).chain(scattered(halves[0], 300));
    for point in points {
        let heights = |cut: &cutaway::Cut| {
            cut.surfaces
                .iter()
                .map(|s| s.kept_height(point))
                .fold(f64::NEG_INFINITY, f64::max)
        };
        let kept = scene.cuts.iter().map(heights).fold(f64::INFINITY, f64::min);
        if kept.abs() < 2.0 * part.relief_off {
            continue;
        }
        let is_in = winding(whole, point) > 0.5;
        let expected = [is_in && kept > 0.0, is_in && kept < 0.0];
        for (half, expected) in halves.iter().zip(expected) {
            assert_eq!(
                winding(half, point) > 0.5,
                expected,
                "{point}, kept by {kept}"
            );
        }
        left += usize::from(expected[0]);
        gone += usize::from(expected[1]);
    }
    assert!(
        left > 20 && gone > 20,
        "{left} left, {gone} removed: too few to tell"
    );
    // Caps are by cuts and their surfaces, and each of them has one.
    let caps: Vec<[usize; 2]> = part
        .halves
        .kept
        .caps
        .iter()
        .map(|c| [c.region, c.plane])
        .collect();
    assert_eq!(caps, [[0, 0], [0, 1], [1, 0]]);
    // More cells, nearer to the relief.
    let finer = cutaway::slice::capped_with(&scene, 96).unwrap();
    assert!(finer[0].relief_off < 0.7 * part.relief_off);
}

#[test]
fn a_cutter_takes_its_own_volume_or_leaves_it() {
    let folder = Scratch::new("export-cutters");
    folder.write(
        "ball.toml",
        "[[part]]\nshape = \"cube\"\n\n[[cut]]\nname = \"ball\"\nvolume = \"shape:sphere\"\nscale = 0.3\n",
    );
    let ball = cutaway::generate::shapes::shape("sphere").unwrap()[0]
        .mesh
        .volume()
        * 0.027;
    let cube = cutaway::generate::shapes::shape("cube").unwrap()[0]
        .mesh
        .volume();
    for (options, kept) in [("", cube - ball), ("--set cut.ball.flip=true", ball)] {
        folder
            .run(&format!(
                "export ball.toml {options} -o a.stl --both --json a.json"
            ))
            .exits(0);
        let json: Value =
            serde_json::from_slice(&fs::read(folder.path("a.json")).unwrap()).unwrap();
        let part = &json["parts"][0];
        assert!(
            (number(&part["kept"]["volume"]) - kept).abs() < 1e-12,
            "{options}: {part}"
        );
        let read = facts(&folder, "a.stl");
        assert!(read.closed && read.inconsistent_edges == 0, "{options}");
        assert!((read.volume - kept).abs() < 1e-6, "{options}");
    }
}

#[test]
fn a_part_that_reliefs_cannot_cut_is_named() {
    let folder = Scratch::new("export-open");
    folder.write(
        "open.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n",
    );
    let ran = folder
        .run("export open.obj --section z=30% --relief waves -o half.stl")
        .exits(2);
    for phrase in ["part `open`", "not closed", "help:"] {
        assert!(ran.stderr.contains(phrase), "{}", ran.stderr);
    }
    assert_eq!(folder.files(), ["open.obj"]);
    // Planes cut it as before.
    folder.run("export open.obj --section z=30% -o half.stl");
    assert_eq!(folder.files(), ["half.stl", "open.obj"]);
}

/// Two cubes of size 1 in one mesh, of which the second is moved by (0.5, 0.1, 0.1).
fn two_that_overlap() -> String {
    let faces = [
        [1, 3, 4, 2],
        [5, 6, 8, 7],
        [1, 2, 6, 5],
        [3, 7, 8, 4],
        [1, 5, 7, 3],
        [2, 4, 8, 6],
    ];
    let cube = |first: usize, to: DVec3| {
        let corner =
            |i: usize| to + DVec3::new((i & 1) as f64, ((i >> 1) & 1) as f64, (i >> 2) as f64);
        let vertices =
            (0..8).map(|i| format!("v {} {} {}\n", corner(i).x, corner(i).y, corner(i).z));
        let faces = faces.iter().map(|f| {
            let [a, b, c, d] = f.map(|i| first + i);
            format!("f {a} {b} {c} {d}\n")
        });
        vertices.chain(faces).collect::<String>()
    };
    cube(0, DVec3::ZERO) + &cube(8, DVec3::new(0.5, 0.1, 0.1))
}

#[test]
fn a_relief_cuts_the_solid_that_the_fill_rule_makes_of_bodies_that_overlap() {
    let folder = Scratch::new("export-fill");
    folder.write("two.obj", two_that_overlap());
    let [below, above, both] = [0.55, 0.45, 0.5 * 0.9 * 0.45];
    for (fill, volume) in [
        ("", below + above - 2.0 * both),
        ("--fill even-odd", below + above - 2.0 * both),
        ("--fill nonzero", below + above - both),
    ] {
        let line = format!(
            "export two.obj --section=-z=50% --relief sawtooth:amplitude=1% {fill} -o r.ply"
        );
        folder.run(&line).exits(0);
        let read = read(&folder, "r.ply");
        let facts = Topology::from_parts(&read.parts);
        assert!(
            facts.closed && (facts.volume - volume).abs() < 0.01,
            "{fill}: {} and {volume}",
            facts.volume
        );
        // Points clearly below the relief, far from faces: inside by the rule.
        for (point, crossings) in [
            (DVec3::new(0.25, 0.5, 0.25), 1),
            (DVec3::new(0.75, 0.5, 0.25), 2),
            (DVec3::new(1.25, 0.5, 0.25), 1),
            (DVec3::new(0.75, 0.5, 0.05), 1),
        ] {
            let is_inside = match fill {
                "--fill nonzero" => crossings > 0,
                _ => crossings % 2 == 1,
            };
            let found = winding(&read.parts[0].mesh, point).round();
            assert_eq!(found, f64::from(u8::from(is_inside)), "{fill} at {point}");
        }
    }
}

#[test]
fn planes_leave_bodies_that_overlap_as_manifold_as_they_are() {
    let folder = Scratch::new("export-overlap");
    folder.write("two.obj", two_that_overlap());
    for extension in ["stl", "3mf"] {
        let line = format!("export two.obj --section x=0.75 -o half.{extension} --json -");
        let ran = folder.run(&line).exits(0);
        let said = "bodies of two overlap";
        assert!(ran.stderr.contains(said), "{}", ran.stderr);
        let part = &ran.json()["parts"][0];
        let ran = folder.run("section two.obj --section x=0.75 --json -");
        let section = &ran.exits(0).json()["sections"][0];
        let areas = [&part["section_area"], &section["area"]].map(|a| a.as_f64().unwrap());
        assert!((areas[0] - areas[1]).abs() < 1e-9, "{areas:?}");
        let apart = folder.run(&line.replace("0.75", "0.25")).exits(0);
        assert!(!apart.stderr.contains(said), "{}", apart.stderr);
        let facts = facts(&folder, &format!("half.{extension}"));
        assert_eq!(
            [facts.non_manifold_edges, facts.coincident_faces],
            [0, 0],
            "{extension}"
        );
    }
}
