//! What is varied: axes with values, and the points and contenders that they make.
//!
//! A text may hold placeholders, `{amplitude}`. An axis whose placeholder is in the words of the scene makes *points*: one frame and
//! one record for each value, and for each combination where there are several such axes. An axis whose placeholder is only in the
//! names of strategies makes more *contenders* within each point, so that they are measured in turns. An axis may have tables for
//! values, each with several placeholders that go together: `{faces}` is its `is`, and `{segments}` and `{sides}` are its others. One of
//! these may be a list of words: it takes the place of a word of the scene that is the placeholder and nothing else.

use std::collections::{BTreeMap, BTreeSet};

use super::{Contender, Maker, Parameters};
use crate::error::did_you_mean;
use crate::strategies::Strategy;
use crate::{Error, Result};

/// Points that one run may have: more are a slip.
const MOST_POINTS: usize = 10_000;

/// Contenders that one point may have: all of them are kept on the device, and measured in turns.
const MOST_CONTENDERS: usize = 200;

/// One value of an axis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Value {
    /// What it is called.
    pub is: String,
    /// Its placeholders; that of the axis is what it is called.
    pub with: Parameters,
    /// Those of them that are lists of words, for a word of the scene that is nothing but the placeholder.
    pub lists: BTreeMap<String, Vec<String>>,
}

/// What is varied.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    /// Its name.
    pub name: String,
    /// Its values, in the order they are written; each has the same placeholders.
    pub values: Vec<Value>,
}

impl Axis {
    /// An axis, if its values can be told apart and have the same placeholders.
    pub fn of(name: &str, values: Vec<Value>) -> Result<Self> {
        let fault = |what: &str, mend: &str| Error::input(format!("axis `{name}`"), what, mend);
        let Some(first) = values.first() else {
            return Err(fault(
                "it has no values",
                "write at least one, or leave it out",
            ));
        };
        if values.iter().any(|v| !v.with.keys().eq(first.with.keys())) {
            let mend = "give every value the same keys";
            return Err(fault("its values have different keys", mend));
        }
        let mut seen = BTreeSet::new();
        if let Some(twice) = values.iter().find(|v| !seen.insert(v.is.as_str())) {
            let what = format!("the value `{}` is there twice", twice.is);
            return Err(fault(&what, "write each value once"));
        }
        Ok(Self {
            name: name.to_owned(),
            values,
        })
    }

    /// Its placeholders.
    fn placeholders(&self) -> impl Iterator<Item = &str> {
        let first = self.values.first();
        first
            .into_iter()
            .flat_map(|v| v.with.keys().map(String::as_str))
    }

    fn is_in(&self, texts: &[&str]) -> bool {
        let mut names = self.placeholders();
        names.any(|n| texts.iter().any(|t| t.contains(&format!("{{{n}}}"))))
    }
}

/// Axes by name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Axes(Vec<Axis>);

impl Axes {
    /// Adds an axis, if its placeholders are not those of another.
    pub fn add(&mut self, axis: Axis) -> Result<()> {
        let taken = axis
            .placeholders()
            .find(|n| self.placeholders().any(|p| p == *n));
        if let Some(taken) = taken {
            let culprit = format!("axis `{}`", axis.name);
            let what = format!("another axis has the placeholder {{{taken}}}");
            return Err(Error::input(culprit, what, "give it another name"));
        }
        self.0.push(axis);
        Ok(())
    }

    /// Puts an axis in the place of that of the same name.
    pub fn replace(&mut self, axis: Axis) {
        for place in self.0.iter_mut().filter(|a| a.name == axis.name) {
            *place = axis.clone();
        }
    }

    /// Leaves out what only the texts that were replaced made use of.
    pub fn forget_unused(&mut self, now: &Templates, before: &Templates) {
        let is_kept = |a: &Axis| a.is_in(&now.texts()) || !a.is_in(&before.texts());
        self.0.retain(is_kept);
    }

    /// An axis by its name.
    pub fn get(&self, name: &str) -> Option<&Axis> {
        self.0.iter().find(|a| a.name == name)
    }

    /// Names of the axes.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|a| a.name.as_str())
    }

    /// Whether a placeholder ever has a value.
    pub fn have(&self, placeholder: &str, value: &str) -> bool {
        let mut values = self.0.iter().flat_map(|a| &a.values);
        values.any(|v| v.with.get(placeholder).is_some_and(|is| is == value))
    }

    /// All placeholders.
    pub fn placeholders(&self) -> impl Iterator<Item = &str> {
        self.0.iter().flat_map(Axis::placeholders)
    }
}

