//! Real meshes, where they lie beside the project: every closed part of every file by five cuts.

use cutaway_io::load::load_mesh_file;

use super::*;
use crate::common::data::data;

/// Larger files are cut in two ways only.
const MOST_TRIANGLES: usize = 150_000;

/// Volumes add up to this share of the whole. Faces within 8 steps of f32 of a plane count as in it, and edges that cutting leaves shorter than
/// 2^-25 of the diagonal become points: rims of caps move by as much, 8 / 2^24 of the size at most.
const REAL_VOLUME: f64 = 5e-7;

/// What moving all vertices by the rounding of the largest coordinate makes of a volume: thin walls have an area, and hardly a volume.
fn rounding(mesh: &Mesh) -> f64 {
    let largest = mesh.positions.iter().map(|p| p.abs().max_element());
    f64::EPSILON * largest.fold(0.0, f64::max) * mesh.area()
}

/// The height of the largest face that lies across an axis.
fn largest_face(mesh: &Mesh, axis: usize) -> Option<f64> {
    let mut areas: BTreeMap<u64, f64> = BTreeMap::new();
    for t in 0..mesh.triangles.len() {
        let [a, b, c] = mesh.corners(t);
        if a[axis] == b[axis] && b[axis] == c[axis] {
            *areas.entry(a[axis].to_bits()).or_default() += (b - a).cross(c - a).length();
        }
    }
    let largest = areas.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
    largest.map(|(bits, _)| f64::from_bits(bits))
}

#[test]
fn closed_parts_of_real_meshes_give_closed_halves() {
    let Some(folder) = data() else { return };
    let facts = std::fs::read_to_string(folder.join("facts.json")).expect("it is there");
    let facts: serde_json::Value = serde_json::from_str(&facts).expect("it is JSON");
    let mut checked = 0;
    for facts in facts.as_array().expect("a list") {
        let file = facts["file"].as_str().expect("a name");
        let Ok(loaded) = load_mesh_file(&folder.join(file)) else {
            continue;
        };
        for part in loaded.parts {
            let mesh = &part.mesh;
            if !mesh.open_edges().is_empty() {
                continue;
            }
            let bounds = mesh.bounds();
            let vertex = mesh.positions[mesh.positions.len() / 2];
            let face = (0..3).find_map(|axis| Some((axis, largest_face(mesh, axis)?)));
            let (axis, at) = face.unwrap_or((1, vertex.y));
            let mut cuts = cuts(&bounds);
            cuts.retain(|(name, _)| {
                !["a box within", "a wide wedge", "boxes that touch"].contains(name)
            });
            cuts.insert(
                0,
                (
                    "a plane in a face or through a vertex",
                    vec![vec![plane(vertex.with_y(at), DVec3::Y)]],
                ),
            );
            let mut through = vertex;
            through[axis] = at;
            cuts[0].1 = vec![vec![plane(through, DVec3::AXES[axis])]];
            let most = if mesh.triangles.len() > MOST_TRIANGLES {
                2
            } else {
                cuts.len()
            };
            for (cut, regions) in &cuts[..most] {
                let what = format!("{file}, {}: {cut}", part.name);
                let halves = halves(mesh, regions);
                for half in [&halves.kept, &halves.removed] {
                    assert!(half.mesh.open_edges().is_empty(), "{what}: open edges");
                }
                if !is_oriented(mesh) {
                    continue;
                }
                for half in [&halves.kept, &halves.removed] {
                    assert!(is_oriented(&half.mesh), "{what}: edges without opposites");
                }
                let bound = REAL_VOLUME * mesh.volume().abs();
                let lost = lost(mesh, &halves).abs();
                assert!(
                    lost <= bound.max(rounding(mesh)),
                    "{what}: {lost:e} of {}",
                    mesh.volume()
                );
                checked += 1;
            }
        }
    }
    assert!(checked > 250, "only {checked} cuts were looked at");
}
