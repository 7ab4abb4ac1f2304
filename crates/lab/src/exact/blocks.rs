//! Minimum and maximum heights per block of an offset map's cells, so that a ray can skip blocks that are far from it.
//!
//! Along each axis, block `k` of level `l` covers the map's cells from `k 2^l` up to `(k + 1) 2^l`, or to the map's end. Cell `i` lies
//! between texels `i` and `i + 1`, and the last cell between the last texel and the next one in the wrap mode. Beyond the map's border,
//! the wrap mode decides: blocks repeat; or they are mirrored, and the cell between two copies belongs to one of the two; or they
//! keep their width and have the heights of the border.
//!
//! Cost: building reads 25 texels for each block of 4 x 4 cells, once; the blocks take a sixth of the map's memory.

use cutaway::scene::{OffsetMap, Wrap};

/// Level of the smallest blocks, which have 4 x 4 cells.
pub(super) const SMALLEST: u32 = 2;

/// The blocks of a map.
pub(super) struct Blocks {
    size: [i64; 2],
    wrap: Wrap,
    /// Levels from [`SMALLEST`] on.
    levels: Vec<Level>,
}

struct Level {
    width: usize,
    /// Least and greatest height, row by row.
    ranges: Vec<[f32; 2]>,
}

/// A block that a ray is in.
pub(super) struct RayBlock {
    /// Least and greatest height of the map.
    pub(super) range: [f32; 2],
    /// Per axis: the cell border at which the ray leaves the block.
    pub(super) ahead: [i64; 2],
}

fn both([a, b]: [f32; 2], [c, d]: [f32; 2]) -> [f32; 2] {
    [a.min(c), b.max(d)]
}

impl Blocks {
    /// All levels up to a single block.
    pub(super) fn of(map: &OffsetMap, wrap: Wrap) -> Self {
        let size = map.size().map(i64::from);
        let columns = map.size()[0] as usize;
        let count = |texels: u32, level: u32| texels.div_ceil(1 << level) as usize;
        let spanned = |block: usize, axis: usize| {
            let first = (block as i64) << SMALLEST;
            let last = (first + (1 << SMALLEST)).min(size[axis]);
            (first..=last).map(move |i| wrap.texel(i, map.size()[axis]) as usize)
        };
        let (width, height) = (
            count(map.size()[0], SMALLEST),
            count(map.size()[1], SMALLEST),
        );
        let lowest = |i: usize| {
            let mut range = [f32::INFINITY, f32::NEG_INFINITY];
            for y in spanned(i / width, 1) {
                for x in spanned(i % width, 0) {
                    range = both(range, [map.texels()[y * columns + x]; 2]);
                }
            }
            range
        };
        let mut below = Level {
            width,
            ranges: (0..width * height).map(lowest).collect(),
        };
        let mut levels = Vec::new();
        while below.ranges.len() > 1 {
            let above = below.halved();
            levels.push(below);
            below = above;
        }
        levels.push(below);
        Self { size, wrap, levels }
    }

    /// The highest level.
    pub(super) fn top(&self) -> u32 {
        SMALLEST + self.levels.len() as u32 - 1
    }

    /// The block that contains a cell at a level. `up` is the ray's direction per axis, which selects the borders ahead.
    pub(super) fn block(&self, level: u32, cell: [i64; 2], up: [bool; 2]) -> RayBlock {
        let of = |axis: usize| self.along(axis, level, cell[axis], up[axis]);
        let ((column, x), (row, y)) = (of(0), of(1));
        let level = &self.levels[(level - SMALLEST) as usize];
        RayBlock {
            range: level.ranges[row * level.width + column],
            ahead: [x, y],
        }
    }

