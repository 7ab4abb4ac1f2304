//! Sweeps: axes with values, and the points and renderers that the values produce.
//!
//! A scene axis sets values of the document by their paths and produces *points*: one frame and one record for each value, or for
//! each combination if there are several such axes. An axis whose name is in braces in a strategy, `grid:{cells}+mask`, produces
//! several *renderers* within each point, so that they are timed in the same rounds.

use std::collections::{BTreeMap, BTreeSet};

use cutaway::error::did_you_mean;
use cutaway::{Error, Result};
use cutaway_io::document::{Document, Node};

use super::{FamilyMember, Parameter, Parameters, Renderer};

/// Maximum number of points in a run; a larger number is regarded as a mistake.
const MOST_POINTS: usize = 10_000;

/// Maximum number of renderers at a point: all of them are kept on the device, and timed in the same rounds.
const MOST_RENDERERS: usize = 200;

/// Values to set in a document, each with its path, in order.
pub type Changes = Vec<(String, Node)>;

/// One value of an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepValue {
    /// Label of the value.
    pub is: Parameter,
    /// Changes that the value makes to the scene; empty on a strategy axis.
    pub sets: Changes,
}

/// Axis of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepAxis {
    /// Its name.
    pub name: String,
    /// Paths that every value of the axis sets, if the axis is written as one list of values.
    pub paths: Vec<String>,
    /// Its values, in the order in which they are written.
    pub values: Vec<SweepValue>,
}

impl SweepAxis {
    /// Makes an axis. Its values must be distinct and set the same paths.
    pub fn of(name: &str, paths: Vec<String>, values: Vec<SweepValue>) -> Result<Self> {
        let fault = |what: &str, help: &str| Error::input(format!("axis `{name}`"), what, help);
        let Some(first) = values.first() else {
            return Err(fault(
                "it has no values",
                "write at least one, or leave it out",
            ));
        };
        let set_by = |value: &SweepValue| -> BTreeSet<String> {
            value.sets.iter().map(|(path, _)| path.clone()).collect()
        };
        if values.iter().any(|v| set_by(v) != set_by(first)) {
            let help = "let every value set the same paths";
            return Err(fault("its values set different paths", help));
        }
        let mut seen = BTreeSet::new();
        if let Some(twice) = values.iter().find(|v| !seen.insert(v.is.to_string())) {
            let what = format!("the value `{}` is listed twice", twice.is);
            return Err(fault(&what, "write each value once"));
        }
        Ok(Self {
            name: name.to_owned(),
            paths,
            values,
        })
    }

    /// Returns true for a strategy axis, false for a scene axis.
    pub(super) fn is_of_strategies(&self) -> bool {
        self.values.iter().all(|v| v.sets.is_empty())
    }

    fn is_in(&self, text: &str) -> bool {
        text.contains(&format!("{{{}}}", self.name))
    }
}

/// The axes of a sweep.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axes(pub Vec<SweepAxis>);

impl Axes {
    /// Replaces the axis of the same name.
    pub fn replace(&mut self, axis: SweepAxis) {
        for place in self.0.iter_mut().filter(|a| a.name == axis.name) {
            *place = axis.clone();
        }
    }

    /// Removes strategy axes that no strategy uses any more.
    pub fn forget_unused(&mut self, strategies: &[String]) {
        let is_kept =
            |a: &SweepAxis| !a.is_of_strategies() || strategies.iter().any(|s| a.is_in(s));
        self.0.retain(is_kept);
    }

    /// Finds an axis by its name.
    pub fn get(&self, name: &str) -> Option<&SweepAxis> {
        self.0.iter().find(|a| a.name == name)
    }

    /// Names of the axes.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|a| a.name.as_str())
    }
}

/// Input of a sweep: scenes and strategies.
#[derive(Clone, Debug)]
pub struct Variable {
    /// The scene before any axis value is set.
    pub scene: Document,
    /// Changes that turn the scene into its truth scene, if that is another scene.
    pub truth: Option<Changes>,
    /// Names of renderers.
    pub strategies: Vec<String>,
}

