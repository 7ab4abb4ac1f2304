//! The library's only error type, and the form of all messages to users.
//!
//! An error names the culprit (file, line, option, key), states what is wrong and how to fix it. A strategy's refusals and overflows
//! are not errors but outcomes of a frame (see [`crate::strategies::Refusal`] and
//! [`crate::session::Outcome`]).

mod diagnostic;

use std::path::{Path, PathBuf};

pub use diagnostic::{Diagnostic, FilePosition, Severity};

/// Advice for a plan that exceeds the adapter's limits.
const OVER_A_LIMIT: &str =
    "lower --resolution, or use --adapter to choose an adapter with higher limits";

/// Every error of the library, from reading a file to drawing a picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file whose contents are not what its format requires.
    #[error("{}{}{}: {what}\n  help: {help}", path.display(), number(*line), number(*column))]
    File {
        /// The file.
        path: PathBuf,
        /// Line in the file, counted from 1, where one is known.
        line: Option<usize>,
        /// Character in the line, counted from 1, where one is known.
        column: Option<usize>,
        /// Description of the error.
        what: String,
        /// Advice for the user.
        help: String,
    },
    /// An invalid option, key or value.
    #[error("{culprit}: {what}\n  help: {help}")]
    Input {
        /// The option, key or value, as the user wrote it.
        culprit: String,
        /// Description of the error.
        what: String,
        /// Advice for the user.
        help: String,
    },
    /// A named file does not exist. The inner error contains the text and where the name was given.
    #[error("{0}")]
    Missing(Box<Self>),
    /// No adapter was found, or the adapter lacks something that a plan needs.
    #[error("{what}\n  help: {help}")]
    Adapter {
        /// Description of the missing item.
        what: String,
        /// Advice for the user.
        help: String,
    },
    /// A shader that fails to compose or validate: a fault of this crate, never of its input.
    #[error("shader {name}: {what}")]
    Shader {
        /// Path of the shader in the source tree.
        name: String,
        /// The report, with file and line if known.
        what: String,
    },
    /// A plan that breaks its own rules: a fault of this crate, never of its input.
    #[error("plan: {0}")]
    Plan(String),
    /// A plan that exceeds the adapter's limits; the strategy's frame is then refused.
    #[error("{0}\n  help: {OVER_A_LIMIT}")]
    Limit(String),
}

/// The library's result type.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// A line or column number in a file, as compilers write it: `scene.toml:12:5`.
fn number(of_place: Option<usize>) -> String {
    of_place.map(|n| format!(":{n}")).unwrap_or_default()
}

impl Error {
    /// A file that cannot be used.
    pub fn file(path: &Path, what: impl Into<String>, help: impl Into<String>) -> Self {
        Self::File {
            path: path.to_owned(),
            line: None,
            column: None,
            what: what.into(),
            help: help.into(),
        }
    }

    /// A file that cannot be used, with the line that is wrong.
    pub fn file_line(
        path: &Path,
        line: usize,
        what: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        Self::File {
            path: path.to_owned(),
            line: Some(line),
            column: None,
            what: what.into(),
            help: help.into(),
        }
    }

    /// Description of the error without the file name, for callers that name the file themselves.
    #[doc(hidden)]
    pub fn into_what(self) -> String {
        match self {
            Self::File { what, .. } => what,
            Self::Missing(error) => error.into_what(),
            other => other.to_string(),
        }
    }

    /// The same error with the column at which the line is wrong.
    #[must_use]
    pub fn at_column(mut self, number: usize) -> Self {
        if let Self::File { column, .. } = &mut self {
            *column = Some(number);
        }
        self
    }

    /// The same error with `place` named first: where the faulty item is used.
    #[doc(hidden)]
    pub fn within(self, place: &str) -> Self {
        match self {
            Self::Input {
                culprit,
                what,
                help,
            } => Self::input(format!("{place}: {culprit}"), what, help),
            Self::File {
                path,
                line,
                column,
                what,
                help,
            } => {
                let [line, column] = [line, column].map(number);
                let culprit = format!("{place}: {}{line}{column}", path.display());
                Self::input(culprit, what, help)
            }
            Self::Missing(error) => error.within(place).missing(),
            other => other,
        }
    }

    /// The same error, marked as caused by a missing file.
    #[doc(hidden)]
    pub fn missing(self) -> Self {
        Self::Missing(Box::new(self))
    }

    /// An invalid option, key or value.
    pub fn input(
        culprit: impl Into<String>,
        what: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        Self::Input {
            culprit: culprit.into(),
            what: what.into(),
            help: help.into(),
        }
    }
}

/// The entry of `known` closest to a misspelt `word`, if any is close.
#[doc(hidden)]
pub fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let scored = known.iter().map(|k| (strsim::jaro_winkler(word, k), *k));
    let (score, best) = scored.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (score > 0.75).then_some(best)
}

/// Text of a `help:` line for a misspelt `word`: the closest entry of `known`, if any is close, and all known entries.
pub fn did_you_mean<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    match nearest(word, &known) {
        Some(near) => format!("did you mean `{near}`? Known: {}", known.join(", ")),
        None => format!("use one of: {}", known.join(", ")),
    }
}
