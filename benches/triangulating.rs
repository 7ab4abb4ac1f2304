//! How long it takes to fill an outline: walls of a known outline are cut across, so that outline is all of the section.
//!
//! Cutting the walls is part of it; they are few next to what the constrained Delaunay triangulation does. Outlines: a star of
//! many points; islands in holes in islands, which decide nothing before all is triangulated; and a star polygon whose edges all
//! cross near its middle, so that the fill has to cut them first.

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use cutaway::scene::{ClipSurface, Fill};
use cutaway::slice::{SlicePlane, Slicer};
use glam::{DVec2, DVec3};

type Loops = Vec<Vec<DVec2>>;

/// Walls without lids from z = -1 to 1 over closed loops, the solid on the left of counter-clockwise ones.
fn walls(loops: &Loops) -> Slicer {
    let (mut positions, mut triangles): (Vec<DVec3>, Vec<[u32; 3]>) = (Vec::new(), Vec::new());
    for points in loops {
        let first = u32::try_from(positions.len()).expect("a small mesh");
        let count = u32::try_from(points.len()).expect("a small mesh");
        for p in points {
            positions.extend([p.extend(-1.0), p.extend(1.0)]);
        }
        for i in 0..count {
            let [a, b] = [i, (i + 1) % count].map(|k| first + 2 * k);
            triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
        }
    }
    Slicer::new(positions, &triangles)
}

/// A loop that goes in and out `points` times.
fn star(points: u32) -> Loops {
    let corner = |i: u32| {
        let radius = if i.is_multiple_of(2) { 1.0 } else { 0.6 };
        DVec2::from_angle(TAU * f64::from(i) / f64::from(2 * points)) * radius
    };
    vec![(0..2 * points).map(corner).collect()]
}

/// `side` x `side` squares in the unit square, each with a hole, each hole with an island.
fn islands(side: u32) -> Loops {
    let square = |middle: DVec2, half: f64, is_hole: bool| {
        let mut corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| (middle + DVec2::new(x, y) * half) / f64::from(side));
        if is_hole {
            corners.reverse();
        }
        corners.to_vec()
    };
    let cells = (0..side).flat_map(|i| (0..side).map(move |j| DVec2::new(i.into(), j.into())));
    cells
        .flat_map(|c| {
            [
                square(c, 0.4, false),
                square(c, 0.3, true),
                square(c, 0.2, false),
            ]
        })
        .collect()
}

/// The star polygon of an odd number of points, each joined to the one almost opposite.
fn crossing(points: u32) -> Loops {
    let corner = |i: u32| {
        let at = i * (points / 2) % points;
        DVec2::from_angle(TAU * f64::from(at) / f64::from(points))
    };
    vec![(0..points).map(corner).collect()]
}

fn triangulating(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("triangulating");
    let plane = SlicePlane::from(&ClipSurface::plane(
        DVec3::Z * 0.1,
        DVec3::new(0.02, 0.01, 1.0),
    ));
    for (name, loops) in [
        ("star/1k", star(250)),
        ("star/4k", star(1_000)),
        ("islands/1k", islands(19)),
        ("islands/4k", islands(38)),
        ("crossing/25", crossing(25)),
    ] {
        let slicer = walls(&loops);
        let section = slicer.section_by(&plane, Fill::EvenOdd);
        assert!(section.is_whole(), "{name}: {:?}", section.defects);
        println!(
            "{name}: {} points, {} loops, {} triangles",
            section.points.len(),
            section.loops.len(),
            section.triangles.len()
        );
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| slicer.section_by(black_box(&plane), Fill::EvenOdd));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = triangulating
}
criterion_main!(benches);
