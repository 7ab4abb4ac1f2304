//! How long a section takes: making a mesh ready, and cutting it again where the plane has moved.
//!
//! The mesh is a torus whose tube is ribbed along and around, of 100 thousand or a million triangles, cut by an oblique plane
//! that moves a little every time. Everything is included: points, loops and triangles of the region.

#[path = "common/meshes.rs"]
mod meshes;

use std::f64::consts::TAU;
use std::hint::black_box;
use std::sync::Arc;

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use cutaway::scene::ClipSurface;
use cutaway::slice::{SlicePlane, Slicer};
use glam::DVec3;

/// A plane that is another one at every step.
fn plane(step: u32) -> SlicePlane {
    let at = 0.1 * (TAU * f64::from(step) * 0.618_034).sin();
    let surface = ClipSurface::plane(DVec3::splat(at), DVec3::new(0.31, 0.2, 1.0));
    SlicePlane::from(&surface)
}

fn slicing(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("slicing");
    for (name, around, along) in [("100k", 500, 100), ("1M", 2000, 250)] {
        let mesh = meshes::ribbed_torus(around, along);
        let (positions, triangles) = (Arc::new(mesh.positions), mesh.triangles);
        let slicer = Slicer::new(Arc::clone(&positions), &triangles);
        let section = slicer.section(&plane(0));
        assert!(section.is_whole(), "{:?}", section.defects);
        println!(
            "{name}: {} points, {} loops, {} triangles in the section",
            section.points.len(),
            section.loops.len(),
            section.triangles.len()
        );
        group.bench_function(BenchmarkId::new("first", name), |b| {
            let input = || Arc::clone(&positions);
            b.iter_batched(
                input,
                |positions| Slicer::new(positions, &triangles).section(&plane(0)),
                BatchSize::LargeInput,
            );
        });
        group.bench_function(BenchmarkId::new("moved", name), |b| {
            let mut step = 0;
            b.iter(|| {
                step += 1;
                slicer.section(black_box(&plane(step)))
            });
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = slicing
}
criterion_main!(benches);
