//! Surfaces that can classify a part's triangles, and the triangles sorted by the surfaces that classify them.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;

use crate::plan::Piece;
use crate::scene::{FlatSurface, PreparedVolume, Side};

/// Surface that can classify triangles.
#[derive(Clone, Debug)]
pub(crate) enum ClassifiedBy {
    /// A clip-surface without relief.
    Flat(FlatSurface),
    /// A cutter.
    Volume(Arc<PreparedVolume>),
}

impl PartialEq for ClassifiedBy {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Flat(a), Self::Flat(b)) => a == b,
            (Self::Volume(a), Self::Volume(b)) => Arc::ptr_eq(&a.positions, &b.positions),
            _ => false,
        }
    }
}

/// A clip-surface with its number.
pub(crate) type NumberedSurface = (u16, ClassifiedBy);

/// Surfaces and shared planes that can classify triangles of a part.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Classifiers {
    /// Clip-surfaces close to the part.
    pub(crate) surfaces: Vec<NumberedSurface>,
    /// Triangles in planes shared between parts, each with the number of its plane.
    pub(crate) shared: Arc<[(u32, u16)]>,
}

impl Classifiers {
    /// Returns true if there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.surfaces.is_empty() && self.shared.is_empty()
    }
}

/// Resolution at which normal components distinguish planes, in steps per unit.
pub(crate) const NORMAL_STEPS: f32 = 4096.0;

/// Position of triangles relative to the surfaces that classify them.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Lie {
    /// Numbers of clip-surfaces, each with the side on which the triangles lie.
    pub(crate) sides: Vec<(u16, Side)>,
    /// Numbers of the clip-surfaces in which the triangles lie.
    pub(crate) flush: Vec<u16>,
    /// Numbers of the cutters in whose faces the triangles lie.
    pub(crate) in_cutters: Vec<u16>,
    /// Normal of the cutter faces, up to sign, in steps of 1 / [`NORMAL_STEPS`].
    pub(crate) normal: [i32; 3],
    /// True if they coincide with other triangles.
    pub(crate) is_doubled: bool,
    /// Number of the plane in which they are coplanar with triangles of other parts.
    pub(crate) plane: Option<u16>,
}

/// Triangles of a part with the same position relative to the classifying surfaces.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ClassifiedGroup {
    pub(crate) lie: Lie,
    pub(crate) indices: Range<u32>,
}

/// A part's indices, its preclassified triangles last.
#[derive(Debug)]
pub(crate) struct Sorted {
    /// The groups with their ranges of the part's indices, in order.
    pub(crate) groups: Vec<ClassifiedGroup>,
    pub(crate) indices: Arc<[u8]>,
}

impl Sorted {
    /// Sorts the triangles of a part; `None` if none is preclassified. `indices` are the triangles as they are drawn, in the same order;
    /// `doubled` are the triangles that coincide with another triangle.
    pub(crate) fn of(
        by: &Classifiers,
        (positions, triangles): (&[Vec3], &[[u32; 3]]),
        plane_tolerance: f64,
        (indices, doubled): (&[u8], &[u32]),
    ) -> Option<Self> {
        let mut lies: BTreeMap<u32, Lie> = BTreeMap::new();
        for (number, surface) in &by.surfaces {
            match surface {
                ClassifiedBy::Flat(flat) => {
                    for preclassified in flat.preclassified(positions, triangles, plane_tolerance) {
                        let lie = lies.entry(preclassified.triangle).or_default();
                        lie.sides.push((*number, preclassified.side));
                        if preclassified.is_in {
                            lie.flush.push(*number);
                        }
                    }
                }
                ClassifiedBy::Volume(volume) => {
                    for triangle in volume.shared_faces(positions, triangles) {
                        let lie = lies.entry(triangle).or_default();
                        lie.in_cutters.push(*number);
                        lie.normal =
                            normal_of(triangles[triangle as usize].map(|i| positions[i as usize]));
                    }
                }
            }
        }
        for triangle in doubled {
            lies.entry(*triangle).or_default().is_doubled = true;
        }
        for (triangle, plane) in by.shared.iter() {
            lies.entry(*triangle).or_default().plane = Some(*plane);
        }
        if lies.is_empty() {
            return None;
        }
        let drawn: &[[u32; 3]] = bytemuck::cast_slice(indices);
        let rest = (0..drawn.len() as u32).filter(|t| !lies.contains_key(t));
        let mut sorted: Vec<[u32; 3]> = rest.map(|t| drawn[t as usize]).collect();
        let mut alike: BTreeMap<Lie, Vec<u32>> = BTreeMap::new();
        for (triangle, lie) in lies {
            alike.entry(lie).or_default().push(triangle);
        }
        let mut groups = Vec::new();
        for (lie, triangles) in alike {
            let first = 3 * sorted.len() as u32;
            sorted.extend(triangles.iter().map(|t| drawn[*t as usize]));
            groups.push(ClassifiedGroup {
                lie,
                indices: first..3 * sorted.len() as u32,
            });
        }
        Some(Self {
            groups,
            indices: Piece::from_values(0, sorted.as_flattened()).bytes,
        })
    }
}

/// The normal of a triangle, in steps, with its sign chosen so that its first nonzero component is positive.
fn normal_of([a, b, c]: [Vec3; 3]) -> [i32; 3] {
    let cross = (b - a).as_dvec3().cross((c - a).as_dvec3());
    let steps = (cross.normalize_or_zero().as_vec3() * NORMAL_STEPS).round();
    let steps = steps.to_array().map(|s| s as i32);
    let first = steps.into_iter().find(|s| *s != 0).unwrap_or(0);
    steps.map(|s| s * first.signum())
}
