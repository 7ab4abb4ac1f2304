//! A table of texts, laid out for a terminal or as Markdown.

use super::markdown::words;

/// Columns with a heading each; the first column is aligned left, the others right.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    heading: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with headings and no rows.
    pub fn new<S: Into<String>>(heading: impl IntoIterator<Item = S>) -> Self {
        Self {
            heading: heading.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row; cells that are missing stay empty.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        let mut cells: Vec<String> = cells.into_iter().map(Into::into).collect();
        cells.resize(self.heading.len(), String::new());
        self.rows.push(cells);
    }

    /// The headings.
    pub fn heading(&self) -> &[String] {
        &self.heading
    }

    /// The rows.
    pub fn rows(&self) -> &[Vec<String>] {
        &self.rows
    }

    /// Aligned with spaces.
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

    /// As a table of GitHub's Markdown, in which cells hold no markup but code between backticks.
    pub fn to_markdown(&self) -> String {
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|c| words(c).replace('|', "\\|")).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let mut text = line(&self.heading);
        text.push_str("|---|");
        text.push_str(&"---:|".repeat(self.heading.len().saturating_sub(1)));
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
        let mut table = Table::new(["name", "µ"]);
        table.row(["a|<b", "1"]);
        table.row(["longer"]);
        assert_eq!(table.to_text(), "name    µ\n---------\na|<b    1\nlonger\n");
        assert_eq!(
            table.to_markdown(),
            "| name | µ |\n|---|---:|\n| a\\|&lt;b | 1 |\n| longer |  |\n"
        );
    }
}
