//! `[[key]]`: animated numbers of the scene.
//!
//! A key finds its numbers in the tree of the file ([`target`](super::target)). For each time they are replaced in the tree, which is then
//! read again. So any number in a file can be animated, and all checks of the readers apply at every time. Before its first time a key has
//! its first value, and after its last time its last. A flag is animated by true and false, or 1 and 0, with step interpolation only.

use cutaway::error::{Result, did_you_mean};

use super::described;
use super::reader::{Entry, Table};
use super::target::{self, KeyTarget, Nesting};
use crate::document::Keys;
use crate::document::describe::KeyDesc;
use crate::document::{Interpolation, Node, Number, Place, Value};

static KEYS: Keys = Keys::below("key.*");

/// Tables whose numbers can be animated. The rest of a file is not part of the scene.
const MOVABLE: [&str; 5] = ["camera", "part", "cut", "relief", "style"];

/// An animated number, vector of numbers or flag of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// Dotted path of the field, for example `cut.front.surfaces.0.origin`.
    pub target: String,
    /// Ascending times.
    pub times_s: Vec<f64>,
    /// One value for each time. All have the same length, which is 1 for a single number; the rows of a matrix are concatenated. Flags are
    /// stored as 1 for true and 0 for false.
    pub values: Vec<Vec<f64>>,
    /// Interpolation between the values.
    pub interpolation: Interpolation,
}

impl Key {
    /// The numbers at a time, or an empty list for a key without times.
    pub fn at(&self, time_s: f64) -> Vec<f64> {
        let next = self.times_s.partition_point(|t| *t <= time_s);
        let (Some(last), true) = (next.checked_sub(1), next < self.times_s.len()) else {
            let end = if next == 0 {
                self.values.first()
            } else {
                self.values.last()
            };
            return end.cloned().unwrap_or_default();
        };
        let [from, to] = [self.times_s[last], self.times_s[next]];
        let share = (time_s - from) / (to - from);
        let share = match self.interpolation {
            Interpolation::Linear => share,
            Interpolation::Step => 0.0,
            Interpolation::Smooth => share * share * (3.0 - 2.0 * share),
        };
        let pairs = self.values[last].iter().zip(&self.values[next]);
        pairs.map(|(a, b)| a + (b - a) * share).collect()
    }
}

/// A key together with its target.
#[derive(Clone, Debug)]
pub(crate) struct Keyed {
    pub(crate) key: Key,
    /// Path of the key itself, such as `key.3`.
    own_path: String,
    /// Path of the key's target, in which entries appear by name.
    path: String,
    /// Positions of the animated numbers in the tree, in order.
    places: Vec<Place>,
}

impl Keyed {
    /// Sets the animated value at a time. Integers stay integers if possible. A flag becomes true if the value is not 0.
    pub(crate) fn set(&self, root: &mut Node, time_s: f64) {
        for (place, value) in self.places.iter().zip(self.key.at(time_s)) {
            match root.at_mut(place).map(|node| &mut node.value) {
                Some(Value::Flag(flag)) => *flag = value != 0.0,
                Some(Value::Number(number)) => *number = Number::like(value, number),
                _ => {}
            }
        }
    }
}

/// A time, and the keys whose values at this time are set in the tree.
#[derive(Clone, Copy)]
pub(crate) struct KeyedTime<'a> {
    pub time_s: f64,
    pub(crate) keys: &'a [Keyed],
}

impl KeyedTime<'_> {
    /// Describes the time, and the keys that may have caused an error in a value.
    pub(super) fn blame(&self, of: &str) -> String {
        let touches = |keyed: &&Keyed| {
            let (short, long) = if of.len() < keyed.path.len() {
                (of, keyed.path.as_str())
            } else {
                (keyed.path.as_str(), of)
            };
            long.strip_prefix(short)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        let named = |keyed: &Keyed| format!("`{}`, the target of `{}`", keyed.path, keyed.own_path);
        let mut blamed: Vec<String> = self.keys.iter().filter(touches).map(named).collect();
        if blamed.is_empty() {
            blamed = self.keys.iter().map(named).collect();
        }
        let time_s = (self.time_s * 1e4).round() / 1e4;
        format!("at {time_s} s ({})", blamed.join("; "))
    }
}

/// Reads all keys of a file.
pub(super) fn read(root: &Table<'_>) -> Result<Vec<Keyed>> {
    let mut all: Vec<Keyed> = Vec::new();
    for entry in root.tables("key")? {
        let keyed = read_one(&entry, root)?;
        let meets = |k: &&Keyed| k.places.iter().any(|p| keyed.places.contains(p));
        if let Some(other) = all.iter().find(meets) {
            let target = entry.table(KEYS.all())?.need("target", "\"camera.near\"")?;
            let what = format!("`{}` animates it, too", other.own_path);
            return Err(target.fault(what, "merge the two keys"));
        }
        all.push(keyed);
    }
    Ok(all)
}

