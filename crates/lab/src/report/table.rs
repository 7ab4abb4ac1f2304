//! A table of texts, laid out for a terminal.

/// A table whose columns have headings; the first column is aligned left, the others right.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TextTable {
    heading: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl TextTable {
    /// A table with headings and no rows.
    pub fn new<S: Into<String>>(heading: impl IntoIterator<Item = S>) -> Self {
        Self {
            heading: heading.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row; missing cells are left empty.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        let mut cells: Vec<String> = cells.into_iter().map(Into::into).collect();
        cells.resize(self.heading.len(), String::new());
        self.rows.push(cells);
    }

    /// The table as text, with columns aligned by spaces.
    pub fn to_text(&self) -> String {
        let widths: Vec<usize> = (0..self.heading.len())
            .map(|c| {
                let cells = self.rows.iter().map(|r| &r[c]).chain([&self.heading[c]]);
                cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
            })
            .collect();
        let line = |cells: &[String]| {
            let padded: Vec<String> = (cells.iter().zip(&widths).enumerate())
                .map(|(c, (cell, w))| match c {
                    0 => format!("{cell:<w$}"),
                    _ => format!("{cell:>w$}"),
                })
                .collect();
            format!("{}\n", padded.join("  ").trim_end())
        };
        let mut text = line(&self.heading);
        text.push_str(&"-".repeat(text.trim_end().chars().count()));
        text.push('\n');
        self.rows.iter().for_each(|r| text.push_str(&line(r)));
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up() {
        let mut table = TextTable::new(["name", "µ"]);
        table.row(["a|<b", "1"]);
        table.row(["longer"]);
        assert_eq!(table.to_text(), "name    µ\n---------\na|<b    1\nlonger\n");
    }
}
