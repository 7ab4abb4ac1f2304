//! Meshes that others made (see `real_meshes.rs`), cut obliquely: closed ones leave nothing open, their fills are what their
//! loops enclose, and the areas within loops add up to the volume.
//!
//! `cargo test -p cutaway-tests --test it areas -- --nocapture` prints a line per section that `experiments/peers/section_areas.py` takes.

use cutaway::scene::{Fill, Mesh, Topology};
use cutaway_io::load::load_mesh_file;
use glam::DVec3;

use crate::common::shares::{Share, in_shares};
use crate::meshes::slice::closed_forms::volume_by_areas;
use crate::meshes::slice::data::data;
use crate::meshes::slice::lines::fault;
use crate::meshes::slice::meshes::without;
use crate::meshes::slice::{plane, slicer};

const NORMALS: [DVec3; 3] = [
    DVec3::new(-0.3, -0.25, -1.0),
    DVec3::new(0.9, 0.1, 0.42),
    DVec3::new(0.2, 1.0, -0.33),
];

/// Closed meshes of all files, with the names of the files.
fn closed(folders: &[&str]) -> Vec<(String, Mesh)> {
    let Some(data) = data() else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for folder in folders {
        let entries = std::fs::read_dir(data.join(folder)).expect("a folder of meshes");
        let mut files: Vec<_> = entries.map(|e| e.expect("an entry").path()).collect();
        files.sort();
        for file in files {
            for part in load_mesh_file(&file).expect("a mesh that loads").parts {
                if Topology::new(&part.mesh).closed {
                    let name = file.file_name().unwrap_or_default().to_string_lossy();
                    found.push((format!("{folder}/{name}"), Mesh::clone(&part.mesh)));
                }
            }
        }
    }
    assert!(found.len() > 5, "only {} closed meshes", found.len());
    found
}

#[test]
fn areas_of_closed_meshes_are_what_their_loops_enclose() {
    for (name, mesh) in closed(&["cad", "organic", "assembly", "messy", "dense", "large"]) {
        let slicer = slicer(&mesh);
        let bounds = mesh.bounds();
        for normal in NORMALS {
            for share in [0.31, 0.5, 0.73] {
                let origin = bounds.min + bounds.size() * share;
                let plane = plane(origin, normal);
                for rule in [Fill::EvenOdd, Fill::Nonzero] {
                    let section = slicer.section_by(&plane, rule);
                    let label = format!("{name} at {share} of {normal} {rule:?}");
                    assert!(section.is_whole(), "{label}: {:?}", section.defects);
                    assert_eq!(fault(&section, rule), None, "{label}");
                    if rule == Fill::EvenOdd {
                        let [p, n] = [plane.origin, plane.frame.normal];
                        println!(
                            "section {name} {} {} {} {} {} {} {} {}",
                            p.x,
                            p.y,
                            p.z,
                            n.x,
                            n.y,
                            n.z,
                            section.area(),
                            section.perimeter()
                        );
                    }
                }
            }
        }
    }
}

in_shares!(areas_within_loops_add_up_to_the_volume, 2);

fn areas_within_loops_add_up_to_the_volume(share: Share) {
    let mut exactly = 0;
    let all = closed(&["cad", "organic", "assembly", "dense", "large"]);
    for (name, mesh) in share.part(all) {
        if Topology::new(&mesh).inconsistent_edges > 0 {
            continue;
        }
        let volume = mesh.volume();
        let normal = NORMALS[0].normalize();
        let sum = |mesh: &Mesh, slabs: Option<u32>| {
            let slicer = slicer(mesh);
            let area = |at| {
                let section = slicer.section(&plane(at, normal));
                let within = section.loops.iter().map(|l| section.loop_area(l));
                within.sum::<f64>()
            };
            let Some(slabs) = slabs else {
                return volume_by_areas(mesh, normal, area);
            };
            let heights = mesh.positions.iter().map(|p| p.dot(normal));
            let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
                (l.min(x), h.max(x))
            });
            let step = (high - low) / f64::from(slabs);
            let at = |i: u32| area(normal * (low + step * (f64::from(i) + 0.5)));
            step * (0..slabs).map(at).sum::<f64>()
        };
        let is_small = mesh.positions.len() < 800;
        exactly += usize::from(is_small);
        let (slabs, tolerance) = if is_small {
            (None, 1e-8)
        } else {
            (Some(160), 3e-3)
        };
        let by_areas = sum(&mesh, slabs);
        let off = (by_areas - volume).abs() / volume.abs();
        println!("{name}: {volume} by faces, {by_areas} by areas: off by {off:.1e}");
        assert!(off < tolerance, "{name}: {volume} {by_areas}");
        if is_small {
            let open = sum(&without(&mesh, 0), slabs);
            let off = (open - volume).abs() / volume.abs();
            assert!(off > tolerance, "{name}: planted: {open}");
        }
    }
    assert!(exactly > 0 || data().is_none(), "no mesh is small");
}
