//! How long it takes to say what a frame needs: the work of the CPU in every frame of a still scene, before the device begins.
//!
//! The plan of the crank halved by a plane and by a relief, for strategies that need few passes and many; and what is done once
//! for a scene, its meshes made ready for the device.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use cutaway::passes::Model;
use cutaway::plan::Capacities;
use cutaway::strategies::{self, Strategy};

#[path = "common/crank.rs"]
mod crank;

const STRATEGIES: [&str; 4] = [
    "raycast+mask",
    "raycast+abuffer",
    "adaptive:0.5+mask",
    "grid:256+vds:1024",
];

fn planning(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("planning");
    for (cut, scene) in crank::scenes() {
        group.bench_function(BenchmarkId::new("scene", cut), |b| {
            b.iter(|| Model::new(black_box(&scene)));
        });
        let model = Model::new(&scene);
        let view = model.prepared.view([1024, 768]);
        for name in STRATEGIES {
            let strategy: Strategy = name.parse().expect("a strategy that is built");
            let plan = strategies::plan(&model, &view, strategy, &Capacities::UNKNOWN)
                .expect("a scene that it draws");
            assert!(plan.passes.len() > 2, "{name} plans {:?}", plan.passes);
            group.bench_function(BenchmarkId::new(name, cut), |b| {
                b.iter(|| {
                    strategies::plan(&model, black_box(&view), strategy, &Capacities::UNKNOWN)
                });
            });
        }
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = planning
}
criterion_main!(benches);
