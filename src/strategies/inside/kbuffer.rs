//! `kbuffer:K`: the K nearest fragments per pixel and part, and the number of fragments (Bavoil et al. 2007).
//!
//! A fragment is offered to its pixel's slots, starting at the nearest; each slot keeps the greater depth-buffer value and passes the other
//! on, by one atomic maximum: no lock, no order, no list to lay out. The fragments behind a crossing are all except those in front, so
//! fragments clipped by the near plane do no harm: they are missing from both numbers. A pass per pixel converts counts and slots into the
//! same words that `mask` writes directly.
//!
//! Per frame: one mesh pass with up to K + 1 atomics per fragment, one reduction, one resolve; 4 (K + 1) bytes per pixel and cut part. As
//! exact as `mask`, except where a crossing lies behind the K-th fragment of a pixel with more fragments.
//!
//! Cannot: decide what lies behind the K-th fragment. It marks such pixels, and the frame reports the K it would have needed; the user
//! chooses K, and it does not grow by itself.

use crate::effects::{FrameOutput, finish};
use crate::passes::{
    Input, Inside, LISTED, Lanes, NEED_OF_FRAGMENTS, Refusal, SceneBuffers, Store, need, over_mesh,
    resolve,
};
use crate::plan::pack::Cascade;
use crate::plan::{Binding, Bounded, BufferRole, Clock, Contents, Pass, Plan, Resource, Work};
use crate::shader::Shader;
use crate::strategies::row::{
    Abilities, CapSurface, InsideTestKind, InsideTestRow, StrategyInfo, StrategyParameter,
};
use crate::strategies::surface;

/// The inside test's row in the strategy table.
pub(crate) static ROW: InsideTestRow = InsideTestRow {
    facts: StrategyInfo {
        name: "kbuffer",
        parameter: Some(StrategyParameter {
            letter: "K",
            about: "fragments of a pixel and part",
            usual: 8,
            least: 1,
            most: 32,
            steps_per_unit: 1,
        }),
        about: "the K nearest fragments of each pixel and part, and their number; marks where more matter",
        limit: "as many layers as it stores",
        rebuilds: "",
        can: Abilities {
            nonzero: false,
            ..Abilities::ALL
        },
        hard_cases: &[("raycast+kbuffer:8", false)],
    },
    answers: InsideTestKind::Rays(record),
};

/// Records the frame of a cap surface with `kbuffer:K`.
fn record(
    plan: &mut Plan,
    input: &Input<'_>,
    surface: CapSurface,
    depths: u32,
) -> Result<FrameOutput, Refusal> {
    let capacity = surface::capacity(input);
    let scene = SceneBuffers::upload(plan, input, Lanes::of_bits(input, capacity))?;
    let lanes = input.active_cuts.lanes;
    let bytes = input.pixel_count() * 4 * lanes as u64 * u64::from(depths + 1);
    let slots = Resource::storage("nearest fragments", bytes, Clock::Frame);
    let slots = plan.add_resource(slots);
    let cascade = Contents::from_values(&[Cascade {
        slots: depths,
        lanes: lanes as u32,
        padding: [0; 2],
    }]);
    let cascade = Resource::upload("cascade", BufferRole::Uniform, cascade, Clock::Cut);
    let cascade = Binding::read("cascade", plan.add_resource(cascade));
    let store = Store {
        file: "lib/store/cascade.wgsl",
        bindings: vec![Binding::update("slots", slots), cascade.clone()],
        rounds: depths,
    };
    let crossings = surface::list(plan, &scene, surface, capacity, &store)?;
    let nearest = over_mesh(plan, &scene, &store, &crossings.asked())?;
    let mask = scene.lanes.reduced_mask(plan, input);
    let need = need(plan, input, Clock::Frame);
    let reduce = Pass::new(
        "reduce",
        "counts and nearest depths of a pixel become its words of the mask",
        Shader::from("strategies/inside/kbuffer/reduce.wgsl").with_all(&LISTED),
        vec![
            scene.frame.clone(),
            scene.parts.clone(),
            Binding::read("crossing_heads", crossings.heads),
            Binding::read("crossing_z", crossings.z),
            cascade,
            Binding::read("slots", slots),
            Binding::write("mask", mask),
            Binding::update("need", need),
        ],
        Work::over(input.view.size_px),
    );
    plan.add_pass(reduce.with_constants(vec![
        scene.lanes.constant(),
        ("need_at", f64::from(NEED_OF_FRAGMENTS)),
    ]));
    plan.bounded.push(Bounded {
        what: "fragments per pixel and part (the K of kbuffer:K)".to_owned(),
        slot: NEED_OF_FRAGMENTS,
        capacity: depths,
        resizes: None,
        exact: false,
    });
    let inside = Inside::mask(mask);
    let layered = resolve(plan, &scene, nearest, inside, &crossings.asked());
    Ok(finish(plan, &scene, layered))
}
