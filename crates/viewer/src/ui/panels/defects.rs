//! Shows mesh defects in the list of parts, and open edges over the picture.

use std::collections::BTreeMap;

use cutaway::scene::Part;
use eframe::egui::{Color32, Context, Painter, Rect, Shape, Stroke, vec2};

use crate::editing::parts;
use crate::inspect::{Counts, Inspector};
use crate::picture::shown::Shown;
use crate::picture::world_view::WorldView;
use crate::ui::Viewer;

/// Maximum number of open edges drawn.
const MOST_LINES: usize = 20_000;

/// The colour of open edges.
pub(in crate::ui) const COLOR: Color32 = Color32::from_rgb(255, 0, 170);

/// Defect counts per part of the document.
#[derive(Debug, Default)]
pub(in crate::ui) struct Badges {
    /// Revision of the scene that the counts belong to.
    revision: Option<u64>,
    counts: Vec<Counts>,
}

impl Badges {
    /// Defects of a part of the document.
    pub(in crate::ui) fn of(&self, index: usize) -> Counts {
        self.counts.get(index).copied().unwrap_or_default()
    }

    /// Returns true if any part has open edges.
    pub(in crate::ui) fn has_open(&self) -> bool {
        self.counts.iter().any(Counts::is_open)
    }
}

impl Viewer {
    /// Continues the inspection of meshes.
    pub(in crate::ui) fn inspect(&mut self, ctx: &Context) {
        let Some(shown) = self.state.shown() else {
            return;
        };
        let wakes = ctx.clone();
        let revision = self.state.revision();
        let of = (shown.scene.parts.as_slice(), revision);
        let is_new = self.inspector.go_on(of, move || wakes.request_repaint());
        if is_new || self.badges.revision != Some(revision) {
            let parts = shown.scene.parts.iter();
            let by_name: BTreeMap<&str, &Part> = parts.map(|p| (p.name.as_str(), p)).collect();
            let entries = 0..parts::parts(self.state.document()).len();
            let counts = entries.map(|entry| {
                let own = shown.timeline.names_of(entry);
                let own = own.filter_map(|name| by_name.get(name));
                Counts::of(own.filter_map(|part| self.inspector.of(&part.mesh)))
            });
            self.badges = Badges {
                revision: Some(revision),
                counts: counts.collect(),
            };
        }
    }
}

/// Draws the open edges of all parts over a picture, including edges that are cut away or hidden.
pub(in crate::ui) fn paint(
    painter: &Painter,
    picture: Rect,
    (shown, inspector): (&Shown, &Inspector),
    view: &WorldView,
) {
    let parts = shown.scene.parts.iter();
    let edges = parts.flat_map(|part| {
        let open = inspector
            .of(&part.mesh)
            .map_or(&[] as &[_], |found| &found.open);
        let world_from_part = part.world_from_part;
        open.iter()
            .map(move |ends| ends.map(|p| world_from_part.transform_point3(p)))
    });
    let at = |p: glam::DVec2| picture.min + vec2(p.x as f32, p.y as f32);
    let stroke = Stroke::new(2.0, COLOR);
    let lines = edges.take(MOST_LINES).filter_map(|[from, to]| {
        let [from, to] = [view.project(from)?, view.project(to)?].map(at);
        Some(Shape::line_segment([from, to], stroke))
    });
    painter.extend(lines);
}
