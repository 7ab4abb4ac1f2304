//! One ray: takes its crossings with the meshes, finds those with the clip-surfaces of the parts it meets, and returns what it sees.
//!
//! Crossings with clip-surfaces are searched between the first and the last mesh crossing, and slightly beyond: elsewhere there
//! is no solid to cut.

use cutaway::layers::{Kind, Layer, NEAR_PLANE};
use glam::DVec2;

use super::clip::Ray;
use super::outline::Brush;
use super::raster::{Crossing, Projected};
use super::ray_scratch::RayScratch;
use super::walk::{Cause, VisiblePoint, walk};
use super::{BandedScene, cutter, shading};

/// Distance before the first and behind the last mesh crossing within which clip-surfaces are searched, in pixels at that depth: events
/// farther apart than this are never too close to order.
const PAD_PX: f64 = 4.0;

/// Result of following a ray.
pub(super) struct Followed {
    pub(super) layer: Layer,
    pub(super) sight: Option<VisiblePoint>,
    /// True if the line crosses some part or cutter as no closed mesh is crossed.
    pub(super) is_odd: bool,
    /// True if there is a crossing or an outline beyond the near plane.
    pub(super) meets_something: bool,
}

impl<'a> BandedScene<'a> {
    /// Follows the ray of a sample. `found` holds the ray's crossings with all meshes, `brushes` the outlines of parts near the sample.
    /// Until `bench` is cleared, it keeps the sorted events and the state before the first.
    pub(super) fn follow(
        &self,
        at: DVec2,
        ray: &Ray,
        found: &[Crossing],
        brushes: &[Brush],
        bench: &mut RayScratch,
    ) -> Followed {
        let (prepared, view) = (self.prepared, self.view);
        let (found, of_cutters) = found.split_at(self.cutters.split(found, |c| c.rank));
        // Start a little before the near plane, so that an event just before the plane is found and counted as close.
        let before_near = view.before_near(self.pad(view.near));
        let mut is_odd = bench.sort_crossings(found, brushes, before_near);
        let in_boxes = self.open_parts.meet(prepared, ray, bench);
        let depths = (bench.crossings.iter().map(|c| c.depth))
            .chain(
                brushes
                    .iter()
                    .flat_map(|b| [b.depth - b.margin, b.depth + b.margin]),
            )
            .fold(in_boxes, |[lo, hi], d| [lo.min(d), hi.max(d)]);
        let mut layer = Layer {
            unreliable: is_odd && !self.open_parts.explain(bench),
            depth: f64::INFINITY,
            ..Layer::default()
        };
        if depths[0] > depths[1] {
            return Followed {
                layer,
                sight: None,
                is_odd,
                meets_something: false,
            };
        }
        self.open_parts.start(prepared, ray, view.near, bench);
        let inside_at_near = bench.ranks.iter().any(|r| bench.start.is_inside(*r));
        let from = if inside_at_near {
            before_near
        } else {
            (depths[0] - self.pad(depths[0])).max(before_near)
        };
        let range = [from, depths[1] + self.pad(depths[1])];
        let is_cutter_odd = self.meet_clips(ray, range, of_cutters, bench);
        is_odd |= is_cutter_odd;
        layer.unreliable |= is_cutter_odd;
        self.open_parts.list(prepared, ray, bench);
        self.classify(at, ray, bench);
        bench.merge_events();
        bench.state.set(&bench.start);
        let sight = walk(
            prepared,
            (view.near, view.near_cap),
            &bench.ranks,
            &bench.events,
            &mut bench.state,
        );
        if let Some(sight) = sight {
            self.show(ray, &sight, bench, &mut layer);
        }
        Followed {
            layer,
            sight,
            is_odd,
            meets_something: true,
        }
    }

    pub(super) fn pad(&self, depth: f64) -> f64 {
        PAD_PX * self.view.pixel_size(depth).abs()
    }

    /// Lists the ray's crossings with the clip-surfaces of the parts it meets. Returns true if the ray's side of some cutter is undefined.
    pub(super) fn meet_clips(
        &self,
        ray: &Ray,
        range: [f64; 2],
        of_cutters: &[Crossing],
        bench: &mut RayScratch,
    ) -> bool {
        let mut odd = false;
        for rank in &bench.ranks {
            for cut in &self.prepared.parts[*rank as usize].cuts {
                for surface in &self.prepared.cuts[*cut].surfaces {
                    if std::mem::replace(&mut bench.met[*surface], true) {
                        continue;
                    }
                    if let Some(volume) = &self.prepared.surfaces[*surface].volume {
                        let number = *surface as u16;
                        let rank = self.cutters.rank_of(number);
                        bench.of_cutter.clear();
                        let own = of_cutters.iter().filter(|c| c.rank == rank);
                        bench.of_cutter.extend(own);
                        let mesh = (self.mesh_of_cutter(number), number, volume.keeps_inside);
                        let met =
                            cutter::meet(mesh, ray, range, &mut bench.of_cutter, &mut bench.roots);
                        bench.start.removed[*surface] = met.removed;
                        odd |= met.odd;
                        continue;
                    }
                    bench.start.removed[*surface] = self.clips[*surface].meet(
                        self.view,
                        ray,
                        range,
                        &mut bench.roots,
                        &mut bench.grazes,
                    );
                }
            }
        }
        odd
    }

    /// The mesh of a cutter, by the number of its clip-surface.
    pub(super) fn mesh_of_cutter(&self, surface: u16) -> &Projected<'a> {
        &self.parts[usize::from(self.cutters.rank_of(surface))]
    }

    /// Writes the visible point into the layer.
    pub(super) fn show(
        &self,
        ray: &Ray,
        sight: &VisiblePoint,
        bench: &RayScratch,
        layer: &mut Layer,
    ) {
        layer.part = self.prepared.parts[sight.rank as usize].part as u16;
        layer.depth = sight.depth;
        layer.overlap = sight.overlap;
        match sight.event.map(|e| (e.cause, e.source as usize)) {
            None => {
                layer.kind = Kind::Cap;
                layer.clip_surface = NEAR_PLANE;
                layer.normal = (-self.view.forward).as_vec3();
            }
            Some((Cause::Clip { surface, .. }, source)) => {
                layer.kind = Kind::Cap;
                layer.clip_surface = surface as u8;
                let root = &bench.roots[source];
                layer.normal = match root.face {
                    None => shading::cap_normal(root),
                    Some(face) => {
                        let mesh = self.mesh_of_cutter(surface);
                        let point = ray.origin + ray.direction * sight.depth;
                        shading::cutter_normal(mesh, root, face, point)
                    }
                };
            }
            Some((Cause::Mesh { .. }, source)) => {
                let crossing = &bench.crossings[source];
                layer.kind = Kind::Surface;
                layer.back_face = crossing.back_face;
                let point = ray.origin + ray.direction * sight.depth;
                let part = &self.parts[sight.rank as usize];
                layer.normal = shading::surface_normal(part, crossing, point);
            }
        }
    }
}
