//! A scene ready to be drawn or evaluated: flattened, recentred, ranked.
//!
//! World space may be far from the origin, tiny or huge; f32 would lose the model. Scene space is world space moved by the
//! bounds' centre and scaled by a power of two, so that the model has a radius between 1/2 and 1. The power of two and an
//! offset with few bits keep simple coordinates exact: a plane through a face still goes through it. Vertices and the
//! origins of clip-surfaces are rounded to f32 once, here, and all users take them from here. An origin that is far from
//! the model keeps its f64 coordinates, since rounding them would move the cut.
//!
//! Parts are ranked by precedence where solids overlap: higher priority first, then the solid that is smaller in its rest pose, so
//! that poses do not change the order. `parts[0]` precedes all others; layers refer to parts by their index in [`Scene::parts`], which
//! [`PreparedPart::part`] keeps.
//!
//! Poses are applied here, in f64, before any rounding: [`Prepared::new`] is the exact scene, and the exact reference evaluates
//! it. A [`Model`](crate::Model) prepares its own scene, and leaves the vertices of moving parts to the
//! device.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::coincidence::shared_planes::SharedPlanes;
use super::{
    Bounds, Camera, ClipSurface, Cutter, Outline, Part, Scene, Style, SurfaceFrame, View, Wrap,
    is_removed_whole, who_wins,
};

mod cuts;
mod part;
mod removed;
mod space;
mod surface;
mod volume;

use cuts::CutTable;
pub use part::PreparedPart;
pub(crate) use part::{facing_out, tolerance_of};
pub use space::SceneSpace;
use space::{NEAR_MODEL, rounded_near};
pub use surface::{PreparedCut, PreparedSurface};
pub use volume::PreparedVolume;

/// A scene in scene space.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// Name of the scene.
    pub name: String,
    /// Parts by rank: where solids overlap, the first wins.
    pub parts: Vec<PreparedPart>,
    /// Clip-surfaces of all cuts in order.
    pub surfaces: Vec<PreparedSurface>,
    /// Cuts in scene order; layers refer to clip-surfaces by these cuts' numbers. Then follow copies of cuts that have an offset
    /// for some parts, with their own clip-surfaces.
    pub cuts: Vec<PreparedCut>,
    /// The stage if it is set, otherwise the bounds of all parts.
    pub bounds: Bounds,
    /// Centre of scene space in world space.
    pub centre_in_world: DVec3,
    /// Scene units per world unit, a power of two.
    pub scale: f64,
    /// [`Scene::interference`].
    pub interference: Option<Vec3>,
    /// Rendering style.
    pub style: Style,
    /// Planes that contain faces of several parts.
    #[doc(hidden)]
    pub shared: Arc<SharedPlanes>,
    camera: Camera,
    outline: Option<Arc<Outline>>,
}

impl Prepared {
    /// Poses, flattens, recentres and ranks a scene.
    pub fn new(scene: &Scene) -> Self {
        Self::in_planes(scene, |parts| SharedPlanes::of(parts, None))
    }

    /// Like [`Prepared::new`], but reuses previously found shared planes.
    pub(crate) fn in_planes(
        scene: &Scene,
        shared: impl FnOnce(&[PreparedPart]) -> Arc<SharedPlanes>,
    ) -> Self {
        let place = |cutter: &Cutter, space: &SceneSpace, _: usize| {
            Arc::new(PreparedVolume::place(cutter, space, None))
        };
        Self::with_parts(scene, &scene.bounds(), PreparedPart::place, place, shared)
    }

