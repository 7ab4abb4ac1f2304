//! The rules of a plan and the limits of core WebGPU.

use cutaway::Error;
use cutaway::passes::ActiveCuts;
use cutaway::plan::{
    Access, Binding, BufferRole, Contents, DepthCompare, Format, Limits, Resource, ResourceId,
    Shape,
};
use cutaway::scene::{Mesh, Part};
use cutaway::strategies::{CapSurface, InsideTest, Unsupported};

use super::*;

const RESOLUTIONS: [[u32; 2]; 5] = [[1, 1], [64, 64], [1024, 768], [1920, 1080], [3840, 2160]];

fn scenes() -> Vec<Scene> {
    let mut all = Vec::new();
    for specs in [
        &["cube"][..],
        &["crank?throws=1&detail=16"],
        &["earth?subdivisions=2"],
        &["cube", "torus", "sphere"],
    ] {
        for cuts in [
            vec![],
            vec![planes(0.1, 1)],
            vec![planes(0.1, 3)],
            vec![reliefs(0.1, 1)],
            vec![planes(0.1, 1), reliefs(-0.1, 2)],
        ] {
            all.push(scene_of(specs, cuts));
        }
    }
    all
}

/// A limit that a plan says it breaks, if that is what is wrong with it.
fn broken_limit(plan: &Plan) -> Option<String> {
    match plan.check(&WITH_STENCIL) {
        Ok(()) => None,
        Err(Error::Limit(reason)) => Some(reason),
        Err(e) => panic!("{e}\n{}", plan.to_text()),
    }
}

#[test]
fn every_plan_keeps_the_rules_up_to_4k() {
    let mut refused = 0;
    for scene in scenes() {
        let model = Model::new(&scene);
        for size in RESOLUTIONS {
            let view = model.prepared.view(size);
            for strategy in all_strategies() {
                let plan = strategies::plan(&model, &view, strategy, &Capacities::UNKNOWN)
                    .unwrap_or_else(|e| panic!("{e}"));
                let too_large = plan.resources.iter().find(|r| {
                    let is_storage = matches!(
                        r.shape,
                        Shape::Buffer {
                            role: BufferRole::Storage,
                            ..
                        }
                    );
                    is_storage && r.shape.bytes() > 128 << 20
                });
                let limit = broken_limit(&plan);
                let what = format!("{strategy} at {size:?}: {limit:?}");
                match (&limit, too_large) {
                    (None, None) => {}
                    // The list of crossings of a relief, 7 to a pixel, outgrows a binding above 4.7 million pixels.
                    // Slots are for the user to choose: as many as asked for, or none.
                    (Some(reason), Some(r)) if r.name == "nearest fragments" => {
                        assert!(reason.contains(&r.name), "{what}");
                        assert!(strategy.to_string().contains("kbuffer"), "{what}");
                    }
                    (Some(reason), Some(r)) => {
                        refused += 1;
                        assert!(reason.contains(&r.name), "{what}");
                        assert!(r.name.starts_with("crossing_"), "{what}");
                        assert!(size[0] > 1920, "{what}");
                    }
                    _ => panic!("{what}, though {too_large:?}"),
                }
            }
        }
    }
    assert!(refused > 0, "no list of crossings was too long for 4K");
}

#[test]
fn sprites_that_outgrow_a_binding_are_refused_by_name() {
    let scene = scene_of(&["cube"], vec![planes(0.1, 1)]);
    assert_eq!(
        broken_limit(&plan_of(&scene, &strategy("grid:2048+vds:4096"))),
        None,
        "the largest that fits"
    );
    let reason = broken_limit(&plan_of(&scene, &strategy("grid:8+vds:8192")));
    let reason = reason.expect("256 MiB of counts");
    assert!(reason.contains("sprite counts"), "{reason}");
}

