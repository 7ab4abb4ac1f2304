//! A list of methods with their costs: a chart with a labelled line for each method, all along one axis.
//!
//! The axis is logarithmic. A mark shows the median, the bar under it the range. A method that did not draw has no mark, but a reason.

use maud::{Markup, html};

use super::axis::{Scale, apart};
use super::html::breakable;
use super::marker::{badge, marker};
use super::{Cell, Grid, Tone};
use crate::report::derived::Spread;
use crate::report::look::Look;
use crate::report::number::{figure, times};

/// Minimum distance between two ticks, in percent of the axis.
const BETWEEN_TICKS: f64 = 18.0;

/// A list of methods.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ranking {
    /// Subject of the comparison.
    pub title: String,
    /// What the lines stand for: methods, or the runs of one method.
    pub names: &'static str,
    /// Quantity along the axis.
    pub axis: String,
    /// True if the numbers are factors; false if they are times or bytes.
    pub is_factor: bool,
    /// Heading of the remarks next to the numbers.
    pub heading: String,
    /// Minimum and maximum of the axis; several rankings may use the same range, so that they can be compared.
    pub range: [f64; 2],
    /// The lines, the best method first.
    pub lines: Vec<Line>,
}

/// The line of a method.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    pub name: String,
    pub look: Look,
    /// The method's cost; `None` if it did not draw.
    pub cost: Option<Spread>,
    /// Remarks on the method.
    pub words: Cell,
}

impl Ranking {
    fn scale(&self) -> Scale {
        Scale::of(&self.range, true, false, [0.0, 100.0])
    }

    fn word(&self, cost: f64) -> String {
        match self.is_factor {
            true => times(cost),
            false => figure(cost),
        }
    }

    /// A table with a mark on an axis in each line.
    pub(super) fn html(&self) -> Markup {
        let scale = self.scale();
        let ticks = apart(scale.ticks(), |v| scale.place(v), BETWEEN_TICKS);
        html! {
            div.scroll tabindex="0" role="region" aria-label=(self.title) {
                table.ranking {
                    thead {
                        tr {
                            th scope="col" { (self.names) }
                            th scope="col" { (self.axis) }
                            th.number scope="col" { "median" }
                            th scope="col" { (self.heading) }
                        }
                    }
                    tbody {
                        @for line in &self.lines { (self.row(line, &scale, &ticks)) "\n" }
                    }
                    tfoot aria-hidden="true" {
                        tr {
                            td {}
                            td { div.track { @for (value, word) in &ticks { span style=(at(scale.place(*value))) { (word) } } } }
                            td {}
                            td {}
                        }
                    }
                }
            }
        }
    }

    /// The same content as a table of text.
    pub(super) fn grid(&self) -> Grid {
        let heading = [self.names, "median", "from", "to", &self.heading];
        let mut grid = Grid::new(&self.title, heading);
        for line in &self.lines {
            let cost = |of: fn(Spread) -> f64| {
                let cost = line.cost.map(of);
                cost.map_or_else(Cell::default, |c| Cell::number(self.word(c), c))
            };
            grid.row([
                Cell::from(line.name.as_str()),
                cost(|s| s.median),
                cost(|s| s.least),
                cost(|s| s.most),
                line.words.clone(),
            ]);
        }
        grid
    }

    fn row(&self, line: &Line, scale: &Scale, ticks: &[(f64, String)]) -> Markup {
        let is_wrong = line.words.tone != Tone::Good;
        html! {
            tr {
                th scope="row" { (badge(line.look)) (breakable(&line.name)) }
                @match line.cost {
                    Some(cost) => {
                        @let [least, median, most] = [cost.least, cost.median, cost.most].map(|c| scale.place(c));
                        td {
                            div class={ "track c" (line.look.color) } title={ (self.word(cost.least)) " to " (self.word(cost.most)) } {
                                @for (value, _) in ticks { u style=(at(scale.place(*value))) {} }
                                i style={ (at(least)) ";width:" (format!("{:.2}%", most - least)) } {}
                                svg viewBox="0 0 14 14" style=(at(median)) aria-hidden="true" { (marker([7.0, 7.0], line.look.marker, is_wrong)) }
                            }
                        }
                        td.number { (self.word(cost.median)) }
                    }
                    None => { td {} td.number { "-" } }
                }
                td class=(line.words.tone.name()) title=[&line.words.title] { (line.words.text) }
            }
        }
    }
}

fn at(place: f64) -> String {
    format!("left:{place:.2}%")
}
