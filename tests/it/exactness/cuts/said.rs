//! What short forms, offsets and switches stand for.

use cutaway::scene::{ClipSurface, Prepared, Scene};
use glam::DVec3;

use super::{Scratch, of_shape, seen};

fn of_cut(cut: &str) -> String {
    of_shape("cube", [5, 4, 3], 2.0, cut)
}

#[test]
fn a_box_is_its_six_planes() {
    let folder = Scratch::new("six");
    let short = "box = { min = [-0.1, -0.2, 0], max = [0.6, 0.3, 1] }";
    let long = "surfaces = [{ section = \"-x=-0.1\" }, { section = \"x=0.6\" }, { section = \"-y=-0.2\" }, \
                { section = \"y=0.3\" }, { section = \"-z=0\" }, { section = \"z=1\" }]";
    let [short, long] = [short, long].map(|cut| folder.scene(&of_cut(cut)));
    let [a, b] = [&short, &long].map(|s| seen(s, [90, 70]));
    assert_eq!(a.layers, b.layers);
    // The control: a box with one face elsewhere.
    let other = folder.scene(&of_cut(
        "box = { min = [-0.1, -0.2, 0.05], max = [0.6, 0.3, 1] }",
    ));
    assert!(seen(&other, [90, 70]).layers != a.layers);
}

#[test]
fn a_wide_wedge_is_two_cuts_of_one_name() {
    let folder = Scratch::new("wide");
    let scene = folder.scene(&of_cut(
        "wedge = { axis = \"z\", from_deg = 0, to_deg = 270, min = -0.2 }\nsurfaces = [{ section = \"-x=0.4\" }]\n\
         except = [\"no*\"]\noffset = { solid = 0.1 }",
    ));
    let names: Vec<&str> = scene.cuts.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["front", "front"]);
    for cut in &scene.cuts {
        assert_eq!(
            cut.surfaces.len(),
            3,
            "a face of the wedge, its end, and the plane"
        );
        assert_eq!(cut.except, ["no*"]);
        assert_eq!(cut.offsets.len(), 1);
    }
    // It is what its complement of a quarter leaves alone.
    let quarter = folder.scene(&of_cut(
        "wedge = { axis = \"z\", from_deg = 270, to_deg = 360 }",
    ));
    let three = folder.scene(&of_cut(
        "wedge = { axis = \"z\", from_deg = 0, to_deg = 270 }",
    ));
    let removes = |scene: &Scene, p: DVec3| {
        let inside = |s: &ClipSurface| s.kept_height(p) < 0.0;
        (scene.cuts.iter()).any(|c| c.surfaces.iter().all(inside))
    };
    for i in 0..500 {
        let p = DVec3::new(0.754_877, 0.569_84, 0.43) * f64::from(i);
        let p = p.fract() - 0.5;
        assert_ne!(removes(&quarter, p), removes(&three, p), "{p}");
    }
}

#[test]
fn half_a_turn_keeps_the_relief_of_either_face() {
    let folder = Scratch::new("half");
    let relief = "[relief.rough]\nkind = \"waves\"\nsize = 8\n";
    let scene = |to_deg: f64, rest: &str| {
        let cut = format!("wedge = {{ axis = \"z\", from_deg = 0, to_deg = {to_deg}{rest} }}");
        folder.scene(&(relief.to_owned() + &of_cut(&cut)))
    };
    let ragged = ", relief = \"rough\", amplitude = \"10%\", faces = [\"to\"]";
    assert_eq!(scene(180.0, "").cuts[0].surfaces.len(), 1, "one plane");
    let half = scene(180.0, ragged);
    let has_relief = half.cuts[0].surfaces.iter().map(|s| s.relief.is_some());
    assert_eq!(has_relief.collect::<Vec<_>>(), [false, true]);
    let removed = |scene: &Scene| -> Vec<bool> {
        let points = (0..4000).map(|i| {
            let p = DVec3::new(0.754_877, 0.569_84, 0.43) * f64::from(i);
            (p.fract() - 0.5) * DVec3::new(1.0, 0.2, 1.0)
        });
        let inside = |p: DVec3| {
            let below = |s: &ClipSurface| s.kept_height(p) < 0.0;
            (scene.cuts.iter()).any(|c| c.surfaces.iter().all(below))
        };
        points.map(inside).collect()
    };
    let differing = |a: &Scene, b: &Scene| {
        let pairs = removed(a).into_iter().zip(removed(b));
        pairs.filter(|(a, b)| a != b).count()
    };
    // It opens without a jump; the control is the relief that is not there.
    assert!(differing(&half, &scene(179.9999, ragged)) < 5);
    assert!(differing(&half, &scene(180.0, "")) > 100);
}

