//! The plan: the least that planes ask for, told with its work on the CPU, within core WebGPU; and what is refused.

use cutaway::Model;
use cutaway::plan::{Capacities, Clock, Limits, Plan, Recorded, Work};
use cutaway::scene::{Camera, ClipSurface, Cut, Scene};
use cutaway::strategies::{self, DrawOptions, Method, Rasteriser, Strategy};
use glam::{DAffine3, DVec3};

use super::common::{meshes, scenes};

const SIZE: [u32; 2] = [320, 200];

fn plan(scene: &Scene, rasteriser: Rasteriser) -> Result<Plan, String> {
    recorded(scene, rasteriser).map(|recorded| recorded.plan)
}

fn recorded(scene: &Scene, rasteriser: Rasteriser) -> Result<Recorded, String> {
    let model = Model::new(scene);
    let view = model.prepared.view(SIZE);
    let options = DrawOptions::by(rasteriser);
    let none = Capacities::UNKNOWN;
    let method = Method::new(Strategy::PLANAR, options);
    strategies::record(&model, &view, method, &none).map_err(|refusal| refusal.reason)
}

fn passes(plan: &Plan) -> Vec<&str> {
    plan.passes.iter().map(|p| p.name.as_str()).collect()
}

/// Instances and triangles that the sections are drawn with.
fn sections(plan: &Plan) -> Vec<(u32, u32)> {
    let pass = plan.passes.iter().find(|p| p.name == "sections");
    match pass.map(|p| &p.work) {
        Some(Work::Draw { draws, .. }) => (draws.iter())
            .map(|d| (d.instance, (d.indices.end - d.indices.start) / 3))
            .collect(),
        _ => Vec::new(),
    }
}

fn plane(z: f64) -> ClipSurface {
    ClipSurface::plane(DVec3::Z * z, DVec3::NEG_Z)
}

/// Cubes in a row along x.
fn cubes(count: usize, cuts: Vec<Cut>) -> Scene {
    let mut parts = Vec::new();
    for i in 0..count {
        let mut cube = meshes::parts("cube").remove(0);
        cube.name = format!("cube {i}");
        cube.world_from_part = DAffine3::from_translation(DVec3::X * 3.0 * i as f64);
        parts.push(cube);
    }
    Scene {
        cuts,
        ..scenes::of_parts("cubes", parts, Vec::new())
    }
}

#[test]
fn one_plane_through_one_part_is_one_section() {
    let scene = cubes(1, vec![Cut::new("cut", vec![plane(0.1)])]);
    let Recorded {
        plan: hardware,
        on_cpu,
    } = recorded(&scene, Rasteriser::Hardware).expect("a plan");
    let expected = ["crossings", "solid", "sections", "resolve", "shade"];
    assert_eq!(passes(&hardware), expected, "passes");
    assert_eq!(sections(&hardware).len(), 1, "sections");
    let works = (hardware.on_cpu.iter()).map(|w| (w.name.as_str(), w.clock));
    let expected = [("slicers", Clock::Solid), ("slice", Clock::Cut)];
    assert_eq!(works.collect::<Vec<_>>(), expected, "work");
    assert!(
        on_cpu.len() == 2 && on_cpu.iter().all(|w| w.took_ms.is_some()),
        "it was sliced"
    );
    hardware.check(&Limits::CORE).expect("core WebGPU");
    let compute = plan(&scene, Rasteriser::Compute).expect("a plan");
    assert!(
        passes(&compute).contains(&"sections"),
        "{:?}",
        passes(&compute)
    );
    compute.check(&Limits::CORE).expect("core WebGPU");
    // The mesh leaves nothing: no fragment of it touches the mask.
    let solid = hardware.passes.iter().find(|p| p.name == "solid");
    let bound: Vec<_> = solid
        .expect("a pass")
        .bindings
        .iter()
        .map(|b| b.name)
        .collect();
    assert!(!bound.contains(&"mask"), "{bound:?}");
}

#[test]
fn what_no_plane_meets_has_no_section() {
    let none = cubes(2, vec![]);
    let plain = plan(&none, Rasteriser::Hardware).expect("a plan");
    assert_eq!(passes(&plain), ["surface", "gather", "shade"], "no cut");
    assert!(plain.on_cpu.is_empty(), "no cut");
    // Of three parts the first is cut by one plane, the second by another, the third by neither.
    let mut cuts = vec![
        Cut::new("first", vec![plane(0.1)]),
        Cut::new("second", vec![plane(0.2)]),
    ];
    cuts[0].applies_to = vec!["cube 0".to_owned()];
    cuts[1].applies_to = vec!["cube 1".to_owned()];
    let scene = cubes(3, cuts);
    let both = plan(&scene, Rasteriser::Hardware).expect("a plan");
    // Place times 32, and the clip-surface's place.
    let mut instances: Vec<u32> = sections(&both).iter().map(|s| s.0).collect();
    instances.sort_unstable();
    assert_eq!(instances, [0, 33], "two sections of four");
    // A plane that meets the box and nothing of the solid: a mask that stays empty, nothing to draw.
    let corner = ClipSurface::plane(DVec3::splat(0.35), DVec3::NEG_ONE);
    let scene = scenes::scene("ball", meshes::shape("sphere?subdivisions=3"), vec![corner]);
    let Recorded {
        plan: missed,
        on_cpu,
    } = recorded(&scene, Rasteriser::Hardware).expect("a plan");
    assert!(sections(&missed).is_empty(), "{:?}", passes(&missed));
    // It was looked for, which took its time.
    assert!(on_cpu[1].took_ms.is_some() && missed.on_cpu[1].makes.is_empty());
    assert!(
        missed.to_text().contains("0 sections, triangulated"),
        "{}",
        missed.to_text()
    );
    missed.check(&Limits::CORE).expect("core WebGPU");
}

