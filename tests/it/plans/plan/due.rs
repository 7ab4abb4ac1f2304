//! Which passes a change of the plan makes due, without a device.

use cutaway::plan::{Contents, Limits};
use cutaway::scene::{JointWeight, Motion};

use super::*;

fn two_sprites() -> (Scene, Model) {
    let mut scene = scene_of(&["cube?divisions=2", "sphere"], vec![planes(0.1, 1)]);
    scene.stage = Some(scene.bounds());
    let model = Model::new(&scene);
    (scene, model)
}

fn plan_of_model(model: &Model) -> Plan {
    let view = model.prepared.view(SIZE);
    let plan = strategies::plan(
        model,
        &view,
        strategy("grid:8+vds:64"),
        &Capacities::UNKNOWN,
    );
    plan.unwrap_or_else(|e| panic!("{e}"))
}

/// Passes of slower clocks that are due after another plan, where storage of these names is new.
fn due(plan: &Plan, before: &Plan, remade: &[&str]) -> Vec<String> {
    let due = plan.due_after(before, |r| remade.contains(&r.name.as_str()));
    let slow = plan.passes.iter().filter(|p| p.clock != Clock::Frame);
    slow.filter(|p| due.passes.contains(&p.name))
        .map(|p| p.name.clone())
        .collect()
}

fn sprite(number: u32) -> Vec<String> {
    let passes = ["clear", "count", "peel"].map(|what| format!("sprite {what} {number}"));
    let [clear, count, peel] = passes;
    vec![clear, count, format!("{peel}.0"), format!("{peel}.1")]
}

#[test]
fn an_unchanged_plan_owes_its_frame_alone() {
    let (_, model) = two_sprites();
    let plan = plan_of_model(&model);
    assert_eq!(due(&plan, &plan, &[]), Vec::<String>::new(), "unchanged");
    let all = plan.due_after(&Plan::default(), |_| true);
    assert_eq!(all.passes.len(), plan.passes.len(), "all of a first plan");
}

#[test]
fn a_moved_part_owes_its_own_sprite() {
    let (mut scene, model) = two_sprites();
    let mut before = plan_of_model(&model);
    let mut model = model;
    for (step, part) in [0, 1, 0, 0, 1].into_iter().enumerate() {
        scene.parts[part].world_from_part.translation.z += 0.01;
        model = model.updated(&scene);
        let plan = plan_of_model(&model);
        let mut expected = vec![format!("place {part}")];
        expected.extend(sprite(part as u32));
        // The buffer of all vertices is made anew when a part begins to move.
        assert_eq!(due(&plan, &before, &[]), expected, "step {step}");
        before = plan;
    }
}

#[test]
fn scratch_that_is_shared_is_filled_again_by_who_reads_it() {
    let (_, model) = two_sprites();
    let plan = plan_of_model(&model);
    // Another table for the second sprite: its passes count from zero again, though clearing does not depend on the mesh.
    let mut changed = plan.clone();
    let id = changed.resource_named("sprite 1").expect("the table");
    changed.resources[id.0].contents = Some(Contents::from_values(&[7_u32; 16]));
    assert_eq!(due(&changed, &plan, &[]), sprite(1), "its table");
    // A pass that is another by itself takes along who filled what it reads, and who reads what it writes.
    let mut changed = plan.clone();
    let count = changed
        .passes
        .iter_mut()
        .find(|p| p.name == "sprite count 1");
    count.expect("the pass").constants.push(("planted", 1.0));
    // Counting clears the first layer: it is peeled again, and what was peeled behind it.
    assert_eq!(due(&changed, &plan, &[]), sprite(1), "its counting");
    // Layers that were made anew hold nothing.
    let peeled = due(&plan, &plan, &["sprite layers 0"]);
    assert_eq!(peeled, sprite(0), "layers made anew");
}

#[test]
fn passes_are_told_apart_by_what_they_do() {
    let (_, model) = two_sprites();
    let plan = plan_of_model(&model);
    let mut renumbered = plan.clone();
    // The same resources in another order: ids differ, names do not.
    let extra = plan_of_model(&two_sprites().1);
    renumbered.resources.insert(0, extra.resources[0].clone());
    renumbered.resources[0].name = "unused".to_owned();
    let shifted = |id: cutaway::plan::ResourceId| cutaway::plan::ResourceId(id.0 + 1);
    for pass in &mut renumbered.passes {
        pass.bindings
            .iter_mut()
            .for_each(|b| b.resource = shifted(b.resource));
        if let Work::Draw {
            color,
            depth,
            vertices,
            indices,
            ..
        } = &mut pass.work
        {
            if let Some(c) = color {
                c.resource = shifted(c.resource);
            }
            depth.resource = shifted(depth.resource);
            *indices = shifted(*indices);
            if let cutaway::plan::Vertices::Mesh(v) = vertices {
                *v = shifted(*v);
            }
        }
    }
    assert_eq!(
        due(&renumbered, &plan, &[]),
        Vec::<String>::new(),
        "renumbered"
    );
    // The control: one that reads another resource under the same name is another.
    let other = renumbered.resource_named("sprite 0").expect("a table");
    let peel = renumbered
        .passes
        .iter_mut()
        .find(|p| p.name == "sprite peel 1.1");
    peel.expect("the pass").bindings[0].resource = other;
    assert_eq!(
        due(&renumbered, &plan, &[]),
        ["sprite peel 1.1"],
        "another table"
    );
}

#[test]
fn a_part_that_never_moves_has_no_pass_for_it() {
    let (mut scene, _) = two_sprites();
    // It could move, but stands at rest.
    let positions = scene.parts[0].mesh.positions.len();
    scene.parts[0].motion = Some(Arc::new(Motion {
        first_pull: (0..=positions as u32).collect(),
        pulls: vec![
            JointWeight {
                joint: 0,
                weight: 1.0
            };
            positions
        ],
        ..Motion::default()
    }));
    let plan = plan_of(&scene, &Strategy::RAYCAST_MASK);
    let named = |plan: &Plan| passes(plan).iter().any(|n| n.starts_with("place"));
    assert!(!named(&plan), "{:?}", passes(&plan));
    scene.parts[0].pose.joints = vec![DAffine3::from_translation(DVec3::Y * 0.1)];
    let plan = plan_of(&scene, &Strategy::RAYCAST_MASK);
    assert!(named(&plan), "the control: {:?}", passes(&plan));
    assert_eq!(plan.check(&Limits::CORE).map_err(|e| e.to_string()), Ok(()));
}
