//! Random scenes as recipes: plain numbers that define a scene, can be simplified one step at a time, and print as code that can be
//! pasted into a numbered regression test.

use cutaway::passes::Model;
use cutaway::scene::{
    Camera, ClipSurface, Cut, Part, Projection, Role, Scene, Style, Viewpoint, Wrap,
};
use glam::{DAffine3, DQuat, DVec3, EulerRot};

use crate::hard_cases::numbers::Numbers;
use crate::hard_cases::{Question, meshes, scenes};

/// Size of most pictures in pixels.
const WHOLE_PX: [u32; 2] = [64, 48];

/// Size in pixels of a large picture; only some of its rows are drawn.
const PRINT_PX: [u32; 2] = [2400, 1800];

/// Number of rows drawn of a large picture.
const ROWS: u32 = 8;

/// Scale applied to prisms, whose length is 4, and to rods, whose length is 6.
const LONG: f64 = 0.25;

/// A solid.
#[derive(Clone, Debug, PartialEq)]
pub enum RandomSolid {
    /// Cells of a lattice with spacing 1/4.
    Cells(Vec<[i32; 3]>),
    /// A ball with lumps.
    Lumpy {
        /// Number of subdivisions of the icosphere.
        subdivisions: u32,
        /// Maximum height of the lumps, as a share of the radius.
        lumps: f64,
        /// Phase of the lumps.
        phase: f64,
    },
    /// Prisms side by side, whose walls are long and narrow triangles.
    Prisms {
        /// Number of prisms.
        count: usize,
        /// Number of sides of each prism.
        sides: u32,
    },
    /// A rod with teeth, whose walls are even narrower.
    Toothed {
        /// Number of teeth.
        teeth: u32,
    },
}

/// A clip-surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Normal of the plane, pointing to the kept side.
    pub normal: [f64; 3],
    /// A point of the plane.
    pub at: [f64; 3],
    /// Noise that turns the plane into a relief.
    pub bumps: Option<Bumps>,
}

/// A map of noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Bumps {
    /// Size of the map, in texels.
    pub size: [u32; 2],
    /// Seed of the noise.
    pub seed: u64,
    /// Height difference between the lowest and highest possible texel.
    pub height: f64,
    /// Length of one repeat.
    pub period: f64,
    /// Wrap mode outside the map.
    pub wrap: Wrap,
}

/// A scene and a camera.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recipe {
    /// Parts, each with its translation.
    pub solids: Vec<(RandomSolid, [f64; 3])>,
    /// True if the first part is never cut.
    pub spared: bool,
    /// True if the last part is seen where parts share a point, whatever its size.
    pub preferred: bool,
    /// Clip-surfaces of each cut.
    pub cuts: Vec<Vec<Surface>>,
    /// The eye.
    pub from: [f64; 3],
    /// Point that the eye looks at.
    pub to: [f64; 3],
    /// Field of view in degrees; `None` for parallel rays.
    pub fov_deg: Option<f64>,
    /// Distance of the near plane; `None` picks one.
    pub near: Option<f64>,
    /// Angles by which parts and clip-surfaces are rotated together, about x, then y, then z.
    pub turned: [f64; 3],
    /// First of the rows drawn of a large picture; `None` draws a small one.
    pub first_row: Option<u32>,
    /// If set, each triangle is split in three, one of them a needle; the value is the needle's width over the triangle's height.
    pub needles: Option<f64>,
}

