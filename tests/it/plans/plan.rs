//! A plan is the minimum for its scene, keeps its own rules and the limits of core WebGPU, and reads as text. No adapter.
//!
//! Only `plan/session.rs` and `plan/bands.rs` draw: they hold the clocks of a plan, and its limits, to what a session does.

use std::collections::BTreeSet;
use std::sync::Arc;

use cutaway::Model;
use cutaway::generate::shapes;
use cutaway::plan::{Capacities, Clock, Limits, Pass, Plan, Work};
use cutaway::scene::{ClipSurface, Cut, OffsetMap, Scene, Wrap};
use cutaway::strategies::{self, Strategy};
use glam::{DAffine3, DVec3};

mod bands;
mod clocks;
mod cut_box;
mod due;
mod golden;
mod minimum;
mod pyramids;
mod rules;
mod session;
mod stencil;
mod strips;

const SIZE: [u32; 2] = [320, 200];

/// What a device with a stencil beside 32 bits of depth offers.
const WITH_STENCIL: Limits = Limits {
    depth32_stencil8: true,
    ..Limits::CORE
};

/// The scene of some shapes, each beside the one before.
fn scene_of(specs: &[&str], cuts: Vec<Cut>) -> Scene {
    let mut parts = Vec::new();
    for (i, spec) in specs.iter().enumerate() {
        for mut part in shapes::shape(spec).unwrap_or_else(|e| panic!("{e}")) {
            part.world_from_part = DAffine3::from_translation(DVec3::X * 3.0 * i as f64);
            part.name = format!("{} {i}", part.name);
            parts.push(part);
        }
    }
    Scene {
        parts,
        cuts,
        ..Scene::default()
    }
}

/// A cut by planes through a point of the z axis, turned about it one by one.
fn planes(z: f64, count: usize) -> Cut {
    let surfaces = (0..count).map(|i| {
        let tilt = 0.1 * i as f64;
        ClipSurface::plane(DVec3::Z * z, DVec3::new(tilt, 0.0, 1.0))
    });
    Cut::new(format!("{count} planes"), surfaces.collect())
}

fn map(heights: &[f32]) -> Arc<OffsetMap> {
    let width = heights.len() as u32 / 2;
    Arc::new(OffsetMap::new([width, 2], heights.to_vec()).expect("finite heights"))
}

/// A cut by reliefs of 4 x 2 texels.
fn reliefs(z: f64, count: usize) -> Cut {
    let map = map(&[0.0, 1.0, 0.25, 0.75, 0.5, 0.0, 1.0, 0.25]);
    let mut cut = planes(z, count);
    for surface in &mut cut.surfaces {
        surface.relief = Some(map.clone());
        surface.scale.z = 0.125;
    }
    cut.name = format!("{count} reliefs");
    cut
}

fn strategy(name: &str) -> Strategy {
    name.parse().unwrap_or_else(|e| panic!("{e}"))
}

/// The strategies that are built and draw cuts of every kind, with small parameters as well as the usual.
fn all_strategies() -> Vec<Strategy> {
    let mut all = Strategy::all();
    all.retain(|s| ![Strategy::STENCIL, Strategy::PLANAR].contains(s));
    all.push(strategy("grid:8+vds:64"));
    all
}

fn plan_at(scene: &Scene, strategy: &Strategy, size: [u32; 2]) -> Plan {
    let model = Model::new(scene);
    let view = model.prepared.view(size);
    strategies::plan(&model, &view, strategy, &Capacities::UNKNOWN)
        .unwrap_or_else(|e| panic!("{e}"))
}

fn plan_of(scene: &Scene, strategy: &Strategy) -> Plan {
    plan_at(scene, strategy, SIZE)
}

fn passes(plan: &Plan) -> Vec<&str> {
    plan.passes.iter().map(|p| p.name.as_str()).collect()
}

fn resources(plan: &Plan) -> BTreeSet<&str> {
    plan.resources.iter().map(|r| r.name.as_str()).collect()
}

fn pass<'a>(plan: &'a Plan, name: &str) -> &'a Pass {
    let found = plan.passes.iter().find(|p| p.name == name);
    found.unwrap_or_else(|| panic!("no pass `{name}` among {:?}", passes(plan)))
}

/// Instances that a pass draws.
fn drawn(pass: &Pass) -> Vec<u32> {
    match &pass.work {
        Work::Draw { draws, .. } => draws.iter().map(|d| d.instance).collect(),
        Work::Compute { .. } | Work::ComputeIndirect { .. } => {
            panic!("{} draws nothing", pass.name)
        }
    }
}

/// The clocks on which two plans differ: in what is uploaded, in what there is, or in the passes.
fn differing_clocks(a: &Plan, b: &Plan) -> Vec<Clock> {
    let of = |plan: &Plan, clock: Clock| {
        let resources: Vec<_> = plan
            .resources
            .iter()
            .filter(|r| r.clock == clock)
            .cloned()
            .collect();
        let passes: Vec<_> = plan
            .passes
            .iter()
            .filter(|p| p.clock == clock)
            .cloned()
            .collect();
        (resources, passes)
    };
    Clock::ALL
        .into_iter()
        .filter(|clock| of(a, *clock) != of(b, *clock))
        .collect()
}

/// The wrap mode that a flat map must not care about.
const ANY_WRAP: Wrap = Wrap::Mirror;
