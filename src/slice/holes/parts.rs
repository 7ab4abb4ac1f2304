//! Closes the holes of parts, and reports their number, positions and sizes.

use std::sync::Arc;

use glam::DVec3;

use super::{
    Closing, Hole, HoleDefect, MOST_EDGES, SMALL_EDGES, SMALL_SHARE, box_of, close_holes, perimeter,
};
use crate::error::Diagnostic;
use crate::scene::memo::Memo;
use crate::scene::meshes::weld::thousands;
use crate::scene::units::numbers::round;
use crate::scene::{FilledPart, GeometryId, Part};

/// Code of the notes on closed holes.
const CLOSED_HOLES: &str = "closed-holes";

/// Maximum holes reported individually, per kind and part.
const MOST_TOLD: usize = 4;

/// Maximum parts reported individually.
const MOST_PARTS_TOLD: usize = 16;

/// Closes the planar and small holes of parts, and returns notes about them. Parts that share a mesh share the result; closed parts
/// are unchanged.
pub fn close_holes_of<'a>(parts: impl IntoIterator<Item = &'a mut Part>) -> Vec<Diagnostic> {
    let known: Memo<GeometryId, Arc<(Closing, Option<FilledPart>)>> = Memo::default();
    let mut notes = Vec::new();
    let (mut untold, mut holes, mut closed) = (0, 0, 0);
    for part in parts {
        let closed_part = known.get_or_make(GeometryId::of(part), |_| {
            let closing = close_holes(&part.mesh);
            let triangles = Some(&closing.triangles).filter(|t| !t.is_empty());
            let grown = triangles.map(|triangles| FilledPart::of(part, triangles));
            Arc::new((closing, grown))
        });
        let (closing, grown) = &*closed_part;
        let Some(note) = note(part, closing) else {
            continue;
        };
        if notes.len() < MOST_PARTS_TOLD {
            notes.push(note);
        } else {
            untold += 1;
            holes += closing.holes.len();
            closed += closing.closed();
        }
        if let Some(grown) = grown {
            grown.apply(part);
        }
    }
    if untold > 0 {
        let text = format!("closed {} of {} holes", thousands(closed), thousands(holes));
        let parts = format!("{} more parts", thousands(untold));
        notes.push(Diagnostic::note(CLOSED_HOLES, text).about(parts));
    }
    notes
}

impl Closing {
    fn closed(&self) -> usize {
        self.holes.iter().filter(|h| h.defect.is_none()).count()
    }
}

/// Note about a part if it is open.
fn note(part: &Part, closing: &Closing) -> Option<Diagnostic> {
    let note = |text: String| Diagnostic::note(CLOSED_HOLES, text).about(&part.name);
    let loose = match closing.loose_edges {
        0 => String::new(),
        edges => format!("; {} open edges belong to no hole", thousands(edges)),
    };
    if closing.holes.is_empty() {
        return (closing.loose_edges > 0).then(|| note(format!("closed no hole{loose}")));
    }
    let (all, closed) = (closing.holes.len(), closing.closed());
    let mut text = format!(
        "closed {} of {} {} with {} triangles",
        thousands(closed),
        thousands(all),
        if all == 1 { "hole" } else { "holes" },
        thousands(closing.triangles.len())
    );
    let place = |hole: &&Hole| HolePlace::of(part, hole);
    let closed = closing.holes.iter().filter(|h| h.defect.is_none());
    text.push_str(&list(": ", closed.map(|h| place(&h)).collect()));
    for why in [
        HoleDefect::Large,
        HoleDefect::Folded,
        HoleDefect::Crossing,
        HoleDefect::Taken,
    ] {
        let left = closing.holes.iter().filter(|h| h.defect == Some(why));
        let left: Vec<HolePlace> = left.map(|h| place(&h)).collect();
        if !left.is_empty() {
            text.push_str(&list(&format!("; left open, {why}: "), left));
        }
        if why == HoleDefect::Large && closing.holes.iter().any(|h| h.defect == Some(why)) {
            text.push_str(&format!(
                " (small: at most {SMALL_EDGES} edges, or at most {MOST_EDGES} edges and a perimeter of {} % of the model's diagonal)",
                round(100.0 * SMALL_SHARE)
            ));
        }
    }
    text.push_str(&loose);
    Some(note(text))
}

/// Position of a hole in the world, and its size.
struct HolePlace {
    edges: usize,
    around: f64,
    middle: DVec3,
}

impl HolePlace {
    fn of(part: &Part, hole: &Hole) -> Self {
        let at = |i: &u32| {
            let p = part.mesh.positions[*i as usize];
            part.world_from_part.transform_point3(p)
        };
        let points: Vec<DVec3> = hole.vertices.iter().map(at).collect();
        Self {
            edges: points.len(),
            around: perimeter(&points),
            middle: box_of(&points).centre(),
        }
    }
}

/// The holes with the largest perimeters, and the number of the others.
fn list(before: &str, mut places: Vec<HolePlace>) -> String {
    if places.is_empty() {
        return String::new();
    }
    places.sort_by(|a, b| b.around.total_cmp(&a.around));
    let told: Vec<String> = (places.iter().take(MOST_TOLD))
        .map(|p| {
            let [x, y, z] = p.middle.to_array().map(round);
            format!(
                "{} edges, {} around, at {x},{y},{z}",
                p.edges,
                round(p.around)
            )
        })
        .collect();
    let more = match places.len() - told.len() {
        0 => String::new(),
        more => format!(" and {} shorter ones", thousands(more)),
    };
    format!("{before}{}{more}", told.join("; "))
}