    /// Like [`Prepared::new`], but the caller's callbacks prepare parts (from the part's index, the part, scene space and the cuts that
    /// apply), cutters (from the cutter, scene space and the clip-surface's number) and shared planes (from all parts by rank).
    /// `world` is the result of [`Scene::bounds`], passed in because computing it may read every vertex.
    pub(crate) fn with_parts(
        scene: &Scene,
        world: &Bounds,
        place: impl Fn(usize, &Part, &SceneSpace, Vec<usize>) -> PreparedPart + Sync,
        place_volume: impl Fn(&Cutter, &SceneSpace, usize) -> Arc<PreparedVolume>,
        shared: impl FnOnce(&[PreparedPart]) -> Arc<SharedPlanes>,
    ) -> Self {
        let space = SceneSpace::new(world);
        let to_scene = |p: DVec3| space.point(p);
        let table = CutTable::of(scene);
        let mut parts: Vec<PreparedPart> = scene
            .parts
            .par_iter()
            .enumerate()
            .map(|(index, part)| place(index, part, &space, table.cuts_of(scene, part)))
            .collect();
        for part in &mut parts {
            part.is_hidden = is_removed_whole(scene, world, &scene.parts[part.part]);
            if part.is_hidden {
                part.triangles = Arc::default();
            }
        }
        parts.sort_by_cached_key(|p| who_wins(&scene.parts[p.part], p.volume_at_rest, p.part));

        let (cuts, surfaces) = table.placed(scene, &space, place_volume);
        parts.par_iter_mut().for_each(|part| {
            part.is_removed = removed::is_removed(part, &cuts, &surfaces);
        });
        Self {
            name: scene.name.clone(),
            bounds: if scene.stage.is_some() || parts.iter().any(|p| p.is_on_device) {
                Bounds::from_points([world.min, world.max].map(to_scene))
            } else {
                (parts.iter().map(|p| p.bounds)).fold(Bounds::EMPTY, Bounds::union)
            },
            shared: shared(&parts),
            parts,
            surfaces,
            cuts,
            centre_in_world: space.centre_in_world,
            scale: space.scale,
            interference: scene.interference,
            style: scene.style,
            camera: scene.camera,
            outline: scene.fitted_outline(),
        }
    }

    /// The view of the scene's camera.
    pub fn view(&self, size_px: [u32; 2]) -> View {
        self.view_of(&self.camera, size_px)
    }

    /// The view of another camera. It can be fitted to the kept geometry only if the scene's camera is; otherwise it is fitted to the
    /// whole model.
    pub fn view_of(&self, camera: &Camera, size_px: [u32; 2]) -> View {
        self.seen_to_the_end(camera.view_fitted(
            |p| (p - self.centre_in_world) * self.scale,
            self.scale,
            (
                self.bounds,
                self.outline.as_deref().map_or(&[], Outline::points),
            ),
            size_px,
        ))
    }

    /// Outline that the scene's camera is fitted to; `None` if it is fitted to the scene's box.
    #[doc(hidden)]
    pub fn outline(&self) -> Option<&Outline> {
        self.outline.as_deref().filter(|o| !o.is_empty())
    }

    /// The view with its depth range extended to the end of all geometry, so that everything behind is counted. This includes cutters,
    /// which may reach farther than the parts.
    pub(crate) fn seen_to_the_end(&self, view: View) -> View {
        let volumes = self.surfaces.iter().filter_map(|s| s.volume.as_ref());
        let boxes = volumes.map(|v| v.bounds).chain([self.bounds]);
        let farthest = boxes
            .flat_map(|b| b.corners())
            .map(|c| view.depth_of(c))
            .fold(f64::NEG_INFINITY, f64::max);
        let far = view.near + (farthest - view.near) * 1.01;
        View {
            far: view.far.max(far),
            ..view
        }
    }

    /// Up direction in world space.
    #[doc(hidden)]
    pub fn up(&self) -> DVec3 {
        self.camera.up.axis()
    }

    /// Returns true if the vertices of all parts are present here; those placed by a device are absent.
    pub fn is_whole(&self) -> bool {
        !self.parts.iter().any(|p| p.is_on_device)
    }

    /// Panics with the reason if a device places some of the parts.
    ///
    /// # Panics
    ///
    /// If a device places some of the parts: a reference would then evaluate another scene, so the call is
    /// a programming error. [`Prepared::new`] and [`Model::truth`](crate::Model::truth) are whole.
    pub fn must_be_whole(&self) {
        assert!(
            self.is_whole(),
            "{}: the vertices of moving parts are only on the device",
            self.name
        );
    }

    /// Number of triangles of all parts.
    pub fn triangle_count(&self) -> usize {
        self.parts.iter().map(|p| p.triangles.len()).sum()
    }
}

impl PreparedSurface {
    /// Moves a clip-surface to scene space, where its origin is `origin`.
    fn place(surface: &ClipSurface, origin: DVec3, scale: f64, cut: usize) -> Self {
        let mut placed = Self {
            origin,
            frame: surface.frame(),
            map_per_unit: [
                surface.scale.x / (surface.u.length() * scale),
                surface.scale.y / (surface.v.length() * scale),
            ],
            height_scale: surface.scale.z * scale,
            relief: surface.relief.clone(),
            wrap: surface.wrap,
            volume: None,
            cut,
        };
        placed.come_near();
        placed
    }

