//! Target of a key: the numbers at a dotted path, and their positions in the tree.

use std::fmt;

use crate::document::{
    Lost, Node, Origin, PathStep, Place, Value, astray, children, farther, walk,
};

/// Nesting of numbers in lists.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Nesting {
    Number,
    /// True or false.
    Flag,
    List(Vec<Self>),
}

impl fmt::Display for Nesting {
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

/// The numbers at a path.
#[derive(Debug)]
pub(super) struct KeyTarget {
    /// The path as shown in errors: named entries appear by name, others by index.
    pub(super) path: String,
    /// Positions of the numbers, in text order.
    pub(super) places: Vec<Place>,
    /// Nesting of the numbers in lists.
    pub(super) shape: Nesting,
}

/// Finds the numbers at a path. Errors show `example` as a possible value.
pub(super) fn find(root: &Node, path: &str, example: &str) -> Result<KeyTarget, Lost> {
    let step = walk(root, path);
    if !step.rest.is_empty() {
        return Err(missing(&step, example));
    }
    let mut places = Vec::new();
    match numbers(&step.node.value, &step.place, &mut places) {
        Some(shape) if !places.is_empty() => Ok(KeyTarget {
            path: step.path,
            places,
            shape,
        }),
        _ => Err(no_number(&step)),
    }
}

fn numbers(value: &Value, place: &Place, places: &mut Vec<Place>) -> Option<Nesting> {
    match value {
        Value::Number(_) | Value::Flag(_) => {
            places.push(place.clone());
            let is_flag = matches!(value, Value::Flag(_));
            Some(if is_flag {
                Nesting::Flag
            } else {
                Nesting::Number
            })
        }
        Value::List(list) => {
            let shape = |(index, child): (usize, &Node)| {
                let below = place.iter().copied().chain([index]).collect();
                numbers(&child.value, &below, places)
            };
            let shapes: Option<_> = list.iter().enumerate().map(shape).collect();
            shapes.map(Nesting::List)
        }
        _ => None,
    }
}

/// Error for a path whose value holds no numbers.
fn no_number(step: &PathStep<'_>) -> Lost {
    let last = step.path.rsplit('.').next().unwrap_or_default();
    match &step.node.value {
        Value::Text(text) => {
            let help = match last {
                "section" => {
                    "write the plane as `normal = [0, 0, 1], origin = [0, 0, 0]` and move its origin"
                }
                _ if text.trim_end().ends_with('%') => {
                    "write it as a number in scene units: a number within a text cannot be animated"
                }
                _ => "let the target be a number of the file",
            };
            (
                format!("it holds no number: {} is the text {text:?}", step.path),
                help.into(),
            )
        }
        Value::Table(_) | Value::List(_) => {
            let what = "it is a group of values and holds no number itself";
            (what.into(), farther(step.node))
        }
        _ => (
            "it holds no number of the scene".into(),
            "let the target be a number of the file".into(),
        ),
    }
}

/// Error for a path that does not resolve. Often the file does not contain the number because the scene uses its default.
fn missing(step: &PathStep<'_>, example: &str) -> Lost {
    let is_field = matches!(step.node.value, Value::Table(_)) && !step.rest.contains('.');
    let (path, next) = (&step.path, &step.rest);
    if !is_field || ["", "relief"].contains(&path.as_str()) {
        return astray(step);
    }
    let below = children(step.node);
    let mut names = below.iter().map(|(names, _)| &*names[0]);
    let help = match names.find(|n| strsim::jaro_winkler(n, next) > 0.9) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!(
            "add `{next} = {example}` to `{path}`{}: a key can only animate a number that is in the file",
            match step.node.origin {
                Origin::Text { line, .. } => format!(" in line {line}"),
                _ => String::new(),
            }
        ),
    };
    (format!("the file has no `{next}` in `{path}`"), help)
}
