//! One form for all messages to users: errors, warnings and notes.
//!
//! A message states what it is about (file, line, part, option), what was found, and what to do. Its code is the name of its kind: messages
//! with the same code differ only in their subject and numbers, so that many of them can be merged. The command, the window and Python
//! print the same text, that of [`Display`](fmt::Display), which omits the severity.

use std::fmt;
use std::path::{Path, PathBuf};

use super::Error;

/// Severity of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Information about unusual input or about a completed action.
    Note,
    /// A likely mistake, or an action without effect.
    Warning,
    /// A stated expectation that did not hold.
    Failure,
    /// An action that could not be completed.
    Error,
    /// A fault of this library or of the graphics driver, not of the input.
    InternalError,
}

impl Severity {
    /// The word that precedes the message on a console.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Failure => "failed",
            Self::Error => "error",
            Self::InternalError => "internal error",
        }
    }
}

/// Position in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilePosition {
    /// The file.
    pub path: PathBuf,
    /// Line, counted from 1, if known.
    pub line: Option<usize>,
    /// Character in the line, counted from 1, if known.
    pub column: Option<usize>,
}

/// As compilers write it: `scene.toml:12:5`.
impl fmt::Display for FilePosition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [line, column] = [self.line, self.column].map(super::number);
        write!(f, "{}{line}{column}", self.path.display())
    }
}

/// A message to the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Severity.
    pub severity: Severity,
    /// Name of the kind of message, such as `open-edges`.
    pub code: &'static str,
    /// The file that the message is about, if there is one.
    pub place: Option<FilePosition>,
    /// The part, node, option or key that the message is about, if there is one.
    pub subject: Option<String>,
    /// Description: one line, or a line followed by indented lines.
    pub text: String,
    /// Advice, if there is any.
    pub help: Option<String>,
}

impl Diagnostic {
    /// A note.
    pub fn note(code: &'static str, text: impl Into<String>) -> Self {
        Self::new(Severity::Note, code, text)
    }

    /// A warning.
    pub fn warning(code: &'static str, text: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, text)
    }

    /// A message of any severity.
    pub fn new(severity: Severity, code: &'static str, text: impl Into<String>) -> Self {
        Self {
            severity,
            code,
            place: None,
            subject: None,
            text: text.into(),
            help: None,
        }
    }

    /// Returns true if an action could not be completed.
    pub fn is_error(&self) -> bool {
        self.severity >= Severity::Error
    }

    /// The same message with advice.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The same message about a file; a message that names a file already is unchanged.
    #[must_use]
    pub fn in_file(mut self, path: &Path) -> Self {
        self.place.get_or_insert_with(|| FilePosition {
            path: path.to_owned(),
            line: None,
            column: None,
        });
        self
    }

    /// The same message about a line of a file, counted from 1.
    #[must_use]
    pub fn at_line(mut self, path: &Path, line: usize) -> Self {
        self.place = Some(FilePosition {
            path: path.to_owned(),
            line: Some(line),
            column: None,
        });
        self
    }

    /// The same message about a part, node, option or key. An earlier subject is appended to the new one: `wheel: primitive 2`.
    #[must_use]
    pub fn about(mut self, subject: impl AsRef<str>) -> Self {
        let outer = subject.as_ref().to_owned();
        self.subject = Some(match self.subject {
            Some(inner) => format!("{outer}: {inner}"),
            None => outer,
        });
        self
    }
}

/// The message without its severity and code: `place: subject: text`, and a `help: ` line.
impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = &self.place {
            write!(f, "{place}: ")?;
        }
        if let Some(subject) = &self.subject {
            write!(f, "{subject}: ")?;
        }
        f.write_str(&self.text)?;
        match &self.help {
            Some(help) => write!(f, "\n  help: {help}"),
            None => Ok(()),
        }
    }
}

impl From<Error> for Diagnostic {
    fn from(error: Error) -> Self {
        Self::from(&error)
    }
}

/// The text of the diagnostic is that of the error.
impl From<&Error> for Diagnostic {
    fn from(error: &Error) -> Self {
        let severity = match error {
            Error::Shader { .. } | Error::Plan(_) => Severity::InternalError,
            _ => Severity::Error,
        };
        let with = |code, what: &str, help: &str| Self::new(severity, code, what).help(help);
        match error {
            Error::File {
                path,
                line,
                column,
                what,
                help,
            } => Self {
                place: Some(FilePosition {
                    path: path.clone(),
                    line: *line,
                    column: *column,
                }),
                ..with("file", what, help)
            },
            Error::Input {
                culprit,
                what,
                help,
            } => with("input", what, help).about(culprit.as_str()),
            Error::Missing(inner) => Self {
                code: "missing-file",
                ..Self::from(&**inner)
            },
            Error::Adapter { what, help } => with("adapter", what, help),
            Error::Shader { .. } => Self::new(severity, "shader", error.to_string()),
            Error::Plan(_) => Self::new(severity, "plan", error.to_string()),
            Error::Limit(what) => with("limit", what, super::OVER_A_LIMIT),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_of_an_error_is_that_of_its_diagnostic() {
        let path = Path::new("scene.toml");
        let errors = [
            Error::file(path, "the file is empty", "export it again"),
            Error::file_line(path, 12, "no such key", "use another").at_column(5),
            Error::input("--section", "is missing", "add it").missing(),
            Error::Limit("17 bindings".to_owned()),
            Error::Plan("two writers".to_owned()),
        ];
        for error in errors {
            assert_eq!(Diagnostic::from(&error).to_string(), error.to_string());
        }
    }

    #[test]
    fn the_outer_subject_comes_first() {
        let message = Diagnostic::note("x", "no skin").about("primitive 2");
        let message = message.about("wheel").in_file(Path::new("a.glb"));
        assert_eq!(message.to_string(), "a.glb: wheel: primitive 2: no skin");
        let again = message.clone().in_file(Path::new("b.glb"));
        assert_eq!(again, message);
    }
}