    /// The clip-surface of a cutter: neither plane nor relief.
    fn of_volume(volume: Arc<PreparedVolume>, cut: usize) -> Self {
        Self {
            origin: volume.bounds.centre(),
            frame: SurfaceFrame {
                u_hat: DVec3::X,
                v_hat: DVec3::Y,
                normal: DVec3::Z,
            },
            map_per_unit: [1.0; 2],
            height_scale: 0.0,
            relief: None,
            wrap: Wrap::default(),
            volume: Some(volume),
            cut,
        }
    }

    /// Moves a far origin by whole map repeats to where f32 can distinguish texels, and rounds an origin near the model.
    fn come_near(&mut self) {
        let repeats = match self.wrap {
            Wrap::Repeat => 1.0,
            Wrap::Mirror => 2.0,
            Wrap::Clamp => 0.0,
        };
        let far = self.origin.abs().max_element() > NEAR_MODEL;
        if far && repeats > 0.0 && self.relief.is_some() {
            let axes = [self.frame.u_hat, self.frame.v_hat];
            for (axis, per_unit) in axes.into_iter().zip(self.map_per_unit) {
                let period = repeats / per_unit.abs();
                let whole = (self.origin.dot(axis) / period).round() * period;
                if whole.is_finite() {
                    self.origin -= axis * whole;
                }
            }
        }
        self.origin = rounded_near(self.origin);
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::scene::{Cut, Mesh};

    fn triangle_at(offset: DVec3, size: f64) -> Scene {
        let positions = [DVec3::ZERO, DVec3::X, DVec3::Y]
            .map(|p| p * size + offset)
            .to_vec();
        let mesh = Mesh {
            positions,
            triangles: vec![[0, 1, 2]],
            corner_normals: None,
            vertex_paint: None,
        };
        Scene {
            parts: vec![Part::new("t", mesh)],
            ..Scene::default()
        }
    }

    #[test]
    fn far_tiny_and_huge_scenes_become_alike() {
        for (offset, size) in [(0.0, 1.0), (1e6, 1.0), (0.0, 1e6), (0.0, 1e-6), (1e3, 1e-6)] {
            let prepared = Prepared::new(&triangle_at(DVec3::splat(offset), size));
            let radius = prepared.bounds.radius();
            assert!(
                (0.4..=1.001).contains(&radius),
                "radius {radius} for offset {offset}, size {size}"
            );
            assert!(
                prepared.bounds.centre().length() < 2e-3,
                "centre {}",
                prepared.bounds.centre()
            );
        }
    }

    #[test]
    fn simple_coordinates_stay_exact() {
        let prepared = Prepared::new(&triangle_at(DVec3::splat(0.25), 0.5));
        let back =
            prepared.parts[0].positions[1].as_dvec3() / prepared.scale + prepared.centre_in_world;
        assert_eq!(
            back,
            DVec3::new(0.75, 0.25, 0.25),
            "the round trip moved a vertex"
        );
    }

    #[test]
    fn a_far_origin_does_not_move_the_cut() {
        let normal = DVec3::new(3.0, 1.0, 0.5);
        let far = normal.cross(DVec3::Z).normalize() * 1e6;
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            for relief in [false, true] {
                let mut scene = triangle_at(DVec3::ZERO, 1.0);
                let mut surface = ClipSurface::plane(far, normal);
                surface.wrap = wrap;
                surface.scale = DVec3::new(0.3, -0.7, 0.1);
                if relief {
                    let map =
                        crate::scene::OffsetMap::new([3, 2], vec![0.0, 0.7, 0.2, 0.9, 0.1, 0.4]);
                    surface.relief = Some(Arc::new(map.expect("finite heights")));
                }
                scene.cuts = vec![Cut::new("far", vec![surface.clone()])];
                let prepared = Prepared::new(&scene);
                let placed = &prepared.surfaces[0];
                for point in [DVec3::ZERO, DVec3::new(0.3, 0.6, 0.1), DVec3::NEG_ONE] {
                    let d = (point - prepared.centre_in_world) * prepared.scale - placed.origin;
                    let texture = DVec2::new(
                        d.dot(placed.frame.u_hat) * placed.map_per_unit[0],
                        d.dot(placed.frame.v_hat) * placed.map_per_unit[1],
                    );
                    let height = (placed.relief.as_ref())
                        .map_or(0.0, |m| m.sample(wrap, texture).0 * placed.height_scale);
                    let kept = (d.dot(placed.frame.normal) + height) / prepared.scale;
                    let wanted = surface.kept_height(point);
                    assert!(
                        (kept - wanted).abs() < 1e-6,
                        "{wrap:?}, relief {relief}, {point}: {kept} instead of {wanted}"
                    );
                }
            }
        }
    }
}
