//! Lengths in units or in percent of a reference length.

use std::fmt;

/// A length or coordinate that may depend on the bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// In world units.
    Units(f64),
    /// In percent of a reference that the caller chooses.
    Percent(f64),
}

impl Amount {
    /// Reads `12.5` or `12.5%`; returns an error text otherwise.
    pub fn parse(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let (digits, percent) = match text.strip_suffix('%') {
            Some(digits) => (digits.trim_end(), true),
            None => (text, false),
        };
        let value = digits
            .parse::<f64>()
            .map_err(|_| format!("`{text}` is not a number"))?;
        if !value.is_finite() {
            return Err(format!("`{text}` is not finite"));
        }
        Ok(if percent {
            Self::Percent(value)
        } else {
            Self::Units(value)
        })
    }

    /// The coordinate in a range; 0 % and 100 % give exactly its ends.
    pub fn between(self, min: f64, max: f64) -> f64 {
        match self {
            Self::Units(v) => v,
            Self::Percent(p) => min * (1.0 - p / 100.0) + max * (p / 100.0),
        }
    }
}

impl fmt::Display for Amount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Units(v) => write!(f, "{v}"),
            Self::Percent(p) => write!(f, "{p}%"),
        }
    }
}
