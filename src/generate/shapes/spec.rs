//! Parameters of shapes, and the parser of `NAME?param=value&param=value`.
//!
//! Before anything is built, every number is checked against its declared range and the resulting triangle count against
//! [`MOST_TRIANGLES`]: a typing error must give a message, not exhaust the machine's memory.

use crate::error::did_you_mean;
use crate::scene::Part;
use crate::{Error, Result};

/// Shapes with more triangles than this are refused.
pub const MOST_TRIANGLES: f64 = 20e6;

/// A numeric parameter of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeParameter {
    /// Name in a spec.
    pub name: &'static str,
    /// Description for help texts.
    pub summary: &'static str,
    /// Value if the spec does not give one.
    pub default: f64,
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// True if only whole numbers are allowed.
    pub whole: bool,
}

impl ShapeParameter {
    /// A real number.
    pub(super) const fn real(
        name: &'static str,
        summary: &'static str,
        default: f64,
        [min, max]: [f64; 2],
    ) -> Self {
        Self {
            name,
            summary,
            default,
            min,
            max,
            whole: false,
        }
    }

    /// A length: any positive number whose square and cube neither overflow nor underflow in f64.
    pub(super) const fn length(name: &'static str, summary: &'static str, default: f64) -> Self {
        Self::real(name, summary, default, [1e-9, 1e9])
    }

    /// A whole number.
    pub(super) const fn count(
        name: &'static str,
        summary: &'static str,
        default: u32,
        [min, max]: [u32; 2],
    ) -> Self {
        Self {
            name,
            summary,
            default: default as f64,
            min: min as f64,
            max: max as f64,
            whole: true,
        }
    }

    fn parse(&self, shape: &str, text: &str) -> Result<f64> {
        let (min, max) = (self.min, self.max);
        let kind = if self.whole { "whole number" } else { "number" };
        let refuse = |what: String| {
            Error::input(
                format!("{shape}?{}={text}", self.name),
                what,
                format!("give a {kind} from {min} to {max} ({})", self.summary),
            )
        };
        let value: f64 = text
            .parse()
            .map_err(|_| refuse(format!("`{text}` is not a number")))?;
        if !(min..=max).contains(&value) {
            Err(refuse(format!("{value} is out of range")))
        } else if self.whole && value.fract() != 0.0 {
            Err(refuse(format!("{value} is not whole")))
        } else {
            Ok(value)
        }
    }
}

/// A built-in shape: its description, its parameters and its builder.
#[derive(Clone, Copy, Debug)]
pub struct ShapeInfo {
    /// Name in a spec.
    pub name: &'static str,
    /// One line for help texts.
    pub summary: &'static str,
    /// Its parameters.
    pub parameters: &'static [ShapeParameter],
    /// Maximum number of triangles; exact for all but the crank and the gears.
    pub(super) triangles: fn(&Values) -> f64,
    /// Builds the parts.
    pub(super) build: fn(&Values) -> Result<Vec<Part>>,
}

impl ShapeInfo {
    /// Reads `param=value&param=value` and builds the parts.
    pub(super) fn build(&self, query: &str) -> Result<Vec<Part>> {
        (self.build)(&self.checked(query)?)
    }

    /// The values of a query; an error if the shape would be too large to build.
    pub(super) fn checked(&self, query: &str) -> Result<Values> {
        let values = self.values(query)?;
        let triangles = (self.triangles)(&values);
        if triangles > MOST_TRIANGLES {
            return Err(Error::input(
                format!("{}?{query}", self.name),
                format!(
                    "it would have up to {:.0} million triangles",
                    triangles / 1e6
                ),
                format!(
                    "reduce the detail: at most {:.0} million are allowed",
                    MOST_TRIANGLES / 1e6
                ),
            ));
        }
        Ok(values)
    }

    /// The values of a query, with defaults for parameters that the query omits.
    pub(super) fn values(&self, query: &str) -> Result<Values> {
        let mut given: Vec<Option<f64>> = vec![None; self.parameters.len()];
        for pair in query.split('&').filter(|p| !p.is_empty()) {
            let (key, text) = pair.split_once('=').ok_or_else(|| {
                let help = format!("write `{}?{pair}=value`", self.name);
                Error::input(format!("{}?{pair}", self.name), "it has no value", help)
            })?;
            let names = self.parameters.iter().map(|p| p.name);
            let slot = names.clone().position(|n| n == key).ok_or_else(|| {
                Error::input(
                    format!("{}?{key}", self.name),
                    format!("`{}` has no parameter `{key}`", self.name),
                    did_you_mean(key, names),
                )
            })?;
            let value = self.parameters[slot].parse(self.name, text)?;
            if given[slot].replace(value).is_some() {
                return Err(Error::input(
                    format!("{}?{pair}", self.name),
                    format!("`{key}` is given twice"),
                    "keep one of them",
                ));
            }
        }
        Ok(Values {
            shape: self.name,
            numbers: self
                .parameters
                .iter()
                .zip(given)
                .map(|(p, v)| (p.name, v.unwrap_or(p.default)))
                .collect(),
        })
    }
}

/// The checked values of a shape's parameters.
#[derive(Debug)]
pub(super) struct Values {
    shape: &'static str,
    numbers: Vec<(&'static str, f64)>,
}

impl Values {
    /// The value of a declared parameter.
    pub(super) fn real(&self, name: &str) -> f64 {
        let found = self.numbers.iter().find(|(n, _)| *n == name);
        found.map_or_else(
            || unreachable!("shape `{}` reads `{name}` undeclared", self.shape),
            |(_, v)| *v,
        )
    }

    /// The value of a declared whole number.
    pub(super) fn count(&self, name: &str) -> usize {
        self.real(name) as usize
    }

    /// Refuses values that are in range individually but contradict each other.
    pub(super) fn require(&self, holds: bool, names: &str, help: impl Into<String>) -> Result<()> {
        if holds {
            return Ok(());
        }
        let listed: Vec<String> = names
            .split(' ')
            .map(|n| format!("{n}={}", self.real(n)))
            .collect();
        Err(Error::input(
            format!("{}?{}", self.shape, listed.join("&")),
            "these values contradict each other",
            help,
        ))
    }
}
