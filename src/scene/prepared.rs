//! A scene ready to be drawn or evaluated: flattened, recentred, ranked.
//!
//! World space may be far from the origin, tiny or huge; f32 would lose the model. Scene space is world space moved by the
//! bounds' centre and scaled by a power of two, so that the model has a radius between 1/2 and 1. A power of two and an
//! offset with few bits keep simple coordinates exact: a plane through a face still goes through it. Vertices and the
//! origins of clip-surfaces are rounded to f32 once, here, and everybody takes them from here. An origin may be far from the
//! model all the same; there its coordinates keep their f64, since rounding them would move the cut.
//!
//! Parts are ranked by who wins where solids share a point: higher priority first, then the smaller solid. `parts[0]` wins
//! over all; layers name parts by their index in [`Scene::parts`], kept in [`PreparedPart::part`].

use std::sync::Arc;

use glam::{DMat3, DVec3, Vec3};
use rayon::prelude::*;

use super::{
    Bounds, Camera, ClipSurface, Cut, DEFAULT_CREASE_DEG, Fill, Material, OffsetMap, Part, Scene,
    ShadingMesh, SurfaceFrame, View, Wrap,
};

/// A part in scene space.
#[derive(Clone, Debug)]
pub struct PreparedPart {
    /// Index in [`Scene::parts`].
    pub part: usize,
    /// Name of the part.
    pub name: String,
    /// Vertices in scene space, rounded to f32.
    pub positions: Vec<Vec3>,
    /// Counter-clockwise from outside, indices into `positions`.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals at the corners of `triangles`, in scene space, where the mesh has them.
    pub corner_normals: Option<Vec<[Vec3; 3]>>,
    /// What is drawn: `positions` split where the surface has a crease, with a normal each.
    pub shading: ShadingMesh,
    /// Bounds of `positions`.
    pub bounds: Bounds,
    /// Look.
    pub material: Material,
    /// Which points the mesh encloses.
    pub fill: Fill,
    /// Indices into [`Prepared::cuts`] of the cuts that apply.
    pub cuts: Vec<usize>,
}

/// A clip-surface in scene space. `T = map_from_scene * (P - origin)`, kept height `(P - origin).N + f(T).height_scale`.
#[derive(Clone, Debug)]
pub struct PreparedSurface {
    /// `O`, rounded to f32 where it is near the model; of a relief that repeats, the repeat of `O` near the model.
    pub origin: DVec3,
    /// `Û`, `V̂`, `N`.
    pub frame: SurfaceFrame,
    /// Texture coordinates per scene unit along `Û` and `V̂`: `Sx / |U|` and `Sy / |V|`.
    pub map_per_unit: [f64; 2],
    /// `Sz` in scene units.
    pub height_scale: f64,
    /// Offset map, for a relief.
    pub relief: Option<Arc<OffsetMap>>,
    /// How the map goes on outside 0..1.
    pub wrap: Wrap,
    /// Index into [`Prepared::cuts`].
    pub cut: usize,
}

/// A cut by the numbers of its clip-surfaces.
#[derive(Clone, Debug)]
pub struct PreparedCut {
    /// Name of the cut.
    pub name: String,
    /// Indices into [`Prepared::surfaces`]; all removed sides together make the removed region.
    pub surfaces: Vec<usize>,
}

/// A scene in scene space.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// Name of the scene.
    pub name: String,
    /// Parts by rank: the first wins where solids share a point.
    pub parts: Vec<PreparedPart>,
    /// Clip-surfaces of all cuts in order.
    pub surfaces: Vec<PreparedSurface>,
    /// Cuts in order.
    pub cuts: Vec<PreparedCut>,
    /// The stage, or else the bounds of all parts.
    pub bounds: Bounds,
    /// Centre of scene space in world space.
    pub centre_in_world: DVec3,
    /// Scene units per world unit, a power of two.
    pub scale: f64,
    camera: Camera,
}

impl Prepared {
    /// Flattens, recentres and ranks a scene.
    pub fn of(scene: &Scene) -> Self {
        let world = scene.bounds();
        let radius = world.radius();
        let scale = if radius > 0.0 && radius.is_finite() {
            (-radius.log2().ceil()).exp2()
        } else {
            1.0
        };
        // 2^-10 of the radius: few enough bits that moving by it is exact for coordinates that have few bits themselves.
        let grid = 1.0 / (scale * 1024.0);
        let centre_in_world = (world.centre() / grid).round() * grid;
        let to_scene = |p: DVec3| (p - centre_in_world) * scale;

        let mut parts: Vec<PreparedPart> = scene
            .parts
            .par_iter()
            .enumerate()
            .map(|(index, part)| {
                let applies = |(i, c): (usize, &Cut)| c.applies_to(part).then_some(i);
                let cuts = scene.cuts.iter().enumerate().filter_map(applies);
                PreparedPart::place(index, part, to_scene, cuts.collect())
            })
            .collect();
        let volume = |p: &PreparedPart| {
            let part = &scene.parts[p.part];
            part.mesh.volume().abs() * part.world_from_part.matrix3.determinant().abs()
        };
        let mut ranked: Vec<(i64, f64)> = Vec::with_capacity(parts.len());
        for p in &parts {
            ranked.push((
                scene.parts[p.part].priority.map_or(i64::MIN, i64::from),
                volume(p),
            ));
        }
        parts.sort_by(|a, b| {
            let ((pa, va), (pb, vb)) = (ranked[a.part], ranked[b.part]);
            pb.cmp(&pa)
                .then(va.total_cmp(&vb))
                .then(a.part.cmp(&b.part))
        });

        let mut surfaces = Vec::new();
        let mut cuts = Vec::new();
        for cut in &scene.cuts {
            let first = surfaces.len();
            surfaces.extend(
                cut.surfaces
                    .iter()
                    .map(|s| PreparedSurface::place(s, to_scene(s.origin), scale, cuts.len())),
            );
            cuts.push(PreparedCut {
                name: cut.name.clone(),
                surfaces: (first..surfaces.len()).collect(),
            });
        }
        Self {
            name: scene.name.clone(),
            bounds: match scene.stage {
                Some(stage) => Bounds::of([stage.min, stage.max].map(to_scene)),
                None => (parts.iter().map(|p| p.bounds)).fold(Bounds::EMPTY, Bounds::union),
            },
            parts,
            surfaces,
            cuts,
            centre_in_world,
            scale,
            camera: scene.camera,
        }
    }

