//! How long the reference takes: every pixel of a small picture of the crank, halved by a plane and by a relief, in f64 on all
//! processors.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use cutaway::layers::Kind;
use cutaway::scene::Prepared;
use cutaway_lab::exact;

#[path = "common/crank.rs"]
mod crank;

const SIZE_PX: [u32; 2] = [256, 192];

fn reference(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("exact");
    for (cut, scene) in crank::scenes() {
        let prepared = Prepared::new(&scene);
        let view = prepared.view(SIZE_PX);
        let found = exact::evaluate(&prepared, &view);
        let cap_px = found.layers.count(Kind::Cap);
        assert!(cap_px > 1000, "only {cap_px} pixels show the cap");
        group.throughput(Throughput::Elements((SIZE_PX[0] * SIZE_PX[1]).into()));
        group.bench_function(BenchmarkId::from_parameter(cut), |b| {
            b.iter(|| exact::evaluate(black_box(&prepared), &view));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = reference
}
criterion_main!(benches);
