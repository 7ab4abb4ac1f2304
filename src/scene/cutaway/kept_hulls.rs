//! Hulls of a breakaway, kept while the parts that they are made of stay as they are: the camera alone then moves the opening.

use std::sync::Arc;

use glam::DAffine3;

use super::{Breakaway, Clusters};
use crate::scene::geometry::hull::ConvexHull;
use crate::scene::memo::{ById, Memo};
use crate::scene::{Mesh, Part, Role, Scene};

/// Number of breakaways whose hulls are kept.
const KEPT: usize = 2;

/// Hulls of a breakaway in world space.
#[derive(Debug)]
pub(super) struct BreakawayHulls {
    /// The extended hulls of the interior parts; parts whose extended hulls intersect share one.
    pub(super) extended: Vec<ConvexHull>,
    /// Indices of the whole parts that lie within one of them.
    pub(super) shows: Vec<usize>,
}

/// Cache of hulls. Copies share it.
#[derive(Clone, Debug)]
pub struct KeptHulls(Arc<Memo<HullsKey, Arc<BreakawayHulls>>>);

/// What hulls depend on.
#[derive(Debug, PartialEq)]
struct HullsKey {
    distance: f64,
    clusters: Clusters,
    /// The interior and the whole parts: index, mesh and placement.
    parts: Vec<(usize, Role, ById<Mesh>, DAffine3)>,
}

impl Default for KeptHulls {
    fn default() -> Self {
        Self(Arc::new(Memo::with_capacity(KEPT)))
    }
}

impl KeptHulls {
    /// The hulls of a breakaway of a scene. They are not kept if a part is posed.
    pub(super) fn of(&self, breakaway: &Breakaway, scene: &Scene) -> Arc<BreakawayHulls> {
        let distance = breakaway.distance_in(&scene.bounds());
        let parts = scene.parts.iter().enumerate();
        let shown = parts.filter(|(_, part)| part.role != Role::Exterior);
        let make = || Arc::new(BreakawayHulls::of(breakaway, distance, scene));
        if shown.clone().any(|(_, part)| !part.pose.is_rest()) {
            return make();
        }
        let key = HullsKey {
            distance,
            clusters: breakaway.clusters,
            parts: shown
                .map(|(i, part)| (i, part.role, ById(part.mesh.clone()), part.world_from_part))
                .collect(),
        };
        self.0.get_or_make(key, |_| make())
    }
}

impl BreakawayHulls {
    fn of(breakaway: &Breakaway, distance: f64, scene: &Scene) -> Self {
        let of_role = |role| {
            let parts = scene.parts.iter().enumerate();
            parts.filter(move |(_, part): &(usize, &Part)| part.role == role)
        };
        let interiors = of_role(Role::Interior);
        let solids = interiors.map(|(_, part)| part.points_in_world().collect());
        let extended = breakaway.hulls(solids.collect(), distance);
        let is_shown = |(_, part): &(usize, &Part)| {
            let holds_it = |hull: &ConvexHull| part.points_in_world().all(|p| hull.holds(p));
            extended.iter().any(holds_it)
        };
        let shows = of_role(Role::Whole).filter(is_shown).map(|(i, _)| i);
        Self {
            shows: shows.collect(),
            extended,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::shapes::shape;

    #[test]
    fn hulls_are_kept_until_a_part_or_the_breakaway_changes() {
        let mut scene = Scene {
            parts: shape("engine").unwrap_or_else(|e| panic!("{e}")),
            ..Scene::default()
        };
        let breakaway = Breakaway::default();
        let kept = KeptHulls::default();
        let first = kept.of(&breakaway, &scene);
        assert!(!first.extended.is_empty());
        scene.camera.azimuth_deg += 10.0;
        assert!(Arc::ptr_eq(&first, &kept.clone().of(&breakaway, &scene)));
        let wider = Breakaway {
            distance: crate::scene::Amount::Percent(2.0),
            ..breakaway
        };
        assert!(!Arc::ptr_eq(&first, &kept.of(&wider, &scene)));
        let interior = scene.parts.iter().position(|p| p.role == Role::Interior);
        let interior = interior.unwrap_or_else(|| panic!("an interior part"));
        scene.parts[interior].world_from_part.translation.y += 0.1;
        let moved = kept.of(&breakaway, &scene);
        assert!(!Arc::ptr_eq(&first, &moved));
        assert_ne!(first.extended[0].corners, moved.extended[0].corners);
    }
}
