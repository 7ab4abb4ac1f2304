//! Bars of time: for each strategy and clock, a bar that is divided into passes, and every time that was measured.
//!
//! Each clock has its own scale: building a structure once can take as long as a thousand frames.

use maud::{Markup, html};

use super::{Cell, Grid};
use crate::report::number::milliseconds;

/// A table with a bar for each strategy and clock.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bars {
    /// Description of the bars.
    pub label: String,
    /// Names of the clocks.
    pub clocks: Vec<String>,
    /// One entry per strategy.
    pub bars: Vec<Bar>,
}

/// The bars of a strategy.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bar {
    pub name: String,
    /// The passes of each clock.
    pub segments: Vec<Vec<Segment>>,
    /// All measured times of each clock in milliseconds, in the order in which they were measured.
    pub samples: Vec<Vec<f64>>,
}

/// The part of a bar that shows one pass.
#[derive(Clone, Debug, Default)]
pub(crate) struct Segment {
    pub name: String,
    /// Duration in milliseconds.
    pub ms: f64,
}

/// Number of hues, which segments use in rotation.
const HUES: usize = 6;

fn total(segments: &[Segment]) -> f64 {
    segments.iter().map(|s| s.ms).sum()
}

impl Bars {
    fn longest(&self, clock: usize) -> f64 {
        let totals = self.bars.iter().filter_map(|b| b.segments.get(clock));
        totals.map(|s| total(s)).fold(0.0, f64::max)
    }

    /// A table with a bar in each cell.
    pub(super) fn html(&self) -> Markup {
        html! {
            div.scroll tabindex="0" role="region" aria-label=(self.label) {
                table.bars {
                    thead {
                        tr {
                            th scope="col" { "strategy" }
                            @for (i, clock) in self.clocks.iter().enumerate() {
                                th scope="col" { (clock) " " small { "full: " (milliseconds(self.longest(i))) " ms" } }
                            }
                        }
                    }
                    tbody {
                        @for bar in &self.bars { (self.row(bar)) "\n" }
                    }
                }
            }
        }
    }

    fn row(&self, bar: &Bar) -> Markup {
        let width = |clock, ms| format!("width:{:.2}%", 100.0 * ms / self.longest(clock));
        html! {
            tr {
                th scope="row" { (bar.name) }
                @for clock in 0..self.clocks.len() {
                    @let segments = bar.segments.get(clock).map_or(&[] as &[_], Vec::as_slice);
                    @let samples = bar.samples.get(clock).map_or(&[] as &[_], Vec::as_slice);
                    @let sum = total(segments);
                    @if sum <= 0.0 && samples.is_empty() {
                        td.faint { "nothing" }
                    } @else {
                        td {
                            @if sum > 0.0 {
                                div.bar {
                                    @for (i, s) in segments.iter().enumerate().filter(|(_, s)| s.ms > 0.0) {
                                        i class={ "s" (i % HUES) } style=(width(clock, s.ms))
                                            title={ (s.name) ": " (milliseconds(s.ms)) " ms" } {}
                                    }
                                }
                                small { (milliseconds(sum)) " ms in passes" }
                            }
                            @if !samples.is_empty() { small.samples { "all samples, ms: " (listed(samples)) } }
                        }
                    }
                }
            }
        }
    }

    /// The same content as a table of text.
    pub(super) fn grid(&self) -> Grid {
        let mut grid = Grid::new(&self.label, ["strategy", "clock", "pass", "ms"]);
        for bar in &self.bars {
            for (index, clock) in self.clocks.iter().enumerate() {
                let row = |pass: &str, ms: Cell| {
                    let words = [bar.name.as_str(), clock, pass].map(Cell::from);
                    words.into_iter().chain([ms]).collect::<Vec<_>>()
                };
                for s in bar.segments.get(index).into_iter().flatten() {
                    grid.row(row(&s.name, Cell::number(milliseconds(s.ms), s.ms)));
                }
                if let Some(samples) = bar.samples.get(index).filter(|s| !s.is_empty()) {
                    grid.row(row("all passes, every sample", Cell::from(listed(samples))));
                }
            }
        }
        grid
    }
}

fn listed(samples: &[f64]) -> String {
    let words: Vec<String> = samples.iter().map(|s| milliseconds(*s)).collect();
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_as_long_as_their_share_of_the_longest() {
        let segments = |all: &[f64]| -> Vec<Segment> {
            let of = |ms: &f64| Segment {
                name: "a<b".to_owned(),
                ms: *ms,
            };
            all.iter().map(of).collect()
        };
        let bar = |all: &[f64]| Bar {
            name: "x".to_owned(),
            segments: vec![segments(all)],
            samples: Vec::new(),
        };
        let bars = Bars {
            label: "where".to_owned(),
            clocks: vec!["frame".to_owned()],
            bars: vec![bar(&[1.0, 3.0]), bar(&[2.0]), bar(&[])],
        };
        let page = bars.html().into_string();
        for said in [
            "width:25.00%",
            "width:75.00%",
            "width:50.00%",
            "nothing",
            "a&lt;b",
        ] {
            assert!(page.contains(said), "{said} is missing from {page}");
        }
        assert_eq!(bars.grid().rows.len(), 3);
    }
}
