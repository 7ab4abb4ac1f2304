//! Only what the scene calls for.

use cutaway::scene::Role;

use super::*;

#[test]
fn without_a_cut_every_strategy_draws_the_same_and_nothing_more() {
    for specs in [
        &["cube"][..],
        &["crank?throws=1&detail=16"],
        &["cube", "sphere", "earth"],
    ] {
        let scene = scene_of(specs, vec![]);
        let first = plan_of(&scene, &Strategy::RAYCAST_MASK);
        assert_eq!(passes(&first), ["surface", "gather", "shade"], "{specs:?}");
        let expected = BTreeSet::from([
            "frame",
            "indices",
            "layers",
            "parts",
            "picture",
            "surface_depth",
            "surface_words",
            "vertices",
        ]);
        assert_eq!(resources(&first), expected, "{specs:?}");
        for strategy in all_strategies() {
            assert_eq!(plan_of(&scene, &strategy), first, "{strategy}: {specs:?}");
        }
    }
    // The control: with a cut, plans differ from strategy to strategy, but that a plane is never tessellated.
    let cut = scene_of(&["cube"], vec![planes(0.1, 1)]);
    let by_list = Strategy::all()
        .into_iter()
        .filter(|s| s.lists_crossings() && s.surface != Strategy::RAYCAST_MASK.surface);
    for strategy in by_list {
        let cast = plan_of(&cut, &Strategy::RAYCAST_MASK);
        assert_eq!(plan_of(&cut, &strategy), cast, "{strategy} on a plane");
    }
    let mut plans = Vec::new();
    for strategy in Strategy::all() {
        let plan = plan_of(&cut, &strategy);
        let is_cast = plan == plan_of(&cut, &Strategy::RAYCAST_MASK);
        assert!(!plans.contains(&plan) || is_cast, "{strategy} on a cut");
        plans.push(plan);
    }
    // A relief is tessellated, and each by itself.
    let ragged = scene_of(&["cube"], vec![reliefs(0.1, 1)]);
    let names = ["raycast+mask", "grid:256+mask", "adaptive:0.5+mask"];
    let plans = names.map(|n| plan_of(&ragged, &strategy(n)));
    assert!(plans[0] != plans[1] && plans[1] != plans[2] && plans[0] != plans[2]);
}

#[test]
fn a_cut_that_misses_is_as_good_as_none() {
    // The cube reaches from -1/2 to 1/2; the side of the normal is kept.
    let scene = scene_of(&["cube"], vec![]);
    let far = scene_of(&["cube"], vec![planes(-9.0, 1), reliefs(-9.0, 2)]);
    for strategy in all_strategies() {
        let (plain, missed) = (plan_of(&scene, &strategy), plan_of(&far, &strategy));
        assert_eq!(missed, plain, "{strategy}");
    }
    // Of an intersection it is enough that one of the clip-surfaces keeps all.
    let mut both = planes(0.1, 1);
    both.surfaces.extend(planes(-9.0, 1).surfaces);
    let intersected = scene_of(&["cube"], vec![both]);
    assert_eq!(
        plan_of(&intersected, &Strategy::RAYCAST_MASK),
        plan_of(&scene, &Strategy::RAYCAST_MASK),
        "an intersection"
    );
}

#[test]
fn parts_that_no_cut_reaches_are_drawn_plainly() {
    // Along x: the first cube is cut, the second and third lie on the kept side.
    let cut = Cut::new("x", vec![ClipSurface::plane(DVec3::ZERO, DVec3::X)]);
    let scene = scene_of(&["cube", "cube", "cube"], vec![cut.clone()]);
    let mask = plan_of(&scene, &Strategy::RAYCAST_MASK);
    assert_eq!(
        passes(&mask),
        ["crossings", "solid", "surface", "resolve", "shade"],
        "passes"
    );
    assert_eq!(drawn(pass(&mask, "solid")), [0], "one part is cut");
    assert_eq!(drawn(pass(&mask, "surface")), [1, 2], "two are not");
    let paper = plan_of(&scene, &strategy("grid:8+vds:64"));
    let sprites = resources(&paper)
        .iter()
        .filter(|n| n.starts_with("sprite layers"))
        .count();
    assert_eq!(sprites, 1, "sprites for one part of three");
    assert_eq!(drawn(pass(&paper, "clip")), [0], "one part is clipped");
    assert_eq!(drawn(pass(&paper, "surface")), [1, 2], "two are not");

    // The same of parts that are never cut.
    let mut scene = scene_of(&["cube", "cube"], vec![planes(0.1, 1)]);
    scene.parts[0].role = Role::Interior;
    let plan = plan_of(&scene, &Strategy::RAYCAST_MASK);
    assert_eq!(drawn(pass(&plan, "solid")).len(), 1, "the exterior part");
    assert_eq!(drawn(pass(&plan, "surface")).len(), 1, "the interior part");
    // The control: cut them both, and no plain pass is left.
    let scene = scene_of(&["cube", "cube"], vec![planes(0.1, 1)]);
    let plan = plan_of(&scene, &Strategy::RAYCAST_MASK);
    assert_eq!(
        passes(&plan),
        ["crossings", "solid", "resolve", "shade"],
        "both are cut"
    );
}

