//! Rows of a picture that is drawn in bands: the rows of each band, and the rows around the band that its effects read.

use crate::scene::View;

/// Rows of a band, and rows around the band.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rows {
    /// First row of the band.
    pub(super) first: u32,
    /// Number of rows of the band.
    pub(super) count: u32,
    /// Number of rows that are also drawn above the band, for passes that read neighbouring rows.
    pub(super) above: u32,
    /// Number of rows that are also drawn below the band.
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

    /// Selects the values of the band's own rows from those of all drawn rows, with `in_a_row` values per row.
    pub(super) fn own<T: Copy>(&self, drawn: &[T], in_a_row: usize) -> Vec<T> {
        let before = self.above as usize * in_a_row;
        drawn[before..before + self.count as usize * in_a_row].to_vec()
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
}
