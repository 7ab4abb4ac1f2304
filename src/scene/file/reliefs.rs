//! `[relief.NAME]`: where heights come from.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use super::reader::{Entry, Table};
use crate::error::{Result, did_you_mean};
use crate::scene::OffsetMap;
use crate::scene::relief::{BlendOp, Procedure, Relief, resolve};

const IMAGE_KEYS: &[&str] = &["kind", "image"];
const BLEND_KEYS: &[&str] = &["kind", "blend", "op", "share"];

/// Offset maps by name.
pub(super) type Maps = BTreeMap<String, Arc<OffsetMap>>;

/// Reliefs as they were when they were last computed.
#[derive(Debug, Default)]
pub(super) struct Resolved {
    described: BTreeMap<String, Relief>,
    maps: Maps,
}

impl Resolved {
    /// Whether a relief, and all that it is blended from, is what it was.
    fn still_holds(&self, name: &str, described: &BTreeMap<String, Relief>) -> bool {
        let relief = described.get(name);
        relief == self.described.get(name)
            && match relief {
                Some(Relief::Blend { of, .. }) => of.iter().all(|n| self.still_holds(n, described)),
                _ => self.maps.contains_key(name),
            }
    }
}

/// Reads all reliefs of `[relief]` and computes those that are not what they were: maps of the others stay the same.
pub(super) fn read(entry: &Entry<'_>, folder: &Path, last: &mut Resolved) -> Result<Maps> {
    let mut described = BTreeMap::new();
    for (name, relief) in entry.open_table()?.all() {
        described.insert(name.to_owned(), describe(&relief, folder)?);
    }
    let mut maps = last.maps.clone();
    maps.retain(|name, _| last.still_holds(name, &described));
    for (name, relief) in entry.open_table()?.all() {
        resolve(name, &described, &mut maps).map_err(|e| relief.place(e))?;
    }
    *last = Resolved {
        described,
        maps: maps.clone(),
    };
    Ok(maps)
}

fn describe(entry: &Entry<'_>, folder: &Path) -> Result<Relief> {
    let open = entry.open_table()?;
    let sources = ["image", "blend"].map(|key| open.get(key));
    if let [Some(_), Some(blend)] = sources {
        return Err(blend.fault("the relief is an image too", "keep one of the two"));
    }
    let kind = match (open.get("kind"), &sources) {
        (Some(kind), _) => kind.text()?,
        (None, [Some(_), _]) => "image",
        (None, [_, Some(_)]) => "blend",
        (None, _) => {
            let mend = "add `kind = \"fractal\"`, `image = \"FILE\"` or `blend = [\"a\", \"b\"]`";
            return Err(entry.fault("it does not say where its heights come from", mend));
        }
    };
    match (kind, Procedure::named(kind)) {
        (_, Some(procedure)) => computed(entry, procedure),
        ("image", _) => {
            let table = entry.table(IMAGE_KEYS)?;
            let file = table.need("image", "\"rock.png\"")?.text()?;
            Ok(Relief::Image(folder.join(file)))
        }
        ("blend", _) => blended(&entry.table(BLEND_KEYS)?),
        (_, None) => {
            let known = Procedure::NAMES.into_iter().chain(["image", "blend"]);
            let mend = did_you_mean(kind, known);
            let kind_entry = open.get("kind").unwrap_or_else(|| entry.clone());
            Err(kind_entry.fault(format_args!("{kind:?} is no kind of relief"), mend))
        }
    }
}

fn computed(entry: &Entry<'_>, mut procedure: Procedure) -> Result<Relief> {
    let known: Vec<&str> = procedure.keys().iter().copied().chain(["kind"]).collect();
    for (key, value) in entry.table(&known)?.all() {
        if key != "kind" {
            let numbers = value.numbers()?;
            procedure
                .set(key, &numbers)
                .map_err(|what| value.fault(what, "leave the key out for its usual value"))?;
        }
    }
    Ok(Relief::Procedure(procedure))
}

fn blended(table: &Table<'_>) -> Result<Relief> {
    let blend = table.need("blend", "[\"a\", \"b\"]")?;
    let names = blend.texts()?;
    let Ok(of) = <[String; 2]>::try_from(names) else {
        let mend = "name two; blend the result with a third in another relief";
        return Err(blend.fault("a blend is of exactly two reliefs", mend));
    };
    let op = table.need("op", "\"add\"")?;
    let name = op.text()?;
    let mut operation = BlendOp::named(name).ok_or_else(|| {
        let what = format!("{name:?} is no way to blend");
        op.fault(what, did_you_mean(name, BlendOp::NAMES))
    })?;
    if let Some(entry) = table.get("share") {
        let BlendOp::Mix { share } = &mut operation else {
            return Err(entry.fault("only op = \"mix\" has a share", "remove it"));
        };
        *share = entry.number()?;
        if !(0.0..=1.0).contains(share) {
            return Err(entry.fault("it must be from 0 to 1", "0.5 takes half of each"));
        }
    }
    Ok(Relief::Blend { of, op: operation })
}
