//! Where the heights of a relief come from: a procedure, an image, or a blend of two others.
//!
//! A [`Relief`] says where heights come from; [`resolve`] turns named ones, which may blend each other, into offset maps.
//! [`ReliefSpec`] is the form of the command line: a relief, and how high and wide it stands on a section.

mod blend;
mod heights;
mod image;
mod noise;
mod procedures;
mod spec;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

pub use blend::BlendOp;
pub use image::read_offset_map;
pub use procedures::{MAX_TEXELS, Procedure, ProcedureKind};
pub(super) use spec::parse_wrap;
pub use spec::{Placement, ReliefSpec, apply_relief, place_map};

use super::OffsetMap;
use crate::error::{Error, Result, did_you_mean};

/// A source of heights.
#[derive(Clone, Debug, PartialEq)]
pub enum Relief {
    /// Computed.
    Procedure(Procedure),
    /// Read from a file.
    Image(PathBuf),
    /// Two named reliefs made into one.
    Blend {
        /// Names of the two.
        of: [String; 2],
        /// How.
        op: BlendOp,
    },
}

/// The offset map of a named relief, from those it is made of. Maps already made are in `done` and stay there.
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
        let what = format!(
            "it is blended from itself: {} -> {name}",
            within.join(" -> ")
        );
        return Err(Error::input(
            culprit,
            what,
            "blend only reliefs that do not use this one",
        ));
    }
    let Some(relief) = reliefs.get(name) else {
        let mend = if reliefs.is_empty() {
            format!("describe it in a table [relief.{name}]")
        } else {
            did_you_mean(name, reliefs.keys().map(String::as_str))
        };
        return Err(Error::input(culprit, "there is no such relief", mend));
    };
    let map = match relief {
        Relief::Procedure(procedure) => procedure.map(),
        Relief::Image(path) => read_offset_map(path)?,
        Relief::Blend { of, op } => {
            within.push(name.to_owned());
            let a = resolve_within(&of[0], reliefs, done, within)?;
            let b = resolve_within(&of[1], reliefs, done, within)?;
            within.pop();
            op.blend(&a, &b)
                .map_err(|what| Error::input(culprit, what, "scale the images of the two down"))?
        }
    };
    let map = Arc::new(map);
    done.insert(name.to_owned(), Arc::clone(&map));
    Ok(map)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blend(a: &str, b: &str) -> Relief {
        Relief::Blend {
            of: [a.into(), b.into()],
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
        assert_eq!(map.texels, [2.0], "four halves");

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
