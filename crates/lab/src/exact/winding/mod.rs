//! Layers by generalised winding numbers: caps for open or self-intersecting meshes.
//!
//! Counting crossings along one ray goes wrong wherever that ray passes through a hole. The generalised winding number of a point
//! (Jacobson, Kavan, Sorkine-Hornung 2013) uses the whole mesh instead: it is the signed solid angle of all faces as seen from the
//! point, over 4 pi. It equals the winding number if the mesh is closed, and varies smoothly if it is not. A candidate for a
//! cap is inside if the part's [`Fill`](cutaway::scene::Fill) counts the nearest whole number as inside. In a mesh with holes, this is
//! right as long as the holes cover less than half of the view from the point.
//!
//! Clip-surfaces are crossed where the exact reference crosses them. If no cut removes a part beyond such a crossing, and the crossing
//! is inside the part, a cap is drawn. If the mesh is crossed and not removed, its surface is drawn, front or back: a hole in the mesh
//! stays a hole in the picture, but caps have no holes. On a closed, consistently oriented mesh, all decided pixels equal
//! those of [`super::evaluate`].
//!
//! A pixel is marked if a winding number evaluated for it is nearer to a half than to a whole number. It is also marked if the mesh shows
//! its inner side although the number just before that point puts the ray inside the solid: a closed mesh does not do that.
//!
//! Cost: a tree over the faces, once per mesh ([`Windings::new`]); per pixel, the crossings, and one traversal of the tree per candidate:
//! some hundred faces and balls, more near a half. Limit: numbers from the tree have an error of about 0.0001, which matters only for numbers
//! that near to a half. Inverted faces are subtracted: with half of the faces inverted, nothing is inside.

pub(super) mod open_parts;

use cutaway::layers::{Layer, Layers};
use cutaway::scene::winding::WindingTree;
use cutaway::scene::{Prepared, View};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use self::open_parts::{BEFORE, OpenParts, depths_within, holds};
use super::clip::Ray;
use super::raster::{self, BAND_ROWS, Crossing};
use super::ray_scratch::RayScratch;
use super::walk::{Cause, Event, VisiblePoint, pass_clips};
use super::{BandedScene, Outlining};

/// A ball of the tree is opened where the bound of its error is greater: at first, and where the sum of errors may change the answer.
const COARSE: f64 = 1e-3;
const FINE: f64 = 1e-5;

/// A winding number farther than this from a whole number is unreliable.
const SURE: f64 = 0.25;

/// The meshes of a scene, prepared for winding-number queries.
pub struct Windings {
    /// The trees, by rank.
    trees: Vec<WindingTree>,
}

impl Windings {
    /// Builds the trees of a scene, which must be whole: [`Prepared::must_be_whole`].
    pub fn new(prepared: &Prepared) -> Self {
        prepared.must_be_whole();
        let trees = prepared.parts.par_iter();
        Self {
            trees: trees
                .map(|p| WindingTree::of(&p.positions, &p.triangles))
                .collect(),
        }
    }

    /// The generalised winding number of a part's mesh, by rank, around a point of the scene.
    pub fn around(&self, rank: usize, point: DVec3) -> f64 {
        self.trees[rank].winding(point, FINE).0
    }

    /// Memory of the trees, in bytes.
    pub fn bytes(&self) -> u64 {
        self.trees.iter().map(WindingTree::bytes).sum()
    }

    /// Layers of a view of the scene.
    pub fn layers(&self, prepared: &Prepared, view: &View) -> Layers {
        // Which parts are open does not matter: all numbers are sums over faces.
        let open_parts = OpenParts::default();
        let lines = BandedScene::with(prepared, view, open_parts, Outlining::Without);
        let mut layers = Layers::background(view.size_px);
        let band_pixels = (view.size_px[0] * BAND_ROWS) as usize;
        let bands = layers.pixels.par_chunks_mut(band_pixels).enumerate();
        bands.for_each(|(band, pixels)| self.band(&lines, band, pixels));
        layers
    }

    fn band(&self, lines: &BandedScene<'_>, band: usize, pixels: &mut [Layer]) {
        let [width, _] = lines.view.size_px;
        let first_row = band as u32 * BAND_ROWS;
        let rows = [first_row, first_row + pixels.len() as u32 / width];
        let (crossings, starts) =
            raster::crossings_of_band(lines.view, &lines.parts, lines.triangles.items(band), rows);
        let mut bench = RayScratch::of(lines.prepared, &lines.open_parts);
        for (pixel, layer) in pixels.iter_mut().enumerate() {
            let at = DVec2::new(
                f64::from(pixel as u32 % width) + 0.5,
                f64::from(first_row + pixel as u32 / width) + 0.5,
            );
            let found = &crossings[starts[pixel]..starts[pixel + 1]];
            self.pixel(lines, at, found, &mut bench, layer);
            bench.clear();
        }
    }