#[test]
fn what_is_removed_altogether_is_not_drawn() {
    for strategy in all_strategies() {
        let gone = plan_of(&scene_of(&["cube"], vec![planes(9.0, 1)]), &strategy);
        assert_eq!(
            passes(&gone),
            ["surface", "gather", "shade"],
            "{strategy}: passes"
        );
        let surface = pass(&gone, "surface");
        assert_eq!(drawn(surface), [0; 0], "{strategy}: draws");
        assert!(
            surface.reason.contains("clears"),
            "{strategy}: the pass says `{}`",
            surface.reason
        );
    }
    // Of two, the one that is left.
    let cut = Cut::new("x", vec![ClipSurface::plane(DVec3::X * 1.5, DVec3::X)]);
    let one = plan_of(
        &scene_of(&["cube", "cube"], vec![cut]),
        &Strategy::RAYCAST_MASK,
    );
    assert_eq!(passes(&one), ["surface", "gather", "shade"], "of two parts");
    assert_eq!(drawn(pass(&one, "surface")).len(), 1, "of two parts");
}

#[test]
fn what_else_cuts_a_part_that_is_removed_does_not_matter() {
    let mut ragged = reliefs(0.1, 1);
    ragged.applies_to = vec!["* 0".to_owned()];
    let gone = Cut::new("x", vec![ClipSurface::plane(DVec3::X * 1.5, DVec3::X)]);
    let scene = scene_of(&["cube", "cube"], vec![ragged, gone, planes(0.1, 1)]);
    let plan = plan_of(&scene, &Strategy::RAYCAST_MASK);
    let crossings = pass(&plan, "crossings");
    assert_eq!(
        crossings.shader.path, "strategies/surface/raycast/planes.wgsl",
        "the relief of a part that is gone is walked"
    );
    assert!(
        crossings.constants.contains(&("capacity", 1.0)),
        "{:?}",
        crossings.constants
    );
}

#[test]
fn planes_are_not_marched() {
    let heights = |plan: &Plan| {
        pass(plan, "crossings")
            .bindings
            .iter()
            .any(|b| b.name == "heights")
    };
    for count in [1, 3] {
        let plan = plan_of(
            &scene_of(&["cube"], vec![planes(0.1, count)]),
            &Strategy::RAYCAST_MASK,
        );
        assert_eq!(
            pass(&plan, "crossings").shader.path,
            "strategies/surface/raycast/planes.wgsl",
            "{count} planes"
        );
        assert!(!heights(&plan), "planes have no heights");
        let plan = plan_of(
            &scene_of(&["cube"], vec![planes(0.1, count), reliefs(0.1, 1)]),
            &Strategy::RAYCAST_MASK,
        );
        assert_eq!(
            pass(&plan, "crossings").shader.path,
            "strategies/surface/raycast/reliefs.wgsl",
            "a relief among {count} planes"
        );
        assert!(heights(&plan), "a relief has");
    }
    // One clip-surface needs no list of which crossing belongs to which.
    let bytes = |count| {
        let scene = scene_of(&["cube"], vec![planes(0.1, count)]);
        let plan = plan_of(&scene, &Strategy::RAYCAST_MASK);
        let id = plan.resource_named("crossing_surface").expect("the list");
        plan.resource(id).shape.bytes()
    };
    assert_eq!(bytes(1), 4, "one plane");
    assert_eq!(bytes(2), 320 * 200 * 4 * 2, "two planes");
}

