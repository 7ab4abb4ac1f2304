//! A table whose cells have a tone, a longer story, and a value to sort by.

/// How grave something is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Tone {
    /// Nothing to say.
    #[default]
    Plain,
    /// As good as can be.
    Good,
    /// A little wrong, or to be known.
    Fair,
    /// Wrong.
    Bad,
    /// Not there: refused, not measured.
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
    /// What it says.
    pub text: String,
    /// The longer story.
    pub title: Option<String>,
    /// How grave it is.
    pub tone: Tone,
    /// What it is sorted by, where that is not its text.
    pub key: Option<f64>,
}

impl Cell {
    /// A cell that sorts by a number.
    pub(crate) fn number(text: impl Into<String>, key: f64) -> Self {
        Self {
            text: text.into(),
            key: Some(key),
            ..Self::default()
        }
    }

    /// The same in a tone.
    pub(crate) fn toned(self, tone: Tone) -> Self {
        Self { tone, ..self }
    }

    /// The same with a longer story.
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
    /// What it is, for those who cannot see it.
    pub label: String,
    /// Headings of the columns.
    pub heading: Vec<Cell>,
    /// Rows of as many cells.
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

    /// Adds a row; cells that are missing stay empty.
    pub(crate) fn row<C: Into<Cell>>(&mut self, cells: impl IntoIterator<Item = C>) {
        let mut cells: Vec<Cell> = cells.into_iter().map(Into::into).collect();
        cells.resize(self.heading.len(), Cell::default());
        self.rows.push(cells);
    }
}
