//! Transient notices for the user: errors with a remedy, and completed actions.

use cutaway::Error;

/// A notice for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// The message.
    pub text: String,
    /// True if something failed.
    pub is_error: bool,
}

impl Notice {
    /// Notice of a completed action.
    pub fn done(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            is_error: false,
        }
    }
}

/// An error's text contains the problem and a `help:` line.
impl From<Error> for Notice {
    fn from(error: Error) -> Self {
        Self {
            text: error.to_string(),
            is_error: true,
        }
    }
}