/// Texts with placeholders.
#[derive(Clone, Debug)]
pub struct Templates {
    /// Words of the scene.
    pub scene: Vec<String>,
    /// Words of the scene that is the truth.
    pub truth: Option<Vec<String>>,
    /// Width and height.
    pub resolution: Option<String>,
    /// Names of contenders.
    pub strategies: Vec<String>,
}

impl Templates {
    /// Texts that say what is drawn.
    fn of_scene(&self) -> Vec<&str> {
        let words = self.scene.iter().chain(self.truth.iter().flatten());
        words.chain(&self.resolution).map(String::as_str).collect()
    }

    fn texts(&self) -> Vec<&str> {
        let mut texts = self.of_scene();
        texts.extend(self.strategies.iter().map(String::as_str));
        texts
    }
}

/// One frame to be measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Values that make its scene.
    pub parameters: Parameters,
    /// Those of them that are axes.
    pub axes: Vec<String>,
    /// What tells it from the other points of its run, for names of files; empty where there is but one.
    pub stem: String,
    /// Words of the scene, as after `cutaway compare`, with its resolution.
    pub scene: Vec<String>,
    /// Words of the scene that is the truth, where that is another.
    pub truth: Option<Vec<String>>,
    /// Who is asked.
    pub entrants: Vec<Entrant>,
}

/// A contender, and what made it.
#[derive(Clone, Debug, PartialEq)]
pub struct Entrant {
    /// Who is asked.
    pub contender: Contender,
    /// What made it: each text of the strategies, with values, that comes to this contender.
    pub makers: Vec<(usize, Maker)>,
}

impl Entrant {
    /// Whether something holds for what made it.
    pub fn is_made_by(&self, holds: impl Fn(&Parameters) -> bool) -> bool {
        self.makers
            .iter()
            .any(|(_, maker)| holds(&maker.parameters))
    }
}

/// Makes all points.
pub fn expand(axes: &Axes, templates: &Templates) -> Result<Vec<Point>> {
    check_placeholders(axes, templates)?;
    let of_scene = templates.of_scene();
    let (of_points, of_contenders): (Vec<&Axis>, Vec<&Axis>) =
        axes.0.iter().partition(|a| a.is_in(&of_scene));
    let Some(count) = product(&of_points).filter(|count| *count <= MOST_POINTS) else {
        let what = "the values make too many points";
        let mend = format!("leave some out: at most {MOST_POINTS} are measured");
        return Err(Error::input("sweep", what, mend));
    };
    let mut stems = BTreeSet::new();
    let mut points = Vec::with_capacity(count);
    for values in combinations(&of_points) {
        let parameters: Parameters = joined(&values);
        let words = |texts: &[String]| {
            let mut words: Vec<String> = (texts.iter())
                .flat_map(|text| match list(text, &values) {
                    Some(list) => list.clone(),
                    None => vec![filled(text, &parameters)],
                })
                .collect();
            let size = templates.resolution.as_ref();
            words.extend(size.map(|r| format!("--resolution={}", filled(r, &parameters))));
            words
        };
        points.push(Point {
            stem: stem(&values, &mut stems),
            scene: words(&templates.scene),
            truth: templates.truth.as_deref().map(words),
            entrants: entrants(&templates.strategies, &of_contenders, &parameters)?,
            axes: of_points.iter().map(|a| a.name.clone()).collect(),
            parameters,
        });
    }
    Ok(points)
}

/// Every placeholder has values, and every axis a place.
fn check_placeholders(axes: &Axes, templates: &Templates) -> Result<()> {
    let texts = templates.texts();
    for text in &texts {
        for name in placeholders(text)? {
            if !axes.placeholders().any(|p| p == name) {
                let what = format!("nothing says what {{{name}}} is");
                let mend = if axes.0.is_empty() {
                    format!("add `sweep = {{ {name} = [1, 2] }}`, or leave the braces out")
                } else {
                    did_you_mean(name, axes.placeholders())
                };
                return Err(Error::input(format!("`{text}`"), what, mend));
            }
        }
    }
    match axes.0.iter().find(|a| !a.is_in(&texts)) {
        None => Ok(()),
        Some(idle) => {
            let names: Vec<String> = idle.placeholders().map(|n| format!("{{{n}}}")).collect();
            Err(Error::input(
                format!("axis `{}`", idle.name),
                "nobody uses its values",
                format!("write {} somewhere, or leave it out", names.join(" or ")),
            ))
        }
    }
}

