//! Pixels: what exact, `raycast+mask` and `stencil` show, outside of what is undecided.

use cutaway::layers::Kind;
use cutaway::scene::{Camera, ClipSurface, Cut, Fill, Mesh, Part, Role, Scene};
use cutaway::session::Outcome;
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};
use glam::{DAffine3, DVec3};

use super::common::shares::{Share, in_shares};
use super::common::{Judged, Question, class_of, meshes, scenes};
use super::decided_differing;

const SIZE: [u32; 2] = [160, 120];

fn section(scene: &Scene, text: &str) -> ClipSurface {
    ClipSurface::parse(text, &scene.bounds()).expect(text)
}

/// Cuts of one name each.
fn cuts(scene: &Scene, sections: &[&[&str]]) -> Vec<Cut> {
    let surfaces = |words: &&[&str]| words.iter().map(|w| section(scene, w)).collect();
    let named = |(i, words): (usize, &&[&str])| Cut::new(format!("cut {i}"), surfaces(words));
    sections.iter().enumerate().map(named).collect()
}

/// Gives a scene its cuts, and what parts they need.
type Way = (&'static str, fn(&mut Scene));

/// Ways to cut by planes.
fn ways() -> Vec<Way> {
    vec![
        ("one oblique", |s| {
            s.cuts = cuts(s, &[&["-1,-2,-1.5@50%,45%,60%"]]);
        }),
        ("along an axis", |s| s.cuts = cuts(s, &[&["-z=50%"]])),
        ("a box", |s| {
            let planes = ["-x=70%", "x=30%", "-y=80%", "y=40%", "-z=90%", "z=20%"];
            // What is inside of all six stays; the removed sides unite.
            s.cuts = planes.iter().flat_map(|p| cuts(s, &[&[*p]])).collect();
        }),
        ("a bite", |s| {
            s.cuts = cuts(
                s,
                &[&["-1,0.1,0.05@45%,50%,50%", "0,-1,-0.2@50%,45%,50%", "-z=35%"]],
            );
        }),
        ("two wedges", |s| {
            s.cuts = cuts(
                s,
                &[
                    &["-1,0.1,-0.2@55%,50%,50%", "-0.2,-1,0.3@50%,60%,50%"],
                    &["-0.4,0.2,-1@50%,50%,70%"],
                ],
            );
        }),
        ("solids that overlap", |s| {
            companion(s, |ball| ball.priority = Some(-1));
            s.parts[0].priority = Some(5);
        }),
        ("a filter and an interior part", |s| {
            companion(s, |_| ());
            s.cuts[0].except = vec!["b?ll*".to_owned()];
            companion(s, |ball| ball.role = Role::Interior);
        }),
        ("nonzero among even-odd", |s| {
            companion(s, |ball| ball.fill = Fill::Nonzero);
            s.parts[0].fill = Fill::Nonzero;
        }),
    ]
}

/// Adds a ball that shares space with the rest, and an oblique cut.
fn companion(scene: &mut Scene, change: impl FnOnce(&mut Part)) {
    let bounds = scene.bounds();
    let mut ball = Part::new("ball", meshes::shape("sphere?subdivisions=3"));
    ball.world_from_part = DAffine3::from_translation(bounds.centre() + bounds.size() * 0.06)
        * DAffine3::from_scale(bounds.size() * 0.6);
    change(&mut ball);
    scene.parts.push(ball);
    scene.cuts = cuts(scene, &[&["-0.3,-0.5,-1@50%,50%,52%"]]);
}

fn corpus() -> impl Iterator<Item = (String, Scene)> {
    meshes::SHAPES.into_iter().flat_map(|shape| {
        ways().into_iter().flat_map(move |(way, apply)| {
            [false, true].map(|orthographic| {
                let mut scene = scenes::of_parts(shape, meshes::parts(shape), Vec::new());
                apply(&mut scene);
                scene.camera = scenes::orbit(35.0, 25.0, orthographic);
                (format!("{shape}, {way}, parallel {orthographic}"), scene)
            })
        })
    })
}

/// Pixels that show something else.
fn other_class(a: &cutaway::layers::Layer, b: &cutaway::layers::Layer) -> bool {
    class_of(a) != class_of(b)
}

/// What a frame should be and is not: against exact, and against the frame of another strategy.
fn fault(found: &Judged, other: &Judged) -> Option<String> {
    let differing = decided_differing(found, other, other_class);
    // Caps have the depth of the list and the normal of the plane, bit for bit, whoever says where they are.
    let elsewhere = decided_differing(found, other, |a, b| {
        let both = [a, b].iter().all(|l| l.kind == Kind::Cap);
        both && (a.depth != b.depth || a.normal != b.normal || a.overlap != b.overlap)
    });
    let differs = (differing + elsewhere > 0)
        .then(|| format!("{differing} classes and {elsewhere} caps differ"));
    found.fault_of_exact().or(differs)
}

in_shares!(
    it_agrees_with_exact_and_with_the_mask_wherever_planes_cut,
    4
);

fn it_agrees_with_exact_and_with_the_mask_wherever_planes_cut(share: Share) {
    let mut faults = Vec::new();
    let (mut caps, mut asked) = (0, 0);
    for (name, scene) in share.part(corpus()) {
        let question = Question::new(&scene, SIZE);
        caps += question.exact.layers.count(Kind::Cap);
        asked += 1;
        let mask = question.answer(Strategy::RAYCAST_MASK);
        for rasteriser in [Rasteriser::Hardware, Rasteriser::Compute] {
            let found = question.answer(Method::new(Strategy::PLANAR, DrawOptions::by(rasteriser)));
            if let Some(fault) = fault(&found, &mask) {
                faults.push(format!("{name}, {rasteriser}: {fault}"));
            }
        }
        let classic = question.answer(Strategy::STENCIL);
        if classic.outcome == Outcome::Complete {
            let found = question.answer(Strategy::PLANAR);
            let differing = decided_differing(&found, &classic, other_class);
            if differing > 0 {
                faults.push(format!("{name}: {differing} differ from stencil"));
            }
        }
    }
    let lines = faults.join("\n");
    assert!(faults.is_empty(), "{} faults:\n{lines}", faults.len());
    assert_eq!(asked, share.exactly(11 * 8 * 2), "scenes");
    assert!(caps > asked * 200, "{caps} cap pixels ask too little");
}

#[test]
fn a_section_by_another_plane_is_found_out() {
    let mut scene = scenes::sectioned("torus?segments=40&sides=20", &["-0.3,-0.5,-1@50%,50%,52%"]);
    let question = Question::new(&scene, SIZE);
    assert_eq!(question.answer(Strategy::PLANAR).fault_of_exact(), None);
    // A hundredth of a radius away: the rim of the cap moves by about half a pixel.
    scene.cuts[0].surfaces[0].origin.z += 0.02;
    let moved = Question {
        exact: question.exact.clone(),
        ..Question::new(&scene, SIZE)
    };
    let judged = moved.answer(Strategy::PLANAR);
    assert!(judged.comparison.decided_wrong_px > 10, "a planted fault");
    let whole = question.answer(Strategy::PLANAR);
    assert!(
        decided_differing(&whole, &judged, other_class) > 10,
        "another frame"
    );
}

#[test]
fn planes_may_begin_far_away() {
    for (origin, normal) in [
        (DVec3::new(1e9, -1e9, 0.0625), DVec3::NEG_Z),
        (DVec3::new(1e15, 1e15, 0.0625), DVec3::NEG_Z),
        (DVec3::new(1e6, -1e6, 1e6), DVec3::new(-1.0, -1.0, 0.0)),
    ] {
        for shape in ["torus?segments=40&sides=20", "gears?flank=2"] {
            let plane = ClipSurface::plane(origin, normal);
            let mut scene = scenes::of_parts(shape, meshes::parts(shape), vec![plane]);
            scene.camera = scenes::orbit(35.0, 25.0, false);
            let question = Question::new(&scene, SIZE);
            assert!(question.exact.layers.count(Kind::Cap) > 200, "{shape}");
            let mask = question.answer(Strategy::RAYCAST_MASK);
            let found = question.answer(Strategy::PLANAR);
            assert_eq!(fault(&found, &mask), None, "{shape} from {origin}");
        }
    }
}

#[test]
fn shells_in_shells_are_told_apart_by_priority() {
    for (outer, inner) in [(None, None), (Some(3), Some(1)), (Some(1), Some(3))] {
        let mut parts = Vec::new();
        for (i, (radius, priority)) in [(1.0, outer), (0.7, inner), (0.4, None)]
            .into_iter()
            .enumerate()
        {
            let mut ball = Part::new(
                format!("ball {i}"),
                meshes::moved(
                    &meshes::shape("sphere?subdivisions=3"),
                    DAffine3::from_scale(DVec3::splat(radius)),
                ),
            );
            ball.priority = priority;
            parts.push(ball);
        }
        let plane = ClipSurface::plane(DVec3::Z * 0.05, DVec3::new(-0.1, -0.3, -1.0));
        let scene = scenes::of_parts("shells", parts, vec![plane]);
        let question = Question::new(&scene, [256, 192]);
        let judged = question.answer(Strategy::PLANAR);
        assert_eq!(judged.fault_of_exact(), None, "{outer:?}, {inner:?}");
        let shown = |part: u16| {
            let pixels = judged.layers.pixels.iter();
            pixels
                .filter(|p| p.kind == Kind::Cap && p.part == part)
                .count()
        };
        // Without priorities the smaller is shown in the larger.
        let hidden = usize::from(outer > inner);
        assert_eq!(shown(1) == 0, hidden == 1, "{outer:?}, {inner:?}");
        assert!(shown(0) > 500, "{outer:?}, {inner:?}");
    }
}

#[test]
fn an_open_mesh_is_capped_as_far_as_it_closes_and_its_doubt_is_marked() {
    let plane = ClipSurface::plane(DVec3::Z * 0.05, DVec3::new(-0.2, -0.3, -1.0));
    let whole = meshes::shape("sphere?subdivisions=3");
    let without = |gone: &dyn Fn(DVec3) -> bool| {
        let kept = whole.triangles.iter().enumerate();
        let kept = kept.filter(|(t, _)| {
            let [a, b, c] = whole.corners(*t);
            !gone((a + b + c) / 3.0)
        });
        Mesh {
            triangles: kept.map(|(_, t)| *t).collect(),
            ..whole.clone()
        }
    };
    let judged = |mesh: Mesh| {
        let scene = scenes::scene("open", mesh, vec![plane.clone()]);
        Question::new(&scene, [256, 192]).answer(Strategy::PLANAR)
    };
    let caps = |j: &Judged| j.layers.count(Kind::Cap);
    let marked = |j: &Judged| j.layers.pixels.iter().filter(|p| p.unreliable).count();
    let closed = judged(whole.clone());
    assert_eq!(marked(&closed), 0, "nothing is doubtful");
    // A hole that the plane does not meet is no matter: the section is whole, and so is the cap.
    let below = judged(without(&|p| p.z < -0.45));
    assert_eq!(caps(&below), caps(&closed), "a hole beside the plane");
    assert_eq!(marked(&below), 0, "a hole beside the plane");
    // One that it meets leaves the outline open, and no cap.
    let across = judged(without(&|p| p.x > 0.4));
    assert_eq!(caps(&across), 0, "an outline that does not close");
    let missed = |i: &usize| closed.layers.pixels[*i].kind == Kind::Cap;
    let mut all = (0..closed.layers.pixels.len()).filter(missed);
    assert!(
        all.all(|i| across.layers.pixels[i].unreliable),
        "the cap that is not there is marked"
    );
    // Another solid of the same mesh closes, and has its cap.
    let ball = meshes::moved(&whole, DAffine3::from_translation(DVec3::Y * 1.25));
    let two = judged(meshes::joined(&[without(&|p| p.x > 0.4), ball]));
    assert!(caps(&two) > 500, "{} cap pixels", caps(&two));
}

#[test]
fn a_near_plane_in_the_solid_is_no_matter_where_it_has_no_cap() {
    let camera = Camera {
        near_cap: false,
        ..scenes::looking(DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.3, -0.1, -1.0), 60.0)
    };
    let plane = ClipSurface::plane(DVec3::Z * -0.2, DVec3::new(-0.2, -0.3, -1.0));
    let mut scene = scenes::scene(
        "inside",
        meshes::shape("sphere?subdivisions=3"),
        vec![plane],
    );
    scene.camera = camera;
    let question = Question::new(&scene, [128, 96]);
    assert!(
        question.exact.layers.count(Kind::Cap) > 1000,
        "it asks something"
    );
    let judged = question.answer(Strategy::PLANAR);
    assert_eq!(judged.fault_of_exact(), None, "the eye in what is removed");
}