#[test]
fn what_cannot_be_drawn_is_refused_with_a_reason() {
    let refused = |scene: &Scene, strategy: Strategy| {
        let model = Model::new(scene);
        let view = model.prepared.view(SIZE);
        strategies::plan(&model, &view, strategy, &Capacities::UNKNOWN).expect_err("a refusal")
    };
    let refusal = |scene: &Scene, name: &str| refused(scene, strategy(name)).to_string();
    // No name means these, but values can.
    let cut = scene_of(&["cube"], vec![planes(0.1, 1)]);
    for unpaired in [
        Strategy::new(CapSurface::PLANAR, InsideTest::MASK),
        Strategy::new(CapSurface::STENCIL, InsideTest::vds(64)),
        Strategy::alone(CapSurface::RAYCAST),
        Strategy::alone(CapSurface::grid(8)),
    ] {
        let refusal = refused(&cut, unpaired);
        assert_eq!(refusal.unsupported, Unsupported::Pairing, "{refusal}");
    }
    let cuts = (0..33).map(|_| planes(0.1, 1)).collect();
    let many = refused(&scene_of(&["cube"], cuts), Strategy::RAYCAST_MASK);
    assert_eq!(many.unsupported, Unsupported::Cuts, "{many}");
    // A smaller picture has as many cuts.
    let error = cutaway_lab::experiment::picture::refused(Strategy::RAYCAST_MASK.into(), &many);
    let message = error.to_string();
    assert!(
        message.contains("more than 32") && message.contains("export"),
        "{message}"
    );
    assert!(!message.contains("--resolution"), "{message}");
    // 32 are not too many.
    let cuts = (0..32).map(|_| planes(0.1, 1)).collect();
    let plan = plan_of(&scene_of(&["cube"], cuts), &Strategy::RAYCAST_MASK);
    assert_eq!(broken_limit(&plan), None, "32 cuts");

    // A cut beyond the 255 that layers can name is refused where it matters, and nowhere else.
    let missing = || planes(-100.0, 1);
    let mut cuts: Vec<Cut> = (0..255).map(|_| missing()).collect();
    cuts.push(planes(0.1, 1));
    let message = refusal(&scene_of(&["cube"], cuts.clone()), "raycast+mask");
    assert!(message.contains("clip-surface 255"), "{message}");
    cuts.swap(254, 255);
    let plan = plan_of(&scene_of(&["cube"], cuts), &Strategy::RAYCAST_MASK);
    assert_eq!(broken_limit(&plan), None, "clip-surface 254");

    let with = |change: &dyn Fn(&mut ClipSurface)| {
        let mut cut = reliefs(0.1, 1);
        change(&mut cut.surfaces[0]);
        refusal(&scene_of(&["cube"], vec![cut]), "raycast+mask")
    };
    let message = with(&|s| s.scale.x = 1e9);
    assert!(message.contains("texels across"), "{message}");
    let message = with(&|s| s.scale.z = 1e30);
    assert!(message.contains("high"), "{message}");
}

#[test]
fn more_parts_than_a_layer_can_name_are_refused() {
    let corner = Mesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        triangles: vec![[0, 1, 2]],
        corner_normals: None,
        vertex_paint: None,
    };
    let mut scene = Scene {
        parts: vec![Part::new("corner", corner); 1 << 16],
        ..Scene::default()
    };
    let recorded = |scene: &Scene| {
        let model = Model::new(scene);
        let view = model.prepared.view(SIZE);
        ActiveCuts::new(&model.prepared, &view).map(|_| ())
    };
    assert_eq!(recorded(&scene), Ok(()), "65536 parts");
    scene.parts.push(scene.parts[0].clone());
    let message = recorded(&scene).expect_err("65537 parts").reason;
    assert!(message.contains("65537 parts"), "{message}");
}

/// Why a plan that was good is refused once it is broken.
fn refusal(name: &str, break_it: impl FnOnce(&mut Plan)) -> String {
    let scene = scene_of(&["cube"], vec![reliefs(0.1, 1)]);
    let mut plan = plan_of(&scene, &strategy(name));
    assert_eq!(
        plan.check(&Limits::CORE).map_err(|e| e.to_string()),
        Ok(()),
        "before it is broken"
    );
    break_it(&mut plan);
    plan.check(&Limits::CORE)
        .expect_err("the plan is broken")
        .to_string()
}

fn pass_mut<'a>(plan: &'a mut Plan, name: &str) -> &'a mut Pass {
    let found = plan.passes.iter_mut().find(|p| p.name == name);
    found.unwrap_or_else(|| panic!("no pass `{name}`"))
}

fn id_of(plan: &Plan, name: &str) -> ResourceId {
    plan.resource_named(name)
        .unwrap_or_else(|| panic!("no resource `{name}`"))
}

#[track_caller]
fn tells(refusal: &str, phrase: &str) {
    assert!(
        refusal.contains(phrase),
        "`{refusal}` does not say `{phrase}`"
    );
}

#[test]
fn names_and_bindings_are_checked() {
    let mask = "raycast+mask";
    let twice = refusal(mask, |p| p.resources[0].name = p.resources[1].name.clone());
    tells(&twice, "is given twice");
    let twice = refusal(mask, |p| p.passes[0].name = p.passes[1].name.clone());
    tells(&twice, "is given twice");

    let unbound = refusal(mask, |p| {
        pass_mut(p, "resolve").bindings.retain(|b| b.name != "mask");
    });
    tells(
        &unbound,
        "`mask` of passes/resolve.wgsl with lib/cap_normal/reliefs.wgsl, lib/crossings/list.wgsl, lib/inside/mask.wgsl, lib/surfaces/one.wgsl is bound to nothing",
    );
    let unknown = refusal(mask, |p| {
        let id = id_of(p, "frame");
        pass_mut(p, "shade")
            .bindings
            .push(Binding::read("extra", id));
    });
    tells(&unknown, "binds no `extra`");
    let read_only = refusal(mask, |p| {
        for b in &mut pass_mut(p, "shade").bindings {
            if b.name == "layers" {
                b.access = Access::ReadWrite;
            }
        }
    });
    tells(&read_only, "is only read by");
    let absent = refusal(mask, |p| {
        pass_mut(p, "shade").shader = "no/such.wgsl".into()
    });
    tells(&absent, "there is no such shader");
}

