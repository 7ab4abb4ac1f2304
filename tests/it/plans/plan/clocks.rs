//! What changes when the view, a cut or a mesh does.

use cutaway::scene::{Camera, Mesh, Viewpoint};

use super::*;

fn scene() -> Scene {
    scene_of(
        &["cube?divisions=2", "sphere"],
        vec![planes(0.1, 1), reliefs(0.2, 1)],
    )
}

fn turned(mut scene: Scene) -> Scene {
    scene.camera = Camera {
        viewpoint: Viewpoint::Orbit {
            azimuth_deg: 50.0,
            elevation_deg: 10.0,
        },
        ..scene.camera
    };
    scene
}

fn with_moved_cut(mut scene: Scene) -> Scene {
    for cut in &mut scene.cuts {
        for surface in &mut cut.surfaces {
            surface.origin.z -= 0.05;
        }
    }
    scene
}

/// One vertex moved inward, so that neither bounds nor counts change.
fn with_dented_mesh(mut scene: Scene) -> Scene {
    let mut mesh = Mesh::clone(&scene.parts[0].mesh);
    let middle = mesh
        .positions
        .iter()
        .position(|p| p.abs().max_element() == p.abs().element_sum())
        .expect("a cube of two divisions has a vertex in the middle of each face");
    mesh.positions[middle] *= 0.75;
    scene.parts[0].mesh = Arc::new(mesh);
    scene
}

#[test]
fn a_plan_changes_on_the_clock_of_what_changed() {
    for strategy in all_strategies() {
        let before = plan_of(&scene(), &strategy);
        let clocks = |scene: Scene| differing_clocks(&before, &plan_of(&scene, &strategy));
        assert_eq!(clocks(scene()), [], "{strategy}: nothing changed");
        assert_eq!(clocks(turned(scene())), [Clock::Frame], "{strategy}: view");
        assert_eq!(
            clocks(with_moved_cut(scene()))
                .into_iter()
                .filter(|c| *c != Clock::Frame)
                .collect::<Vec<_>>(),
            [Clock::Cut],
            "{strategy}: cut"
        );
        assert_eq!(
            clocks(with_dented_mesh(scene())),
            [Clock::Solid],
            "{strategy}: mesh"
        );
    }
}

#[test]
fn sprites_are_built_on_the_clock_of_the_solid() {
    let plan = plan_of(&scene(), &strategy("grid:8+vds:64"));
    let sprite_passes: Vec<&Pass> = plan
        .passes
        .iter()
        .filter(|p| p.name.starts_with("sprite"))
        .collect();
    // Clear, count and two layers, of two parts.
    assert_eq!(sprite_passes.len(), 8, "{:?}", passes(&plan));
    for p in &plan.passes {
        let is_sprite = p.name.starts_with("sprite");
        assert_eq!(p.clock == Clock::Solid, is_sprite, "{}", p.name);
        for id in p.writes() {
            let r = plan.resource(id);
            let is_of_solid = r.clock == Clock::Solid;
            assert_eq!(is_of_solid, is_sprite, "{} writes {}", p.name, r.name);
        }
    }
    // Part by part: one more part is built beside the others, which stay as they are.
    let more = scene_of(&["cube?divisions=2", "sphere", "torus"], scene().cuts);
    let more = plan_of(&more, &strategy("grid:8+vds:64"));
    let count = passes(&more)
        .iter()
        .filter(|n| n.starts_with("sprite"))
        .count();
    assert_eq!(count, 12, "{:?}", passes(&more));
}

#[test]
fn slower_clocks_come_first() {
    for strategy in all_strategies() {
        let clocks: Vec<Clock> = plan_of(&scene(), &strategy)
            .passes
            .iter()
            .map(|p| p.clock)
            .collect();
        assert!(clocks.is_sorted(), "{strategy}: {clocks:?}");
    }
}
