//! Table of wrapped texel addresses around the scene, computed once for all rays.

use cutaway::scene::Wrap;

/// Maximum number of addresses in a table. Without a table, each address is wrapped when it is needed.
const TABLE_TEXELS: i64 = 1 << 20;

/// The wrapped texel for each address around a point, along one axis.
pub(super) struct TexelTable {
    first: i64,
    texels: Vec<u32>,
    wrap: Wrap,
    size: u32,
}

impl TexelTable {
    /// The table for all addresses within `reach` of `centre`.
    pub(super) fn of(wrap: Wrap, size: u32, centre: f64, reach: f64) -> Self {
        let first = (centre - reach).floor() as i64 - 2;
        let last = (centre + reach).ceil() as i64 + 3;
        let texels = if last.saturating_sub(first) < TABLE_TEXELS {
            (first..=last).map(|i| wrap.texel(i, size)).collect()
        } else {
            Vec::new()
        };
        Self {
            first,
            texels,
            wrap,
            size,
        }
    }

    /// The texel at an address.
    pub(super) fn texel(&self, address: i64) -> usize {
        let known = usize::try_from(address.wrapping_sub(self.first))
            .ok()
            .and_then(|i| self.texels.get(i));
        known
            .copied()
            .unwrap_or_else(|| self.wrap.texel(address, self.size)) as usize
    }
}
