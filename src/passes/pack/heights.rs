//! The heights of all reliefs in one buffer, map after map.
//!
//! Maps are compared by identity: a map that several clip-surfaces share is stored once, and in an animated scene only new maps
//! are packed and uploaded, as long as the others keep their positions. Maps that cut no part are not stored.

use std::sync::Arc;

use crate::plan::pack::NO_RELIEF;
use crate::plan::{Contents, Piece};
use crate::scene::{OffsetMap, Prepared};

/// Bytes of a height.
const TEXEL_BYTES: u64 = 4;

/// A map and its bytes.
#[derive(Clone, Debug)]
pub(crate) struct PackedMap {
    map: Arc<OffsetMap>,
    bytes: Arc<[u8]>,
}

/// Heights of a scene, packed.
pub(crate) struct Heights {
    /// The texels of all maps.
    pub(crate) contents: Contents,
    /// First texel of each clip-surface, or [`NO_RELIEF`].
    pub(crate) first_texel: Vec<u32>,
    /// The maps, in order.
    pub(crate) maps: Vec<PackedMap>,
}

impl Heights {
    /// Packs the maps of true reliefs, reusing those packed before.
    pub(crate) fn of(prepared: &Prepared, before: Option<(&Contents, &[PackedMap])>) -> Self {
        let old = before.map_or(&[] as &[PackedMap], |(_, maps)| maps);
        let mut maps: Vec<PackedMap> = Vec::new();
        let mut starts: Vec<u32> = Vec::new();
        let mut end = 0;
        let is_had = |cut: usize| prepared.parts.iter().any(|p| p.cuts.contains(&cut));
        let had: Vec<bool> = (0..prepared.cuts.len()).map(is_had).collect();
        let first_texel = prepared.surfaces.iter().map(|surface| {
            let relief = surface.relief.as_ref().filter(|_| had[surface.cut]);
            let Some(map) = relief.filter(|_| surface.flat_height().is_none()) else {
                return NO_RELIEF;
            };
            let is_it = |m: &&PackedMap| Arc::ptr_eq(&m.map, map);
            let known = maps.iter().position(|m| is_it(&m));
            let number = known.unwrap_or(maps.len());
            if known.is_none() {
                let packed = old.iter().find(is_it).cloned();
                maps.push(packed.unwrap_or_else(|| PackedMap {
                    map: map.clone(),
                    bytes: bytemuck::cast_slice(map.texels()).into(),
                }));
                starts.push(end);
                end += map.texels().len() as u32;
            }
            starts[number]
        });
        let first_texel = first_texel.collect();
        let alike = |old: &[PackedMap]| {
            let same = |(a, b): (&PackedMap, &PackedMap)| Arc::ptr_eq(&a.map, &b.map);
            old.len() == maps.len() && old.iter().zip(&maps).all(same)
        };
        let contents = match before {
            Some((contents, old)) if alike(old) => contents.clone(),
            // Contents that a concurrent call has made stay in use, because only at this point is it known that the maps change.
            before => contents(&maps, &starts, before.is_some()),
        };
        Self {
            contents,
            first_texel,
            maps,
        }
    }
}

/// The texels of maps. Bindings cannot be empty, so without any map there is one texel, which no plane reads.
fn contents(maps: &[PackedMap], starts: &[u32], changes: bool) -> Contents {
    let Some((last, start)) = maps.last().zip(starts.last()) else {
        return Contents::from_values(&[0.0_f32]);
    };
    let end = u64::from(*start) * TEXEL_BYTES + last.bytes.len() as u64;
    let pieces = maps.iter().zip(starts).map(|(map, start)| Piece {
        offset: u64::from(*start) * TEXEL_BYTES,
        bytes: map.bytes.clone(),
    });
    Contents::in_pieces(end, pieces.collect(), changes)
}