    /// The view of the scene's camera.
    pub fn view(&self, size_px: [u32; 2]) -> View {
        self.view_of(&self.camera, size_px)
    }

    /// The view of another camera.
    pub fn view_of(&self, camera: &Camera, size_px: [u32; 2]) -> View {
        camera.view(
            |p| (p - self.centre_in_world) * self.scale,
            self.scale,
            self.bounds,
            size_px,
        )
    }

    /// How many triangles all parts have.
    pub fn triangle_count(&self) -> usize {
        self.parts.iter().map(|p| p.triangles.len()).sum()
    }
}

/// Coordinates up to this are rounded as those of vertices are: the model reaches to 1.
const NEAR_MODEL: f64 = 4.0;

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
            cut,
        };
        placed.come_near();
        placed
    }

    /// Moves a far origin by whole repeats of the map to where f32 tells texels apart, and rounds what is near.
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
        for c in self.origin.as_mut() {
            if c.abs() <= NEAR_MODEL {
                *c = f64::from(*c as f32);
            }
        }
    }
}

impl PreparedPart {
    /// Moves a part to scene space. A mirroring placement turns the triangles round, so that outside stays outside.
    fn place(
        index: usize,
        part: &Part,
        to_scene: impl Fn(DVec3) -> DVec3,
        cuts: Vec<usize>,
    ) -> Self {
        let m = part.world_from_part;
        let mirrored = m.matrix3.determinant() < 0.0;
        let normal_from_part = normal_matrix(m.matrix3);
        let turned = |n: Vec3| {
            let turned = normal_from_part * n.as_dvec3();
            turned.normalize_or_zero().as_vec3()
        };
        let positions: Vec<Vec3> = part
            .mesh
            .positions
            .iter()
            .map(|p| to_scene(m.transform_point3(*p)).as_vec3())
            .collect();
        let mut placed = Self {
            part: index,
            name: part.name.clone(),
            bounds: Bounds::of(positions.iter().map(|p| p.as_dvec3())),
            positions,
            triangles: part
                .mesh
                .triangles
                .iter()
                .map(|t| facing_out(*t, mirrored))
                .collect(),
            corner_normals: part.mesh.corner_normals.as_ref().map(|all| {
                all.iter()
                    .map(|n| facing_out(n.map(turned), mirrored))
                    .collect()
            }),
            shading: ShadingMesh::default(),
            material: part.material,
            fill: part.fill,
            cuts,
        };
        placed.shading = ShadingMesh::of(&placed, DEFAULT_CREASE_DEG);
        placed
    }
}

/// The corners of a triangle, the other way round where its placement mirrors.
fn facing_out<T>([a, b, c]: [T; 3], mirrored: bool) -> [T; 3] {
    if mirrored { [a, c, b] } else { [a, b, c] }
}

fn normal_matrix(m: DMat3) -> DMat3 {
    if m.determinant() == 0.0 {
        m
    } else {
        m.inverse().transpose()
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::scene::Mesh;

    fn triangle_at(offset: DVec3, size: f64) -> Scene {
        let positions = [DVec3::ZERO, DVec3::X, DVec3::Y]
            .map(|p| p * size + offset)
            .to_vec();
        let mesh = Mesh {
            positions,
            triangles: vec![[0, 1, 2]],
            corner_normals: None,
        };
        Scene {
            parts: vec![Part::new("t", mesh)],
            ..Scene::default()
        }
    }

    #[test]
    fn far_tiny_and_huge_scenes_become_alike() {
        for (offset, size) in [(0.0, 1.0), (1e6, 1.0), (0.0, 1e6), (0.0, 1e-6), (1e3, 1e-6)] {
            let prepared = Prepared::of(&triangle_at(DVec3::splat(offset), size));
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
        let prepared = Prepared::of(&triangle_at(DVec3::splat(0.25), 0.5));
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
                    let map = OffsetMap::new([3, 2], vec![0.0, 0.7, 0.2, 0.9, 0.1, 0.4]);
                    surface.relief = Some(Arc::new(map.expect("finite heights")));
                }
                scene.cuts = vec![Cut::of("far", vec![surface.clone()])];
                let prepared = Prepared::of(&scene);
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
