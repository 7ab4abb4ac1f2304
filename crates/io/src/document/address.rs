//! Dotted paths: `cut.front.surfaces.0.origin`.
//!
//! A path consists of table keys and, for lists, entry names or indices from 0. Names may contain dots: every possible way to split the
//! path is tried.

use std::borrow::Cow;

use cutaway::error::did_you_mean;

use super::node::{Node, Place, Value};

/// Error message about a path, and its help text.
pub(crate) type Lost = (String, String);

/// Result of following a path.
#[derive(Clone)]
pub(crate) struct PathStep<'a> {
    /// The value that the path leads to.
    pub(crate) node: &'a Node,
    pub(crate) place: Place,
    /// The resolved path as shown in errors: named entries appear by name, others by index.
    pub(crate) path: String,
    /// Remainder of the path that could not be resolved.
    pub(crate) rest: String,
}

/// Follows a path as far as it resolves.
pub(crate) fn walk<'a>(root: &'a Node, path: &str) -> PathStep<'a> {
    go_on(PathStep {
        node: root,
        place: Place::new(),
        path: String::new(),
        rest: path.to_owned(),
    })
}

/// Continues from a step as far as the rest of its path resolves.
fn go_on(from: PathStep<'_>) -> PathStep<'_> {
    let mut farthest = from.clone();
    for (index, (names, child)) in children(from.node).into_iter().enumerate() {
        for name in &names {
            let Some(tail) = from.rest.strip_prefix(&**name) else {
                continue;
            };
            let tail = match (tail.is_empty(), tail.strip_prefix('.')) {
                (true, _) => "",
                (false, Some(tail)) if !tail.is_empty() => tail,
                _ => continue,
            };
            let path = match from.path.as_str() {
                "" => names[0].to_string(),
                path => format!("{path}.{}", names[0]),
            };
            let mut place = from.place.clone();
            place.push(index);
            let step = go_on(PathStep {
                node: child,
                place,
                path,
                rest: tail.to_owned(),
            });
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

/// Returns the direct children of a value. Each has all its names, with the preferred name first.
pub(crate) fn children(node: &Node) -> Vec<(Vec<Cow<'_, str>>, &Node)> {
    match &node.value {
        Value::Table(table) => (table.iter())
            .map(|(key, child)| (vec![Cow::from(&**key)], child))
            .collect(),
        Value::List(list) => (list.iter().enumerate())
            .map(|(index, child)| {
                let name = child.name().map(Cow::from);
                let name = name.or_else(|| child.model().map(Cow::from));
                let mut names: Vec<_> = name.into_iter().collect();
                names.push(Cow::from(index.to_string()));
                (names, child)
            })
            .collect(),
        _ => Vec::new(),
    }
}

/// Lists the possible continuations of a path that ends at a value.
pub(crate) fn farther(node: &Node) -> String {
    let below = children(node);
    let names: Vec<&str> = below.iter().map(|(names, _)| &*names[0]).collect();
    format!("continue with one of: {}", names.join(", "))
}

/// Error for a path that does not resolve.
pub(crate) fn astray(step: &PathStep<'_>) -> Lost {
    let below = children(step.node);
    let names = || below.iter().map(|(names, _)| &*names[0]);
    let (next, _) = step.rest.split_once('.').unwrap_or((&step.rest, ""));
    match (&step.node.value, step.path.as_str()) {
        (Value::Table(_), "" | "relief") | (Value::List(_), "part" | "cut") => {
            let what = match step.path.as_str() {
                "" => format!("there is no `{next}` in the file"),
                list => format!("there is no {list} `{next}`"),
            };
            (what, did_you_mean(next, names()))
        }
        (Value::Table(_) | Value::List(_), path) => {
            let what = format!("there is no `{next}` in `{path}`");
            (what, did_you_mean(next, names()))
        }
        (_, path) => (
            format!("there is nothing below `{path}`"),
            format!("write `{path}` itself"),
        ),
    }
}
