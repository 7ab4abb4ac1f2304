//! Plans that use the stencil: as many draws as there are crossings, what a device must offer, and what is refused.

use cutaway::plan::{DepthCompare, DepthTarget, Limits, Stencil, StencilStep};
use cutaway::scene::{Camera, Fill, Viewpoint};

use super::*;

fn cut_cubes(count: usize, cut: Cut) -> Scene {
    scene_of(&vec!["cube"; count], vec![cut])
}

/// A cut by planes that meet every cube of a row along x, turned about x one by one.
fn tilted(count: usize) -> Cut {
    let surfaces = (0..count).map(|i| {
        let tilt = 0.1 * i as f64;
        ClipSurface::plane(DVec3::Z * 0.1, DVec3::new(0.0, tilt, 1.0))
    });
    Cut::new("tilted", surfaces.collect())
}

fn depth_of(pass: &Pass) -> DepthTarget {
    match &pass.work {
        Work::Draw { depth, .. } => *depth,
        Work::Compute { .. } | Work::ComputeIndirect { .. } => {
            panic!("{} draws nothing", pass.name)
        }
    }
}

fn refusal(scene: &Scene, name: &str) -> String {
    let model = Model::new(scene);
    let view = model.prepared.view(SIZE);
    strategies::plan(&model, &view, strategy(name), &Capacities::UNKNOWN)
        .expect_err(name)
        .reason
}

#[test]
fn each_crossing_is_laid_down_once_and_eight_pairs_share_a_stencil() {
    // One part, one plane: what is behind the crossing, and the total.
    let plan = plan_of(&cut_cubes(1, planes(0.1, 1)), &Strategy::RAYCAST_STENCIL);
    let expected = [
        "crossings",
        "solid",
        "lay 0",
        "mark 0 crossing 0",
        "mark 0 in all",
        "take 0",
        "resolve",
        "shade",
    ];
    assert_eq!(passes(&plan), expected, "one plane");
    for (parts, planes_cut) in [(1, 3), (3, 1), (3, 3), (5, 2)] {
        let scene = cut_cubes(parts, tilted(planes_cut));
        let plan = plan_of(&scene, &Strategy::RAYCAST_STENCIL);
        let count = |word: &str| {
            let named = |n: &&&str| n.starts_with(word);
            passes(&plan).iter().filter(named).count()
        };
        let what = format!("{parts} parts, {planes_cut} planes");
        assert_eq!(count("lay "), planes_cut, "{what}");
        assert_eq!(count("mark "), parts * (planes_cut + 1), "{what}");
        let batches = (parts * (planes_cut + 1)).div_ceil(8);
        assert_eq!(count("take "), batches, "{what}");
        assert_eq!(count("solid"), 1, "{what}: surfaces are drawn once");
        // The stencil is cleared before each batch, and each draw has a bit of its own.
        let marks = plan.passes.iter().filter(|p| p.name.starts_with("mark "));
        let stencils: Vec<Stencil> = marks.filter_map(|p| depth_of(p).stencil).collect();
        for (i, stencil) in stencils.iter().enumerate() {
            assert_eq!(stencil.clear, i % 8 == 0, "{what}: draw {i}");
            let bits = 1 << (i % 8);
            assert_eq!(stencil.step, StencilStep::Flip { bits }, "{what}: draw {i}");
        }
    }
}

#[test]
fn parts_filled_nonzero_have_the_stencil_to_themselves() {
    let mut scene = cut_cubes(3, planes(0.1, 1));
    scene.parts[1].fill = Fill::Nonzero;
    let plan = plan_of(&scene, &Strategy::RAYCAST_STENCIL);
    let winds = plan.passes.iter().filter(|p| {
        matches!(&p.work, Work::Draw { depth, .. } if depth.stencil.is_some_and(|s| s.step == StencilStep::Wind && s.clear))
    });
    assert_eq!(winds.count(), 2, "a crossing and the total");
    let takes: Vec<usize> = (plan.passes.iter())
        .filter(|p| p.name.starts_with("take "))
        .map(|p| {
            p.constants
                .iter()
                .filter(|c| c.0.starts_with("to_"))
                .count()
        })
        .collect();
    assert_eq!(takes, [4, 1, 1], "bits taken at a time");
}