#[test]
fn a_flat_relief_is_planned_as_the_plane_it_is() {
    let flat = |width: usize, height: f32, scale_z: f64| {
        let mut cut = planes(0.125, 1);
        let surface = &mut cut.surfaces[0];
        surface.relief = Some(map(&vec![height; width * 2]));
        surface.wrap = ANY_WRAP;
        surface.scale.z = scale_z;
        scene_of(&["cube"], vec![cut])
    };
    for strategy in all_strategies() {
        // The surface lies at -f Sz along N: at height 1/2 and scale 1/4, an eighth below where it is given.
        let lowered = plan_of(&scene_of(&["cube"], vec![planes(0.0, 1)]), &strategy);
        let plan = plan_of(&flat(4, 0.5, 0.25), &strategy);
        assert_eq!(plan.passes, lowered.passes, "{strategy}: passes");
        let shapes = |plan: &Plan| -> Vec<_> {
            plan.resources
                .iter()
                .map(|r| (r.name.clone(), r.shape))
                .collect()
        };
        assert_eq!(shapes(&plan), shapes(&lowered), "{strategy}: resources");
        // What is seen of it is equal bit for bit.
        let height_row = |plan: &Plan| {
            let id = plan.resource_named("cut_table").expect("the cuts");
            let contents = plan.resource(id).contents.clone().expect("uploaded");
            let table: cutaway::plan::pack::CutTable =
                bytemuck::pod_read_unaligned(&contents.bytes());
            let s = table.surfaces[0];
            (s.height_row, s.normal, s.first_texel)
        };
        assert_eq!(height_row(&plan), height_row(&lowered), "{strategy}");

        // No height at all, and heights that are scaled to nothing.
        for scene in [flat(1, 0.0, 1.0), flat(4, 0.75, 0.0)] {
            let plane = plan_of(&scene_of(&["cube"], vec![planes(0.125, 1)]), &strategy);
            assert_eq!(
                plan_of(&scene, &strategy).passes,
                plane.passes,
                "{strategy}"
            );
        }
    }
    // The control: a map that is not flat.
    let plane = plan_of(
        &scene_of(&["cube"], vec![planes(0.125, 1)]),
        &Strategy::RAYCAST_MASK,
    );
    let relief = plan_of(
        &scene_of(&["cube"], vec![reliefs(0.125, 1)]),
        &Strategy::RAYCAST_MASK,
    );
    assert_ne!(relief.passes, plane.passes, "a true relief");
}

/// Bits of a lane, lanes, words per pixel, and where the parts' lanes are.
fn lanes(scene: &Scene, capacities: &Capacities) -> (u32, u32, u64, Vec<[u32; 2]>) {
    let model = Model::new(scene);
    let view = model.prepared.view(SIZE);
    let plan = strategies::plan(&model, &view, Strategy::RAYCAST_MASK, capacities)
        .unwrap_or_else(|e| panic!("{e}"));
    let constant = |name: &str| {
        let constants = &pass(&plan, "resolve").constants;
        let found = constants.iter().find(|(n, _)| *n == name);
        found.unwrap_or_else(|| panic!("no constant {name}")).1 as u32
    };
    let of = |name: &str| {
        let id = plan
            .resource_named(name)
            .unwrap_or_else(|| panic!("no {name}"));
        plan.resource(id).clone()
    };
    let contents = of("parts").contents.expect("uploaded");
    let parts: Vec<cutaway::plan::pack::Part> = bytemuck::pod_collect_to_vec(&contents.bytes());
    (
        constant("lane_bits"),
        constant("lane_count"),
        of("mask").shape.bytes() / (4 * 320 * 200),
        parts.iter().map(|p| [p.lane_word, p.lane_shift]).collect(),
    )
}

#[test]
fn lanes_are_as_wide_as_the_crossings_ask() {
    // A lane has a bit for each crossing and one for the total, and is a power of two, or whole words, so that none straddles
    // a word.
    let cases: [(usize, usize, Option<u32>, u32); 11] = [
        (1, 0, None, 2),
        (2, 0, None, 4),
        (3, 0, None, 4),
        (4, 0, None, 8),
        (8, 0, None, 16),
        (0, 1, None, 8),
        (1, 1, None, 16),
        (0, 1, Some(2), 4),
        (0, 1, Some(31), 32),
        (0, 1, Some(32), 64),
        (0, 1, Some(300), 320),
    ];
    for (planes_cut, reliefs_cut, crossings, bits) in cases {
        let mut cut = planes(0.1, planes_cut);
        cut.surfaces.extend(reliefs(0.1, reliefs_cut).surfaces);
        let scene = scene_of(&["cube"], vec![cut]);
        let capacities = Capacities {
            crossings,
            ..Capacities::UNKNOWN
        };
        let what = format!("{planes_cut} planes, {reliefs_cut} reliefs, {crossings:?}");
        assert_eq!(
            lanes(&scene, &capacities),
            (bits, 1, u64::from(bits.div_ceil(32)), vec![[0, 0]]),
            "{what}"
        );
    }
}

#[test]
fn lanes_fill_word_after_word() {
    for (parts, words) in [(1, 1), (5, 1), (16, 1), (17, 2), (40, 3)] {
        let scene = scene_of(&vec!["cube"; parts], vec![planes(0.1, 1)]);
        let (bits, count, per_pixel, places) = lanes(&scene, &Capacities::UNKNOWN);
        assert_eq!(
            (bits, count, per_pixel),
            (2, parts as u32, words),
            "{parts} parts"
        );
        let expected: Vec<[u32; 2]> = (0..parts as u32).map(|i| [i / 16, i % 16 * 2]).collect();
        assert_eq!(places, expected, "{parts} parts");
    }
}

#[test]
fn long_lanes_are_words_of_their_own() {
    let scene = scene_of(&["cube"; 3], vec![reliefs(0.1, 1)]);
    let capacities = Capacities {
        crossings: Some(70),
        ..Capacities::UNKNOWN
    };
    let places = vec![[0, 0], [3, 0], [6, 0]];
    assert_eq!(lanes(&scene, &capacities), (96, 3, 9, places));
}