/// One frame to be measured.
#[derive(Clone, Debug)]
pub struct Point {
    /// Values that the scene's sweep axes have at this point.
    pub parameters: Parameters,
    /// Part of file names that distinguishes the point from the run's other points; empty if there is only one point.
    pub stem: String,
    /// The scene.
    pub scene: Document,
    /// The truth scene, if that is another scene.
    pub truth: Option<Document>,
    /// Renderers to measure.
    pub trials: Vec<Trial>,
}

/// A renderer and the sweep values that produced it.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Renderer to measure.
    pub renderer: Renderer,
    /// Sources of the renderer: the index of each strategy text that gives it, with the values used.
    pub families: Vec<(usize, FamilyMember)>,
}

impl Trial {
    /// Returns true if the predicate holds for the parameters of at least one of the renderer's sources.
    pub fn is_made_by(&self, holds: impl Fn(&Parameters) -> bool) -> bool {
        self.families
            .iter()
            .any(|(_, member)| holds(&member.parameters))
    }
}

/// Expands a sweep into its points.
pub fn expand(axes: &Axes, of: &Variable) -> Result<Vec<Point>> {
    check_braces(axes, &of.strategies)?;
    let (of_renderers, of_points): (Vec<&SweepAxis>, Vec<&SweepAxis>) =
        axes.0.iter().partition(|a| a.is_of_strategies());
    let Some(count) = product(&of_points).filter(|count| *count <= MOST_POINTS) else {
        let what = "the values give too many points";
        let help = format!("leave some out: at most {MOST_POINTS} are measured");
        return Err(Error::input("sweep", what, help));
    };
    must_be_apart(axes, &of.scene)?;
    let trials = trials(&of.strategies, &of_renderers)?;
    let mut stems = BTreeSet::new();
    let mut points = Vec::with_capacity(count);
    for values in combinations(&of_points) {
        let scene = of.scene.with_changes(values.iter().flat_map(|v| &v.sets))?;
        let truth = of
            .truth
            .as_ref()
            .map(|t| scene.with_changes(t))
            .transpose()?;
        points.push(Point {
            parameters: named_values(&of_points, &values),
            stem: stem(&values, &mut stems),
            trials: trials.clone(),
            scene,
            truth,
        });
    }
    Ok(points)
}

/// Fails if two axes set the same value.
fn must_be_apart(axes: &Axes, scene: &Document) -> Result<()> {
    let paths = |axis: &SweepAxis| -> Vec<String> {
        let first = axis.values.first().map_or(&[] as &[_], |v| &v.sets);
        first.iter().map(|(path, _)| path.clone()).collect()
    };
    for (index, axis) in axes.0.iter().enumerate() {
        for other in &axes.0[..index] {
            for path in paths(axis) {
                if paths(other).iter().any(|p| scene.overlap(p, &path)) {
                    let what = format!("axis `{}` sets `{path}` too", other.name);
                    let help = "set each value by one axis only: otherwise the last axis overrides the others";
                    return Err(Error::input(format!("axis `{}`", axis.name), what, help));
                }
            }
        }
    }
    Ok(())
}

fn named_values(axes: &[&SweepAxis], values: &[&SweepValue]) -> Parameters {
    let pairs = axes.iter().zip(values);
    pairs
        .map(|(axis, value)| (axis.name.clone(), value.is.clone()))
        .collect()
}

/// Checks that every name in braces has values, and that every axis without paths is used by a strategy.
fn check_braces(axes: &Axes, strategies: &[String]) -> Result<()> {
    let of_strategies: Vec<&str> = (axes.0.iter())
        .filter(|a| a.is_of_strategies())
        .map(|a| a.name.as_str())
        .collect();
    for text in strategies {
        for name in in_braces(text)? {
            if !of_strategies.contains(&name) {
                let what = format!("{{{name}}} has no values");
                let help = if of_strategies.is_empty() {
                    format!("add `sweep = {{ {name} = [1, 2] }}`, or leave the braces out")
                } else {
                    did_you_mean(name, of_strategies)
                };
                return Err(Error::input(format!("`{text}`"), what, help));
            }
        }
    }
    Ok(())
}

