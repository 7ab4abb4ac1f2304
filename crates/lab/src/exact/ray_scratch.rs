//! Scratch memory for one ray: its lists of crossings, roots and events, and its states. Each thread reuses it for the next ray.

use cutaway::scene::Prepared;

use super::ambiguity::Scratch;
use super::clip::{Graze, Root};
use super::outline::Brush;
use super::raster::Crossing;
use super::walk::{Cause, Event, RayState, by_depth};
use super::winding::open_parts::OpenParts;

/// Scratch memory for one ray; reused from ray to ray.
pub(super) struct RayScratch {
    pub(super) crossings: Vec<Crossing>,
    /// Crossings with one cutter.
    pub(super) of_cutter: Vec<Crossing>,
    pub(super) roots: Vec<Root>,
    pub(super) grazes: Vec<Graze>,
    pub(super) events: Vec<Event>,
    /// Ranks of the parts the ray meets or almost meets, in order.
    pub(super) ranks: Vec<u16>,
    /// Per surface: true if its roots are listed.
    pub(super) met: Vec<bool>,
    /// Crossings with preclassified triangles, each with the clip-surface and its [`Crossing::place`]: rounding cannot change their order.
    pub(super) preclassified: Vec<(u32, u16, i8)>,
    /// Crossings, each with the number of the plane in which its triangle is coplanar with triangles of other parts.
    pub(super) shared: Vec<(u32, u16)>,
    pub(super) start: RayState,
    pub(super) state: RayState,
    pub(super) scratch: Scratch,
    /// Winding numbers after all crossings of the line.
    pub(super) end: RayState,
}

impl RayScratch {
    pub(super) fn of(prepared: &Prepared, open_parts: &OpenParts) -> Self {
        let state = RayState::of(prepared, open_parts.ranks());
        Self {
            crossings: Vec::new(),
            of_cutter: Vec::new(),
            roots: Vec::new(),
            grazes: Vec::new(),
            events: Vec::new(),
            ranks: Vec::new(),
            met: vec![false; prepared.surfaces.len()],
            preclassified: Vec::new(),
            shared: Vec::new(),
            start: state.clone(),
            state: state.clone(),
            scratch: Scratch::of(state.clone()),
            end: state,
        }
    }

    /// Keeps the crossings beyond a depth and counts the crossings before it. Returns true if the line ends inside some part.
    pub(super) fn sort_crossings(
        &mut self,
        found: &[Crossing],
        brushes: &[Brush],
        from: f64,
    ) -> bool {
        self.ranks.extend(found.iter().map(|c| c.rank));
        self.ranks.extend(brushes.iter().map(|b| b.rank));
        self.ranks.sort_unstable();
        self.ranks.dedup();
        for crossing in found {
            let rank = crossing.rank as usize;
            let step = i32::from(crossing.step());
            self.end.winding[rank] += step;
            if crossing.depth > from {
                self.crossings.push(*crossing);
            } else {
                self.start.winding[rank] += step;
            }
        }
        self.ranks.iter().any(|r| self.end.is_inside(*r))
    }

    pub(super) fn merge_events(&mut self) {
        self.events
            .extend(self.crossings.iter().enumerate().map(|(i, c)| Event {
                depth: c.depth,
                place: c.place,
                cause: Cause::Mesh {
                    rank: c.rank,
                    step: c.step(),
                },
                source: i as u32,
            }));
        self.events
            .extend(self.roots.iter().enumerate().map(|(i, r)| Event {
                depth: r.depth,
                place: 0,
                cause: Cause::Clip {
                    surface: r.surface,
                    to_kept: r.to_kept,
                },
                source: i as u32,
            }));
        self.events.sort_unstable_by(by_depth);
    }

    pub(super) fn clear(&mut self) {
        for rank in self.ranks.drain(..) {
            self.start.winding[rank as usize] = 0;
            self.start.through_holes[rank as usize] = 0;
            self.end.winding[rank as usize] = 0;
        }
        self.start.at_clips.clear();
        self.crossings.clear();
        self.roots.clear();
        self.grazes.clear();
        self.events.clear();
        self.preclassified.clear();
        self.shared.clear();
        self.met.fill(false);
        self.start.removed.fill(false);
    }
}
