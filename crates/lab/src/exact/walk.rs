//! The definition itself: walk the events along a ray in order of depth, and stop where the ray first enters a kept solid.
//!
//! State: per part, the winding number, from which the part's fill rule decides inside or outside, and which for an open part includes what
//! its holes add ([`super::winding::open_parts`]); per clip-surface, whether the
//! ray is on its removed or its kept side. A point is removed by a cut if it is on the removed side of all the cut's surfaces,
//! and by a part's cuts if any of them removes it. A part *shows* where the ray is inside it and no cut removes it. The visible
//! point is the first point beyond the near plane at which some part begins to show. Of an open part, a face that is not removed is seen
//! from either side, unless the ray has been inside the part since the near plane.
//!
//! Ties. A solid is taken without its boundary: a mesh event whose triangle lies in a clip-surface comes before the clip event if the
//! ray leaves the solid there, and after it if the ray enters ([`super::classify`]); so a cut leaves no sheet of zero thickness.
//! Any other mesh event at exactly the depth of a clip event is taken to be on the surface's kept side. Clip events at one depth happen
//! at once: two cuts that share a plane leave no sheet between them. Mesh events at one depth are ordered by the rank of their parts;
//! within a part, entering comes first, so that of two coincident faces the one that faces the eye is seen.

use std::cmp::Ordering;

use cutaway::scene::{Fill, Prepared};

/// Cause of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cause {
    /// The ray crosses the mesh of a part.
    Mesh {
        /// Rank of the part.
        rank: u16,
        /// Change of the winding number: 1 where the ray enters the mesh, -1 where it leaves.
        step: i8,
    },
    /// The ray crosses a clip-surface.
    Clip {
        /// Number of the surface.
        surface: u16,
        /// True if the ray passes to the kept side.
        to_kept: bool,
    },
}

/// Something that happens along a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    /// Depth of the event.
    pub(super) depth: f64,
    /// Order among the events at that depth: -1 before all clip events, 1 after them.
    pub(super) place: i8,
    /// Cause of the event.
    pub(super) cause: Cause,
    /// Index of the crossing or root that the event stands for.
    pub(super) source: u32,
}

impl Event {
    fn precedence(&self) -> (i8, u8, u16, i8) {
        match self.cause {
            Cause::Clip {
                surface,
                to_kept: true,
            } => (self.place, 0, surface, 0),
            Cause::Mesh { rank, step } => (self.place, 1, rank, -step),
            Cause::Clip { surface, .. } => (self.place, 2, surface, 0),
        }
    }
}

/// Order along the ray.
pub(super) fn by_depth(a: &Event, b: &Event) -> Ordering {
    a.depth
        .total_cmp(&b.depth)
        .then_with(|| a.precedence().cmp(&b.precedence()))
        .then_with(|| a.source.cmp(&b.source))
}

/// Insertion sort for events that are almost in order: one step per event, plus one step for each position by which an event
/// moves.
pub(super) fn restore_order(events: &mut [Event]) {
    for unplaced in 1..events.len() {
        let mut at = unplaced;
        while at > 0 && by_depth(&events[at], &events[at - 1]).is_lt() {
            events.swap(at, at - 1);
            at -= 1;
        }
    }
}

/// State of a ray at a depth.
#[derive(Clone, Debug, Default)]
pub(super) struct RayState {
    /// Per rank: the winding number.
    pub(super) winding: Vec<i32>,
    /// Per rank: the fill rule.
    pub(super) fill: Vec<Fill>,
    /// Per clip-surface: true on its removed side.
    pub(super) removed: Vec<bool>,
    /// Per rank: what the holes of an open part add to the crossings counted in `winding`; 0 for closed parts.
    pub(super) through_holes: Vec<i32>,
    /// Per rank: true if the part is open.
    pub(super) is_open: Vec<bool>,
    /// Per rank: true if the part is open and the ray has been inside it since the near plane.
    pub(super) is_from_near: Vec<bool>,
    /// What holes add at crossings with clip-surfaces, and where it is near a half, at the near plane; in any order.
    pub(super) at_clips: Vec<HoleNumber>,
}