    /// The number of a cell's block along an axis, and the border ahead.
    fn along(&self, axis: usize, level: u32, cell: i64, up: bool) -> (usize, i64) {
        let (n, width) = (self.size[axis], 1 << level);
        let (number, ahead) = match self.wrap {
            Wrap::Clamp => {
                let first = (cell >> level) << level;
                let ahead = if up { first + width } else { first };
                (cell.clamp(0, n - 1) >> level, ahead)
            }
            Wrap::Mirror if cell.rem_euclid(2 * n) >= n => {
                // Mirrored: cell c of this copy is cell 2n - 2 - c of the map, and -1 belongs to the first block.
                let copy = cell - cell.rem_euclid(2 * n);
                let turned = (2 * n - 2 - cell.rem_euclid(2 * n)).max(0);
                let number = turned >> level;
                let low = if number == 0 { -1 } else { number << level };
                let high = ((number + 1) << level).min(n - 1);
                let end = if up { low } else { high };
                (number, copy + 2 * n - 1 - end)
            }
            Wrap::Mirror | Wrap::Repeat => {
                let place = match self.wrap {
                    Wrap::Mirror => cell.rem_euclid(2 * n),
                    _ => cell.rem_euclid(n),
                };
                let number = place >> level;
                let low = number << level;
                let end = if up { (low + width).min(n) } else { low };
                (number, cell - place + end)
            }
        };
        (usize::try_from(number).unwrap_or(0), ahead)
    }
}

impl Level {
    fn halved(&self) -> Self {
        let height = self.ranges.len() / self.width;
        let width = self.width.div_ceil(2);
        let of = |i: usize| {
            let (x, y) = (i % width * 2, i / width * 2);
            let mut range = [f32::INFINITY, f32::NEG_INFINITY];
            for (x, y) in [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)] {
                if x < self.width && y < height {
                    range = both(range, self.ranges[y * self.width + x]);
                }
            }
            range
        };
        Self {
            width,
            ranges: (0..width * height.div_ceil(2)).map(of).collect(),
        }
    }
}

#[cfg(test)]
impl Blocks {
    /// Blocks with heights so wide apart that no ray is far from them: all cells are visited.
    pub(super) fn always_near(mut self) -> Self {
        for level in &mut self.levels {
            level.ranges.fill([f32::NEG_INFINITY, f32::INFINITY]);
        }
        self
    }

    /// Blocks with a deliberate fault: the range of one block is a single height far above all others.
    pub(super) fn with_a_fault(mut self, level: u32) -> Self {
        let ranges = &mut self.levels[(level - SMALLEST) as usize].ranges;
        let middle = ranges.len() / 2;
        ranges[middle] = [1e6; 2];
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_hold_the_texels_of_their_cells_and_end_where_they_say() {
        let heights = |size: [u32; 2]| {
            let texels = (0..size[0] * size[1]).map(|i| ((i * 37 + 11) % 101) as f32);
            OffsetMap::new(size, texels.collect()).expect("finite heights")
        };
        for (size, wrap) in [[1, 9], [5, 13], [16, 16], [23, 1]]
            .into_iter()
            .flat_map(|s| [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp].map(|w| (s, w)))
        {
            let map = heights(size);
            let blocks = Blocks::of(&map, wrap);
            for level in SMALLEST..=blocks.top() {
                for (x, y) in (-60..60).flat_map(|x| (-60..60).map(move |y| (x, y))) {
                    let [here, down] = [true, false].map(|up| blocks.block(level, [x, y], [up; 2]));
                    for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                        let h = map.texel(wrap, x + dx, y + dy) as f32;
                        let [low, high] = here.range;
                        assert!(
                            low <= h && h <= high,
                            "{size:?} {wrap:?}, level {level}: {h} of ({x}, {y}) is not in {low}..{high}"
                        );
                    }
                    for (cell, axis) in [(x, 0), (y, 1)] {
                        let (low, high) = (down.ahead[axis], here.ahead[axis]);
                        assert!(low <= cell && cell < high, "({x}, {y}) is in {low}..{high}");
                        // All cells between the borders are in the same block.
                        for other in [low, high - 1] {
                            let found = blocks.along(axis, level, other, true);
                            assert_eq!(found, blocks.along(axis, level, cell, true));
                        }
                    }
                }
            }
        }
    }
}
