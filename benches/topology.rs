//! How long it takes to say whether a mesh is closed: edges, components and extents, as `cutaway inspect` tells them.

#[path = "common/meshes.rs"]
mod meshes;

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use cutaway::scene::Topology;

fn topology(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("topology");
    for (name, around, along) in [("10k", 100, 50), ("200k", 500, 200), ("1M", 2000, 250)] {
        let mesh = meshes::ribbed_torus(around, along);
        assert!(Topology::new(&mesh).closed, "a torus is closed");
        group.throughput(Throughput::Elements(mesh.triangles.len() as u64));
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| Topology::new(black_box(&mesh)));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = topology
}
criterion_main!(benches);