#[test]
fn the_classic_draws_each_part_once() {
    let plan = plan_of(&cut_cubes(2, planes(0.1, 1)), &Strategy::STENCIL);
    assert_eq!(
        passes(&plan),
        ["solid 0", "cap 0", "solid 1", "cap 1", "gather", "shade"],
        "two parts"
    );
    for list in ["mask", "crossing_heads", "crossing_z", "stencil"] {
        assert_eq!(plan.resource_named(list), None, "no {list}");
    }
    assert_eq!(
        depth_of(pass(&plan, "solid 0")).stencil,
        Some(Stencil {
            clear: true,
            step: StencilStep::WindAll
        }),
        "counted from nothing"
    );
    let after = depth_of(pass(&plan, "solid 1"));
    assert!(
        !after.clear && after.stencil.is_some_and(|s| !s.clear),
        "the cap has set it back"
    );
    // A part that the cut does not reach is drawn plainly.
    let cut = Cut::new("x", vec![ClipSurface::plane(DVec3::ZERO, DVec3::X)]);
    let plan = plan_of(&scene_of(&["cube", "cube"], vec![cut]), &Strategy::STENCIL);
    assert_eq!(
        passes(&plan),
        ["solid 0", "cap 0", "surface", "gather", "shade"],
        "one of two"
    );
}

#[test]
fn the_classic_refuses_what_is_beyond_one_plane() {
    let mut inside = cut_cubes(1, planes(0.1, 1));
    inside.camera = Camera {
        viewpoint: Viewpoint::Explicit {
            position: DVec3::ZERO,
            focal_point: DVec3::X,
            view_up: None,
        },
        ..Camera::default()
    };
    for (scene, phrase) in [
        (cut_cubes(1, reliefs(0.1, 1)), "has a relief"),
        (cut_cubes(1, planes(0.1, 2)), "2 clip-surfaces"),
        (
            scene_of(&["cube"], vec![planes(0.1, 1), planes(0.2, 1)]),
            "2 clip-surfaces",
        ),
        (inside, "the near plane meets `cube 0`"),
    ] {
        let reason = refusal(&scene, "stencil");
        assert!(reason.contains(phrase), "{reason}");
    }
    // The control: a flat relief is a plane, and a second clip-surface that meets nothing is none.
    let mut flat = planes(0.1, 1);
    flat.surfaces[0].relief = Some(map(&[0.5; 4]));
    let beside = scene_of(&["cube"], vec![planes(0.1, 1), planes(-9.0, 1)]);
    for scene in [scene_of(&["cube"], vec![flat]), beside] {
        let plan = plan_of(&scene, &Strategy::STENCIL);
        assert_eq!(passes(&plan)[..2], ["solid 0", "cap 0"], "drawn");
    }
}

#[test]
fn more_draws_than_a_device_times_are_refused() {
    let scene = cut_cubes(300, reliefs(0.1, 1));
    let reason = refusal(&scene, "raycast+stencil");
    assert!(
        reason.contains("300 cut parts with 7 crossings"),
        "{reason}"
    );
}

