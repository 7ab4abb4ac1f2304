//! Cases 16 to 19 by the nonzero rule: which points a mesh winds around, and what is said where it cannot be told.

use cutaway::layers::Kind;
use cutaway::scene::{ClipSurface, Cut, Fill, Mesh, Scene};
use cutaway::session::Outcome;
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};
use cutaway_lab::hard_cases::{self, Expected};
use glam::{DAffine3, DVec2, DVec3};

use crate::common::numbers::Numbers;
use crate::common::{Judged, Question, meshes, scenes, session};

/// How often a polygon goes round a point.
fn index(polygon: &[DVec2], at: DVec2) -> i32 {
    let ends = polygon.iter().zip(polygon.iter().cycle().skip(1));
    ends.map(|(a, b)| {
        let left = (*b - *a).perp_dot(at - *a) > 0.0;
        match (a.y <= at.y, b.y <= at.y) {
            (true, false) if left => 1,
            (false, true) if !left => -1,
            _ => 0,
        }
    })
    .sum()
}

fn distance(polygon: &[DVec2], at: DVec2) -> f64 {
    let ends = polygon.iter().zip(polygon.iter().cycle().skip(1));
    ends.map(|(a, b)| {
        let along = *b - *a;
        let t = ((at - *a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        at.distance(*a + along * t)
    })
    .fold(f64::INFINITY, f64::min)
}

/// The same scene with every part filled by the nonzero rule.
fn nonzero(mut scene: Scene) -> Scene {
    for part in &mut scene.parts {
        part.fill = Fill::Nonzero;
    }
    scene
}

/// A closed profile turned about the z axis. Its winding number around a point is that of the profile around the point's
/// distance from the axis and height, up to the corners of the turn.
fn revolved(profile: &[DVec2], segments: u32) -> Mesh {
    let count = profile.len() as u32;
    let mut mesh = Mesh::default();
    for s in 0..segments {
        let turn = std::f64::consts::TAU * f64::from(s) / f64::from(segments);
        let out = DVec3::new(turn.cos(), turn.sin(), 0.0);
        (mesh.positions).extend(profile.iter().map(|p| out * p.x + DVec3::Z * p.y));
        for p in 0..count {
            let at = |s: u32, p: u32| s % segments * count + p % count;
            let [a, b, c, d] = [at(s, p), at(s + 1, p), at(s + 1, p + 1), at(s, p + 1)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

/// Curves that cross themselves: a loop within a loop, which goes round its inside twice, and an eight, of which one half is
/// inside out.
fn profiles() -> [(&'static str, Vec<DVec2>); 2] {
    let around = |point: &dyn Fn(f64) -> DVec2| {
        let turns = (0..96).map(|i| std::f64::consts::TAU * f64::from(i) / 96.0);
        turns.map(point).collect()
    };
    [
        (
            "loop in a loop",
            around(&|t| {
                let reach = 0.12 + 0.24 * t.cos();
                DVec2::new(0.45 + reach * t.cos(), reach * t.sin())
            }),
        ),
        (
            "eight",
            around(&|t| DVec2::new(0.5 + 0.3 * t.sin(), 0.25 * (2.0 * t).sin())),
        ),
    ]
}

/// A self-crossing solid, its upper part removed, seen from above.
fn crossed(profile: &[DVec2], fill: Fill) -> Scene {
    let plane = ClipSurface::plane(DVec3::Z * 0.031, DVec3::NEG_Z);
    let mut scene = scenes::scene("crossed", revolved(profile, 256), vec![plane]);
    scene.parts[0].fill = fill;
    scene.camera = scenes::of_case("04-rays-through-vertices", 256)
        .remove(0)
        .camera;
    scene
}

/// The frame of the exact strategy by the compute rasteriser.
fn by_compute(question: &Question) -> (Judged, Vec<u32>) {
    let mut session = session();
    let method = Method::new(Strategy::RAYCAST_MASK, DrawOptions::by(Rasteriser::Compute));
    let drawn = (session.draw(&question.model, &question.view, method)).expect("a frame");
    let mask = session.words(method, "mask").expect("its mask");
    let judged = question.judge(&session, method, drawn.outcome);
    (judged, mask)
}

#[test]
fn case_16_a_hollow_ball_is_hollow_if_its_inner_shell_is_turned() {
    let caps = |flip: u32, fill: Fill| {
        let shape = format!("shells?subdivisions=3&flip_inner={flip}");
        let mut scene = scenes::sectioned(&shape, &["-z=0.05"]);
        scene.parts[0].fill = fill;
        let judged = Question::new(&scene, [128; 2]).answer(Strategy::RAYCAST_MASK);
        assert_eq!(judged.fault_of_exact(), None, "{shape}, {fill}");
        judged.layers.count(Kind::Cap)
    };
    let [same, turned] = [0, 1].map(|flip| caps(flip, Fill::EvenOdd));
    assert_eq!(same, turned, "parity ignores orientation");
    let [same_nonzero, turned_nonzero] = [0, 1].map(|flip| caps(flip, Fill::Nonzero));
    let (ring, disc) = (same.min(turned), same_nonzero.max(turned_nonzero));
    let least = same_nonzero.min(turned_nonzero);
    assert_eq!(least, ring, "one of the two is a ring");
    assert!(
        disc > ring * 11 / 10,
        "the other is full: {disc} and {ring}"
    );
}

#[test]
fn case_17_overlapping_balls_unite() {
    let scenes = scenes::of_case("17-overlapping", 256);
    let caps = |scene: &Scene| {
        let judged = Question::new(scene, [256; 2]).answer(Strategy::RAYCAST_MASK);
        assert_eq!(judged.fault_of_exact(), None, "{}", scene.name);
        judged.layers.count(Kind::Cap)
    };
    let united = scenes::of_case("17-overlapping-nonzero", 256);
    for (parity, nonzero) in scenes.iter().zip(&united) {
        let (void, full) = (caps(parity), caps(nonzero));
        assert!(full > void * 5 / 4, "the lens is full: {full} and {void}");
    }
}

#[test]
fn case_18_winding_is_the_index_of_the_profile() {
    for (name, profile) in profiles() {
        for fill in [Fill::EvenOdd, Fill::Nonzero] {
            let question = Question::new(&crossed(&profile, fill), [256; 2]);
            let judged = question.answer(Strategy::RAYCAST_MASK);
            assert_eq!(judged.fault_of_exact(), None, "{name}, {fill}");
            let prepared = &question.model.prepared;
            let (mut inside, mut twice) = (0, 0);
            for (pixel, layer) in question.exact.layers.pixels.iter().enumerate() {
                let (x, y) = (pixel as u32 % 256, pixel as u32 / 256);
                let at = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let (origin, _) = question.view.ray(at);
                let world = origin / prepared.scale + prepared.centre_in_world;
                let at = DVec2::new(world.truncate().length(), 0.031);
                // The turn has corners: a circle is off by this much of its radius.
                if distance(&profile, at) < 1e-3 {
                    continue;
                }
                let winding = index(&profile, at);
                let label = format!("{name}, {fill}: pixel ({x}, {y}), winding {winding}");
                assert_eq!(layer.kind == Kind::Cap, fill.holds(winding), "{label}");
                inside += usize::from(winding != 0);
                twice += usize::from(winding.abs() == 2);
            }
            assert!(inside > 5000, "{name}: {inside} pixels inside");
            assert_eq!(twice > 500, name == "loop in a loop", "{name}: {twice}");
        }
    }
}

#[test]
fn case_18_the_mask_holds_the_winding_number_itself() {
    let (_, profile) = &profiles()[0];
    let question = Question::new(&crossed(profile, Fill::Nonzero), [256; 2]);
    let (judged, mask) = by_compute(&question);
    assert_eq!(judged.fault_of_exact(), None, "by the compute rasteriser");
    // One word of totals, one of bytes of which the first is the plane's.
    let (totals, counts) = mask.split_at(256 * 256);
    assert_eq!(counts.len(), totals.len(), "two words to a pixel");
    assert!(totals.iter().all(|t| t & 0xffff == 0), "the mesh is closed");
    let mut seen = [0; 3];
    for word in counts {
        seen[(word & 0xff) as usize] += 1;
    }
    assert!(seen.iter().all(|n| *n > 500), "pixels by winding: {seen:?}");
}

#[test]
fn case_19_a_doubled_mesh_is_as_solid_as_a_single_one() {
    let single = Question::new(&scenes::torus_cut(), [256; 2]).answer(Strategy::RAYCAST_MASK);
    let doubled = scenes::of_case("19-doubled-nonzero", 256).remove(0);
    let question = Question::new(&doubled, [256; 2]);
    let judged = question.answer(Strategy::RAYCAST_MASK);
    assert_eq!(judged.fault_of_exact(), None, "hardware");
    assert_eq!(by_compute(&question).0.fault_of_exact(), None, "compute");
    assert_eq!(
        judged.layers.count(Kind::Cap),
        single.layers.count(Kind::Cap),
        "wound around twice"
    );
}

#[test]
fn more_shells_than_a_byte_counts_are_marked() {
    let cube = meshes::shape("cube");
    let shells = |count: usize| {
        let shell = |i| {
            meshes::moved(
                &cube,
                DAffine3::from_scale(DVec3::splat(1.0 + 1e-3 * i as f64)),
            )
        };
        let mesh = meshes::joined(&(0..count).map(shell).collect::<Vec<_>>());
        let plane = ClipSurface::plane(DVec3::ZERO, DVec3::new(-0.2, -0.1, -1.0));
        let scene = scenes::scene("shells", mesh, vec![plane]);
        Question::new(&nonzero(scene), [96; 2])
    };
    for rasteriser in [Rasteriser::Hardware, Rasteriser::Compute] {
        let most = match rasteriser {
            Rasteriser::Hardware => shells(127).answer(Strategy::RAYCAST_MASK),
            Rasteriser::Compute => by_compute(&shells(127)).0,
        };
        assert_eq!(most.fault_of_exact(), None, "127 shells, {rasteriser}");
        // 256 shells make a byte of 0: no cap, and every such pixel says so.
        let question = shells(256);
        let beyond = match rasteriser {
            Rasteriser::Hardware => question.answer(Strategy::RAYCAST_MASK),
            Rasteriser::Compute => by_compute(&question).0,
        };
        assert_eq!(beyond.outcome, Outcome::Complete, "{rasteriser}");
        let wrong: Vec<usize> = beyond.decided_wrong().collect();
        assert!(wrong.len() > 500, "{rasteriser}: {} wrong", wrong.len());
        let unmarked = wrong.iter().find(|i| !beyond.layers.pixels[**i].unreliable);
        assert_eq!(unmarked, None, "{rasteriser}: wrong and not marked");
    }
}

#[test]
fn faces_that_disagree_on_what_is_out_are_marked_where_they_are() {
    let ball = meshes::shape("sphere?subdivisions=2");
    let toward = DVec3::new(0.45, 0.35, 0.75);
    let front = (0..ball.triangles.len())
        .max_by(|a, b| {
            let along = |t: usize| ball.corners(t).iter().map(|p| p.dot(toward)).sum::<f64>();
            along(*a).total_cmp(&along(*b))
        })
        .expect("triangles");
    let mut mesh = ball.clone();
    mesh.triangles[front].swap(0, 1);
    let plane = ClipSurface::plane(DVec3::new(0.0, 0.2, 0.0), DVec3::new(-0.2, -1.0, -0.1));
    let even_odd = scenes::scene("one face turned", mesh, vec![plane]);
    let parity = Question::new(&even_odd, [128; 2]).answer(Strategy::RAYCAST_MASK);
    assert_eq!(parity.comparison.odd_parity_px, 0, "parity ignores it");
    let question = Question::new(&nonzero(even_odd.clone()), [128; 2]);
    for judged in [
        question.answer(Strategy::RAYCAST_MASK),
        by_compute(&question).0,
    ] {
        let marked = judged.comparison.odd_parity_px;
        assert!(marked > 20, "{marked} pixels are marked");
        let method = Method::from(Strategy::RAYCAST_MASK);
        let asked = hard_cases::Question::new(&nonzero(even_odd.clone()), [128; 2]);
        let fault = Expected::Marked.fault(&asked, &judged, &method);
        assert_eq!(fault, None);
    }
}

/// Boxes and lumpy balls in one mesh, some turned inside out, cut by a plane or a relief, filled either way.
fn random(n: &mut Numbers) -> Scene {
    let shells = (0..2 + n.below(3)).map(|_| {
        let mesh = if n.once_in(2) {
            let half = [(); 3].map(|()| n.between(0.15, 0.5));
            meshes::block(-DVec3::from(half), DVec3::from(half))
        } else {
            meshes::lumpy(2, n.between(0.0, 0.3), n.between(0.0, 6.0))
        };
        let by = [(); 3].map(|()| n.between(-0.3, 0.3));
        let mesh = meshes::moved(&mesh, DAffine3::from_translation(DVec3::from(by)));
        if n.once_in(3) {
            meshes::turned(&mesh)
        } else {
            mesh
        }
    });
    let mesh = meshes::joined(&shells.collect::<Vec<_>>());
    let mut scene = scenes::scene("shells", mesh, Vec::new());
    let at = n.between(40.0, 60.0);
    let section = format!("-0.3,{:.2},-1@50%,50%,{at:.1}%", n.between(-0.5, 0.5));
    let surface = if n.once_in(2) {
        scenes::relief(&scene, &section, "fractal:size=32,amplitude=8%")
    } else {
        ClipSurface::parse(&section, &scene.bounds()).expect("a section")
    };
    scene.cuts = vec![Cut::new("cut", vec![surface])];
    if !n.once_in(4) {
        scene.parts[0].fill = Fill::Nonzero;
    }
    scene.camera = scenes::orbit(n.between(0.0, 60.0), n.between(5.0, 50.0), n.once_in(3));
    scene
}

#[test]
fn shells_at_random_are_filled_as_exact_says() {
    let mut n = Numbers(17);
    let (mut caps, mut parted) = (0, 0);
    for i in 0..40 {
        let mut scene = random(&mut n);
        let question = Question::new(&scene, [64, 48]);
        for strategy in [Strategy::RAYCAST_MASK, Strategy::RAYCAST_STENCIL] {
            let judged = question.answer(strategy);
            assert_eq!(judged.fault_of_exact(), None, "{i}: {strategy}");
        }
        assert_eq!(
            by_compute(&question).0.fault_of_exact(),
            None,
            "{i}: compute"
        );
        caps += question.exact.layers.count(Kind::Cap);
        // The control: the other rule is another picture, wherever shells overlap.
        scene.parts[0].fill = match scene.parts[0].fill {
            Fill::EvenOdd => Fill::Nonzero,
            Fill::Nonzero => Fill::EvenOdd,
        };
        let other = Question::new(&scene, [64, 48]);
        parted += usize::from(question.compare(&other.exact.layers).decided_wrong_px > 5);
    }
    assert!(caps > 5000, "only {caps} cap pixels");
    assert!(parted > 20, "the rules part in {parted} scenes of 40");
}
