//! Strategies that follow the paper's method: a grid with a depth sprite, of any sizes, drawn with the default options.
//!
//! If a point has the strategy with the paper's own parameters, only that one counts. Otherwise all sizes count, which gives a range.

use cutaway::strategies::Strategy;

use crate::experiment::Record;

/// Indices of a point's strategies that follow the paper's method: the one with the paper's parameters, or else all of that kind.
pub(crate) fn papers(record: &Record) -> Vec<usize> {
    let of = |is_it: fn(Strategy) -> bool| -> Vec<usize> {
        let all = record.measurement.strategies.iter().enumerate();
        all.filter(|(_, s)| s.name.parse().is_ok_and(is_it))
            .map(|(index, _)| index)
            .collect()
    };
    match of(|s| s == Strategy::PAPER) {
        own if !own.is_empty() => own,
        _ => of(|s| s.is_of_the_kind(&Strategy::PAPER)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::example;
    use crate::report::derived::totals::tests::record_of;

    fn of(names: &[&str]) -> Vec<usize> {
        let mut measurement = example();
        let one = measurement.strategies[0].clone();
        let named = names.iter().map(|name| {
            let mut found = one.clone();
            found.name = (*name).to_owned();
            found
        });
        measurement.strategies = named.collect();
        papers(&record_of(measurement))
    }

    #[test]
    fn any_grid_with_a_sprite_is_the_papers_path() {
        let others = [
            "raycast+vds:64",
            "grid:64+mask",
            "winding",
            "grid:64+vds:64@hardware-filter",
        ];
        assert_eq!(of(&others), [0usize; 0]);
        assert_eq!(
            of(&["grid:64+vds:512", "raycast+mask", "grid:8+vds:64"]),
            [0, 2]
        );
        let with_its_own = ["grid:64+vds:512", "grid:256+vds:1024"];
        assert_eq!(of(&with_its_own), [1], "its own parameters");
    }
}
