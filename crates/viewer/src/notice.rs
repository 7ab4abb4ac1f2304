//! What the user is told, and may forget: errors with what to do, and what was done.

use cutaway::Error;

/// Something to be told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// What it is.
    pub text: String,
    /// Whether something failed.
    pub is_error: bool,
}

impl Notice {
    /// What was done.
    pub fn done(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            is_error: false,
        }
    }
}

/// An error says what and `help:`.
impl From<Error> for Notice {
    fn from(error: Error) -> Self {
        Self {
            text: error.to_string(),
            is_error: true,
        }
    }
}
