//! Plane sections of a mesh as polygons, without a graphics card: areas, outlines and holes.
//!
//! `cargo run --example slice`

use std::sync::Arc;

use cutaway::generate::shapes::shape;
use cutaway::scene::{ClipSurface, Fill};
use cutaway::slice::{SlicePlane, Slicer};

fn main() -> cutaway::Result<()> {
    for (percent, area, loops) in slices()? {
        println!("z = {percent:2} %: area {area:.4} in {loops} loops");
    }
    Ok(())
}

/// At some heights, in percent of the box of a gear wheel: area in square units of the mesh, and number of loops.
pub(crate) fn slices() -> cutaway::Result<Vec<(u32, f64, usize)>> {
    let gear = &shape("gears")?[0];
    let bounds = cutaway::scene::Bounds::from_points(gear.mesh.positions.iter().copied());
    // Built once: a section then costs about what the plane meets.
    let positions = Arc::new(gear.mesh.positions.clone());
    let slicer = Slicer::new(positions, &gear.mesh.triangles);
    let mut found = Vec::new();
    for percent in [10, 50, 90] {
        let surface = ClipSurface::parse(&format!("z={percent}%"), &bounds)?;
        let section = slicer.section_by(&SlicePlane::from(&surface), Fill::EvenOdd);
        assert!(section.is_whole(), "{:?}", section.defects);
        found.push((percent, section.area(), section.loops.len()));
    }
    Ok(found)
}