impl Recipe {
    /// A random recipe.
    pub fn random(n: &mut Numbers) -> Self {
        let solids = (0..1 + n.below(2))
            .map(|_| (solid(n), point(n, 0.2)))
            .collect();
        let cuts = (0..1 + n.below(2))
            .map(|_| (0..1 + n.below(2)).map(|_| surface(n)).collect())
            .collect();
        // One eye in four is within the solids or just outside them.
        let reach = if n.once_in(4) { 0.35 } else { 2.5 };
        let mut from = point(n, 1.0);
        if DVec3::from_array(from).length() < 0.3 {
            from[2] += 0.5;
        }
        let mut recipe = Self {
            solids,
            spared: n.once_in(6),
            preferred: n.once_in(3),
            cuts,
            from: from.map(|c| c * reach),
            to: point(n, 0.2),
            fov_deg: (!n.once_in(4)).then(|| n.between(20.0, 80.0)),
            near: n.once_in(4).then(|| n.between(0.01, 1.0) * reach),
            ..Self::default()
        };
        // Options added later draw their random numbers last, so that scenes without these options stay the same.
        if n.once_in(4) {
            // Parts touch, are flush or share faces.
            for (_, at) in &mut recipe.solids {
                *at = at.map(|c| (c * 8.0).round() * 0.125);
            }
        }
        if n.once_in(6) {
            let count = 1 + n.below(40) as usize;
            let sides = 3 + n.below(22) as u32;
            recipe.solids[0].0 = RandomSolid::Prisms { count, sides };
        }
        if n.once_in(3) {
            recipe.turned = point(n, std::f64::consts::PI);
        }
        if n.once_in(12) {
            recipe.first_row = Some(n.below(u64::from(PRINT_PX[1] - ROWS)) as u32);
        }
        if n.once_in(8) {
            recipe.needles = Some(10.0_f64.powf(n.between(-7.0, -1.5)));
        }
        if n.once_in(16) {
            let teeth = 20 + n.below(600) as u32;
            recipe.solids[0].0 = RandomSolid::Toothed { teeth };
            recipe.first_row = Some(n.below(u64::from(PRINT_PX[1] - ROWS)) as u32);
        }
        recipe
    }

    /// The scene in its view, with its reference.
    pub fn question(&self) -> Question {
        let scene = self.scene();
        let Some(first) = self.first_row else {
            return Question::new(&scene, WHOLE_PX);
        };
        let model = Model::new(&scene);
        let view = model.prepared.view(PRINT_PX).rows(first, ROWS);
        Question::of_model(model, &scene, view)
    }

    /// The scene.
    pub fn scene(&self) -> Scene {
        let [x, y, z] = self.turned;
        let turn = DQuat::from_euler(EulerRot::ZYX, z, y, x);
        let parts = self.solids.iter().enumerate().map(|(i, (solid, at))| {
            let mesh = match solid {
                RandomSolid::Cells(cells) => meshes::cells(cells, 0.25),
                RandomSolid::Lumpy {
                    subdivisions,
                    lumps,
                    phase,
                } => meshes::lumpy(*subdivisions, *lumps, *phase),
                RandomSolid::Prisms { count, sides } => meshes::moved(
                    &meshes::prisms(*count, *sides),
                    DAffine3::from_scale(DVec3::splat(LONG)),
                ),
                RandomSolid::Toothed { teeth } => meshes::moved(
                    &meshes::toothed(*teeth),
                    DAffine3::from_scale(DVec3::splat(LONG)),
                ),
            };
            let mesh = match self.needles {
                Some(share) => meshes::with_needles(&mesh, share),
                None => mesh,
            };
            let mut part = Part::new(format!("solid {i}"), mesh);
            if self.spared && i == 0 && self.solids.len() > 1 {
                part.role = Role::Interior;
            }
            if self.preferred && i + 1 == self.solids.len() {
                part.priority = Some(1);
            }
            let at = turn * DVec3::from_array(*at);
            part.world_from_part = DAffine3::from_rotation_translation(turn, at);
            part
        });
        let cuts = self.cuts.iter().enumerate().map(|(i, surfaces)| {
            Cut::new(
                format!("cut {i}"),
                surfaces.iter().map(|s| s.made(turn)).collect(),
            )
        });
        Scene {
            name: "random".to_owned(),
            parts: parts.collect(),
            cuts: cuts.collect(),
            outline: None,
            camera: Camera {
                viewpoint: Viewpoint::Explicit {
                    position: DVec3::from_array(self.from),
                    focal_point: DVec3::from_array(self.to),
                    view_up: None,
                },
                projection: match self.fov_deg {
                    Some(fov_y_deg) => Projection::Perspective { fov_y_deg },
                    None => Projection::Orthographic { height: Some(1.6) },
                },
                near: self.near,
                ..Camera::default()
            },
            stage: None,
            interference: None,
            style: Style::default(),
        }
    }

