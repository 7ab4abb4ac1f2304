//! A part: a named mesh placed in the world.

use std::borrow::Cow;
use std::cmp::Reverse;
use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::{Bounds, Driver, Fill, Material, Mesh, Motion, Pose};
use crate::scene::describe::Described;

/// Effect of a cut on a part (Diepstraten et al. 2003, rule R1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Described)]
pub enum Role {
    /// Cut by the cuts that apply to it.
    #[default]
    Exterior,
    /// Never cut.
    Interior,
    /// Never cut, but hidden if cuts remove the whole part: bolts, pins and shafts, which drawings do not cut lengthwise.
    Whole,
}

/// A named mesh with a placement, a material and a priority.
#[derive(Clone, Debug)]
pub struct Part {
    /// Name, matched by the globs of cuts.
    pub name: String,
    /// The solid's boundary; shared between instances.
    pub mesh: Arc<Mesh>,
    /// Placement.
    pub world_from_part: DAffine3,
    /// Look.
    pub material: Material,
    /// Effect of cuts on the part.
    pub role: Role,
    /// True if its model specifies `role`; false if `role` is a default.
    pub role_is_said: bool,
    /// Material names from its file; globs of roles match these names too.
    pub materials: Vec<String>,
    /// True if its file marks the whole part as light-transmitting, which makes it exterior (Diepstraten et al. 2003, section 4).
    pub is_transparent: bool,
    /// Priority where solids overlap: the highest is shown. `None` counts as 0; with equal priority the smaller solid is shown.
    pub priority: Option<i32>,
    /// Fill rule of its mesh.
    pub fill: Fill,
    /// Morph targets and skin weights of its vertices.
    pub motion: Option<Arc<Motion>>,
    /// Current pose of its vertices.
    pub pose: Pose,
    /// Rig and animations from the part's file; see [`Part::at_time`].
    pub driver: Option<Arc<Driver>>,
}

/// Sort key for overlapping solids; the first is shown: higher priority (0 if none is given), then smaller volume in the rest
/// pose, then lower index.
pub fn who_wins(of: &Part, volume_at_rest: f64, index: usize) -> impl Ord + use<> {
    let priority = of.priority.unwrap_or(0);
    // The bits of non-negative floats sort like their values.
    (Reverse(priority), volume_at_rest.to_bits(), index)
}

impl Part {
    /// A part at the origin with the default material.
    pub fn new(name: impl Into<String>, mesh: impl Into<Arc<Mesh>>) -> Self {
        Self {
            name: name.into(),
            mesh: mesh.into(),
            world_from_part: DAffine3::IDENTITY,
            material: Material::default(),
            role: Role::Exterior,
            role_is_said: false,
            materials: Vec::new(),
            is_transparent: false,
            priority: None,
            fill: Fill::EvenOdd,
            motion: None,
            pose: Pose::default(),
            driver: None,
        }
    }

    /// Volume of a mesh placed like this part, computed from its volume in part space; never negative.
    #[doc(hidden)]
    pub fn placed_volume(&self, of_mesh: f64) -> f64 {
        of_mesh.abs() * self.world_from_part.matrix3.determinant().abs()
    }

    /// Vertices of the posed and placed mesh.
    pub(crate) fn points_in_world(&self) -> impl Iterator<Item = DVec3> + use<> {
        let mesh = match self.posed_mesh() {
            Cow::Borrowed(_) => self.mesh.clone(),
            Cow::Owned(posed) => Arc::new(posed),
        };
        let placed = self.world_from_part;
        (0..mesh.positions.len()).map(move |i| placed.transform_point3(mesh.positions[i]))
    }

    /// Bounds of the posed and placed mesh.
    pub fn bounds_in_world(&self) -> Bounds {
        Bounds::from_points(
            self.posed_mesh()
                .positions
                .iter()
                .map(|p| self.world_from_part.transform_point3(*p)),
        )
    }
}