/// What the holes of an open part add to the crossings that a ray counts, where it crosses a clip-surface or the near plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HoleNumber {
    /// Index of the root that stands for the crossing with the clip-surface, or [`Self::AT_NEAR_PLANE`].
    pub(super) source: u32,
    /// Rank of the part.
    pub(super) rank: u16,
    /// The nearest whole number.
    pub(super) number: i32,
    /// The second nearest, if rounding may lead to it.
    pub(super) other: Option<i32>,
}

impl HoleNumber {
    /// In place of the index of a root.
    pub(super) const AT_NEAR_PLANE: u32 = u32::MAX - 1;
}

impl RayState {
    /// A state outside everything. `open` lists the ranks of open parts.
    pub(super) fn of(prepared: &Prepared, open: impl Iterator<Item = u16>) -> Self {
        let mut is_open = vec![false; prepared.parts.len()];
        open.for_each(|rank| is_open[usize::from(rank)] = true);
        Self {
            winding: vec![0; prepared.parts.len()],
            fill: prepared.parts.iter().map(|p| p.fill).collect(),
            removed: vec![false; prepared.surfaces.len()],
            through_holes: vec![0; prepared.parts.len()],
            is_open,
            is_from_near: vec![false; prepared.parts.len()],
            at_clips: Vec::new(),
        }
    }

    /// Becomes a copy of another state.
    pub(super) fn set(&mut self, other: &Self) {
        self.winding.copy_from_slice(&other.winding);
        self.removed.copy_from_slice(&other.removed);
        self.through_holes.copy_from_slice(&other.through_holes);
        self.is_from_near.copy_from_slice(&other.is_from_near);
        self.at_clips.clone_from(&other.at_clips);
    }

    /// Returns true if the ray is inside a part here.
    pub(super) fn is_inside(&self, rank: u16) -> bool {
        let rank = usize::from(rank);
        self.fill[rank].holds(self.winding[rank] + self.through_holes[rank])
    }

    fn cut_removes(&self, prepared: &Prepared, cut: usize) -> bool {
        let surfaces = &prepared.cuts[cut].surfaces;
        !surfaces.is_empty() && surfaces.iter().all(|s| self.removed[*s])
    }

    /// Returns true if a part is removed here.
    pub(super) fn removes(&self, prepared: &Prepared, rank: u16) -> bool {
        prepared.parts[rank as usize]
            .cuts
            .iter()
            .any(|c| self.cut_removes(prepared, *c))
    }

    /// Returns true if the ray is inside a part here, and nothing removes it.
    pub(super) fn shows(&self, prepared: &Prepared, rank: u16) -> bool {
        self.is_inside(rank) && !self.removes(prepared, rank)
    }

    /// Applies an event.
    pub(super) fn apply(&mut self, event: &Event) {
        match event.cause {
            Cause::Mesh { rank, step } => self.winding[rank as usize] += i32::from(step),
            Cause::Clip { surface, .. } => {
                self.reach(event);
                self.removed[surface as usize] ^= true;
            }
        }
    }

    /// Becomes the state just before a crossing with a clip-surface: what holes add changes between crossings.
    fn reach(&mut self, clip: &Event) {
        for at_clip in self.at_clips.iter().filter(|h| h.source == clip.source) {
            self.through_holes[usize::from(at_clip.rank)] = at_clip.number;
        }
    }
}

/// Visible point of a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct VisiblePoint {
    /// Rank of the part.
    pub(super) rank: u16,
    /// Depth of the point.
    pub(super) depth: f64,
    /// The event that makes the point visible; none if the near plane does.
    pub(super) event: Option<Event>,
    /// True for a cap whose event also makes other parts show: solids overlap there.
    pub(super) overlap: bool,
}

