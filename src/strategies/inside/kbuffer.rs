//! `kbuffer:K`: of each pixel and part the K nearest fragments, and how many there are (Bavoil et al. 2007).
//!
//! A fragment is offered to the slots of its pixel from the nearest on; each keeps the greater depth-buffer value and offers
//! the other to the next, by one atomic maximum: no lock, no order, no list to lay out. Behind a crossing are all fragments
//! but those in front of it, so that what the near plane cuts off does no harm: it is missing from both numbers. A pass per
//! pixel turns counts and slots into the very words that `mask` writes at once.
//!
//! Per frame: one mesh pass of up to K + 1 atomics a fragment, one reduction, one resolve; 4 (K + 1) bytes per pixel and cut
//! part. Exact, as `mask` is, where no crossing lies behind the K-th fragment of a pixel that has more.
//!
//! Cannot: tell what lies behind the K-th. There it marks the pixel, and the frame reports how many it would have needed; K is
//! the user's number and does not grow by itself.

use crate::passes::Refusal;
use crate::passes::{Inside, NEED_OF_FRAGMENTS, Rasteriser, Recorder, Store, pixels};
use crate::plan::pack::Cascade;
use crate::plan::{Binding, Bounded, Capacities, Clock, Contents, Resource, Role};
use crate::strategies::row::{Abilities, Answers, CapSurface, Facts, InsideTestRow, Parameter};
use crate::strategies::surface;

/// The row of the table.
pub static ROW: InsideTestRow = InsideTestRow {
    facts: Facts {
        name: "kbuffer",
        parameter: Some(Parameter {
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
    answers: Answers::Rays(record),
};

/// Records the frame of a cap surface with `kbuffer:K`.
fn record(
    recorder: &mut Recorder<'_>,
    surface: CapSurface,
    depths: u32,
    rasteriser: Rasteriser,
    capacities: &Capacities,
) -> Result<(), Refusal> {
    let capacity = surface::capacity(recorder, capacities);
    recorder.lay_lanes(capacity);
    let lanes = recorder.relevance.lanes;
    let bytes = pixels(recorder.view.size_px) * 4 * lanes as u64 * u64::from(depths + 1);
    let slots = recorder.once("nearest fragments", |_| {
        Resource::storage("nearest fragments", bytes, Clock::Frame)
    });
    let cascade = Cascade {
        slots: depths,
        lanes: lanes as u32,
        padding: [0; 2],
    };
    let table = recorder.once("cascade", |_| {
        Resource::upload(
            "cascade",
            Role::Uniform,
            Contents::of(&[cascade]),
            Clock::Cut,
        )
    });
    let cascade = Binding::read("cascade", table);
    let store = Store {
        file: "lib/store/cascade.wgsl",
        bindings: vec![Binding::update("slots", slots), cascade.clone()],
    };
    let crossings = surface::list(recorder, surface, capacity, &store, capacities)?;
    recorder.over_mesh(rasteriser, &store, &crossings)?;
    let mask = recorder.reduced_mask();
    let need = recorder.need(Clock::Frame);
    let bindings = vec![
        recorder.frame(),
        recorder.parts(),
        Binding::read("crossing_heads", crossings.heads),
        Binding::read("crossing_z", crossings.z),
        cascade,
        Binding::read("slots", slots),
        Binding::write("mask", mask),
        Binding::update("need", need),
    ];
    recorder.compute(
        "reduce",
        Clock::Frame,
        "counts and nearest depths of a pixel become its words of the mask",
        "strategies/inside/kbuffer/reduce.wgsl",
        bindings,
        vec![
            ("lane_bits", f64::from(recorder.lane_bits)),
            ("need_at", f64::from(NEED_OF_FRAGMENTS)),
        ],
        recorder.view.size_px,
    );
    recorder.plan.bounded.push(Bounded {
        what: "fragments per pixel and part (the K of kbuffer:K)".to_owned(),
        slot: NEED_OF_FRAGMENTS,
        capacity: depths,
        knob: None,
        exact: false,
    });
    recorder.resolve(rasteriser, Inside::mask(mask), &crossings);
    Ok(())
}
