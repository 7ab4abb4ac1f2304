//! Renderers: the sources of a frame's layers.
//!
//! Methods draw on the device. Exact and `winding`, generalised winding numbers ([`Windings`](crate::exact::Windings)), are evaluated on
//! all CPU cores. Exact is the reference; `winding` is not meant for drawing, but shows what other results open meshes can give.
//! Evaluations are always timed by the wall clock, whatever clocks the device has.

use std::fmt;
use std::str::FromStr;

use cutaway::layers::Layers;
use cutaway::scene::{Prepared, View};
use cutaway::strategies::{DrawOptions, InsideTest, Method, Strategy, open_parts_in_words};
use cutaway::{Error, Model, Result};

use super::Stopwatch;
use crate::exact::{Windings, evaluate};

/// Source of the layers of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Renderer {
    /// A method, which draws on the device.
    Method(Method),
    /// An evaluator, which runs on the CPU.
    Cpu(Evaluator),
}

/// An evaluator of a frame's layers on the CPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Evaluator {
    /// The exact reference.
    Exact,
    /// Generalised winding numbers.
    Winding,
}

/// A frame that was evaluated on the CPU.
pub struct Evaluation {
    /// The layers.
    pub layers: Layers,
    /// Bytes of the structures built from the meshes.
    pub bytes: u64,
    /// Time to build these structures, in milliseconds.
    pub solid_ms: f64,
    /// Time to evaluate the pixels, in milliseconds.
    pub frame_ms: f64,
}

impl Evaluator {
    /// Evaluates a frame of a scene whose meshes are already posed.
    pub fn evaluate(self, truth: &Prepared, view: &View) -> Evaluation {
        let watch = Stopwatch::start();
        match self {
            Self::Exact => Evaluation {
                layers: evaluate(truth, view).layers,
                bytes: 0,
                solid_ms: 0.0,
                frame_ms: watch.ms(),
            },
            Self::Winding => {
                let windings = Windings::new(truth);
                let solid_ms = watch.ms();
                Evaluation {
                    layers: windings.layers(truth, view),
                    bytes: windings.bytes(),
                    solid_ms,
                    frame_ms: watch.ms() - solid_ms,
                }
            }
        }
    }
}

impl Renderer {
    /// The exact reference.
    pub const EXACT: Self = Self::Cpu(Evaluator::Exact);

    /// The renderers that a name selects; `all` selects all strategies with their usual parameters.
    ///
    /// # Errors
    ///
    /// Fails for unknown names, and for `exact`, against which all other renderers are measured.
    pub fn named(name: &str) -> Result<Vec<Self>> {
        if name.trim() == "all" {
            return Ok(Strategy::all().into_iter().map(Self::from).collect());
        }
        match name.parse()? {
            Self::EXACT => Err(Error::input(
                "`exact`",
                "exact is the reference that strategies are measured against",
                "leave it out; its picture and time are part of every comparison",
            )),
            renderer => Ok(vec![renderer]),
        }
    }

    /// The method, if this renderer is one.
    pub fn method(&self) -> Option<Method> {
        match self {
            Self::Method(method) => Some(*method),
            Self::Cpu(_) => None,
        }
    }

    /// Reports the open parts of a model whose inside this renderer decides by winding numbers.
    pub fn open_parts_in_words(&self, model: &Model) -> Option<String> {
        let method = self.method()?;
        let is_by_winding = method.strategy.inside == Some(InsideTest::WINDING);
        is_by_winding.then(|| open_parts_in_words(model)).flatten()
    }

    /// The renderer's draw options; the default ones if it runs on the CPU.
    pub fn options(&self) -> DrawOptions {
        self.method()
            .map_or_else(DrawOptions::default, |m| m.options)
    }

    /// The same renderer; a method that names no draw options gets these.
    #[must_use]
    pub fn or(self, usual: DrawOptions) -> Self {
        match self {
            Self::Method(method) => Self::Method(method.or(usual)),
            Self::Cpu(_) => self,
        }
    }
}

impl From<Method> for Renderer {
    fn from(method: Method) -> Self {
        Self::Method(method)
    }
}

impl From<Strategy> for Renderer {
    fn from(strategy: Strategy) -> Self {
        Self::Method(strategy.into())
    }
}

impl fmt::Display for Evaluator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Exact => "exact",
            Self::Winding => "winding",
        })
    }
}

impl fmt::Display for Renderer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Method(method) => method.fmt(f),
            Self::Cpu(evaluator) => evaluator.fmt(f),
        }
    }
}

impl FromStr for Renderer {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let (name, options) = match text.trim().split_once('@') {
            Some((name, options)) => (name, Some(options)),
            None => (text.trim(), None),
        };
        let evaluators = [Evaluator::Exact, Evaluator::Winding];
        match evaluators.into_iter().find(|e| e.to_string() == name) {
            Some(evaluator) if options.is_none() => Ok(Self::Cpu(evaluator)),
            Some(evaluator) => Err(Error::input(
                text,
                format!("{evaluator} runs on the CPU and has no draw options"),
                "leave out the @ and the options after it",
            )),
            None => text.parse().map(Self::Method),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn renderers_are_written_as_they_are_read() {
        for text in ["raycast+mask@compute", "winding", "exact"] {
            let renderer: Renderer = text.parse().unwrap();
            assert_eq!(renderer.to_string(), text);
        }
        for text in ["winding@compute", "exact@32-bit"] {
            let message = text.parse::<Renderer>().unwrap_err().to_string();
            assert!(message.contains("on the CPU"), "{message}");
        }
        assert!(Renderer::named("exact").is_err(), "nothing to measure");
    }
}