impl VisiblePoint {
    /// Key by which two answers count as equal: the part and, for a cap, the clip-surface or, for a surface, the side that it shows.
    pub(super) fn class(&self) -> (u16, Option<Cause>) {
        let cause = self.event.map(|e| match e.cause {
            Cause::Clip { surface, .. } => Cause::Clip {
                surface,
                to_kept: true,
            },
            mesh @ Cause::Mesh { .. } => mesh,
        });
        (self.rank, cause)
    }
}

/// Walks sorted events from a state. `ranks` are the parts the ray meets, in order; `state` becomes the state where the walk stops.
pub(super) fn walk(
    prepared: &Prepared,
    (near, near_cap): (f64, bool),
    ranks: &[u16],
    events: &[Event],
    state: &mut RayState,
) -> Option<VisiblePoint> {
    let first = events.partition_point(|e| e.depth <= near);
    for event in &events[..first] {
        state.apply(event);
    }
    if near_cap {
        let mut shown = ranks.iter().filter(|r| state.shows(prepared, **r));
        if let Some(rank) = shown.next() {
            return Some(VisiblePoint {
                rank: *rank,
                depth: near,
                event: None,
                overlap: shown.next().is_some(),
            });
        }
    }
    for rank in ranks.iter().filter(|r| state.is_open[usize::from(**r)]) {
        state.is_from_near[usize::from(*rank)] = state.shows(prepared, *rank);
    }
    let mut rest = &events[first..];
    while let Some(event) = rest.first() {
        let count = match event.cause {
            Cause::Mesh { .. } => 1,
            Cause::Clip { .. } => rest
                .iter()
                .take_while(|e| e.depth == event.depth && matches!(e.cause, Cause::Clip { .. }))
                .count(),
        };
        let (now, later) = rest.split_at(count);
        rest = later;
        let seen = match event.cause {
            Cause::Mesh { rank, step } => {
                // Where the ray enters an inner shell, the part may already show.
                let showed = state.shows(prepared, rank);
                state.apply(event);
                let place = usize::from(rank);
                let is_seen = match state.is_open[place] {
                    false => !showed && state.shows(prepared, rank),
                    // Through a hole, faces are seen from both sides; without caps of the near plane, from outside alone.
                    true => {
                        (near_cap || step > 0)
                            && !state.is_from_near[place]
                            && !state.removes(prepared, rank)
                    }
                };
                state.is_from_near[place] &= state.is_inside(rank);
                is_seen.then_some((rank, *event, false))
            }
            Cause::Clip { .. } => pass_clips(prepared, ranks, now, state),
        };
        if let Some((rank, event, overlap)) = seen {
            return Some(VisiblePoint {
                rank,
                depth: event.depth,
                event: Some(event),
                overlap,
            });
        }
    }
    None
}

/// Applies the clip events at one depth. Returns the part that then begins to show, the event that stops removing it, and
/// whether that event stops removing other parts too.
pub(super) fn pass_clips(
    prepared: &Prepared,
    ranks: &[u16],
    events: &[Event],
    state: &mut RayState,
) -> Option<(u16, Event, bool)> {
    let freed = |state: &RayState, rank: u16| {
        events.iter().copied().find(|e| {
            let Cause::Clip { surface, .. } = e.cause else {
                return false;
            };
            let cut = prepared.surfaces[surface as usize].cut;
            prepared.parts[rank as usize].cuts.contains(&cut) && state.cut_removes(prepared, cut)
        })
    };
    events.iter().for_each(|event| state.reach(event));
    // Usually the ray is inside no removed part, or no event ends the removal.
    let candidates: Vec<(u16, Event)> = ranks
        .iter()
        .filter(|r| state.is_inside(**r))
        .filter_map(|r| freed(state, *r).map(|e| (*r, e)))
        .collect();
    for event in events {
        state.apply(event);
    }
    let mut shown = candidates
        .into_iter()
        .filter(|(rank, _)| state.shows(prepared, *rank));
    let (rank, event) = shown.next()?;
    let overlap = shown.any(|(_, other)| other.cause == event.cause);
    Some((rank, event, overlap))
}
