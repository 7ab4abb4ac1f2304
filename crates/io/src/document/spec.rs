//! Conversion of command-line words to the equivalent tables of a scene file.
//!
//! ```text
//! fractal:amplitude=5%,period=20,seed=7   { kind = "fractal", seed = 7 }, and amplitude and period of its surface
//! rock.png:wrap=mirror                    { image = "rock.png" }, and wrap
//! 50%,50%,50%:                            box = { min = ["50%", "50%", "50%"] }: unbounded where a corner is left out
//! -y:-30:200@0,50%,0                      wedge = { axis = "-y", from_deg = -30, to_deg = 200, origin = [0, "50%", 0] }
//! holes:amount=5%,patch=12                { kind = "holes", amount = "5%", patch = 12 }
//! ```
//!
//! Only the syntax of the words is checked here. Their values are checked later, by the readers of scene files.

use cutaway::error::{Error, Result, did_you_mean};
use cutaway::generate::defects::{Defect, DefectKind};
use cutaway::scene::describe::Described;
use cutaway::scene::relief::Procedure;

use super::node::Value;

const RELIEF: &str =
    "write for example `fractal:amplitude=5%,period=20,seed=7` or `rock.png:wrap=mirror`";
const DEFECT: &str = "write for example `holes:amount=5%,seed=1` or `soup:amount=0.01`";
const BOX: &str = "write for example `0,0,0:1,1,1`, or `50%,50%,50%:` for a box that is open above";
const WEDGE: &str = "write for example `z:0:90`, or `-y:-30:200@0,50%,0`";

/// Relief keys that place the relief on a surface, and are therefore stored with the surface.
const PLACEMENT: [&str; 3] = ["amplitude", "period", "wrap"];

/// A table under construction.
pub(super) type Entries = Vec<(String, Value)>;

pub(super) struct ReliefWords {
    /// Suggested name of the relief.
    pub(super) name: String,
    /// The table `[relief.NAME]`.
    pub(super) relief: Entries,
    /// Keys to add to the surface that has the relief.
    pub(super) placement: Entries,
}

/// Reads `NAME[:key=value,...]` or `IMAGE[:key=value,...]`.
pub(super) fn relief(text: &str) -> Result<ReliefWords> {
    let fault = |what: String, help: String| Error::input(format!("relief `{text}`"), what, help);
    // A path may contain a colon, so only text that looks like keys is read as keys.
    let (name, words) = match text.rsplit_once(':') {
        Some((name, tail)) if tail.contains('=') => (name.trim(), tail),
        _ => (text.trim(), ""),
    };
    let procedure = Procedure::named(name);
    let mut relief = match &procedure {
        Some(_) => vec![("kind".to_owned(), name.into())],
        None if looks_like_a_path(name) => vec![("image".to_owned(), name.into())],
        None => {
            let help = format!("{}, or an image file", did_you_mean(name, Procedure::NAMES));
            return Err(fault("there is no such relief or file".into(), help));
        }
    };
    let fields = procedure.as_ref().map_or(&[] as &[_], Procedure::fields);
    let keys: Vec<&str> = fields.iter().map(|field| field.key).collect();
    let mut placement = Entries::new();
    for (key, value) in settings(words).map_err(|what| fault(what, RELIEF.into()))? {
        let table = match key {
            key if PLACEMENT.contains(&key) => &mut placement,
            key if keys.contains(&key) => &mut relief,
            key => {
                let help = did_you_mean(key, PLACEMENT.into_iter().chain(keys.iter().copied()));
                return Err(fault(format!("`{key}` is no key of {name}"), help));
            }
        };
        table.push((key.to_owned(), several(value)));
    }
    let stem = std::path::Path::new(name).file_stem().unwrap_or_default();
    let plain = |c: char| if c.is_alphanumeric() { c } else { '_' };
    Ok(ReliefWords {
        name: stem.to_string_lossy().chars().map(plain).collect(),
        relief,
        placement,
    })
}

fn looks_like_a_path(name: &str) -> bool {
    name.contains(['/', '\\', '.']) || std::path::Path::new(name).exists()
}

