//! Sheets: clip-surfaces drawn as triangles only to learn where rays cross them. What they cost a plan, what the pass that merges
//! them makes of the fragments of a pixel, and that every inside test finds the same by one list.

use crate::common;

mod images;
mod merge;
mod overflow;
mod plans;
mod sides;

use cutaway::gpu::{ClockSet, Program};
use cutaway::layers::Layers;
use cutaway::plan::{Capacities, Plan};
use cutaway::scene::{Cut, Part, Scene};
use cutaway::strategies;
use glam::{DAffine3, DVec3};

use common::{Question, meshes, scenes, session, strategy};

const SIZE: [u32; 2] = [96, 72];

/// A ring under a rough relief.
fn ring() -> Scene {
    let mut scene = scenes::of_parts("ring", meshes::parts("torus?segments=40&sides=20"), vec![]);
    let rough = scenes::relief(
        &scene,
        "-0.3,-1,-0.2@50%,50%,50%",
        "fractal:size=64,amplitude=12%",
    );
    scene.cuts = vec![Cut::new("cut", vec![rough])];
    scene
}

/// Three balls in a row, cut by two reliefs or a plane.
fn row() -> Scene {
    let parts = (0..3).map(|i| {
        let mut part = Part::new(format!("ball {i}"), meshes::shape("sphere?subdivisions=2"));
        part.world_from_part = DAffine3::from_translation(DVec3::X * 0.7 * f64::from(i));
        part
    });
    let mut scene = scenes::of_parts("row", parts.collect(), Vec::new());
    let waves = scenes::relief(&scene, "-z=55%", "waves:size=16,amplitude=8%");
    let rough = scenes::relief(
        &scene,
        "-0.2,-1,0.1@50%,40%,50%",
        "fractal:size=32,amplitude=6%",
    );
    let plane = scenes::sectioned("sphere?subdivisions=2", &["-1,-0.2,0.1@20%,50%,50%"]);
    scene.cuts = vec![
        Cut::new("both", vec![waves, rough]),
        Cut::new("plane", plane.cuts[0].surfaces.clone()),
    ];
    scene.camera = scenes::orbit(70.0, 25.0, false);
    scene
}

/// A plan with room for all.
fn roomy(question: &Question, name: &str) -> Plan {
    let capacities = Capacities {
        crossings: Some(31),
        fragments: Some(200_000),
        sheets: Some(200_000),
        ..Capacities::UNKNOWN
    };
    plan_with(question, name, &capacities)
}

fn plan_with(question: &Question, name: &str, capacities: &Capacities) -> Plan {
    let strategy = strategy(name);
    strategies::plan(&question.model, &question.view, strategy, capacities)
        .unwrap_or_else(|e| panic!("{e}"))
}

/// What a program that was run for a plan left in some buffers, and its layers.
fn run(plan: Plan, size_px: [u32; 2], buffers: &[&str]) -> (Layers, Vec<Vec<u32>>) {
    let session = session();
    let gpu = session.gpu();
    let mut program = Program::default();
    program.load(gpu, plan).unwrap_or_else(|e| panic!("{e}"));
    (program.run(gpu, ClockSet::ALL)).unwrap_or_else(|e| panic!("{e}"));
    let layers = program
        .layers(gpu, size_px)
        .unwrap_or_else(|e| panic!("{e}"));
    let words = (buffers.iter())
        .map(|b| program.words(gpu, b).unwrap_or_else(|e| panic!("{e}")))
        .collect();
    (layers, words)
}