/// Names between braces.
fn in_braces(text: &str) -> Result<Vec<&str>> {
    let fault = || {
        let help = "write {name}: a name between two braces";
        Error::input(format!("`{text}`"), "it has an unpaired brace", help)
    };
    let mut names = Vec::new();
    for piece in text.split('{').skip(1) {
        let (name, _) = piece.split_once('}').ok_or_else(fault)?;
        names.push(name);
    }
    if text.matches('}').count() != names.len() || names.contains(&"") {
        return Err(fault());
    }
    Ok(names)
}

/// All combinations of one value from each axis; the last axis varies fastest.
fn combinations<'a>(axes: &[&'a SweepAxis]) -> Vec<Vec<&'a SweepValue>> {
    axes.iter().fold(vec![Vec::new()], |chosen, axis| {
        let longer = |c: &Vec<&'a SweepValue>| {
            let mut all = Vec::new();
            for value in &axis.values {
                let mut longer = c.clone();
                longer.push(value);
                all.push(longer);
            }
            all
        };
        chosen.iter().flat_map(longer).collect()
    })
}

/// A file name for the point that no other point of the run has.
fn stem(values: &[&SweepValue], taken: &mut BTreeSet<String>) -> String {
    let is_safe = |c: char| c.is_ascii_alphanumeric() || "+-".contains(c);
    let safe = |text: String| -> String {
        text.chars()
            .map(|c| if is_safe(c) { c } else { '_' })
            .collect()
    };
    let plain: Vec<String> = values.iter().map(|v| safe(v.is.to_string())).collect();
    let plain = plain.join("_");
    // `cases` is the stem of the hard cases' files. Characters other than letters, digits, `+` and `-` are already replaced by `_`.
    let is_taken = |s: &String| s == "cases" || taken.contains(s);
    let mut stem = plain.clone();
    let mut count = 1;
    while is_taken(&stem) {
        count += 1;
        stem = format!("{plain}_{count}");
    }
    taken.insert(stem.clone());
    stem
}

fn trials(texts: &[String], axes: &[&SweepAxis]) -> Result<Vec<Trial>> {
    let mut trials: Vec<Trial> = Vec::new();
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    for (template, text) in texts.iter().enumerate() {
        let own: Vec<&SweepAxis> = axes.iter().copied().filter(|a| a.is_in(text)).collect();
        if product(&own).is_none_or(|count| count > MOST_RENDERERS) {
            let help = format!("leave some out: at most {MOST_RENDERERS} are measured in turns");
            return Err(Error::input(
                format!("`{text}`"),
                "it has too many values",
                help,
            ));
        }
        for values in combinations(&own) {
            let parameters = named_values(&own, &values);
            let fill = |text: String, (name, value): (&String, &Parameter)| {
                text.replace(&format!("{{{name}}}"), &value.to_string())
            };
            let name = parameters.iter().fold(text.clone(), fill);
            for renderer in Renderer::named(&name)? {
                let name = renderer.to_string();
                let member = FamilyMember {
                    family: match own.is_empty() {
                        false => text.clone(),
                        true => name.clone(),
                    },
                    parameters: parameters.clone(),
                };
                let place = *places.entry(name).or_insert_with(|| {
                    trials.push(Trial {
                        renderer,
                        families: Vec::new(),
                    });
                    trials.len() - 1
                });
                trials[place].families.push((template, member));
            }
        }
    }
    if trials.len() > MOST_RENDERERS {
        let what = format!("the values give {} renderers", trials.len());
        let help = format!("leave some out: at most {MOST_RENDERERS} are measured in turns");
        return Err(Error::input("strategies", what, help));
    }
    Ok(trials)
}

/// Number of combinations; `None` on overflow.
fn product(axes: &[&SweepAxis]) -> Option<usize> {
    (axes.iter()).try_fold(1_usize, |count, axis| count.checked_mul(axis.values.len()))
}