/// Reads `KIND[:key=value,...]`.
pub(super) fn defect(text: &str) -> Result<Entries> {
    let fault = |what: String, help: String| Error::input(format!("defect `{text}`"), what, help);
    let (name, words) = text.split_once(':').unwrap_or((text, ""));
    let name = name.trim();
    let Some(kind) = DefectKind::named(name) else {
        let help = did_you_mean(name, DefectKind::NAMES);
        return Err(fault("there is no such defect".to_owned(), help));
    };
    let mut table = vec![("kind".to_owned(), name.into())];
    let known: Vec<&str> = Defect::of(kind).fields().iter().map(|f| f.key).collect();
    for (key, value) in settings(words).map_err(|what| fault(what, DEFECT.into()))? {
        if !known.contains(&key) {
            let help = did_you_mean(key, known.iter().copied());
            return Err(fault(format!("`{key}` is no key of {name}"), help));
        }
        table.push((key.to_owned(), number_or_text(value)));
    }
    Ok(table)
}

/// Reads `MIN:MAX`.
pub(super) fn block(text: &str) -> Result<Entries> {
    let fault = |what: String| Error::input(format!("box `{text}`"), what, BOX);
    let Some((min, max)) = text.split_once(':') else {
        return Err(fault("it has no `:` between its corners".into()));
    };
    let mut table = Entries::new();
    for (key, corner) in [("min", min), ("max", max)] {
        if !corner.trim().is_empty() {
            table.push((key.to_owned(), point(corner).map_err(fault)?));
        }
    }
    if table.is_empty() {
        return Err(fault("it has no corner".into()));
    }
    Ok(table)
}

/// Reads `AXIS:FROM:TO`, optionally followed by `@X,Y,Z`, a point on the axis.
pub(super) fn wedge(text: &str) -> Result<Entries> {
    let fault = |what: String| Error::input(format!("wedge `{text}`"), what, WEDGE);
    let (turn, origin) = match text.split_once('@') {
        Some((turn, origin)) => (turn, Some(point(origin).map_err(fault)?)),
        None => (text, None),
    };
    let words: Vec<&str> = turn.split(':').map(str::trim).collect();
    let [axis, from, to] = words[..] else {
        return Err(fault("it must consist of an axis and two angles".into()));
    };
    if !["x", "y", "z"].contains(&axis.strip_prefix('-').unwrap_or(axis)) {
        return Err(fault(format!("`{axis}` is not an axis")));
    }
    let mut table = vec![
        ("axis".to_owned(), axis.into()),
        ("from_deg".to_owned(), number_or_text(from)),
        ("to_deg".to_owned(), number_or_text(to)),
    ];
    table.extend(origin.map(|point| ("origin".to_owned(), point)));
    Ok(table)
}

/// Reads `key=value,...` of an opening with automatic placement. A number alone is the value of the first key in `keys`.
pub(super) fn opening(text: &str, what: &str, keys: &[&str]) -> Result<Entries> {
    let fault = |fault: String, help: String| Error::input(format!("{what} `{text}`"), fault, help);
    let words = match text {
        text if !text.is_empty() && !text.contains('=') => format!("{}={text}", keys[0]),
        text => text.to_owned(),
    };
    let mut table = Entries::new();
    let usual = || format!("write for example `{}=10`", keys[0]);
    for (key, value) in settings(&words).map_err(|what| fault(what, usual()))? {
        if !keys.contains(&key) {
            let help = did_you_mean(key, keys.iter().copied());
            return Err(fault(format!("it has no key `{key}`"), help));
        }
        table.push((key.to_owned(), number_or_text(value)));
    }
    Ok(table)
}

fn point(text: &str) -> Result<Value, String> {
    let coordinates: Vec<Value> = text.split(',').map(number_or_text).collect();
    match coordinates.len() {
        3 => Ok(coordinates.into()),
        count => Err(format!("`{text}` has {count} coordinates, not 3")),
    }
}

/// Splits `key=value,key=value` into its keys and values.
fn settings(words: &str) -> Result<Vec<(&str, &str)>, String> {
    let settings = words.split(',').filter(|s| !s.trim().is_empty());
    settings
        .map(|setting| match setting.split_once('=') {
            Some((key, value)) => Ok((key.trim(), value)),
            None => Err(format!("`{setting}` is not of the form key=value")),
        })
        .collect()
}

