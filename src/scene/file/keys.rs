//! `[[key]]`: numbers of the scene over time.

use super::reader::Entry;
use crate::error::{Result, did_you_mean};
use crate::scene::{Cut, Part};

const KEYS: &[&str] = &["target", "times_s", "values"];

/// A number field of the scene, or a vector of numbers, over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// Dotted path of the field, for example `cut.front.surfaces.0.origin`.
    pub target: String,
    /// Ascending times.
    pub times_s: Vec<f64>,
    /// One value for each time, all of the same length; a single number has length 1.
    pub values: Vec<Vec<f64>>,
}

/// Reads one key; its target must begin with something the scene has.
pub(super) fn read(entry: &Entry<'_>, parts: &[Part], cuts: &[Cut]) -> Result<Key> {
    let table = entry.table(KEYS)?;
    let target = table.need("target", "\"cut.front.surfaces.0.origin\"")?;
    let path: Vec<&str> = target.text()?.split('.').collect();
    let field = "add the field, as in `camera.azimuth_deg` or `cut.front.surfaces.0.origin`";
    let shortest = match path[0] {
        "camera" => 2,
        "part" | "cut" => 3,
        kind => {
            let mend = did_you_mean(kind, ["camera", "part", "cut"]);
            return Err(target.fault(format_args!("nothing called `{kind}` can move"), mend));
        }
    };
    if path.len() < shortest || path.iter().any(|step| step.is_empty()) {
        return Err(target.fault("it names no number of the scene", field));
    }
    let names: Vec<&str> = match path[0] {
        "part" => parts.iter().map(|p| p.name.as_str()).collect(),
        "cut" => cuts.iter().map(|c| c.name.as_str()).collect(),
        _ => vec![path[1]],
    };
    if !names.contains(&path[1]) {
        let what = format!("there is no {} `{}`", path[0], path[1]);
        return Err(target.fault(what, did_you_mean(path[1], names)));
    }
    let times = table.need("times_s", "[0, 2]")?;
    let times_s = times.numbers()?;
    if times_s.is_empty() || times_s.windows(2).any(|w| w[0] >= w[1]) {
        return Err(times.fault("times must ascend", "sort them and remove doubles"));
    }
    let list = table.need("values", "[[0, 0, -1], [0, 0, 1]]")?;
    let values: Vec<Vec<f64>> = list
        .list()?
        .iter()
        .map(Entry::numbers)
        .collect::<Result<_>>()?;
    if values.len() != times_s.len() {
        let what = format!(
            "there are {} values for {} times",
            values.len(),
            times_s.len()
        );
        return Err(list.fault(what, "give one value for each time"));
    }
    if values
        .iter()
        .any(|v| v.is_empty() || v.len() != values[0].len())
    {
        let mend = "make all values numbers, or all lists of the same length";
        return Err(list.fault("the values differ in length", mend));
    }
    Ok(Key {
        target: target.text()?.to_owned(),
        times_s,
        values,
    })
}
