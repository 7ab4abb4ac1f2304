//! Rows of a picture that is drawn in bands or in strips: the rows of each, and the rows around them that effects read.

use crate::plan::Capacities;
use crate::scene::View;

/// Rows of a band or of a strip, and rows around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rows {
    /// First row.
    pub(super) first: u32,
    /// Number of rows.
    pub(super) count: u32,
    /// Number of rows that are also drawn above these, for passes that read neighbouring rows.
    pub(super) above: u32,
    /// Number of rows that are also drawn below these.
    below: u32,
}

impl Rows {
    /// Divides a picture into `bands` bands, from the top; up to `halo` more rows are drawn on each side, as far as the picture extends.
    pub(super) fn bands(rows: u32, bands: u32, halo: u32) -> impl Iterator<Item = Self> {
        let begin = move |band: u32| {
            let row = u64::from(rows) * u64::from(band) / u64::from(bands);
            row as u32
        };
        (0..bands).map(move |band| {
            let (first, end) = (begin(band), begin(band + 1));
            Self {
                first,
                count: end - first,
                above: halo.min(first),
                below: halo.min(rows - end),
            }
        })
    }

    /// Divides a picture into strips, from the top, that all draw as many rows: at most `most`, of which `halo` on each side are drawn for
    /// effects alone. There are more if a strip would be lower than [`Capacities::FEWEST_ROWS`].
    pub(super) fn strips(rows: u32, most: u32, halo: u32) -> impl Iterator<Item = Self> {
        let own = match rows <= most {
            true => rows.max(1),
            false => most.saturating_sub(2 * halo).max(Capacities::FEWEST_ROWS),
        };
        let count = rows.div_ceil(own).max(1);
        let drawn = (rows.div_ceil(count) + 2 * halo).min(rows);
        Self::bands(rows, count, halo).map(move |band| {
            let top = band.first.saturating_sub(halo).min(rows - drawn);
            Self {
                above: band.first - top,
                below: top + drawn - band.first - band.count,
                ..band
            }
        })
    }

    /// All rows of a picture.
    pub(super) fn whole(rows: u32) -> Self {
        Self {
            first: 0,
            count: rows,
            above: 0,
            below: 0,
        }
    }

    /// The first drawn row, and the number of drawn rows.
    pub(super) fn drawn(&self) -> (u32, u32) {
        let (above, below) = (self.above, self.below);
        (self.first - above, above + self.count + below)
    }

    /// The view of all drawn rows.
    pub(super) fn view(&self, of: &View) -> View {
        let (first, count) = self.drawn();
        View {
            halo_rows: [self.above, self.below],
            ..of.rows(first, count)
        }
    }

    /// Selects the values of the own rows from those of all drawn rows, with `in_a_row` values per row.
    pub(super) fn own<'a, T>(&self, drawn: &'a [T], in_a_row: usize) -> &'a [T] {
        let before = self.above as usize * in_a_row;
        &drawn[before..before + self.count as usize * in_a_row]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_own_every_row_once_and_see_beyond_it() {
        for (rows, bands, halo) in [(100, 1, 5), (100, 4, 5), (97, 8, 20), (64, 2, 64)] {
            let mut next = 0;
            for band in Rows::bands(rows, bands, halo) {
                assert_eq!(band.first, next, "{rows} rows in {bands}");
                next += band.count;
                let (first, count) = band.drawn();
                assert!(first + count <= rows, "{band:?} is within {rows} rows");
                assert_eq!(first, band.first.saturating_sub(halo), "{band:?}");
                assert_eq!(first + count, (next + halo).min(rows), "{band:?}");
                let drawn: Vec<u32> = (first..first + count).flat_map(|r| [r, r]).collect();
                let own = band.own(&drawn, 2);
                assert_eq!(own.first().copied(), Some(band.first), "{band:?}");
                assert_eq!(own.last().copied(), Some(next - 1), "{band:?}");
            }
            assert_eq!(next, rows);
        }
    }

    #[test]
    fn strips_draw_as_many_rows_each_and_own_every_row_once() {
        for (rows, most, halo, strips) in [
            (100, 100, 5, 1),
            (1000, 300, 5, 4),
            (997, 100, 20, 16),
            (997, 10, 0, 16),
            (500, 300, 100, 5),
            (8192, 4000, 515, 3),
            (1, 1, 0, 1),
        ] {
            let found: Vec<Rows> = Rows::strips(rows, most, halo).collect();
            let what = format!("{rows} rows, {most} at most, halo {halo}");
            assert_eq!(found.len(), strips, "{what}");
            let mut next = 0;
            for strip in &found {
                assert_eq!(strip.first, next, "{what}: {strip:?}");
                next += strip.count;
                let (first, count) = strip.drawn();
                assert_eq!(count, found[0].drawn().1, "{what}: {strip:?}");
                assert!(first <= strip.first.saturating_sub(halo), "{what}");
                assert!(first + count >= (next + halo).min(rows), "{what}");
                assert!(first + count <= rows, "{what}: {strip:?}");
            }
            assert_eq!(next, rows, "{what}");
        }
    }
}
