//! Undecided samples: those whose answer depends on differences smaller than the precision of the picture.
//!
//! A sample is undecided if an implementation that moves it by [`View::doubt_px`], or rounds a depth by four ulp of f32, may correctly
//! give another answer. There are three causes: an outline nearby; two events of one ray that are too close to order ([`super::order`]; at
//! a seam either triangle may be hit, and the margin is that of the less precise triangle); and a ray that grazes a clip-surface. For the
//! last two causes, nearness alone is not enough: the walk is repeated with the pair swapped, or the graze taken the other way. The sample
//! is undecided only if kind, part or clip-surface changes. If none does but the depth jumps, as between the folds of a relief, only the
//! depth is open. If only the set of solids that overlap at a cap changes, only the overlap is open. An outline leaves the sample undecided
//! unless the part is clearly removed there or the outline is hidden. An outline at which the part may be open also counts where the
//! part is removed, and behind a cap that depends on whether the part is open.
//!
//! Two things are decided for whole triangles ([`super::classify`]): on which side of a nearby flat clip-surface a triangle lies; and
//! which of two parts is seen where they share a triangle or a plane, namely the first in rank.

use cutaway::scene::{Prepared, View};

use super::clip::{Graze, Ray, Root};
use super::cutter::{self, CutterMeshes};
use super::outline::{Brush, OutlineEdge};
use super::raster::{Crossing, Projected};
use super::walk::{Cause, Event, HoleNumber, RayState, VisiblePoint, restore_order, walk};

/// Four ulp of f32 at a depth. Scene space has a radius of about 1, and its coordinates are rounded to ulps of 1, so depths
/// below 1 are not more precise than 1. An orthographic depth buffer has the same resolution over its whole depth range.
pub(super) fn rounding(view: &View, depth: f64) -> f64 {
    let span = if view.orthographic {
        view.far - view.near
    } else {
        1.0
    };
    4.0 * f64::from(f32::EPSILON) * depth.abs().max(span).max(1.0)
}

/// Degree to which an answer is undecided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Openness {
    /// The whole answer is decided.
    Nothing,
    /// Which solids overlap at a cap may differ; everything else is decided.
    Overlap,
    /// The depth may differ, and with it the normal and the overlap; kind, part and clip-surface are decided.
    Depth,
    /// Anything may differ.
    All,
}

impl Openness {
    /// Maximum of several values; stops at the first [`Openness::All`].
    pub(super) fn worst(all: impl Iterator<Item = Self>) -> Self {
        let mut worst = Self::Nothing;
        for one in all {
            worst = worst.max(one);
            if worst == Self::All {
                break;
            }
        }
        worst
    }
}

/// Everything known about one ray.
pub(super) struct RayCase<'a> {
    pub(super) prepared: &'a Prepared,
    pub(super) view: &'a View,
    pub(super) parts: &'a [Projected<'a>],
    pub(super) ray: Ray,
    /// Ranks of the parts that the ray meets.
    pub(super) ranks: &'a [u16],
    /// State before the first event.
    pub(super) start: &'a RayState,
    /// The ray's events, in order.
    pub(super) events: &'a [Event],
    pub(super) crossings: &'a [Crossing],
    pub(super) roots: &'a [Root],
    pub(super) grazes: &'a [Graze],
    pub(super) brushes: &'a [Brush],
    /// Outlines of cutters near the sample; the ranks of cutters follow those of the parts.
    pub(super) cutter_brushes: &'a [Brush],
    pub(super) cutters: &'a CutterMeshes,
    /// The visible point, whose openness is in question; none for the background.
    pub(super) sight: Option<VisiblePoint>,
    /// Crossings with preclassified triangles, each with the clip-surface, and -1 if the crossing is before it or 1 if behind it.
    pub(super) preclassified: &'a [(u32, u16, i8)],
    /// Crossings, each with the number of the plane in which its triangle is coplanar with triangles of other parts.
    pub(super) shared: &'a [(u32, u16)],
}

/// Buffers for repeated walks.
#[derive(Default)]
pub(super) struct Scratch {
    pub(super) events: Vec<Event>,
    state: RayState,
    pub(super) margins: Vec<f64>,
}

impl Scratch {
    /// Buffers for a scene, from a state outside everything.
    pub(super) fn of(state: RayState) -> Self {
        Self {
            state,
            ..Self::default()
        }
    }

    /// Copies the events, so that they can be changed.
    pub(super) fn begin(&mut self, events: &[Event]) {
        self.events.clear();
        self.events.extend_from_slice(events);
    }
}

