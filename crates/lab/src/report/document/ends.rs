//! Places the name of each series in a drawing: next to the series' last mark, where no other name and no mark is.
//!
//! Names are placed greedily in the order of the series: next to the mark, above, below, then farther away with a leader line. A series
//! without a free position has no name in the drawing. Time is quadratic in the number of marks, of which there are a few hundred.

/// The placed name of a series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SeriesLabel {
    /// Index of the series.
    pub series: usize,
    /// Position of the start of the text, on its baseline.
    pub at: [f64; 2],
    /// Position of the mark from which a leader line starts, if there is one.
    pub lead: Option<[f64; 2]>,
}

/// Height of a line of text.
const LINE: f64 = 14.0;
/// Distance from a mark to the name next to it.
const GAP: f64 = 8.0;

/// Left, right, top and bottom of a rectangle.
pub(super) type Area = [f64; 4];

fn meet(a: &Area, b: &Area) -> bool {
    a[0] < b[1] && b[0] < a[1] && a[2] < b[3] && b[2] < a[3]
}

/// Places the names of series, given the positions of their marks, within an area.
pub(super) fn placed(
    series: &[(&str, Vec<[f64; 2]>)],
    within: Area,
    letter: f64,
) -> Vec<SeriesLabel> {
    let marks = series.iter().flat_map(|(_, marks)| marks);
    let mut taken: Vec<Area> = marks
        .map(|[x, y]| [x - 5.0, x + 5.0, y - 5.0, y + 5.0])
        .collect();
    let mut endings = Vec::new();
    for (index, (name, marks)) in series.iter().enumerate() {
        let Some(last) = marks.iter().copied().max_by(|a, b| a[0].total_cmp(&b[0])) else {
            continue;
        };
        let width = name.chars().count() as f64 * letter;
        let area = |at: [f64; 2]| [at[0], at[0] + width, at[1] - LINE + 3.0, at[1] + 3.0];
        let is_free = |at: &[f64; 2], taken: &[Area]| {
            let own = area(*at);
            let is_inside = own[0] >= within[0]
                && own[1] <= within[1]
                && own[2] >= within[2]
                && own[3] <= within[3];
            is_inside && !taken.iter().any(|other| meet(&own, other))
        };
        let [x, y] = last;
        let beside = [
            [x + GAP, y + 4.0],
            [x - GAP - width, y + 4.0],
            [x - width * 0.5, y - GAP],
            [x - width * 0.5, y + GAP + 9.0],
        ];
        let farther = (1..=5).flat_map(|n| {
            let shift = f64::from(n) * LINE;
            [
                [x + 2.5 * GAP, y - shift + 4.0],
                [x + 2.5 * GAP, y + shift + 4.0],
            ]
        });
        let beside = beside.into_iter().map(|at| (at, None));
        let mut all = beside.chain(farther.map(|at| (at, Some(last))));
        if let Some((at, lead)) = all.find(|(at, _)| is_free(at, &taken)) {
            taken.push(area(at));
            endings.push(SeriesLabel {
                series: index,
                at,
                lead,
            });
        }
    }
    endings
}

#[cfg(test)]
mod tests {
    use super::*;

    const WITHIN: Area = [0.0, 400.0, 0.0, 200.0];

    #[test]
    fn names_stand_beside_the_last_mark_and_apart() {
        let lines = [
            ("first", vec![[10.0, 50.0], [200.0, 100.0]]),
            ("second", vec![[10.0, 60.0], [200.0, 103.0]]),
            ("third", vec![[200.0, 20.0]]),
        ];
        let found = placed(&lines, WITHIN, 6.0);
        assert_eq!(found.len(), 3);
        assert_eq!((found[0].at, found[0].lead), ([208.0, 104.0], None));
        let areas: Vec<Area> = (found.iter().zip(&lines))
            .map(|(e, (name, _))| {
                let width = name.len() as f64 * 6.0;
                [e.at[0], e.at[0] + width, e.at[1] - 11.0, e.at[1] + 3.0]
            })
            .collect();
        for (i, a) in areas.iter().enumerate() {
            assert!(areas[..i].iter().all(|b| !meet(a, b)), "{found:?}");
        }
        assert!(
            meet(&[0.0, 2.0, 0.0, 2.0], &[1.0, 3.0, 1.0, 3.0]),
            "the control"
        );
    }

    #[test]
    fn what_has_no_room_has_no_name() {
        let name = "x".repeat(100);
        assert_eq!(placed(&[(&name, vec![[200.0, 100.0]])], WITHIN, 6.0), []);
    }
}
