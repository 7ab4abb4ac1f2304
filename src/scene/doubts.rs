//! Checks a scene for likely mistakes, and for input that makes its caps ambiguous.

use super::units::numbers::describe_bounds;
use super::{Bounds, Cut, Cutter, Fill, Part, Role, Scene, Topology};
use crate::error::Diagnostic;

fn described(bounds: &Bounds) -> String {
    describe_bounds(bounds.min.to_array(), bounds.max.to_array())
}

/// Messages about a scene: cuts and cutters that miss the model, and faces with inconsistent orientation where orientation
/// matters.
pub fn doubts(scene: &Scene) -> Vec<Diagnostic> {
    let bounds = scene.bounds();
    let mut doubts: Vec<Diagnostic> = nonzero_depends(&scene.parts).into_iter().collect();
    for (cut, stays) in misses(scene) {
        let side = if stays { "stays" } else { "is removed" };
        doubts.push(Diagnostic::warning(
            "cut-misses-model",
            format!(
                "section {} misses the model: all of it is on the side that {side}\n  bounds: {}",
                cut.name,
                described(&bounds)
            ),
        ).help("give a position within the bounds, or a percentage of them such as z=50%"));
    }
    let spared = scene.parts.iter().filter(|p| p.role != Role::Exterior);
    let spared: Vec<&str> = spared.map(|p| p.name.as_str()).collect();
    let is_plain = |cut: &Cut| cut.enabled && cut.breakaway.is_none();
    if let ([first, ..], true) = (&spared[..], scene.cuts.iter().any(is_plain)) {
        doubts.push(Diagnostic::note("parts-not-cut", format!(
            "{} of {} parts are not cut because they are interior or whole, for example {first}; --roles 'exterior=*' cuts them",
            spared.len(),
            scene.parts.len()
        )));
    }
    let cuts = scene.cuts.iter().filter(|c| c.enabled);
    let closed = cuts.clone().filter(|c| !c.is_on());
    doubts.extend(closed.map(|cut| {
        let text = format!(
            "{} opens nothing: the eye is inside the interior parts, or these parts have no volume",
            cut.name
        );
        Diagnostic::warning("breakaway-opens-nothing", text)
            .help("move the camera away from the interior parts")
    }));
    let cutters = cuts.filter_map(|c| c.volume.as_ref());
    doubts.extend(cutters.filter_map(|cutter| missing(cutter, scene)));
    doubts
}

/// Cuts that miss the model; the flag is true if all of the model is kept. If a cut has several faces, one that lies beyond the model
/// on the removed side is not reported, since a box may extend past the model.
pub fn misses(scene: &Scene) -> impl Iterator<Item = (&Cut, bool)> {
    let bounds = scene.bounds();
    let cuts = (scene.cuts.iter()).filter(|c| c.enabled && !c.surfaces.is_empty());
    cuts.filter_map(move |cut| {
        let missing = cut.surfaces.iter().filter(|s| s.misses(&bounds));
        let stays: Vec<bool> = missing
            .map(|s| s.kept_height(bounds.centre()) > 0.0)
            .collect();
        let is_said = stays.contains(&true) || stays.len() == cut.surfaces.len();
        is_said.then(|| (cut, stays.contains(&true)))
    })
}

fn missing(cutter: &Cutter, scene: &Scene) -> Option<Diagnostic> {
    let (bounds, own) = (scene.bounds(), cutter.bounds_in_world());
    let is_apart = (own.min.cmpgt(bounds.max) | bounds.min.cmpgt(own.max)).any();
    is_apart.then(|| {
        let (name, own, of_model) = (cutter.name(), described(&own), described(&bounds));
        let text = format!(
            "the cutter {name} misses the model\n  bounds: {own}; the model's bounds: {of_model}"
        );
        Diagnostic::warning("cutter-misses-model", text)
            .help("place it with `translate`, `scale` and `rotate_deg` in a scene file")
    })
}

/// Under the nonzero rule, faces with inconsistent orientation are as bad as holes. All such parts give a single note.
fn nonzero_depends(parts: &[Part]) -> Option<Diagnostic> {
    let filled = parts.iter().filter(|p| p.fill == Fill::Nonzero);
    let edges = filled.map(|p| (p, Topology::new(&p.mesh).inconsistent_edges));
    let doubtful: Vec<(&Part, usize)> = edges.filter(|(_, edges)| *edges > 0).collect();
    let (part, edges) = doubtful.iter().max_by_key(|(_, edges)| *edges)?;
    let place = match doubtful.len() {
        1 => format!("{}: fill is nonzero, but at {edges} edges", part.name),
        count => format!(
            "{count} parts: fill is nonzero, but at edges (worst: {}, {edges})",
            part.name
        ),
    };
    let text = format!(
        "{place} the faces disagree on which side is outside; caps can be wrong there and are marked"
    );
    let note = Diagnostic::note("inconsistent-orientation", text);
    Some(note.help("flip the faces, or use even-odd, which ignores orientation"))
}

/// Warning for an empty picture.
pub fn empty_picture(scene: &Scene) -> Diagnostic {
    let text = format!(
        "the picture is empty: all of the model is cut away or outside the view\n  bounds: {}",
        described(&scene.bounds())
    );
    Diagnostic::warning("empty-picture", text)
        .help("keep the other side (--flip), move the section, or leave the camera options out")
}
