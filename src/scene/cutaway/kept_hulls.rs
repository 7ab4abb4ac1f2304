//! Hulls of a breakaway, kept while the parts that they are made of stay as they are: the camera alone then moves the opening.

use std::sync::{Arc, Weak};

use glam::DAffine3;

use super::{Breakaway, Clusters};
use crate::scene::geometry::hull::ConvexHull;
use crate::scene::memo::Memo;
use crate::scene::{Bounds, Mesh, Part, Role};

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
    parts: Vec<(usize, Role, MeshIdentity, DAffine3)>,
}

/// Identity of a mesh, which does not keep it in memory.
#[derive(Debug)]
struct MeshIdentity(Weak<Mesh>);

impl PartialEq for MeshIdentity {
    fn eq(&self, other: &Self) -> bool {
        self.0.ptr_eq(&other.0)
    }
}

impl Default for KeptHulls {
    fn default() -> Self {
        Self(Arc::new(Memo::with_capacity(KEPT)))
    }
}

impl KeptHulls {
    /// The hulls of a breakaway of some parts, within the bounds of their scene. They are not kept if a part is posed.
    pub(super) fn of(
        &self,
        breakaway: &Breakaway,
        parts: &[Part],
        bounds: &Bounds,
    ) -> Arc<BreakawayHulls> {
        let distance = breakaway.distance_in(bounds);
        let numbered = parts.iter().enumerate();
        let shown = numbered.filter(|(_, part)| part.role != Role::Exterior);
        let make = || Arc::new(BreakawayHulls::of(breakaway, distance, parts));
        if shown.clone().any(|(_, part)| !part.pose.is_rest()) {
            return make();
        }
        let key = HullsKey {
            distance,
            clusters: breakaway.clusters,
            parts: shown
                .map(|(i, part)| {
                    let mesh = MeshIdentity(Arc::downgrade(&part.mesh));
                    (i, part.role, mesh, part.world_from_part)
                })
                .collect(),
        };
        self.0.get_or_make(key, |_| make())
    }
}

impl BreakawayHulls {
    fn of(breakaway: &Breakaway, distance: f64, parts: &[Part]) -> Self {
        let of_role = |role| {
            let parts = parts.iter().enumerate();
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
        let mut parts = shape("engine").unwrap_or_else(|e| panic!("{e}"));
        let all = parts.iter().map(Part::bounds_in_world);
        let bounds = all.fold(Bounds::EMPTY, Bounds::union);
        let breakaway = Breakaway::default();
        let kept = KeptHulls::default();
        let first = kept.of(&breakaway, &parts, &bounds);
        assert!(!first.extended.is_empty());
        let again = kept.clone().of(&breakaway, &parts.clone(), &bounds);
        assert!(Arc::ptr_eq(&first, &again));
        let wider = Breakaway {
            distance: crate::scene::Amount::Percent(2.0),
            ..breakaway
        };
        assert!(!Arc::ptr_eq(&first, &kept.of(&wider, &parts, &bounds)));
        let interior = parts.iter().position(|p| p.role == Role::Interior);
        let interior = interior.unwrap_or_else(|| panic!("an interior part"));
        parts[interior].world_from_part.translation.y += 0.1;
        let moved = kept.of(&breakaway, &parts, &bounds);
        assert!(!Arc::ptr_eq(&first, &moved));
        assert_ne!(first.extended[0].corners, moved.extended[0].corners);
    }
}