    /// Recipes that are a little simpler.
    pub fn simpler(&self) -> Vec<Self> {
        let mut all = Vec::new();
        let mut with = |change: &dyn Fn(&mut Self)| {
            let mut other = self.clone();
            change(&mut other);
            if other != *self {
                all.push(other);
            }
        };
        for i in 0..self.solids.len() {
            if self.solids.len() > 1 {
                with(&|r| {
                    r.solids.remove(i);
                });
            }
            with(&|r| r.solids[i].1 = [0.0; 3]);
            match &self.solids[i].0 {
                RandomSolid::Cells(cells) if cells.len() > 1 => {
                    for c in 0..cells.len() {
                        let mut fewer = cells.clone();
                        fewer.remove(c);
                        with(&|r| r.solids[i].0 = RandomSolid::Cells(fewer.clone()));
                    }
                }
                RandomSolid::Lumpy {
                    subdivisions: 1.., ..
                } => with(&|r| {
                    if let RandomSolid::Lumpy { subdivisions, .. } = &mut r.solids[i].0 {
                        *subdivisions -= 1;
                    }
                }),
                RandomSolid::Prisms { count, sides } => {
                    let (count, sides) = (*count, *sides);
                    for (count, sides) in [(count.div_ceil(2), sides), (count, sides.max(4) - 1)] {
                        with(&|r| r.solids[i].0 = RandomSolid::Prisms { count, sides });
                    }
                }
                RandomSolid::Toothed { teeth } if *teeth > 3 => {
                    let teeth = teeth / 2;
                    with(&|r| r.solids[i].0 = RandomSolid::Toothed { teeth });
                }
                _ => {}
            }
        }
        for i in 0..self.cuts.len() {
            if self.cuts.len() > 1 {
                with(&|r| {
                    r.cuts.remove(i);
                });
            }
            for j in 0..self.cuts[i].len() {
                if self.cuts[i].len() > 1 {
                    with(&|r| {
                        r.cuts[i].remove(j);
                    });
                }
                with(&|r| r.cuts[i][j].bumps = None);
                if let Some(bumps) = &self.cuts[i][j].bumps {
                    let halved = bumps.size.map(|s| s.div_ceil(2));
                    with(&|r| {
                        if let Some(b) = &mut r.cuts[i][j].bumps {
                            b.size = halved;
                        }
                    });
                }
            }
        }
        with(&|r| r.to = [0.0; 3]);
        with(&|r| r.near = None);
        with(&|r| r.turned = [0.0; 3]);
        with(&|r| r.first_row = None);
        with(&|r| r.needles = None);
        with(&|r| r.spared = false);
        with(&|r| r.preferred = false);
        all
    }
}

impl Surface {
    fn made(&self, turn: DQuat) -> ClipSurface {
        let [at, normal] = [self.at, self.normal].map(|v| turn * DVec3::from_array(v));
        let Some(bumps) = &self.bumps else {
            return ClipSurface::plane(at, normal);
        };
        let noise = |x: u32, y: u32| {
            let place = u64::from(y) << 32 | u64::from(x);
            (Numbers(bumps.seed ^ place.wrapping_mul(0x9e37_79b9)).unit() - 0.5) as f32
        };
        let map = scenes::map(bumps.size, noise);
        scenes::mapped(at, normal, map, (bumps.period, bumps.height), bumps.wrap)
    }
}

fn point(n: &mut Numbers, reach: f64) -> [f64; 3] {
    [(); 3].map(|()| n.between(-reach, reach))
}

fn solid(n: &mut Numbers) -> RandomSolid {
    if n.once_in(2) {
        let mut cells: Vec<[i32; 3]> = (0..2 + n.below(9))
            .map(|_| [(); 3].map(|()| n.below(4) as i32 - 2))
            .collect();
        cells.sort_unstable();
        cells.dedup();
        RandomSolid::Cells(cells)
    } else {
        RandomSolid::Lumpy {
            subdivisions: 1 + n.below(3) as u32,
            lumps: n.between(0.0, 0.4),
            phase: n.between(0.0, 6.0),
        }
    }
}

fn surface(n: &mut Numbers) -> Surface {
    let mut normal = point(n, 1.0);
    if n.once_in(4) {
        // View along an axis: rays pass through faces, edges and vertices of cells.
        normal = [0.0; 3];
        normal[n.below(3) as usize] = if n.once_in(2) { 1.0 } else { -1.0 };
    }
    let at = if n.once_in(4) {
        [(); 3].map(|()| f64::from(n.below(5) as i32 - 2) * 0.25)
    } else {
        point(n, 0.3)
    };
    let wraps = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];
    let bumps = n.once_in(2).then(|| Bumps {
        size: [(); 2].map(|()| 1 + n.below(16) as u32),
        seed: n.word(),
        height: n.between(0.0, 0.4),
        period: n.between(0.5, 2.0),
        wrap: wraps[n.below(3) as usize],
    });
    Surface { normal, at, bumps }
}
