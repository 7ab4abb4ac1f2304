//! What *undecided* promises: no decided pixel changes when the scene moves by what a rasteriser may move it.

use cutaway::layers::Kind;
use cutaway::scene::{ClipSurface, Fill, Precision, Prepared, Role, Scene, View};
use cutaway_lab::exact::{Exact, Truth, evaluate};
use glam::{DVec3, dvec3};

use crate::exactness::exact::solids::{
    ball, cuboid, fractal, joined, mapped, noise, orbit, parallel, relief, scene, unit_cube,
};

fn scenes() -> Vec<(&'static str, Scene)> {
    let plane = ClipSurface::plane(dvec3(0.0, 0.0, 0.1), dvec3(0.2, 0.1, -1.0));
    let ragged = || relief(0.1, 0.9, 0.3, fractal(64, 5));
    let pin = || cuboid(dvec3(-0.15, -0.15, -0.9), dvec3(0.15, 0.15, 0.9));
    let comb = || {
        (0..8).fold(
            cuboid(dvec3(-0.9, -0.9, -0.9), dvec3(0.9, -0.7, 0.9)),
            |m, i| {
                let x = -0.85 + 0.22 * f64::from(i);
                joined(m, cuboid(dvec3(x, -0.7, -0.9), dvec3(x + 0.1, 0.7, 0.9)))
            },
        )
    };
    // A part that is not cut, and crosses the cap of one that is.
    let mut spared = scene(
        vec![ball(1.0, 60, 80), ball(0.5, 30, 40)],
        vec![vec![plane.clone()]],
        orbit(20.0, 50.0),
    );
    spared.parts[1].role = Role::Interior;
    // Each triangle twice: what moves one moves both.
    let mut twice = ball(1.0, 60, 80);
    twice.triangles.extend(twice.triangles.clone());
    let mut doubled = scene(vec![twice], vec![vec![plane.clone()]], orbit(30.0, 40.0));
    doubled.parts[0].fill = Fill::Nonzero;
    vec![
        ("spared", spared),
        ("doubled", doubled),
        (
            "ball",
            scene(
                vec![ball(1.0, 60, 80)],
                vec![vec![plane.clone()]],
                orbit(30.0, 40.0),
            ),
        ),
        (
            "ragged",
            scene(
                vec![ball(1.0, 60, 80), pin()],
                vec![vec![ragged()]],
                orbit(30.0, 50.0),
            ),
        ),
        (
            "grazing",
            scene(
                vec![unit_cube(), pin()],
                vec![vec![ragged()]],
                orbit(50.0, 4.0),
            ),
        ),
        (
            "notch",
            scene(
                vec![unit_cube(), pin()],
                vec![vec![
                    ragged(),
                    ClipSurface::plane(DVec3::ZERO, DVec3::NEG_X),
                ]],
                orbit(50.0, 30.0),
            ),
        ),
        (
            "comb",
            scene(vec![comb()], vec![vec![plane]], orbit(25.0, 30.0)),
        ),
        (
            "parallel",
            scene(
                vec![mapped(unit_cube(), |p| p * 1.3), ball(0.7, 30, 40)],
                vec![vec![ragged()]],
                parallel(dvec3(1.0, 2.0, 3.0), DVec3::ZERO, 2.6),
            ),
        ),
    ]
}

/// Moves each vertex in the picture by up to `px` along each axis.
fn jittered(prepared: &Prepared, view: &View, px: f64, seed: u64) -> Prepared {
    let mut random = noise(seed);
    let mut moved = prepared.clone();
    for part in &mut moved.parts {
        for p in std::sync::Arc::make_mut(&mut part.positions) {
            let at = p.as_dvec3();
            let pixel = view.pixel_size((at - view.eye).dot(view.forward)) * px;
            let mut step = || (2.0 * random() - 1.0) * pixel;
            *p = (at + view.right * step() + view.up * step()).as_vec3();
        }
    }
    moved
}

fn changed(a: &Exact, b: &Exact) -> (usize, usize) {
    let label = |e: &Exact, i: usize| {
        let l = &e.layers.pixels[i];
        (l.kind, l.part, l.clip_surface)
    };
    let differ = |i: &usize| label(a, *i) != label(b, *i);
    let all: Vec<usize> = (0..a.layers.pixels.len()).filter(differ).collect();
    (all.iter().filter(|i| !a.undecided[**i]).count(), all.len())
}

#[test]
fn decided_pixels_survive_the_rounding_of_a_rasteriser() {
    let (mut decided, mut all, mut too_far) = (0, 0, 0);
    for (name, scene) in scenes() {
        let prepared = Prepared::new(&scene);
        let view = prepared.view([256, 256]);
        let exact = evaluate(&prepared, &view);
        for seed in 0..8 {
            let moved = evaluate(&jittered(&prepared, &view, 1.0 / 512.0, seed), &view);
            let (d, a) = changed(&exact, &moved);
            println!("{name} {seed}: {a} px changed, {d} of them decided");
            decided += d;
            all += a;
        }
        // Control: eight times as far is not promised.
        let far = evaluate(&jittered(&prepared, &view, 8.0 / 512.0, 1), &view);
        too_far += changed(&exact, &far).0;
    }
    assert_eq!(decided, 0, "of {all} changed pixels some were decided");
    assert!(
        too_far > 0,
        "eight times as far decided pixels must change: else the jitter does nothing"
    );
    assert!(all > 20, "only {all} pixels changed: the test has no teeth");
}

