//! What a key moves: the numbers at a dotted path, and where they stand in the text.
//!
//! A path goes by the keys of tables; entries of lists go by their `name` or by their number, from 0. Names with dots in
//! them are understood: every way to read the path is tried.

use std::fmt;
use std::ops::Range;

use toml::Spanned;
use toml::de::DeValue;

use super::reader::Source;
use crate::error::did_you_mean;

/// How numbers are nested in lists.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Number,
    /// True or false.
    Flag,
    List(Vec<Self>),
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number => write!(f, "a number"),
            Self::Flag => write!(f, "true or false"),
            Self::List(all) if all.iter().all(|s| *s == Self::Number) => {
                write!(f, "a list of {} numbers", all.len())
            }
            Self::List(all) => write!(f, "{} lists in a list", all.len()),
        }
    }
}

/// A number of the file, or a flag.
#[derive(Clone, Debug)]
pub(super) struct Slot {
    /// Its bytes.
    pub(super) span: Range<usize>,
    form: Form,
}

/// How the file writes a value.
#[derive(Clone, Copy, Debug)]
enum Form {
    /// Without a point.
    Whole,
    Real,
    Flag,
}

impl Slot {
    /// A value as the file would write it: whole numbers stay whole where they can; a flag is on unless it is 0.
    pub(super) fn write(&self, value: f64) -> String {
        let is_whole = value.fract().abs() <= 0.0 && value.abs() < 1e15;
        match self.form {
            Form::Flag => format!("{}", value != 0.0),
            Form::Whole if is_whole => format!("{value:.0}"),
            Form::Whole | Form::Real => format!("{value:?}"),
        }
    }
}

/// The numbers at a path.
#[derive(Debug)]
pub(super) struct Target {
    /// The path as errors write it: entries by name where they have one.
    pub(super) path: String,
    /// In the order of the text.
    pub(super) slots: Vec<Slot>,
    /// How they are nested.
    pub(super) shape: Shape,
}

/// What is wrong with a path, and how to mend it.
pub(super) type Lost = (String, String);

/// Finds the numbers at a path; `example` is a value for them.
pub(super) fn find(
    root: &DeValue<'_>,
    source: &Source<'_>,
    path: &str,
    example: &str,
) -> Result<Target, Lost> {
    let step = walk(root, 0..0, String::new(), path);
    if !step.rest.is_empty() {
        return Err(missing(&step, source, example));
    }
    let mut slots = Vec::new();
    match numbers(step.value, step.span.clone(), &mut slots) {
        Some(shape) if !slots.is_empty() => Ok(Target {
            path: step.path,
            slots,
            shape,
        }),
        _ => Err(no_number(&step)),
    }
}

/// How far a path leads.
struct Step<'a> {
    value: &'a DeValue<'a>,
    span: Range<usize>,
    path: String,
    rest: String,
}

/// Follows a path as far as it goes.
fn walk<'a>(value: &'a DeValue<'a>, span: Range<usize>, path: String, rest: &str) -> Step<'a> {
    let mut farthest = Step {
        value,
        span,
        path: path.clone(),
        rest: rest.to_owned(),
    };
    for (names, child) in children(value) {
        for name in &names {
            let Some(tail) = rest.strip_prefix(name.as_str()) else {
                continue;
            };
            let tail = match (tail.is_empty(), tail.strip_prefix('.')) {
                (true, _) => "",
                (false, Some(tail)) if !tail.is_empty() => tail,
                _ => continue,
            };
            let below = match path.as_str() {
                "" => names[0].clone(),
                path => format!("{path}.{}", names[0]),
            };
            let step = walk(child.get_ref(), child.span(), below, tail);
            if step.rest.is_empty() {
                return step;
            }
            if step.rest.len() < farthest.rest.len() {
                farthest = step;
            }
        }
    }
    farthest
}

