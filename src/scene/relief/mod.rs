//! Sources of a relief's heights: a procedure, an image, numbers, a blend of other reliefs, or a position between layers.
//!
//! A [`Relief`] describes the source of heights; [`resolve`] converts named reliefs, which may use each other, to offset maps;
//! [`ClipSurface::with_relief`](super::ClipSurface::with_relief) puts a map on a section, scaled by a [`Placement`].

mod blend;
mod derived;
mod heights;
mod layers;
mod noise;
mod place;
mod procedures;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

pub use blend::BlendOp;
pub use derived::MapScale;
pub use layers::between_layers;
pub use place::Placement;
#[doc(hidden)]
pub use place::place_map;
pub use procedures::{MAX_TEXELS, Procedure, ProcedureKind};

use super::{OffsetMap, Wrap};
use crate::error::{Error, Result, did_you_mean};

/// A source of heights.
#[derive(Clone, Debug, PartialEq)]
pub enum Relief {
    /// Computed by a procedure.
    Procedure(Procedure),
    /// The map of an image file.
    Image(Image),
    /// Named reliefs blended in order: the second with the first, the third with that result, and so on.
    Blend {
        /// Their names, at least two.
        of: Vec<String>,
        /// Operation that combines the reliefs.
        op: BlendOp,
    },
    /// Heights at equal steps along `U`; each is constant along `V`.
    Profile(Vec<f64>),
    /// A position between named reliefs of the same size ([`between_layers`]).
    Layers {
        /// Names of the layers, in order.
        of: Vec<String>,
        /// The coordinate across the layers: layer `i` is at `i`.
        at: f64,
        /// Address mode beyond the first and the last.
        wrap: Wrap,
    },
}

/// The heights of an image file, read and shared. Images are equal if they come from the same file and the same read.
#[derive(Clone, Debug)]
pub struct Image {
    /// The file.
    pub path: PathBuf,
    /// Heights of the image.
    pub map: Arc<OffsetMap>,
}

impl PartialEq for Image {
    fn eq(&self, other: &Self) -> bool {
        self.path == other.path && Arc::ptr_eq(&self.map, &other.map)
    }
}

impl Relief {
    /// Names of the reliefs that it uses.
    pub fn of(&self) -> &[String] {
        match self {
            Self::Blend { of, .. } => of,
            Self::Layers { of, .. } => of,
            Self::Procedure(_) | Self::Image(_) | Self::Profile(_) => &[],
        }
    }
}

/// The offset map of a named relief, computed from the reliefs it uses. `done` caches finished maps.
pub fn resolve(
    name: &str,
    reliefs: &BTreeMap<String, Relief>,
    done: &mut BTreeMap<String, Arc<OffsetMap>>,
) -> Result<Arc<OffsetMap>> {
    resolve_within(name, reliefs, done, &mut Vec::new())
}

fn resolve_within(
    name: &str,
    reliefs: &BTreeMap<String, Relief>,
    done: &mut BTreeMap<String, Arc<OffsetMap>>,
    within: &mut Vec<String>,
) -> Result<Arc<OffsetMap>> {
    if let Some(map) = done.get(name) {
        return Ok(Arc::clone(map));
    }
    let culprit = format!("relief `{name}`");
    if within.iter().any(|n| n == name) {
        let what = format!("it is made of itself: {} -> {name}", within.join(" -> "));
        let help = "use only reliefs that do not use this one";
        return Err(Error::input(culprit, what, help));
    }
    let Some(relief) = reliefs.get(name) else {
        // Images used as layers have internal names that a user cannot write, so they are not suggested.
        let known = reliefs.keys().map(String::as_str);
        let mut known = known
            .filter(|n| !n.starts_with(char::is_control))
            .peekable();
        let help = if known.peek().is_none() {
            format!("describe it in a table [relief.{name}]")
        } else {
            did_you_mean(name, known)
        };
        return Err(Error::input(culprit, "there is no such relief", help));
    };
    within.push(name.to_owned());
    let made_of = relief.of().iter();
    let parts: Vec<Arc<OffsetMap>> = made_of
        .map(|part| resolve_within(part, reliefs, done, within))
        .collect::<Result<_>>()?;
    within.pop();
    let map = match relief {
        Relief::Procedure(procedure) => Arc::new(procedure.map()),
        Relief::Image(image) => Arc::clone(&image.map),
        Relief::Blend { op, .. } => {
            let mut all = parts.into_iter();
            let first = all.next().ok_or_else(|| {
                let help = "name at least two: `blend = [\"a\", \"b\"]`";
                Error::input(&culprit, "it blends nothing", help)
            })?;
            all.try_fold(first, |below, above| op.blend(&below, &above).map(Arc::new))
                .map_err(|what| Error::input(culprit, what, "scale their images down"))?
        }
        Relief::Profile(heights) => {
            let help = "give heights within the range of f32";
            Arc::new(profile(heights).map_err(|what| Error::input(culprit, what, help))?)
        }
        Relief::Layers { at, wrap, .. } => {
            let help =
                "give layers of one size: add `size = [256, 256]` to each, or scale the images";
            between_layers(&parts, *at, *wrap).map_err(|what| Error::input(culprit, what, help))?
        }
    };
    done.insert(name.to_owned(), Arc::clone(&map));
    Ok(map)
}

/// One row of heights.
fn profile(heights: &[f64]) -> Result<OffsetMap, String> {
    let width = u32::try_from(heights.len()).unwrap_or(u32::MAX);
    OffsetMap::new([width, 1], heights.iter().map(|h| *h as f32).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blend(a: &str, b: &str) -> Relief {
        Relief::Blend {
            of: vec![a.into(), b.into()],
            op: BlendOp::Add,
        }
    }

    #[test]
    fn blends_of_blends_resolve_and_rings_are_named() {
        let constant = Relief::Procedure(Procedure::named("constant").expect("constant"));
        let mut reliefs = BTreeMap::from([
            ("one".to_owned(), constant),
            ("two".to_owned(), blend("one", "one")),
            ("four".to_owned(), blend("two", "two")),
        ]);
        let map = resolve("four", &reliefs, &mut BTreeMap::new()).expect("no ring");
        assert_eq!(map.texels(), [2.0], "four halves");

        let three = Relief::Blend {
            of: vec!["one".into(), "one".into(), "two".into()],
            op: BlendOp::Multiply,
        };
        reliefs.insert("three".to_owned(), three);
        let map = resolve("three", &reliefs, &mut BTreeMap::new()).expect("no ring");
        assert_eq!(map.texels(), [0.25], "a half of a half of one");

        reliefs.insert("two".to_owned(), blend("one", "four"));
        let error = resolve("four", &reliefs, &mut BTreeMap::new()).expect_err("a ring");
        let text = error.to_string();
        assert!(
            text.contains("four -> two -> four"),
            "the ring is not named: {text}"
        );

        let error = resolve("fuor", &reliefs, &mut BTreeMap::new()).expect_err("a typo");
        assert!(
            error.to_string().contains("did you mean `four`?"),
            "{error}"
        );
    }
}
