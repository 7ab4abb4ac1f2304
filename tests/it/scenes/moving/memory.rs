//! What a plan says that it takes is what is taken.

use cutaway::Model;
use cutaway::plan::Clock;
use cutaway::scene::ClipSurface;
use cutaway::session::{Outcome, Session};
use cutaway::strategies::Strategy;
use glam::DVec3;

use super::actors::{both, still};
use super::common::{gpu, scenes, strategy};

#[test]
fn a_plan_takes_the_bytes_that_it_says() {
    let plane = ClipSurface::plane(DVec3::ZERO, DVec3::new(0.1, 0.2, -1.0));
    let parts = vec![both(40.0, 0.5), still("torus", DVec3::X)];
    let scene = scenes::of_parts("memory", parts, vec![plane]);
    let model = Model::new(&scene);
    let view = model.prepared.view([50, 40]);
    let mut session = Session::new(gpu());
    let mut all = Strategy::all();
    all.push(strategy("grid:8+vds:64"));
    let mut met = [0; 3];
    for strategy in all {
        let drawn = session.draw(&model, &view, strategy).expect("a frame");
        if matches!(drawn.outcome, Outcome::Refused(_)) {
            continue;
        }
        let plan = session.plan(strategy).expect("a plan").clone();
        for clock in Clock::ALL {
            for (is_scene, said) in [
                (false, plan.bytes_on(clock)),
                (true, plan.scene_bytes_on(clock)),
            ] {
                let taken = session
                    .allocated_on(strategy, clock, is_scene)
                    .expect("bytes");
                assert_eq!(taken, said, "{strategy}, {clock:?}, scene {is_scene}");
                met[clock as usize] += u64::from(taken > 0);
            }
        }
        // The control: a resource that is left out is missed.
        let most = plan.resources.iter().map(|r| r.shape.bytes()).max();
        let total: u64 = Clock::ALL
            .map(|c| plan.bytes_on(c) + plan.scene_bytes_on(c))
            .iter()
            .sum();
        assert!(most.is_some_and(|m| m > 0 && m < total), "{strategy}");
    }
    assert!(met.iter().all(|m| *m > 0), "bytes on every clock: {met:?}");
}
