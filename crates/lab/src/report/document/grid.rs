//! A table whose cells have a tone, a tooltip, and a sort key.

/// Severity of a cell or a notice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Tone {
    /// Neutral.
    #[default]
    Plain,
    /// As good as possible.
    Good,
    /// Slightly wrong, or worth knowing.
    Fair,
    /// Wrong.
    Bad,
    /// No value: refused or not measured.
    Faint,
}

impl Tone {
    /// Lower-case name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Good => "good",
            Self::Fair => "fair",
            Self::Bad => "bad",
            Self::Faint => "faint",
        }
    }
}

/// A cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Cell {
    /// Text of the cell.
    pub text: String,
    /// Tooltip with more detail.
    pub title: Option<String>,
    /// Severity.
    pub tone: Tone,
    /// Numeric sort key; `None` sorts by the text.
    pub key: Option<f64>,
}

impl Cell {
    /// A cell that is sorted by a number, its key.
    pub(crate) fn number(text: impl Into<String>, key: f64) -> Self {
        Self {
            text: text.into(),
            key: Some(key),
            ..Self::default()
        }
    }

    /// The same cell in a tone.
    pub(crate) fn toned(self, tone: Tone) -> Self {
        Self { tone, ..self }
    }

    /// The same cell with a tooltip.
    pub(crate) fn titled(self, title: impl Into<String>) -> Self {
        let title = Some(title.into());
        Self { title, ..self }
    }
}

impl<S: Into<String>> From<S> for Cell {
    fn from(text: S) -> Self {
        Self {
            text: text.into(),
            ..Self::default()
        }
    }
}

/// A table.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Grid {
    /// Description of the table for assistive technology.
    pub label: String,
    /// Headings of the columns.
    pub heading: Vec<Cell>,
    /// Rows, each with as many cells as there are headings.
    pub rows: Vec<Vec<Cell>>,
}

impl Grid {
    /// A table with headings and no rows.
    pub(crate) fn new<C: Into<Cell>>(label: &str, heading: impl IntoIterator<Item = C>) -> Self {
        Self {
            label: label.to_owned(),
            heading: heading.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row; missing cells are left empty.
    pub(crate) fn row<C: Into<Cell>>(&mut self, cells: impl IntoIterator<Item = C>) {
        let mut cells: Vec<Cell> = cells.into_iter().map(Into::into).collect();
        cells.resize(self.heading.len(), Cell::default());
        self.rows.push(cells);
    }

    /// Removes columns without text and columns that contain only zeros, except the first column and those named in `kept`. Returns the
    /// headings of the removed columns of zeros.
    pub(crate) fn without_zeros(&mut self, kept: &[&str]) -> Vec<String> {
        let is_zero = |column: usize| {
            let cells = || self.rows.iter().map(|row| &row[column]);
            cells().any(|c| c.key.is_some())
                && cells().all(|c| c.text.is_empty() || c.key == Some(0.0))
        };
        let zeros: Vec<usize> = (1..self.heading.len())
            .filter(|c| !kept.contains(&self.heading[*c].text.as_str()) && is_zero(*c))
            .collect();
        let names = zeros.iter().map(|c| self.heading[*c].text.clone());
        let names: Vec<String> = names.collect();
        let is_empty = |c: &usize| self.rows.iter().all(|row| row[*c].text.is_empty());
        let empty = (1..self.heading.len()).filter(is_empty);
        let mut gone: Vec<usize> = zeros.into_iter().chain(empty).collect();
        gone.sort_unstable();
        for column in gone.into_iter().rev() {
            self.heading.remove(column);
            self.rows
                .iter_mut()
                .for_each(|row| drop(row.remove(column)));
        }
        names
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_of_zeros_are_named_and_left_out_as_empty_ones_are() {
        let zero = || Cell::number("0", 0.0);
        let mut grid = Grid::new("", ["name", "a", "b", "kept", "empty", "words"]);
        let empty = Cell::default;
        grid.row([
            Cell::from("x"),
            zero(),
            zero(),
            zero(),
            empty(),
            Cell::from("0"),
        ]);
        grid.row([
            Cell::from("y"),
            empty(),
            Cell::number("1", 1.0),
            zero(),
            empty(),
            empty(),
        ]);
        assert_eq!(grid.without_zeros(&["kept"]), ["a"]);
        let left: Vec<&str> = grid.heading.iter().map(|c| c.text.as_str()).collect();
        assert_eq!(left, ["name", "b", "kept", "words"]);
        assert!(grid.rows.iter().all(|row| row.len() == left.len()));
    }
}
