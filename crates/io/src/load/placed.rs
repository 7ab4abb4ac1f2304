//! Solids with their placement in the file, and the parts that they become.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use cutaway::scene::{Driver, Material, Mesh, Part, Role};
use glam::{DAffine3, Vec3};

use super::DraftSolid;

/// A solid and its placement in the file.
pub(super) struct Placed {
    pub(super) name: Option<String>,
    pub(super) color: Option<Vec3>,
    pub(super) materials: Vec<String>,
    pub(super) is_transparent: bool,
    /// Role of the solid, if the file states one.
    pub(super) role: Option<Role>,
    /// True if the mesh is known to have no open edges.
    pub(super) is_closed: bool,
    pub(super) mesh: Arc<Mesh>,
    pub(super) world_from_part: DAffine3,
    pub(super) driver: Option<Arc<Driver>>,
}

impl Placed {
    pub(super) fn of(solid: DraftSolid) -> Self {
        Self {
            name: solid.name,
            color: solid.color,
            materials: solid.materials,
            is_transparent: solid.is_transparent,
            role: None,
            is_closed: solid.is_closed,
            mesh: Arc::new(solid.mesh),
            world_from_part: DAffine3::IDENTITY,
            driver: None,
        }
    }
}

/// Converts solids to parts. A single solid is named after the file. Several solids keep their names, made unique.
pub(super) fn parts_of(placed: Vec<Placed>, stem: &str) -> Vec<Part> {
    let alone = placed.len() == 1;
    let mut taken = HashSet::new();
    // Number of parts with each name so far. Thousands of parts may share a name.
    let mut counts: HashMap<String, usize> = HashMap::new();
    let mut name_of = |given: Option<String>| {
        let wanted = match given.filter(|n| !alone && !n.trim().is_empty()) {
            Some(name) => name,
            None => stem.to_owned(),
        };
        let mut name = wanted.clone();
        let count = counts.entry(wanted.clone()).or_insert(1);
        while !taken.insert(name.clone()) {
            *count += 1;
            name = format!("{wanted}_{count}");
        }
        name
    };
    placed
        .into_iter()
        .enumerate()
        .map(|(i, p)| {
            let mut part = Part::new(name_of(p.name), p.mesh);
            part.world_from_part = p.world_from_part;
            part.driver = p.driver;
            part.materials = p.materials;
            part.is_transparent = p.is_transparent;
            part.role = p.role.unwrap_or_default();
            part.role_is_said = p.role.is_some();
            part.material = Material::of_index(i);
            if let Some(color) = p.color {
                part.material.color = color;
            }
            part
        })
        .collect()
}