fn precision(sub_pixel_bits: u32) -> Precision {
    Precision {
        sub_pixel_bits,
        ..Precision::USUAL
    }
}

#[test]
fn decided_pixels_survive_the_rounding_of_a_coarse_rasteriser() {
    for bits in [4, 6] {
        let (mut decided, mut by_usual) = (0, 0);
        for (name, scene) in scenes() {
            let prepared = Prepared::new(&scene);
            let usual = prepared.view([192, 192]);
            let truth = Truth::new(&prepared, usual);
            let exact = truth.at(precision(bits));
            assert_eq!(exact.layers, truth.layers, "{name}: bits change no layer");
            assert!(exact.undecided_px() > truth.undecided_px(), "{name}");
            for seed in 0..4 {
                let half_step = 0.5 / f64::from(1_u32 << bits);
                let moved = evaluate(&jittered(&prepared, &usual, half_step, seed), &usual);
                decided += changed(&exact, &moved).0;
                by_usual += changed(&truth, &moved).0;
            }
        }
        assert_eq!(decided, 0, "{bits} bits");
        assert!(by_usual > 0, "{bits} bits: the usual band is too narrow");
    }
}

#[test]
fn more_bits_than_usual_leave_as_much_undecided() {
    let (_, scene) = scenes().remove(0);
    let prepared = Prepared::new(&scene);
    let view = prepared.view([64, 64]);
    let truth = Truth::new(&prepared, view);
    assert_eq!(truth.at(precision(12)).undecided, truth.undecided);
    assert_eq!(truth.at(precision(8)).undecided, truth.undecided);
    // The band is that of 8 bits up to 2048 px, and grows with the side of the picture.
    let doubt_px = |size_px, bits| {
        View {
            size_px,
            precision: precision(bits),
            ..view
        }
        .doubt_px()
    };
    assert_eq!(doubt_px([200, 150], 8), 1.0 / 256.0);
    assert_eq!(doubt_px([2048, 100], 8), 1.0 / 256.0);
    assert_eq!(doubt_px([4096, 3000], 8), 1.0 / 128.0);
    assert_eq!(doubt_px([200, 150], 4), 1.0 / 16.0);
}

#[test]
fn decided_depths_survive_a_shift_of_the_samples() {
    let (mut open, mut decided) = (0, 0);
    for seed in 5..11 {
        let cut = vec![vec![relief(0.1, 0.5, 0.3, fractal(128, seed))]];
        let camera = parallel(dvec3(1.0, 2.0, 0.9), DVec3::ZERO, 2.0);
        let prepared = Prepared::new(&scene(vec![ball(1.0, 40, 60)], cut, camera));
        let view = prepared.view([256, 256]);
        let exact = evaluate(&prepared, &view);
        for [x, y] in [
            [1.0, 0.0],
            [-1.0, 0.0],
            [0.0, 1.0],
            [0.0, -1.0],
            [1.0, 1.0],
            [-1.0, 1.0],
        ] {
            // What rounding to 1/256 px does at most, along each axis; at 1/256 px itself second-order terms decide.
            let step = view.pixel_size(view.near) / 512.0;
            let eye = view.eye + (view.right * x + view.up * y) * step;
            let moved = evaluate(&prepared, &View { eye, ..view });
            assert_eq!(changed(&exact, &moved).0, 0, "a decided pixel changed");
            for (i, a) in exact.layers.pixels.iter().enumerate() {
                let jump = (a.depth - moved.layers.pixels[i].depth).abs();
                // A fold of the relief is many times deeper than what a slope makes of 1/256 px.
                if a.kind != Kind::Background && !exact.undecided[i] && jump > 0.02 {
                    open += usize::from(exact.depth_open[i]);
                    decided += usize::from(!exact.depth_open[i]);
                }
            }
        }
    }
    println!("{open} jumps where the depth is open, {decided} elsewhere");
    assert_eq!(decided, 0, "of {open} more jumps in depth");
    assert!(open > 5, "only {open} jumps: the test has no teeth");
}

#[test]
fn few_pixels_are_undecided() {
    // Of a doubled mesh every edge is an outline, for it has four faces.
    for (name, scene) in scenes().into_iter().filter(|(name, _)| *name != "doubled") {
        let prepared = Prepared::new(&scene);
        let view = prepared.view([512, 384]);
        let exact = evaluate(&prepared, &view);
        println!(
            "{name}: {} of {} covered px are undecided, {:.1e}; {} px of cap",
            exact.undecided_px(),
            exact.covered_px(),
            exact.undecided_share(),
            exact.layers.count(Kind::Cap)
        );
        assert!(
            exact.undecided_share() < 1e-3,
            "{name}: {}",
            exact.undecided_share()
        );
    }
}