/// Names between braces.
fn placeholders(text: &str) -> Result<Vec<&str>> {
    let fault = || {
        let mend = "write {name}, with both braces and a name between";
        Error::input(format!("`{text}`"), "a brace stands alone", mend)
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

/// A text with values in the place of placeholders; those that have none stay.
fn filled(text: &str, values: &Parameters) -> String {
    let fill = |text: String, (name, value): (&String, &String)| {
        text.replace(&format!("{{{name}}}"), value)
    };
    values.iter().fold(text.to_owned(), fill)
}

/// All choices of one value from each axis; the last axis varies fastest.
fn combinations<'a>(axes: &[&'a Axis]) -> Vec<Vec<&'a Value>> {
    axes.iter().fold(vec![Vec::new()], |chosen, axis| {
        let longer = |c: &Vec<&'a Value>| {
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

fn joined(values: &[&Value]) -> Parameters {
    let all = values.iter().flat_map(|v| &v.with);
    all.map(|(name, value)| (name.clone(), value.clone()))
        .collect()
}

/// The words that take the place of a word that is nothing but the placeholder of a list.
fn list<'a>(text: &str, values: &[&'a Value]) -> Option<&'a Vec<String>> {
    let name = text.strip_prefix('{')?.strip_suffix('}')?;
    values.iter().find_map(|v| v.lists.get(name))
}

/// A name that files of the point can have, unlike those of the others.
fn stem(values: &[&Value], taken: &mut BTreeSet<String>) -> String {
    let is_safe = |c: char| c.is_ascii_alphanumeric() || "+-".contains(c);
    let safe = |text: &str| -> String {
        text.chars()
            .map(|c| if is_safe(c) { c } else { '_' })
            .collect()
    };
    let plain: Vec<String> = values.iter().map(|v| safe(&v.is)).collect();
    let plain = plain.join("_");
    // The files of hard cases are called so, and a stem of dots and spaces says nothing.
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

fn entrants(texts: &[String], axes: &[&Axis], of_point: &Parameters) -> Result<Vec<Entrant>> {
    let mut entrants: Vec<Entrant> = Vec::new();
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    for (template, text) in texts.iter().enumerate() {
        let own: Vec<&Axis> = axes.iter().copied().filter(|a| a.is_in(&[text])).collect();
        if product(&own).is_none_or(|count| count > MOST_CONTENDERS) {
            let mend = format!("leave some out: at most {MOST_CONTENDERS} are measured in turns");
            return Err(Error::input(
                format!("`{text}`"),
                "it has too many values",
                mend,
            ));
        }
        for values in combinations(&own) {
            let parameters = joined(&values);
            let name = filled(&filled(text, of_point), &parameters);
            for contender in named(&name)? {
                let name = contender.to_string();
                let maker = Maker {
                    family: match text.contains('{') {
                        true => text.clone(),
                        false => name.clone(),
                    },
                    parameters: parameters.clone(),
                };
                let place = *places.entry(name).or_insert_with(|| {
                    entrants.push(Entrant {
                        contender,
                        makers: Vec::new(),
                    });
                    entrants.len() - 1
                });
                entrants[place].makers.push((template, maker));
            }
        }
    }
    if entrants.len() > MOST_CONTENDERS {
        let what = format!("the values make {} contenders", entrants.len());
        let mend = format!("leave some out: at most {MOST_CONTENDERS} are measured in turns");
        return Err(Error::input("strategies", what, mend));
    }
    Ok(entrants)
}

/// How many combinations there are; none where that is more than can be counted.
fn product(axes: &[&Axis]) -> Option<usize> {
    (axes.iter()).try_fold(1_usize, |count, axis| count.checked_mul(axis.values.len()))
}

/// The contenders of a name: `all` are all strategies with their usual parameters.
pub fn named(name: &str) -> Result<Vec<Contender>> {
    match name.trim() {
        "all" => Ok(Strategy::ALL.map(Contender::from).to_vec()),
        "exact" => Err(Error::input(
            "`exact`",
            "exact is what strategies are measured against",
            "leave it out; its picture and time are part of every record",
        )),
        name => Ok(vec![name.parse()?]),
    }
}