fn read_one(entry: &Entry<'_>, root: &Table<'_>) -> Result<Keyed> {
    let table = entry.table(KEYS.all())?;
    let desc: KeyDesc = described::read(&table)?;
    let target = table.need("target", "\"cut.front.surfaces.0.origin\"")?;
    let path = target.text()?;
    movable(&target, path)?;
    let times = table.need("times_s", "[0, 2]")?;
    let times_s = times.numbers()?;
    if times_s.is_empty() || times_s.windows(2).any(|w| w[0] >= w[1]) {
        return Err(times.fault("times must ascend", "sort them and remove duplicates"));
    }
    let list = table.need("values", "[[0, 0, -1], [0, 0, 1]]")?;
    let given = list.list()?;
    if given.len() != times_s.len() {
        let what = format!(
            "there are {} values for {} times",
            given.len(),
            times_s.len()
        );
        return Err(list.fault(what, "give one value for each time"));
    }
    let (values, shapes): (Vec<_>, Vec<_>) = given
        .iter()
        .map(Entry::nested)
        .collect::<Result<Vec<_>>>()?
        .into_iter()
        .unzip();
    if values[0].is_empty() || shapes.iter().any(|s| *s != shapes[0]) {
        let help = "make all values numbers, or all lists of the same length";
        return Err(list.fault("the values are empty or differ in length", help));
    }
    let example = match values[0].as_slice() {
        [one] if shapes[0] == Nesting::Flag => format!("{}", *one != 0.0),
        [one] => format!("{one}"),
        several => format!("{several:?}"),
    };
    let KeyTarget {
        path: full,
        places,
        shape,
    } = target::find(root.entry.node, path, &example)
        .map_err(|(what, help)| target.fault(what, help))?;
    let is_flag = shape == Nesting::Flag;
    let switches = |v: &Vec<f64>| matches!(v.as_slice(), [v] if [0.0, 1.0].contains(v));
    let is_list = matches!(shapes[0], Nesting::List(_));
    if is_flag && (is_list || !values.iter().all(switches)) {
        let what = format!("`{full}` is true or false");
        return Err(list.fault(what, "let every value be true or false"));
    }
    if shape != shapes[0] && !is_flag {
        let what = format!("the values are {} each, but `{full}` is {shape}", shapes[0]);
        return Err(list.fault(what, "make both the same"));
    }
    let interpolation = match (desc.interpolation, is_flag) {
        (None | Some(Interpolation::Step), true) => Interpolation::Step,
        (Some(_), true) => {
            let what = format!("`{full}` is true or false, with no values in between");
            return Err(table.entry.fault(what, "write `interpolation = \"step\"`"));
        }
        (given, false) => given.unwrap_or_default(),
    };
    Ok(Keyed {
        key: Key {
            target: path.to_owned(),
            times_s,
            values,
            interpolation,
        },
        own_path: entry.key.clone(),
        path: full,
        places,
    })
}

/// Refuses targets outside the scene, and values that determine which files are loaded.
fn movable(target: &Entry<'_>, path: &str) -> Result<()> {
    let (root, below) = path.split_once('.').unwrap_or((path, ""));
    if !MOVABLE.contains(&root) {
        let what = format!("`{root}` cannot be animated");
        return Err(target.fault(what, did_you_mean(root, MOVABLE)));
    }
    if below.is_empty() || path.split('.').any(str::is_empty) {
        let help = "add the field, as in `camera.azimuth_deg` or `cut.front.surfaces.0.origin`";
        return Err(target.fault("it holds no number of the scene", help));
    }
    let last = path.rsplit('.').next();
    if matches!(root, "part" | "relief") && matches!(last, Some("fps" | "first" | "loop")) {
        let what = "it determines how files are played, which cannot change over time";
        return Err(target.fault(what, "animate another number"));
    }
    // A shape given as text gets a separate error message.
    let is_made = below.contains(".shape.");
    let is_broken = path.split('.').any(|word| word == "defects");
    let how = match last {
        _ if is_made => Some("made"),
        Some("split") => Some("split"),
        Some("close_holes") => Some("closed"),
        _ => is_broken.then_some("broken"),
    };
    if let Some(how) = how.filter(|_| root == "part") {
        let what = format!("the mesh is {how} once, when it is opened");
        return Err(target.fault(what, "animate another number"));
    }
    Ok(())
}
