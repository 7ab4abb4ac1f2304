//! Dispatches with one invocation per item, for the maximum number of items.

/// Invocations along x of a dispatch folded into two dimensions; must match `shaders/lib/rasterise/sweep.wgsl`.
pub const INVOCATIONS_PER_ROW: u32 = 1 << 21;
/// Invocations of a workgroup in which each invocation handles one triangle or vertex.
pub(crate) const GROUP: u32 = 64;

/// Workgroups for one invocation per item, folded into two dimensions if one is not enough.
pub(crate) fn groups_along(items: u32) -> [u32; 3] {
    let groups = items.div_ceil(GROUP).max(1);
    let row = INVOCATIONS_PER_ROW / GROUP;
    [groups.min(row), groups.div_ceil(row), 1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folded_dispatches_cover_every_item_within_the_limits() {
        for items in [
            0,
            1,
            64,
            65,
            INVOCATIONS_PER_ROW,
            INVOCATIONS_PER_ROW + 1,
            u32::MAX,
        ] {
            let [x, y, z] = groups_along(items);
            assert!(x.max(y) <= 65_535 && z == 1, "{items}: {x} x {y}");
            assert!(
                y == 1 || x * GROUP == INVOCATIONS_PER_ROW,
                "{items}: rows of another length"
            );
            assert!(
                u64::from(x) * u64::from(y) * u64::from(GROUP) >= u64::from(items),
                "{items}"
            );
        }
    }
}
