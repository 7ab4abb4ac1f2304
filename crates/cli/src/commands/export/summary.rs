//! What `export` reports for each part as JSON: triangles, volumes, cap areas, open edges.

use cutaway::scene::{Edges, Mesh, Scene, SceneSpace};
use cutaway::slice::{CappedPart, Half, Slicer, planes_of};
use serde_json::{Value, json};

/// Summary of a part.
pub(super) struct ExportSummary {
    pub(super) part: String,
    cuts: Vec<String>,
    /// Open edges of the input part.
    pub(super) open_edges: usize,
    pub(super) kept: HalfFacts,
    removed: HalfFacts,
    /// Area of the section by the part's fill rule; none unless exactly one plane cuts the part.
    section_area: Option<f64>,
    relief_off: f64,
    defects: Vec<String>,
}

/// Summary of one half of a part.
pub(super) struct HalfFacts {
    triangles: usize,
    cap_triangles: usize,
    volume: f64,
    cap_area: f64,
    pub(super) open_edges: usize,
}

impl ExportSummary {
    pub(super) fn of(scene: &Scene, part: &CappedPart, space: &SceneSpace) -> Self {
        let own = &scene.parts[part.part];
        Self {
            part: own.name.clone(),
            cuts: part
                .cuts
                .iter()
                .map(|c| scene.cuts[*c].name.clone())
                .collect(),
            open_edges: open_edges(&own.mesh),
            kept: HalfFacts::of(&part.halves.kept),
            removed: HalfFacts::of(&part.halves.removed),
            section_area: section_area(scene, part, space),
            relief_off: part.relief_off,
            defects: part
                .halves
                .defects
                .iter()
                .map(ToString::to_string)
                .collect(),
        }
    }

    pub(super) fn to_json(&self) -> Value {
        json!({
            "part": self.part, "cuts": self.cuts, "open_edges": self.open_edges,
            "kept": self.kept.to_json(), "removed": self.removed.to_json(), "relief_off": self.relief_off,
            "section_area": self.section_area,
            "defects": self.defects,
        })
    }
}

/// Largest relative excess of cap area over section area that counts as rounding: up to this, both are printed as the same number.
const ROUNDED_AREA: f64 = 1e-5;

impl ExportSummary {
    /// The areas of the caps and of the section, if bodies of the part overlap in the plane and so have separate caps.
    pub(super) fn overlap(&self) -> Option<[f64; 2]> {
        let areas = [self.kept.cap_area, self.section_area?];
        (areas[0] > areas[1] * (1.0 + ROUNDED_AREA)).then_some(areas)
    }
}

fn section_area(scene: &Scene, part: &CappedPart, space: &SceneSpace) -> Option<f64> {
    let [cut] = part.cuts[..] else { return None };
    let part = &scene.parts[part.part];
    let [plane] = planes_of(&scene.cuts[cut], part)?[..] else {
        return None;
    };
    // In scene space, as in `section` and in the cap construction, so that faces in the plane are classified alike.
    let slicer = Slicer::of_part_in(part, space);
    let plane = plane.seen_from(part.bounds_in_world().centre());
    Some(slicer.section_by(&plane, part.fill).area())
}

impl HalfFacts {
    fn of(half: &Half) -> Self {
        Self {
            triangles: half.mesh.triangles.len(),
            cap_triangles: half.mesh.triangles.len() - half.surface_triangles(),
            volume: if half.mesh.triangles.is_empty() {
                0.0
            } else {
                half.mesh.volume()
            },
            cap_area: half.cap_area(),
            open_edges: open_edges(&half.mesh),
        }
    }

    fn to_json(&self) -> Value {
        json!({
            "triangles": self.triangles, "cap_triangles": self.cap_triangles, "volume": self.volume,
            "cap_area": self.cap_area, "open_edges": self.open_edges,
        })
    }
}

fn open_edges(mesh: &Mesh) -> usize {
    Edges::of(&mesh.triangles).count().open
}