/// Converts a word to a number or, if it is not one, to a text.
pub(super) fn number_or_text(text: &str) -> Value {
    let text = text.trim();
    match (text.parse::<i64>(), text.parse::<f64>()) {
        (Ok(whole), _) => whole.into(),
        (_, Ok(number)) if number.is_finite() => number.into(),
        _ => text.into(),
    }
}

/// Converts a word to a number, to a list if it has numbers separated by `x`, or otherwise to a text.
fn several(text: &str) -> Value {
    let parts: Vec<Value> = text.split('x').map(number_or_text).collect();
    let is_number = |value: &Value| matches!(value, Value::Number(_));
    if parts.len() > 1 && parts.iter().all(is_number) {
        parts.into()
    } else {
        number_or_text(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Node;

    fn toml(entries: Entries) -> Value {
        let entries = entries.into_iter();
        Value::Table(entries.map(|(k, v)| (k.into(), Node::new(v))).collect())
    }

    #[test]
    fn words_are_the_tables_of_files() {
        let spec =
            relief("fractal:seed=7,size=64x32,amplitude=0.5,period=25%,wrap=mirror").expect("fine");
        let table = Value::read("{ kind = \"fractal\", seed = 7, size = [64, 32] }");
        assert_eq!(toml(spec.relief), table);
        let placement = Value::read("{ amplitude = 0.5, period = \"25%\", wrap = \"mirror\" }");
        assert_eq!(toml(spec.placement), placement);
        assert_eq!(spec.name, "fractal");
        for (text, image, name) in [
            (r"C:\maps\rock.png", r"C:\maps\rock.png", None),
            (
                "maps/rock.v2.png:wrap=clamp",
                "maps/rock.v2.png",
                Some("rock_v2"),
            ),
        ] {
            let spec = relief(text).expect(text);
            assert_eq!(toml(spec.relief), Value::from([("image", image.into())]));
            assert!(name.is_none_or(|n| n == spec.name), "{}", spec.name);
        }
        for (words, expected) in [
            (
                block("50%,0,25%:3,1,100%"),
                "{ min = [\"50%\", 0, \"25%\"], max = [3, 1, \"100%\"] }",
            ),
            (block(":0,0.5,4"), "{ max = [0, 0.5, 4] }"),
            (
                wedge("z:-30:200"),
                "{ axis = \"z\", from_deg = -30, to_deg = 200 }",
            ),
            (
                wedge("-x:0:90@0,50%,3"),
                "{ axis = \"-x\", from_deg = 0, to_deg = 90, origin = [0, \"50%\", 3] }",
            ),
            (
                defect("holes:amount=5%,patch=12"),
                "{ kind = \"holes\", amount = \"5%\", patch = 12 }",
            ),
            (defect("open:axis=-x"), "{ kind = \"open\", axis = \"-x\" }"),
        ] {
            assert_eq!(toml(words.expect(expected)), Value::read(expected));
        }
    }

    #[test]
    fn words_of_no_form_are_refused() {
        for (error, phrase) in [
            (relief("fractl").err(), "did you mean `fractal`"),
            (relief("fractal:seed=1,loud").err(), "not of the form"),
            (
                relief("fractal:amplitud=1").err(),
                "did you mean `amplitude`",
            ),
            (relief("rock.png:seed=1").err(), "no key of rock.png"),
            (block("0,0,0").err(), "no `:`"),
            (block(":").err(), "no corner"),
            (block("0,0:1,1,1").err(), "2 coordinates"),
            (wedge("z").err(), "two angles"),
            (wedge("w:0:90").err(), "`w` is not an axis"),
            (wedge("z:0:90@1,2").err(), "2 coordinates"),
            (defect("hole").err(), "did you mean `holes`"),
            (defect("soup:patch=2").err(), "no key of soup"),
        ] {
            let error = error.map(|e| e.to_string()).unwrap_or_default();
            assert!(
                error.contains(phrase) && error.contains("help:"),
                "{phrase}: {error}"
            );
        }
    }
}