#[test]
fn a_device_without_such_a_texture_refuses_by_name() {
    let scene = cut_cubes(1, planes(0.1, 1));
    for (strategy, texture) in [
        (Strategy::RAYCAST_STENCIL, "stencil"),
        (Strategy::STENCIL, "surface_depth"),
    ] {
        let plan = plan_of(&scene, &strategy);
        let message = plan
            .check(&Limits::CORE)
            .expect_err("core WebGPU")
            .to_string();
        assert!(
            message.contains(texture) && message.contains("depth32float-stencil8"),
            "{message}"
        );
        plan.check(&WITH_STENCIL).unwrap_or_else(|e| panic!("{e}"));
    }
    // The control: who has no stencil asks for none.
    let mask = plan_of(&scene, &Strategy::RAYCAST_MASK);
    mask.check(&Limits::CORE).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn what_a_stencil_reads_and_writes_is_told() {
    let mut plan = plan_of(&cut_cubes(1, planes(0.1, 1)), &Strategy::RAYCAST_STENCIL);
    let mark = pass(&plan, "mark 0 crossing 0");
    let stencil = plan.resource_named("stencil").expect("the texture");
    assert_eq!(depth_of(mark).compare, DepthCompare::Behind, "strictly");
    assert!(mark.writes().contains(&stencil), "it counts");
    assert!(mark.reads().contains(&stencil), "it tests");
    assert!(
        !pass(&plan, "lay 0").reads().contains(&stencil),
        "it replaces"
    );
    // Without the pass that lays the depth down the plan is no plan.
    plan.passes.retain(|p| p.name != "lay 0");
    let message = plan
        .check(&WITH_STENCIL)
        .expect_err("nothing is laid down")
        .to_string();
    assert!(
        message.contains("reads stencil before anything wrote it"),
        "{message}"
    );
}

#[test]
fn the_cube_cut_by_a_plane_in_the_classic_way() {
    let scene = scene_of(&["cube"], vec![planes(0.0, 1)]);
    let text = plan_of(&scene, &Strategy::STENCIL).to_text();
    // By hand: targets of 8 + 5 bytes, layers of 12 and a picture of 4 for 64,000 pixels.
    insta::assert_snapshot!(text, @r"
per cut: 0 passes, 12 B
per frame: 4 passes, 1.8 MiB
  solid 0  [draw 12 triangles in 1 draw, stencil winds]
    why     kept part of `cube 0`: back faces add 1, front faces subtract 1
    reads   frame, parts, ray_table, vertices, indices
    writes  surface_words, surface_depth
  cap 0  [draw 1 triangle in 1 draw, where stencil & 0x01 != 0]
    why     the plane, where it is inside `cube 0`
    reads   frame, cut_table, parts, ray_table, screen indices, surface_words, surface_depth
    writes  surface_words, surface_depth
  gather  [compute 20 x 13 x 1 groups]
    why     layers are what the picture and the comparison read
    reads   frame, surface_words, surface_depth
    writes  layers
  shade  [compute 20 x 13 x 1 groups]
    why     lit shading turns layers into a picture
    reads   frame, parts, layers
    writes  picture
");
}

#[test]
fn lanes_of_counts_follow_the_lanes_of_bits() {
    let mut scene = cut_cubes(4, tilted(5));
    scene.parts[1].fill = Fill::Nonzero;
    scene.parts[3].fill = Fill::Nonzero;
    let plan = plan_of(&scene, &Strategy::RAYCAST_MASK);
    let id = plan.resource_named("parts").expect("the parts");
    let contents = plan.resource(id).contents.clone().expect("uploaded");
    let parts: Vec<cutaway::plan::pack::Part> = bytemuck::pod_collect_to_vec(&contents.bytes());
    let lanes: Vec<[u32; 2]> = parts.iter().map(|p| [p.lane_word, p.lane_shift]).collect();
    // Two lanes of 8 bits share a word; 5 crossings take a word of totals and two of bytes.
    assert_eq!(lanes, [[0, 0], [1, 32], [0, 8], [4, 32]], "word and shift");
    let mask = plan.resource_named("mask").expect("the mask");
    assert_eq!(
        plan.resource(mask).shape.bytes(),
        320 * 200 * 4 * 7,
        "words"
    );
    let filled = |plan: &Plan| pass(plan, "solid").shader.with.clone();
    let list = "lib/crossings/list.wgsl";
    assert_eq!(
        filled(&plan),
        [list, "lib/store/winding.wgsl", "lib/surfaces/any.wgsl"],
        "counts and bits"
    );
    let plain = plan_of(&cut_cubes(4, tilted(5)), &Strategy::RAYCAST_MASK);
    assert_eq!(
        filled(&plain),
        [list, "lib/store/mask.wgsl", "lib/surfaces/any.wgsl"],
        "nobody counts"
    );
    // The sprite knows parity alone.
    let reason = refusal(&scene, "grid:8+vds:64");
    assert!(reason.contains("nonzero"), "{reason}");
}