#[test]
fn reliefs_stand_on_the_faces_that_are_named() {
    let folder = Scratch::new("faces");
    let relief = "[relief.rough]\nkind = \"waves\"\nsize = 8\n";
    let ruffled = |cut: &str| -> Vec<bool> {
        let scene = folder.scene(&(relief.to_owned() + &of_cut(cut)));
        let surfaces = scene.cuts.iter().flat_map(|c| &c.surfaces);
        surfaces.map(|s| s.relief.is_some()).collect()
    };
    let with = |faces: &str| {
        format!(
            "wedge = {{ axis = \"z\", from_deg = 0, to_deg = 90, min = -0.3, relief = \"rough\"{faces} }}"
        )
    };
    assert_eq!(ruffled(&with("")), [true; 3]);
    assert_eq!(ruffled(&with(", faces = [\"to\"]")), [false, true, false]);
    assert_eq!(
        ruffled(&with(", faces = [\"min\", \"from\"]")),
        [true, false, true]
    );
    let block = "box = { min = [0, 0, 0], relief = \"rough\", period = 0.2, faces = [\"-y\"] }";
    assert_eq!(ruffled(block), [false, true, false]);
    let smooth =
        "box = { min = [0, 0, 0] }\nsurfaces = [{ section = \"z=0.2\", relief = \"rough\" }]";
    assert_eq!(ruffled(smooth), [true, false, false, false]);
}

#[test]
fn parts_with_equal_offsets_share_a_cut_and_numbers_stay() {
    let folder = Scratch::new("share");
    let text = |offset: &str| {
        format!(
            "[[part]]\nshape = \"earth?subdivisions=1\"\n[[part]]\nname = \"cube\"\nshape = \"cube\"\n\
             [[cut]]\nname = \"a\"\nsurfaces = [{{ section = \"z=0\" }}, {{ section = \"x=0\" }}]\n{offset}\n\
             [[cut]]\nname = \"b\"\nsurfaces = [{{ section = \"y=0\" }}]\n"
        )
    };
    let of = |offset: &str| Prepared::new(&folder.scene(&text(offset)));
    let plain = of("");
    assert_eq!((plain.cuts.len(), plain.surfaces.len()), (2, 3));
    let offset = of("offset = { mantle = 0.1, cube = 0.1, \"c*t\" = \"2%\" }");
    assert_eq!((offset.cuts.len(), offset.surfaces.len()), (4, 3 + 2 * 2));
    // Those of the scene come first, with the numbers that they have without offsets.
    for (a, b) in plain.surfaces.iter().zip(&offset.surfaces) {
        assert_eq!((a.origin, a.cut), (b.origin, b.cut));
    }
    let cuts_of = |name: &str| {
        let part = offset.parts.iter().find(|p| p.name == name);
        part.expect("a part of this name").cuts.clone()
    };
    assert_eq!(cuts_of("core"), [0, 1]);
    assert_eq!(cuts_of("mantle"), cuts_of("cube"), "equal offsets");
    let own: Vec<(&str, usize, bool)> = ["mantle", "crust"]
        .map(|name| {
            let cut = &offset.cuts[cuts_of(name)[0]];
            (cut.name.as_str(), cut.of, cut.keeps == 0.1)
        })
        .to_vec();
    assert_eq!(own, [("a", 0, true), ("a", 0, false)]);
    assert_eq!(cuts_of("mantle")[1], 1, "the other cut has no offset");
    // z = 0 and x = 0 keep the positive sides: 0.1 more of them.
    let moved = &offset.surfaces[offset.cuts[cuts_of("mantle")[0]].surfaces[0]];
    let at = moved.origin / offset.scale + offset.centre_in_world;
    assert!((at.z + 0.1).abs() < 1e-6, "moved to {at}");
}

#[test]
fn a_cut_without_an_inside_is_off_and_keeps_its_numbers() {
    let folder = Scratch::new("inside");
    for (cut, surfaces) in [
        ("wedge = { axis = \"z\", from_deg = 20, to_deg = 20 }", 2),
        (
            "wedge = { axis = \"z\", from_deg = 0, to_deg = 90, min = 0.1, max = 0.1 }",
            4,
        ),
        ("box = { centre = [0, 0, 0], size = [1, 0, 1] }", 6),
        ("enabled = false\nsurfaces = [{ section = \"z=0\" }]", 1),
    ] {
        let scene = folder.scene(&of_cut(cut));
        assert!(!scene.cuts[0].enabled, "{cut}");
        let prepared = Prepared::new(&scene);
        assert_eq!(prepared.surfaces.len(), surfaces, "{cut}");
        assert_eq!(prepared.parts[0].cuts, [0; 0], "{cut}");
    }
    let on = folder.scene(&of_cut(
        "enabled = true\nsurfaces = [{ section = \"z=0\" }]",
    ));
    assert_eq!(Prepared::new(&on).parts[0].cuts, [0], "the control");
}
