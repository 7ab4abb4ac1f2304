//! Splits tables so that none is wider than a page.
//!
//! A table with more columns than fit is laid out as several tables under each other, each beginning with the first column. The minimum
//! width of a column is estimated for the letters of a usual sans-serif font: text that may be broken into lines is as wide as its longest
//! word; numbers and code are not broken.

use super::{Cell, Grid};

/// Width of a page's text area on a screen 1280 pixels wide.
pub(super) const PAGE: f64 = 1200.0;

/// Estimated width of a letter, in pixels.
const LETTER: f64 = 7.8;

/// Padding on the left and right of a cell, together.
const PADDING: f64 = 17.0;

/// Room for the arrow that marks a sorted column.
const SORT_MARK: f64 = 12.0;

/// Minimum width of a column of sentences, so that no line holds only one word.
const SENTENCE: f64 = 190.0;

/// Number of letters from which a text counts as a sentence.
const SENTENCE_LETTERS: usize = 60;

fn width_of_cell(cell: &Cell) -> f64 {
    let letters = |text: &str| text.chars().filter(|c| *c != '`').count();
    let all = letters(&cell.text);
    if cell.key.is_some() {
        return all as f64 * LETTER;
    }
    let words = cell.text.split(' ').map(letters);
    let longest = words.max().unwrap_or(0) as f64 * LETTER;
    match all > SENTENCE_LETTERS {
        true => longest.max(SENTENCE),
        false => longest,
    }
}

/// Width of a heading, which may also be broken after a `+`, `@` or `,`.
fn width_of_heading(cell: &Cell) -> f64 {
    let words = cell.text.split(' ').flat_map(breaks);
    let longest = words.map(|word| word.chars().count()).max();
    longest.unwrap_or(0) as f64 * LETTER + SORT_MARK
}

/// Splits text after each `+`, `@` and `,`, where lines may break. A text that contains code is left whole.
pub(super) fn breaks(words: &str) -> impl Iterator<Item = &str> {
    let is_code = words.contains('`');
    words.split_inclusive(move |c| !is_code && matches!(c, '+' | '@' | ','))
}

fn width_of_column(grid: &Grid, column: usize) -> f64 {
    let heading = width_of_heading(&grid.heading[column]);
    let cells = grid.rows.iter().map(|row| width_of_cell(&row[column]));
    cells.fold(heading, f64::max) + PADDING
}

/// Minimum width of a table.
#[cfg(test)]
pub(super) fn width(grid: &Grid) -> f64 {
    let columns = 0..grid.heading.len();
    columns.map(|column| width_of_column(grid, column)).sum()
}

/// Splits a table into pieces that fit on a page; a table that fits is returned as one piece.
pub(super) fn pieces(grid: &Grid) -> Vec<Grid> {
    let widths: Vec<f64> = (0..grid.heading.len())
        .map(|column| width_of_column(grid, column))
        .collect();
    let Some((first, others)) = widths.split_first() else {
        return vec![grid.clone()];
    };
    let split = |room: f64| {
        let mut pieces: Vec<Vec<usize>> = vec![vec![0]];
        let mut used = *first;
        for (index, width) in others.iter().enumerate() {
            let is_alone = pieces.last().is_none_or(|p| p.len() == 1);
            if !is_alone && (used + width > PAGE || used >= room) {
                pieces.push(vec![0]);
                used = *first;
            }
            if let Some(piece) = pieces.last_mut() {
                piece.push(index + 1);
            }
            used += width;
        }
        pieces
    };
    // Pieces of about equal width read better than several full pieces and a narrow rest.
    let count = split(PAGE).len() as f64;
    let pieces = split(others.iter().sum::<f64>() / count + first);
    let of = |columns: &Vec<usize>| Grid {
        label: grid.label.clone(),
        heading: columns.iter().map(|c| grid.heading[*c].clone()).collect(),
        rows: (grid.rows.iter())
            .map(|row| columns.iter().map(|c| row[*c].clone()).collect())
            .collect(),
    };
    pieces.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(columns: usize) -> Grid {
        let heading = (0..columns).map(|c| format!("column {c}"));
        let mut grid = Grid::new("wide", heading);
        grid.row((0..columns).map(|c| Cell::number("×1.29 ± 0.05", c as f64)));
        grid
    }

    #[test]
    fn what_fits_stays_whole_and_what_does_not_is_in_pieces() {
        assert_eq!(pieces(&grid(4)), [grid(4)]);
        let wide = grid(40);
        assert!(width(&wide) > PAGE, "the control");
        let pieces = pieces(&wide);
        assert!(pieces.iter().all(|p| width(p) <= PAGE));
        // Every column is in exactly one piece, except the first, which is in all pieces.
        let columns: usize = pieces.iter().map(|p| p.heading.len() - 1).sum();
        assert_eq!(columns, 39);
        assert!(pieces.iter().all(|p| p.rows[0][0] == wide.rows[0][0]));
        let [first, last] = [&pieces[0], &pieces[pieces.len() - 1]];
        assert!(
            first.heading.len() - last.heading.len() <= 2,
            "of one width"
        );
    }

    #[test]
    fn words_are_broken_and_numbers_are_not() {
        let text = "one two three four five";
        assert!(width_of_cell(&Cell::from(text)) < width_of_cell(&Cell::number(text, 1.0)));
    }
}
