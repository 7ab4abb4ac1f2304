//! Setting, adding and removing values. The tree and the text are changed together, so that neither has to be generated from the other.

use std::path::Path;

use cutaway::error::{Error, Result};
use toml_edit::DocumentMut;

use super::node::{Node, Origin, Place, Value};
use super::{Document, PathStep, astray, farther, lost, text, walk};

impl Document {
    /// Sets the value at a path. A missing key is added to its table, with any missing tables above it.
    ///
    /// # Errors
    ///
    /// Fails if the path goes through a number or a missing list entry, or if the value would replace a table.
    pub fn set(&mut self, path: &str, value: impl Into<Value>) -> Result<()> {
        self.set_node(path, Node::new(value))
    }

    /// Returns a copy of the document in which each value is set at its path, in order.
    ///
    /// # Errors
    ///
    /// The errors of [`Document::set`].
    pub fn with_changes<'a>(
        &self,
        changes: impl IntoIterator<Item = &'a (String, Node)>,
    ) -> Result<Self> {
        let mut changed = self.clone();
        for (path, node) in changes {
            changed.set_node(path, node.clone())?;
        }
        Ok(changed)
    }

    /// Like [`Document::set`], but the value has a source position, which errors about the value report.
    ///
    /// # Errors
    ///
    /// The errors of [`Document::set`].
    pub fn set_node(&mut self, path: &str, node: Node) -> Result<()> {
        let step = self.to_be_set(path)?;
        let is_table = matches!(step.node.value, Value::Table(_));
        if step.rest.is_empty() && is_table && !matches!(node.value, Value::Table(_)) {
            return Err(lost(path, ("it is a table".into(), farther(step.node))));
        }
        let (place, rest) = (step.place, step.rest);
        if rest.is_empty() {
            self.set_at(&place, node)
        } else {
            self.add_at(&place, &rest.split('.').collect::<Vec<_>>(), node)
        }
    }

    /// Sets a key in each entry of a list of tables, such as `part`.
    ///
    /// # Errors
    ///
    /// Fails if the text cannot be edited.
    pub fn set_in_each(&mut self, list: &str, key: &str, node: &Node) -> Result<()> {
        for (place, held) in self.in_each(list, key) {
            match held {
                Some(held) => self.set_at(&held, node.clone())?,
                None => self.add_at(&place, &[key], node.clone())?,
            }
        }
        Ok(())
    }

    /// Appends a value to the list at a key, in each entry of a list of tables.
    ///
    /// # Errors
    ///
    /// Fails if the text cannot be edited.
    pub fn push_in_each(&mut self, list: &str, key: &str, node: &Node) -> Result<()> {
        for (place, held) in self.in_each(list, key) {
            match held {
                Some(held) => self.push_at(&held, node.clone())?,
                None => {
                    let value = Value::List(vec![node.clone()]);
                    let origin = node.origin.clone();
                    self.add_at(&place, &[key], Node { value, origin })?;
                }
            }
        }
        Ok(())
    }

    /// Removes the value at a path, if it exists.
    ///
    /// # Errors
    ///
    /// Fails if the text cannot be edited.
    pub fn remove(&mut self, path: &str) -> Result<()> {
        let step = walk(&self.root, path);
        let (place, is_there) = (step.place, step.rest.is_empty());
        let Some((last, parent)) = place.split_last().filter(|_| is_there) else {
            return Ok(());
        };
        let text = edited(&mut self.edited, &self.text, &self.path)?;
        text::remove(text, (&self.root, parent), *last);
        match self.root.at_mut(parent).map(|node| &mut node.value) {
            Some(Value::Table(entries)) => {
                entries.remove(*last);
            }
            Some(Value::List(list)) => {
                list.remove(*last);
            }
            _ => {}
        }
        Ok(())
    }

    /// The entries of a list of tables. Each comes with its value at a key, if it has one.
    fn in_each(&self, list: &str, key: &str) -> Vec<(Place, Option<Place>)> {
        let step = walk(&self.root, list);
        let Value::List(entries) = &step.node.value else {
            return Vec::new();
        };
        let within = |(index, entry): (usize, &Node)| {
            let place: Place = step.place.iter().copied().chain([index]).collect();
            let held = match &entry.value {
                Value::Table(entries) => entries.iter().position(|(name, _)| **name == *key),
                _ => None,
            };
            let held = held.map(|at| place.iter().copied().chain([at]).collect());
            (place, held)
        };
        entries.iter().enumerate().map(within).collect()
    }

    /// Adds a key to the table at a place, with any missing tables above it.
    pub(super) fn add_at(&mut self, place: &Place, new: &[&str], mut node: Node) -> Result<()> {
        let text = edited(&mut self.edited, &self.text, &self.path)?;
        text::set(text, (&self.root, place), new, &node.value);
        for key in new.iter().skip(1).rev() {
            let origin = node.origin.clone();
            node = Node {
                value: Value::Table(vec![((*key).into(), node)]),
                origin,
            };
        }
        if let Some(Value::Table(entries)) = self.root.at_mut(place).map(|node| &mut node.value) {
            entries.push((new[0].into(), node));
        }
        Ok(())
    }

    /// Appends a value to the list at a place.
    fn push_at(&mut self, place: &Place, node: Node) -> Result<()> {
        let text = edited(&mut self.edited, &self.text, &self.path)?;
        text::push(text, (&self.root, place), &node.value);
        if let Some(Value::List(list)) = self.root.at_mut(place).map(|node| &mut node.value) {
            list.push(node);
        }
        Ok(())
    }

    /// Replaces the value at a place.
    pub(super) fn set_at(&mut self, place: &Place, node: Node) -> Result<()> {
        let text = edited(&mut self.edited, &self.text, &self.path)?;
        text::set(text, (&self.root, place), &[], &node.value);
        match self.root.at_mut(place) {
            // A value set by a program takes over the source position of the value that it replaces.
            Some(held) if node.origin == Origin::Program => held.value = node.value,
            Some(held) => *held = node,
            None => {}
        }
        Ok(())
    }

    /// Appends a value to the list at a path, and creates a missing list: `push("cut", ..)`.
    ///
    /// # Errors
    ///
    /// Fails if the value at the path is not a list, or if the path goes through a value that is not a table.
    pub fn push(&mut self, path: &str, node: Node) -> Result<()> {
        let step = self.to_be_set(path)?;
        if !step.rest.is_empty() {
            let origin = node.origin.clone();
            let value = Value::List(vec![node]);
            return self.set_node(path, Node { value, origin });
        }
        if !matches!(step.node.value, Value::List(_)) {
            let help = "put it into a list, such as `cut`, or set the value itself";
            return Err(lost(path, ("it is not a list".into(), help.into())));
        }
        self.push_at(&step.place, node)
    }

    /// Returns true if a value can be set at a path, because it exists already or because a table can hold it.
    #[doc(hidden)]
    pub fn takes(&self, path: &str) -> bool {
        self.to_be_set(path).is_ok()
    }

    /// Returns true if two paths lead to the same value, or one to a descendant of the other.
    #[doc(hidden)]
    pub fn overlap(&self, one: &str, other: &str) -> bool {
        let [a, b] = [one, other].map(|path| {
            let step = walk(&self.root, path);
            let known = step.place.iter().map(usize::to_string);
            let new = step.rest.split('.').filter(|key| !key.is_empty());
            known
                .chain(new.map(|key| format!(".{key}")))
                .collect::<Vec<_>>()
        });
        a.starts_with(&b) || b.starts_with(&a)
    }

    /// Resolves a path to where a value can be set.
    fn to_be_set(&self, path: &str) -> Result<PathStep<'_>> {
        if path.split('.').any(str::is_empty) {
            let help = "separate keys by points, as in `camera.azimuth_deg`";
            return Err(lost(path, ("it names no value".into(), help.into())));
        }
        let step = walk(&self.root, path);
        if !step.rest.is_empty() && !matches!(step.node.value, Value::Table(_)) {
            return Err(lost(path, astray(&step)));
        }
        // Missing levels are created as tables. They are not created as lists, because the intended entry would be unknown.
        let new: Vec<&str> = step.rest.split('.').collect();
        let is_list = step.path.is_empty() && LISTS.contains(&new[0]);
        let is_entry = |at: &usize| {
            let is_of_names = NAMED.contains(&new[at - 1]);
            (is_list && *at == 1) || (is_number(new[*at]) && !is_of_names)
        };
        if let Some(at) = (1..new.len()).find(is_entry) {
            let list = path.strip_suffix(&new[at..].join(".")).unwrap_or(path);
            let list = list.trim_end_matches('.');
            let what = format!("there is no `{}`, because `{list}` does not exist", new[at]);
            return Err(lost(
                path,
                (what, format!("set the whole list: `{list}=[..]`")),
            ));
        }
        Ok(step)
    }
}

/// The lists of a scene file.
const LISTS: [&str; 3] = ["part", "cut", "key"];

/// Tables whose keys are names, which may be numbers.
const NAMED: [&str; 2] = ["relief", "offset"];

fn is_number(key: &str) -> bool {
    !key.is_empty() && key.bytes().all(|b| b.is_ascii_digit())
}

/// The text, which is edited together with the tree.
fn edited<'a>(
    edited: &'a mut Option<DocumentMut>,
    text: &str,
    path: &Path,
) -> Result<&'a mut DocumentMut> {
    match edited {
        Some(text) => Ok(text),
        None => {
            let parsed = text.parse().map_err(|e| {
                let help =
                    "please report this: one TOML parser accepts the text, but another does not";
                Error::file(path, format!("{e}"), help)
            })?;
            Ok(edited.insert(parsed))
        }
    }
}