#[test]
fn an_open_outline_is_the_only_reason_to_count_fragments() {
    let mut mesh = meshes::shape("sphere?subdivisions=3");
    let store = |mesh: &cutaway::scene::Mesh| {
        let scene = scenes::scene("ball", mesh.clone(), vec![plane(0.05)]);
        let plan = plan(&scene, Rasteriser::Hardware).expect("a plan");
        plan.check(&Limits::CORE).expect("core WebGPU");
        let solid = plan.passes.iter().find(|p| p.name == "solid");
        let with = solid.expect("a pass").shader.with.iter().copied();
        with.filter(|file| file.starts_with("lib/store/"))
            .collect::<Vec<_>>()
    };
    assert_eq!(store(&mesh), ["lib/store/nothing.wgsl"], "closed");
    // A triangle that the plane crosses.
    let crossed = (0..mesh.triangles.len())
        .find(|t| {
            let z = mesh.corners(*t).map(|p| p.z < 0.05);
            z.contains(&true) && z.contains(&false)
        })
        .expect("the plane meets the ball");
    mesh.triangles.remove(crossed);
    assert_eq!(store(&mesh), ["lib/store/total.wgsl"], "open");
}

#[test]
fn the_plan_is_told_with_its_work_on_the_cpu() {
    let scene = cubes(1, vec![Cut::new("cut", vec![plane(0.0)])]);
    let plan = plan(&scene, Rasteriser::Hardware).expect("a plan");
    let text = plan.to_text();
    // By hand: six vertices of 16 bytes at most for a square that a diagonal of each wall crosses, in powers of two.
    for line in [
        "per cut: 0 passes",
        "  slicers  [on the CPU]",
        "    why     1 part prepared for slicing by any plane",
        "  slice  [on the CPU]",
        "    why     1 section, triangulated: the region of a plane inside a part",
        "    writes  section vertices, section indices",
        "    why     1 section: under a section, the crossing of its plane is inside the part",
    ] {
        assert!(text.contains(line), "`{line}` is not in\n{text}");
    }
    let json = plan.to_json();
    assert_eq!(json["on_cpu"][0]["name"], "slicers", "{json}");
    assert_eq!(json["on_cpu"][1]["name"], "slice", "{json}");
    assert_eq!(json["on_cpu"][1]["clock"], "cut", "{json}");
}

#[test]
fn what_is_no_section_is_refused_with_the_reason() {
    let ragged = {
        let scene = cubes(1, vec![]);
        scenes::relief(&scene, "-z=50%", "fractal:size=64,amplitude=8%")
    };
    let mut inside = cubes(1, vec![Cut::new("cut", vec![plane(0.1)])]);
    inside.camera = Camera {
        ..scenes::looking(DVec3::ZERO, DVec3::X, 40.0)
    };
    for (scene, phrase) in [
        (
            cubes(1, vec![Cut::new("front", vec![plane(0.2), ragged.clone()])]),
            "clip-surface 1 of cut `front` has a relief",
        ),
        (inside, "the near plane meets `cube 0`"),
    ] {
        let reason = plan(&scene, Rasteriser::Hardware).expect_err(phrase);
        assert!(reason.contains(phrase), "{reason}");
    }
    // The controls: a relief that meets nothing is none, a flat one is a plane, and without its cap the near plane is none.
    let far = {
        let mut far = ragged.clone();
        far.origin.z += 100.0;
        Cut::new("far", vec![far])
    };
    let mut flat = plane(0.1);
    let map = cutaway::scene::OffsetMap::new([2, 2], vec![0.5; 4]).expect("a flat map");
    flat.relief = Some(std::sync::Arc::new(map));
    let mut uncapped = cubes(1, vec![Cut::new("cut", vec![plane(0.1)])]);
    uncapped.camera = Camera {
        near_cap: false,
        ..scenes::looking(DVec3::ZERO, DVec3::X, 40.0)
    };
    for scene in [
        cubes(1, vec![Cut::new("cut", vec![plane(0.2)]), far]),
        cubes(1, vec![Cut::new("cut", vec![flat])]),
        uncapped,
    ] {
        let drawn = plan(&scene, Rasteriser::Hardware);
        drawn.unwrap_or_else(|e| panic!("{e}"));
    }
}