impl RayCase<'_> {
    /// Degree to which the answer of this ray is undecided.
    pub(super) fn openness(&self, scratch: &mut Scratch) -> Openness {
        if self.brushed(scratch) || self.bitten() {
            return Openness::All;
        }
        let grazed = self.grazed(scratch).max(self.unsure_inside(scratch));
        if grazed == Openness::All || self.events.is_empty() {
            return grazed;
        }
        grazed.max(self.disordered(scratch))
    }

    /// Openness from rounding the winding number of an open part the other way, at one crossing with a clip-surface or the near plane.
    fn unsure_inside(&self, scratch: &mut Scratch) -> Openness {
        let numbers = &self.start.at_clips;
        let unsure = numbers.iter().enumerate();
        let unsure = unsure.filter_map(|(place, at_clip)| Some((place, at_clip.other?)));
        Openness::worst(unsure.map(|(place, other)| {
            scratch.begin(self.events);
            self.change_from(scratch, 0.0, |start| {
                let number = &mut start.at_clips[place];
                number.number = other;
                if number.source == HoleNumber::AT_NEAR_PLANE {
                    start.through_holes[usize::from(number.rank)] = other;
                }
            })
        }))
    }

    pub(super) fn seen_depth(&self) -> f64 {
        self.sight.map_or(f64::INFINITY, |s| s.depth)
    }

    /// Largest change of an event's depth.
    pub(super) fn margin(&self, event: &Event) -> f64 {
        let change = match event.cause {
            Cause::Mesh { rank, .. } => {
                let change = |triangle| {
                    let facet = self.parts[usize::from(rank)].facet(triangle);
                    facet.depth_change(self.view, self.ray.direction, event.depth)
                };
                let own = change(self.crossings[event.source as usize].triangle);
                // A rasteriser that rounds corners may hit the triangle beyond a seam instead.
                let beyond = self.brushes.iter().filter_map(|brush| {
                    let apart = (brush.depth - event.depth).abs();
                    match brush.edge {
                        OutlineEdge::Seam(two)
                            if brush.rank == rank && apart <= own + brush.margin =>
                        {
                            Some(two)
                        }
                        _ => None,
                    }
                });
                beyond.flatten().map(change).fold(own, f64::max)
            }
            Cause::Clip { surface, .. } => {
                let root = &self.roots[event.source as usize];
                match root.face {
                    // A cutter's faces are rasterised like those of parts.
                    Some(face) => {
                        let cutter = &self.parts[usize::from(self.cutters.rank_of(surface))];
                        let facet = cutter.facet(face.triangle);
                        facet.depth_change(self.view, self.ray.direction, event.depth)
                    }
                    None => root.depth_change(self.view, &self.ray),
                }
            }
        };
        change + rounding(self.view, event.depth)
    }

    /// Returns true if an outline near the sample is neither hidden nor clearly removed. If the part may be open there, the outline counts
    /// even if removed, or hidden by a cap that depends on it: an algorithm that counts crossings behind the cap may find one more or less.
    fn brushed(&self, scratch: &mut Scratch) -> bool {
        self.brushes.iter().any(|brush| {
            let is_hidden = brush.depth - brush.margin > self.seen_depth();
            match brush.edge {
                OutlineEdge::Rim => !is_hidden || self.start_matters(scratch, brush.rank),
                OutlineEdge::Fold => !is_hidden && !self.clearly_removed(brush),
                OutlineEdge::Seam(_) => false,
            }
        })
    }

    /// Returns true if a cap appears or vanishes when the ray starts on the other side of a part; the part's faces are seen either way.
    fn start_matters(&self, scratch: &mut Scratch, rank: u16) -> bool {
        let is_clip = |event: &Event| matches!(event.cause, Cause::Clip { .. });
        let shows_cap = self.sight.filter(|s| s.event.is_none_or(|e| is_clip(&e)));
        if shows_cap.is_some_and(|s| s.rank == rank) {
            return true;
        }
        let bounds = &self.prepared.parts[usize::from(rank)].bounds;
        let has_near_cap = self.view.near_cap && self.view.near_plane_meets(bounds);
        let state = &mut scratch.state;
        [1, -1].into_iter().any(|by| {
            state.set(self.start);
            state.winding[usize::from(rank)] += by;
            let before_near = self.events.partition_point(|e| e.depth <= self.view.near);
            let (before, beyond) = self.events.split_at(before_near);
            before.iter().for_each(|event| state.apply(event));
            let is_near_cap = has_near_cap && state.shows(self.prepared, rank);
            let mut seen = beyond.iter().take_while(|e| e.depth <= self.seen_depth());
            is_near_cap
                || seen.any(|event| {
                    let was_removed = state.removes(self.prepared, rank);
                    state.apply(event);
                    is_clip(event) && was_removed && state.shows(self.prepared, rank)
                })
        })
    }

    /// Returns true if an outline of a cutter may change what is seen.
    fn bitten(&self) -> bool {
        let mut brushes = self.cutter_brushes.iter();
        brushes.any(|brush| {
            let surface = self.cutters.surface_of(brush.rank);
            let events = self.events.iter().map(|e| (e, self.margin(e)));
            brush.depth - brush.margin <= self.seen_depth()
                && cutter::bites(
                    self.prepared,
                    (brush, surface),
                    self.ranks,
                    self.start,
                    events,
                )
        })
    }

    fn clearly_removed(&self, brush: &Brush) -> bool {
        let part = &self.prepared.parts[brush.rank as usize];
        let mut removed = self.start.removed.clone();
        for event in self.events {
            let Cause::Clip { surface, .. } = event.cause else {
                continue;
            };
            if !part
                .cuts
                .contains(&self.prepared.surfaces[surface as usize].cut)
            {
                continue;
            }
            if (event.depth - brush.depth).abs() <= brush.margin + self.margin(event) {
                return false;
            }
            if event.depth < brush.depth {
                removed[surface as usize] ^= true;
            }
        }
        let state = RayState {
            removed,
            ..RayState::default()
        };
        state.removes(self.prepared, brush.rank)
    }

    /// Openness from taking each graze the other way: a miss as two crossings, or two crossings as a miss.
    fn grazed(&self, scratch: &mut Scratch) -> Openness {
        Openness::worst(self.grazes.iter().map(|graze| {
            let hidden = self.seen_depth() + rounding(self.view, graze.depth);
            let of_surface =
                |e: &Event| matches!(e.cause, Cause::Clip { surface, .. } if surface == graze.surface);
            let step = 0.5 * rounding(self.view, graze.depth);
            scratch.begin(self.events);
            let crossed_before = self
                .events
                .iter()
                .filter(|e| of_surface(e) && e.depth < graze.depth)
                .count();
            let removed =
                self.start.removed[usize::from(graze.surface)] ^ (crossed_before % 2 == 1);
            // Where the extremum touches 0, rounding may have left out the pair of roots around it, or put both at one depth:
            // then the events contradict the graze, and the pair must be inserted.
            if graze.crossed && removed == graze.removed {
                let after = self.events.partition_point(|e| e.depth <= graze.depth);
                let before = self.events[..after].iter().rposition(of_surface);
                let behind = self.events[after..].iter().position(of_surface);
                let (Some(before), Some(behind)) = (before, behind) else {
                    return Openness::Nothing;
                };
                // The extremum itself may lie behind the visible point: what counts is the crossing before the extremum.
                if self.events[before].depth > hidden {
                    return Openness::Nothing;
                }
                scratch.events.remove(after + behind);
                scratch.events.remove(before);
            } else {
                if graze.depth > hidden {
                    return Openness::Nothing;
                }
                for (depth, to_kept) in [
                    (graze.depth - step, removed),
                    (graze.depth + step, !removed),
                ] {
                    scratch.events.push(Event {
                        depth,
                        place: 0,
                        cause: Cause::Clip {
                            surface: graze.surface,
                            to_kept,
                        },
                        source: u32::MAX,
                    });
                }
            }
            let changed = self.change(scratch, rounding(self.view, graze.depth));
            // What is inside an open part is not evaluated there.
            let cut = self.prepared.surfaces[usize::from(graze.surface)].cut;
            let may_open = (self.ranks.iter().map(|r| usize::from(*r)))
                .any(|rank| self.start.is_open[rank] && self.prepared.parts[rank].cuts.contains(&cut));
            match may_open {
                true => Openness::All,
                false => changed,
            }
        }))
    }

    /// Repeats the walk with the events in `scratch`; `reach` is how far they were moved.
    pub(super) fn change(&self, scratch: &mut Scratch, reach: f64) -> Openness {
        self.change_from(scratch, reach, |_| ())
    }

    /// As [`Self::change`], from a start that is changed.
    fn change_from(
        &self,
        scratch: &mut Scratch,
        reach: f64,
        changed: impl FnOnce(&mut RayState),
    ) -> Openness {
        let Scratch { events, state, .. } = scratch;
        restore_order(events);
        state.set(self.start);
        changed(state);
        let other = walk(
            self.prepared,
            (self.view.near, self.view.near_cap),
            self.ranks,
            events,
            state,
        );
        match (self.sight, other) {
            (None, None) => Openness::Nothing,
            (Some(a), Some(b)) if a.class() == b.class() => {
                let step = rounding(self.view, a.depth);
                if (a.depth - b.depth).abs() > 2.0 * (reach + step) {
                    Openness::Depth
                } else if a.overlap != b.overlap {
                    Openness::Overlap
                } else {
                    Openness::Nothing
                }
            }
            _ => Openness::All,
        }
    }
}