/// What is directly below a value, under all its names, the usual one first.
fn children<'a>(value: &'a DeValue<'a>) -> Vec<(Vec<String>, &'a Spanned<DeValue<'a>>)> {
    match value {
        DeValue::Table(table) => table
            .iter()
            .map(|(key, child)| (vec![key.get_ref().to_string()], child))
            .collect(),
        DeValue::Array(array) => array
            .iter()
            .enumerate()
            .map(|(index, child)| {
                let mut names: Vec<String> = name_of(child.get_ref()).into_iter().collect();
                names.push(index.to_string());
                (names, child)
            })
            .collect(),
        _ => Vec::new(),
    }
}

fn name_of(value: &DeValue<'_>) -> Option<String> {
    let DeValue::Table(table) = value else {
        return None;
    };
    match table.get("name").map(Spanned::get_ref) {
        Some(DeValue::String(name)) => Some(name.to_string()),
        _ => None,
    }
}

fn numbers(value: &DeValue<'_>, span: Range<usize>, slots: &mut Vec<Slot>) -> Option<Shape> {
    match value {
        DeValue::Integer(_) | DeValue::Float(_) | DeValue::Boolean(_) => {
            let (form, shape) = match value {
                DeValue::Integer(_) => (Form::Whole, Shape::Number),
                DeValue::Boolean(_) => (Form::Flag, Shape::Flag),
                _ => (Form::Real, Shape::Number),
            };
            slots.push(Slot { span, form });
            Some(shape)
        }
        DeValue::Array(array) => array
            .iter()
            .map(|child| numbers(child.get_ref(), child.span(), slots))
            .collect::<Option<_>>()
            .map(Shape::List),
        _ => None,
    }
}

/// The path leads to something else than numbers.
fn no_number(step: &Step<'_>) -> Lost {
    let last = step.path.rsplit('.').next().unwrap_or_default();
    match step.value {
        DeValue::String(text) => {
            let mend = match last {
                "section" => {
                    "write the plane as `normal = [0, 0, 1], origin = [0, 0, 0]` and move its origin"
                }
                _ if text.trim_end().ends_with('%') => {
                    "write it as a number in scene units: a number in a text cannot move"
                }
                _ => "let the target be a number of the file",
            };
            (
                format!("it names no number: {} is the text {text:?}", step.path),
                mend.into(),
            )
        }
        DeValue::Table(_) | DeValue::Array(_) => {
            let below = children(step.value);
            let names: Vec<&str> = below.iter().map(|(names, _)| names[0].as_str()).collect();
            let what = "it names no number of the scene, but what holds some";
            (
                what.into(),
                format!("go on to one of: {}", names.join(", ")),
            )
        }
        _ => (
            "it names no number of the scene".into(),
            "let the target be a number of the file".into(),
        ),
    }
}

/// The path leads nowhere.
fn missing(step: &Step<'_>, source: &Source<'_>, example: &str) -> Lost {
    let below = children(step.value);
    let names = || below.iter().map(|(names, _)| names[0].as_str());
    let (next, _) = step.rest.split_once('.').unwrap_or((&step.rest, ""));
    match (step.value, step.path.as_str()) {
        (DeValue::Table(_), "" | "relief") | (DeValue::Array(_), "part" | "cut") => {
            let what = match step.path.as_str() {
                "" => format!("there is no `{next}` in the file"),
                list => format!("there is no {list} `{next}`"),
            };
            (what, did_you_mean(next, names()))
        }
        (DeValue::Table(_), path) if next == step.rest => {
            let near = names().find(|n| strsim::jaro_winkler(n, next) > 0.9);
            let mend = match near {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!(
                    "add `{next} = {example}` to `{path}` in line {}: a key moves a number that the file has",
                    source.line(step.span.start)
                ),
            };
            (format!("the file has no `{next}` in `{path}`"), mend)
        }
        (DeValue::Table(_) | DeValue::Array(_), path) => {
            let what = format!("there is no `{next}` in `{path}`");
            (what, did_you_mean(next, names()))
        }
        (_, path) => (
            format!("there is nothing below `{path}`"),
            format!("let the target be `{path}` itself"),
        ),
    }
}