#[test]
fn what_is_read_was_written_and_what_is_written_is_read() {
    let mask = "raycast+mask";
    let early = refusal(mask, |p| p.passes.swap(0, 1));
    tells(&early, "before anything wrote it");
    let uncleared = refusal(mask, |p| {
        if let Work::Draw { depth, .. } = &mut pass_mut(p, "solid").work {
            depth.clear = false;
        }
    });
    tells(&uncleared, "reads surface_depth before");
    let idle = refusal(mask, |p| {
        p.add_resource(Resource::storage("idle", 16, Clock::Frame));
    });
    tells(&idle, "nothing reads idle");
    let unread = refusal(mask, |p| {
        p.passes.retain(|pass| pass.name != "shade");
        p.picture = None;
    });
    tells(&unread, "nothing reads");
    // An output counts as read, and only while it is one.
    let forgotten = refusal(mask, |p| p.picture = None);
    tells(&forgotten, "nothing reads picture");
}

#[test]
fn a_slower_clock_reads_nothing_of_a_faster_one() {
    let vds = "grid:8+vds:64";
    // An upload of the frame: it changes, and nothing would run the pass again.
    let upload = refusal(vds, |p| {
        let id = id_of(p, "sprite 0");
        p.resources[id.0].clock = Clock::Frame;
    });
    tells(&upload, "runs per solid but reads sprite 0, made per frame");
    let made = refusal(vds, |p| {
        let id = id_of(p, "sprite counts");
        p.resources[id.0].clock = Clock::Cut;
    });
    tells(
        &made,
        "runs per solid but reads sprite counts, made per cut",
    );
    let pass = refusal(vds, |p| pass_mut(p, "cap 0").clock = Clock::Cut);
    tells(&pass, "runs per cut but reads frame, made per frame");
}

#[test]
fn limits_are_checked() {
    let mask = "raycast+mask";
    let set = |name: &'static str, shape: Shape| {
        move |p: &mut Plan| {
            let id = id_of(p, name);
            p.resources[id.0].shape = shape;
        }
    };
    let buffer = |bytes, role| Shape::Buffer { bytes, role };
    for (name, role, most) in [
        ("mask", BufferRole::Storage, 128_u64 << 20),
        ("frame", BufferRole::Uniform, 64 << 10),
        ("vertices", BufferRole::Vertex, 256 << 20),
        ("indices", BufferRole::Index, 256 << 20),
    ] {
        let message = refusal(mask, set(name, buffer(most + 4, role)));
        tells(&message, &format!("{name} needs {} bytes", most + 4));
        // At the limit it is good.
        let scene = scene_of(&["cube"], vec![planes(0.1, 1)]);
        let mut plan = plan_of(&scene, &Strategy::RAYCAST_MASK);
        set(name, buffer(most, role))(&mut plan);
        assert_eq!(broken_limit(&plan), None, "{name} at {most} bytes");
    }
    let texture = |size, layers| Shape::Texture {
        size,
        layers,
        format: Format::Depth32Float,
    };
    let wide = refusal(mask, set("surface_depth", texture([64, 8193], 1)));
    tells(&wide, "8193 texels along a texture");
    let deep = refusal(mask, set("surface_depth", texture([64, 64], 257)));
    tells(&deep, "257 layers");
    let many = refusal(mask, |p| {
        pass_mut(p, "shade").work = Work::Compute {
            groups: [1, 65_536, 1],
        };
    });
    tells(&many, "65536, 1] workgroups");

    // A device that offers less refuses more.
    let scene = scene_of(&["cube"], vec![planes(0.1, 1)]);
    let plan = plan_of(&scene, &Strategy::RAYCAST_MASK);
    let fewer = Limits {
        storage_buffers_per_stage: 5,
        ..Limits::CORE
    };
    let message = plan.check(&fewer).expect_err("resolve has 7").to_string();
    tells(&message, "storage buffers in one stage");
}

#[test]
fn contents_are_compared_by_what_they_hold() {
    let (a, b) = (
        Contents::from_values(&[1_u32, 2]),
        Contents::from_values(&[1_u32, 2]),
    );
    assert_eq!(a, b, "equal words at two places");
    assert_ne!(a, Contents::from_values(&[1_u32, 3]), "one word differs");
    // Nobody reads a depth buffer but its own test, and that is enough.
    let scene = scene_of(&["cube"], vec![planes(0.1, 1)]);
    let plan = plan_of(&scene, &strategy("grid:8+vds:64"));
    let depths = plan.passes.iter().filter(
        |p| matches!(&p.work, Work::Draw { depth, .. } if depth.compare == DepthCompare::Less),
    );
    assert!(depths.count() > 0, "the sprite is peeled");
}