    fn pixel(
        &self,
        lines: &BandedScene<'_>,
        at: DVec2,
        found: &[Crossing],
        bench: &mut RayScratch,
        layer: &mut Layer,
    ) {
        let (prepared, view) = (lines.prepared, lines.view);
        let (found, of_cutters) = found.split_at(lines.cutters.split(found, |c| c.rank));
        let ray = Ray::through(view, at);
        // A ray may enter and leave a solid through holes, without crossing its mesh.
        let mut reach = [f64::INFINITY, f64::NEG_INFINITY];
        for (rank, part) in prepared.parts.iter().enumerate() {
            if let Some([from, to]) = depths_within(&ray, &part.bounds)
                && !part.is_removed
                && to >= view.near
            {
                bench.ranks.push(rank as u16);
                reach = [reach[0].min(from), reach[1].max(to)];
            }
        }
        if bench.ranks.is_empty() {
            return;
        }
        bench.sort_crossings(found, &[], view.near);
        let range = [
            (reach[0] - lines.pad(reach[0])).max(view.near),
            reach[1] + lines.pad(reach[1]),
        ];
        lines.meet_clips(&ray, range, of_cutters, bench);
        lines.classify(at, &ray, bench);
        bench.merge_events();
        // Which surfaces remove the start of the range. Winding numbers are evaluated only where they are needed.
        bench.start.winding.fill(0);
        bench.state.set(&bench.start);
        let mut ask = Ask {
            windings: self,
            prepared,
            ray,
            is_sure: true,
        };
        if let Some(sight) = ask.walk(lines, bench) {
            lines.show(&ray, &sight, bench, layer);
            // The wall of a void also shows its inner side, but the space before the wall is not solid.
            layer.unreliable = layer.back_face
                && sight.event.is_some()
                && (prepared.parts[usize::from(sight.rank)].fill)
                    .holds(ask.at(sight.rank, sight.depth));
        }
        layer.unreliable |= !ask.is_sure;
    }
}

/// Evaluates winding numbers along a ray.
struct Ask<'a> {
    windings: &'a Windings,
    prepared: &'a Prepared,
    ray: Ray,
    /// True if all numbers so far were close to whole numbers.
    is_sure: bool,
}

impl Ask<'_> {
    /// A part's winding number at a depth, rounded to the nearest whole number.
    fn at(&mut self, rank: u16, depth: f64) -> i32 {
        let point = self.ray.origin + self.ray.direction * depth;
        let before = self.ray.direction.normalize_or_zero() * BEFORE;
        if !holds(&self.prepared.parts[usize::from(rank)].bounds, point) {
            return 0;
        }
        let tree = &self.windings.trees[usize::from(rank)];
        let off = |number: f64| (number - number.round()).abs();
        let (mut number, error) = tree.winding(point - before, COARSE);
        if 0.5 - off(number) <= error || (off(number) - SURE).abs() <= error {
            number = tree.winding(point - before, FINE).0;
        }
        self.is_sure &= off(number) <= SURE;
        number.round() as i32
    }

    /// First visible point, as in [`super::walk::walk`], but with winding numbers evaluated instead of counted along the ray.
    fn walk(&mut self, lines: &BandedScene<'_>, bench: &mut RayScratch) -> Option<VisiblePoint> {
        let (prepared, view) = (lines.prepared, lines.view);
        let RayScratch {
            ranks,
            events,
            state,
            ..
        } = bench;
        // Parts that contain the eye: the ray stays inside such a part until crossings lead out of it.
        let mut within = Vec::new();
        for rank in ranks.iter().copied() {
            let eye = self.ray.origin + self.ray.direction * view.near;
            let bounds = &prepared.parts[usize::from(rank)].bounds;
            if holds(bounds, eye) && !state.removes(prepared, rank) {
                let number = self.at(rank, view.near);
                if prepared.parts[usize::from(rank)].fill.holds(number) {
                    within.push((rank, number));
                }
            }
        }
        if view.near_cap
            && let Some((rank, _)) = within.first()
        {
            return Some(VisiblePoint {
                rank: *rank,
                depth: view.near,
                event: None,
                overlap: within.len() > 1,
            });
        }
        let mut rest: &[Event] = events;
        while let Some(event) = rest.first() {
            let Cause::Mesh { rank, step } = event.cause else {
                let is_beside =
                    |e: &&Event| e.depth == event.depth && matches!(e.cause, Cause::Clip { .. });
                let (now, later) = rest.split_at(rest.iter().take_while(is_beside).count());
                rest = later;
                let was_removed: Vec<bool> =
                    ranks.iter().map(|r| state.removes(prepared, *r)).collect();
                let pass = |state: &mut super::walk::RayState| {
                    now.iter().for_each(|event| state.apply(event));
                };
                pass(state);
                for (rank, was_removed) in ranks.iter().zip(was_removed) {
                    // A face in the clip-surface through which the ray leaves the solid is before it.
                    let has_left = events.iter().any(|e| {
                        e.depth == event.depth
                            && e.place < 0
                            && matches!(e.cause, Cause::Mesh { rank: of, .. } if of == *rank)
                    });
                    let is_free = was_removed && !has_left && !state.removes(prepared, *rank);
                    state.winding[usize::from(*rank)] = if is_free {
                        self.at(*rank, event.depth)
                    } else {
                        0
                    };
                }
                // Applying an event a second time undoes it.
                pass(state);
                if let Some((rank, event, overlap)) = pass_clips(prepared, ranks, now, state) {
                    return Some(VisiblePoint {
                        rank,
                        depth: event.depth,
                        event: Some(event),
                        overlap,
                    });
                }
                continue;
            };
            rest = &rest[1..];
            let still = within.iter().position(|(of, _)| *of == rank);
            if let Some(still) = still {
                within[still].1 += i32::from(step);
                if !prepared.parts[usize::from(rank)]
                    .fill
                    .holds(within[still].1)
                {
                    within.swap_remove(still);
                }
            } else if !state.removes(prepared, rank) {
                return Some(VisiblePoint {
                    rank,
                    depth: event.depth,
                    event: Some(*event),
                    overlap: false,
                });
            }
        }
        None
    }
}
