//! Sky that reliefs hide from themselves: one map per height map, at the same positions.
//!
//! Made on first request, and kept as long as the maps and their placement stay the same. Clip-surfaces that share a map share
//! the result for the first of them.

use std::sync::{Arc, OnceLock};

use glam::DVec2;

use crate::plan::Contents;
use crate::plan::pack::NO_RELIEF;
use crate::scene::relief::MapScale;
use crate::scene::{OffsetMap, Prepared};

/// A height map, its placement, and its first texel.
#[derive(Debug)]
struct PlacedMap {
    map: Arc<OffsetMap>,
    scale: MapScale,
    first: u32,
}

/// The maps of a scene.
#[derive(Debug, Default)]
pub(crate) struct ReliefSky {
    placed: Vec<PlacedMap>,
    contents: OnceLock<Contents>,
}

impl ReliefSky {
    /// Hidden sky of a scene whose heights begin at these texels; the previous result is kept if nothing has changed.
    pub(crate) fn of(
        prepared: &Prepared,
        first_texel: &[u32],
        before: Option<&Arc<Self>>,
    ) -> Arc<Self> {
        let mut placed: Vec<PlacedMap> = Vec::new();
        for (surface, first) in prepared.surfaces.iter().zip(first_texel) {
            let Some(map) = surface.relief.as_ref().filter(|_| *first != NO_RELIEF) else {
                continue;
            };
            if placed.iter().all(|p| p.first != *first) {
                placed.push(PlacedMap {
                    map: map.clone(),
                    scale: MapScale {
                        repeat: 1.0 / DVec2::from(surface.map_per_unit),
                        height: surface.height_scale,
                        wrap: surface.wrap,
                    },
                    first: *first,
                });
            }
        }
        let is_same = |a: &PlacedMap, b: &PlacedMap| {
            Arc::ptr_eq(&a.map, &b.map) && a.scale == b.scale && a.first == b.first
        };
        let holds = |before: &&Arc<Self>| {
            before.placed.len() == placed.len()
                && before
                    .placed
                    .iter()
                    .zip(&placed)
                    .all(|(a, b)| is_same(a, b))
        };
        match before.filter(holds) {
            Some(before) => before.clone(),
            None => Arc::new(Self {
                placed,
                contents: OnceLock::new(),
            }),
        }
    }

    /// Returns true if there is any relief.
    pub(crate) fn has_reliefs(&self) -> bool {
        !self.placed.is_empty()
    }

    /// The share of the sky visible from each texel.
    pub(crate) fn contents(&self) -> &Contents {
        self.contents.get_or_init(|| {
            let end = |p: &PlacedMap| p.first as usize + p.map.texels().len();
            let count = self.placed.iter().map(end).max().unwrap_or(1);
            let mut sky = vec![1.0_f32; count];
            for placed in &self.placed {
                let seen = placed.map.visibility(&placed.scale);
                sky[placed.first as usize..][..seen.len()].copy_from_slice(&seen);
            }
            Contents::from_values(&sky)
        })
    }
}
