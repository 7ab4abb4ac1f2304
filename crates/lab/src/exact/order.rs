//! Finds events of one ray that are too close to order, and what the ray would show if their order were different.
//!
//! Pairs are swapped one at a time. Where other crossings lie between a crossing and a clip-surface, the crossing alone is moved past the
//! surface, as the others may be preclassified against it ([`super::classify`]). Costs up to two walks along the ray for each close pair.
//! Limit: an order of three events that takes more than one such step to reach is not tried.

use glam::DVec3;

use super::ambiguity::{Openness, RayCase, Scratch, rounding};
use super::classify::share_plane;
use super::walk::{Cause, Event};

impl RayCase<'_> {
    /// Openness from swapping two events whose order is open. The near plane counts as an event.
    pub(super) fn disordered(&self, scratch: &mut Scratch) -> Openness {
        let mut margins = std::mem::take(&mut scratch.margins);
        margins.clear();
        margins.extend(self.events.iter().map(|e| self.margin(e)));
        let widest = margins.iter().copied().fold(0.0, f64::max);
        let seen = self.seen_depth();
        let open = Openness::worst(
            (0..self.events.len())
                .take_while(|i| self.events[*i].depth <= seen + 2.0 * widest)
                .map(|i| {
                    let depth = self.events[i].depth;
                    let near = if (depth - self.view.near).abs() <= margins[i] {
                        self.across_near(scratch, i, margins[i])
                    } else {
                        Openness::Nothing
                    };
                    let close = (i + 1..self.events.len())
                        .take_while(|j| self.events[*j].depth - depth <= margins[i] + widest)
                        .filter(|j| self.events[*j].depth - depth <= margins[i] + margins[*j]);
                    near.max(Openness::worst(close.map(|j| {
                        if self.order_matters(&self.events[i], &self.events[j]) {
                            self.swapped(scratch, [i, j], margins[i] + margins[j])
                        } else {
                            Openness::Nothing
                        }
                    })))
                }),
        );
        scratch.margins = margins;
        open
    }

    /// Openness from moving an event to the other side of the near plane. An event exactly at the plane is before it.
    fn across_near(&self, scratch: &mut Scratch, event: usize, margin: f64) -> Openness {
        let depth = self.events[event].depth;
        let step = rounding(self.view, depth);
        scratch.begin(self.events);
        let across = if depth > self.view.near {
            self.view.near
        } else {
            self.view.near + step
        };
        self.put(scratch, event, across);
        self.change(scratch, margin + step)
    }

    fn swapped(&self, scratch: &mut Scratch, [i, j]: [usize; 2], margin: f64) -> Openness {
        let [near, far] = [i, j].map(|k| self.events[k].depth);
        scratch.begin(self.events);
        self.put(scratch, i, far);
        // At equal depths the tie rule decides; to get the other order, the event is moved by the rounding error.
        let hair = (near == far).then(|| rounding(self.view, near));
        self.put(scratch, j, near - hair.unwrap_or(0.0));
        let open = self.change(scratch, margin);
        match open == Openness::All || j == i + 1 {
            true => open,
            false => open.max(self.passed(scratch, [i, j], margin)),
        }
    }

    /// Openness from moving a crossing past a clip-surface. The surface stays where it is: crossings between the two may be preclassified
    /// against the surface, which then cannot move past them.
    fn passed(&self, scratch: &mut Scratch, [i, j]: [usize; 2], margin: f64) -> Openness {
        let [near, far] = [i, j].map(|k| &self.events[k]);
        let (moved, depth) = match (near.cause, far.cause) {
            (Cause::Mesh { .. }, Cause::Clip { .. }) => {
                (i, far.depth + rounding(self.view, far.depth))
            }
            (Cause::Clip { .. }, Cause::Mesh { .. }) => {
                (j, near.depth - rounding(self.view, near.depth))
            }
            _ => return Openness::Nothing,
        };
        scratch.begin(self.events);
        self.put(scratch, moved, depth);
        self.change(scratch, margin)
    }

    /// Moves an event to another depth, together with all crossings whose triangles coincide with the event's own triangle.
    fn put(&self, scratch: &mut Scratch, event: usize, depth: f64) {
        let moved = &self.events[event];
        for (other, copy) in self.events.iter().zip(&mut scratch.events) {
            if self.share_triangle(moved, other) {
                copy.depth = depth;
            }
        }
        scratch.events[event].depth = depth;
    }

    /// Returns true if swapping two events can change the answer, and exact coincidence does not fix their order.
    fn order_matters(&self, a: &Event, b: &Event) -> bool {
        let is_preclassified = |mesh: &Event, surface: u16| {
            (self.preclassified.iter())
                .any(|(source, by, _)| (*source, *by) == (mesh.source, surface))
        };
        match (a.cause, b.cause) {
            // For two crossings of one part, it matters which side of the mesh is seen.
            (Cause::Mesh { rank: p, step: s }, Cause::Mesh { rank: q, step: t }) => {
                (p != q || s != t)
                    && !self.share_triangle(a, b)
                    && !share_plane(self.shared, [a, b])
                    && !self.is_between(a, b)
            }
            // A part that the surface does not cut may be in front of the cap of another part, or behind it.
            (Cause::Mesh { .. }, Cause::Clip { surface, .. }) => !is_preclassified(a, surface),
            (Cause::Clip { surface, .. }, Cause::Mesh { .. }) => !is_preclassified(b, surface),
            (Cause::Clip { surface: s, .. }, Cause::Clip { surface: t, .. }) => {
                // Two clip-surfaces in one plane are crossed at once, whatever the rounding.
                let [g, h] = [a, b].map(|e| self.roots[e.source as usize].gradient);
                // Not so for a cutter's face in the plane of another surface: triangles are rounded one by one.
                let of_cutter = |surface: u16| self.cutters.contains(surface);
                let apart = a.depth != b.depth || g.cross(h) != DVec3::ZERO;
                s != t && (apart || of_cutter(s) || of_cutter(t))
            }
        }
    }

    /// Returns true if some clip-surface has the two crossings on different sides.
    fn is_between(&self, a: &Event, b: &Event) -> bool {
        let of = |event: &Event| {
            let source = event.source;
            (self.preclassified.iter()).filter(move |(crossing, _, _)| *crossing == source)
        };
        of(a).any(|(_, by, place)| of(b).any(|(_, other, there)| by == other && place != there))
    }

    /// Returns true if two events are crossings at equal depths, with triangles that have the same corners.
    fn share_triangle(&self, a: &Event, b: &Event) -> bool {
        let is_mesh = |e: &Event| matches!(e.cause, Cause::Mesh { .. });
        if a.depth != b.depth || !is_mesh(a) || !is_mesh(b) {
            return false;
        }
        let points = [a, b].map(|e| {
            let crossing = &self.crossings[e.source as usize];
            self.parts[crossing.rank as usize]
                .facet(crossing.triangle)
                .points
        });
        points[0].iter().all(|p| points[1].contains(p))
    }
}
