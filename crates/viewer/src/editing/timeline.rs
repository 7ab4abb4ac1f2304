//! The keys of a document as rows of a timeline, and changes to them.
//!
//! A row has one target, with a time and a value for each key. An animated value is in the document twice: as the target's rest value,
//! and in the keys. The [pose] of a document has the values at one time in place of the rest values; a manual change
//! to a pose is stored [in the keys](keep) at that time.
//!
//! Cannot: key percentages, because keys are numbers (percentages are converted to units before they are keyed); or key an entry of a
//! list whose name and number are both names of other entries.

mod address;
mod chosen;

use address::by_number;
pub use address::{path_of, take_out_cut};
pub use chosen::{prepare, targets};
use cutaway::{Error, Result};
use cutaway_io::Document;
use cutaway_io::document::{Key, Node, Number, Value};

/// Times are rounded to this many steps per second; keys stay at least one step apart.
const TIME_DECIMALS: f64 = 1000.0;

/// The keys of one target.
#[derive(Clone, Debug, PartialEq)]
pub struct TimelineTrack {
    /// Dotted path of the target.
    pub target: String,
    /// Ascending times in seconds.
    pub times_s: Vec<f64>,
    /// Values, one per key.
    pub values: Vec<Value>,
}

/// All rows of a document, in order.
pub fn tracks(document: &Document) -> Vec<TimelineTrack> {
    let keys = document.root().get("key").map_or(&[] as &[_], Node::items);
    let track = |key: &Node| {
        let list = |name: &str| key.get(name).map_or(&[] as &[_], Node::items);
        let target = key.get("target").and_then(Node::text).unwrap_or_default();
        TimelineTrack {
            target: target.to_owned(),
            times_s: list("times_s").iter().filter_map(number).collect(),
            values: list("values")
                .iter()
                .map(|node| node.value.clone())
                .collect(),
        }
    };
    keys.iter().map(track).collect()
}

/// Returns true if a key moves the value at a path.
pub fn is_target(document: &Document, path: &str) -> bool {
    let path = by_number(document, path);
    let mut tracks = tracks(document).into_iter();
    tracks.any(|track| by_number(document, &track.target) == path)
}

/// Sets a key at a time, replacing an existing one.
///
/// # Errors
///
/// A document that cannot be changed.
pub fn add(document: &mut Document, target: &str, time_s: f64, value: Value) -> Result<()> {
    let time_s = rounded(time_s);
    let path = by_number(document, target);
    let tracks = tracks(document);
    let own = |track: &TimelineTrack| by_number(document, &track.target) == path;
    let Some(index) = tracks.iter().position(own) else {
        let key = Value::from([
            ("target", target.into()),
            ("times_s", vec![time_s].into()),
            ("values", vec![value].into()),
        ]);
        return document.push("key", Node::new(key));
    };
    let TimelineTrack {
        mut times_s,
        mut values,
        ..
    } = tracks[index].clone();
    let at = times_s.partition_point(|t| *t < time_s - 0.5 / TIME_DECIMALS);
    match times_s.get(at) {
        Some(held) if (held - time_s).abs() < 0.5 / TIME_DECIMALS => {
            return document.set(&format!("key.{index}.values.{at}"), value);
        }
        _ => {
            times_s.insert(at, time_s);
            values.insert(at, value);
        }
    }
    document.set(&format!("key.{index}.times_s"), times_s)?;
    document.set(&format!("key.{index}.values"), values)
}

/// Moves a key to another time. The time is limited so that the key stays between its neighbours.
///
/// # Errors
///
/// A key that does not exist.
pub fn move_key(document: &mut Document, [track, key]: [usize; 2], to_s: f64) -> Result<()> {
    let times_s = found(document, [track, key])?.times_s;
    let apart = 1.0 / TIME_DECIMALS;
    let least = if key > 0 {
        times_s[key - 1] + apart
    } else {
        0.0
    };
    let most = times_s
        .get(key + 1)
        .map_or(f64::INFINITY, |next| next - apart);
    let to_s = rounded(to_s.clamp(least, most.max(least)));
    document.set(&format!("key.{track}.times_s.{key}"), to_s)
}

/// Removes a key. If it was the row's last key, the row is removed too.
///
/// # Errors
///
/// A key that does not exist.
pub fn remove(document: &mut Document, [track, key]: [usize; 2]) -> Result<()> {
    if found(document, [track, key])?.times_s.len() == 1 {
        return match tracks(document).len() {
            1 => document.remove("key"),
            _ => document.remove(&format!("key.{track}")),
        };
    }
    document.remove(&format!("key.{track}.times_s.{key}"))?;
    document.remove(&format!("key.{track}.values.{key}"))
}

/// Removes the rows of all targets below a path.
///
/// # Errors
///
/// A document that cannot be changed.
pub fn remove_below(document: &mut Document, path: &str) -> Result<()> {
    let below = format!("{path}.");
    for (index, track) in tracks(document).iter().enumerate().rev() {
        if by_number(document, &track.target).starts_with(&below) {
            match tracks(document).len() {
                1 => document.remove("key")?,
                _ => document.remove(&format!("key.{index}"))?,
            }
        }
    }
    Ok(())
}

fn found(document: &Document, [track, key]: [usize; 2]) -> Result<TimelineTrack> {
    let tracks = tracks(document);
    let found = tracks.get(track).filter(|t| key < t.times_s.len());
    found.cloned().ok_or_else(|| {
        let culprit = format!("key {key} of row {track}");
        Error::input(culprit, "there is no such key", "choose another one")
    })
}

/// Replaces rest values by the keys' values at a time.
///
/// # Errors
///
/// A target that the document does not have.
pub fn pose<'a>(
    document: &mut Document,
    keys: impl IntoIterator<Item = &'a Key>,
    time_s: f64,
) -> Result<()> {
    for key in keys {
        let mut numbers = key.at(time_s).into_iter();
        let held = document.get(&key.target)?.value.clone();
        document.set(&key.target, filled(&held, &mut numbers))?;
    }
    Ok(())
}

/// Stores the changes to a pose in the keys at its time, and restores the rest values.
///
/// # Errors
///
/// A document that cannot be changed.
pub fn keep<'a>(
    document: &mut Document,
    rest: &Document,
    keys: impl IntoIterator<Item = &'a Key>,
    time_s: f64,
) -> Result<()> {
    for key in keys {
        // A removed target has no keys to update.
        let Ok(node) = document.get(&key.target) else {
            continue;
        };
        let value = node.value.clone();
        add(document, &key.target, time_s, value)?;
        if let Ok(node) = rest.get(&key.target) {
            document.set(&key.target, node.value.clone())?;
        }
    }
    Ok(())
}

/// A value of the same structure, with its numbers taken from `numbers` in order.
fn filled(held: &Value, numbers: &mut impl Iterator<Item = f64>) -> Value {
    match held {
        Value::List(list) => {
            let each = list
                .iter()
                .map(|node| Node::new(filled(&node.value, numbers)));
            Value::List(each.collect())
        }
        Value::Flag(flag) => numbers.next().map_or(*flag, |n| n != 0.0).into(),
        Value::Number(number) => match numbers.next() {
            Some(value) if number.whole.is_some() && value.fract().abs() <= 0.0 => {
                (value as i64).into()
            }
            Some(value) => value.into(),
            None => Value::Number(*number),
        },
        other => other.clone(),
    }
}

fn number(node: &Node) -> Option<f64> {
    match &node.value {
        Value::Number(Number { value, .. }) => Some(*value),
        _ => None,
    }
}

fn rounded(time_s: f64) -> f64 {
    (time_s.max(0.0) * TIME_DECIMALS).round() / TIME_DECIMALS
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway_io::load::Assets;

    const SCENE: &str = "[[part]]\nname = \"box\"\nshape = \"cube\"\ntranslate = [0, 0, 0] # at rest\n\n[[key]]\ntarget = \"part.box.translate\"\ntimes_s = [0, 2]\nvalues = [[0, 0, 0], [4, 0, 0]]\n";

    fn document() -> Document {
        Document::parse("s.toml", SCENE).expect("a scene")
    }

    fn times(document: &Document) -> Vec<f64> {
        tracks(document)[0].times_s.clone()
    }

    #[test]
    fn keys_are_added_moved_and_taken_away() {
        let mut document = document();
        add(
            &mut document,
            "part.0.translate",
            0.5,
            vec![9.0, 0.0, 0.0].into(),
        )
        .expect("a key");
        assert_eq!(
            times(&document),
            [0.0, 0.5, 2.0],
            "by its number, in its row"
        );
        add(
            &mut document,
            "part.box.translate",
            0.5,
            vec![3.0, 0.0, 0.0].into(),
        )
        .expect("a key");
        assert_eq!(times(&document).len(), 3, "in the place of the other");
        let timeline = document
            .timeline(&mut Assets::default())
            .expect("a timeline");
        let keys: Vec<_> = timeline.keys().collect();
        assert_eq!(keys[0].at(0.5), [3.0, 0.0, 0.0]);

        move_key(&mut document, [0, 1], 5.0).expect("a key");
        assert_eq!(
            times(&document),
            [0.0, 1.999, 2.0],
            "it stays before the next"
        );
        move_key(&mut document, [0, 1], -5.0).expect("a key");
        assert_eq!(
            times(&document),
            [0.0, 0.001, 2.0],
            "and behind the one before"
        );
        move_key(&mut document, [0, 2], 7.12345).expect("a key");
        assert_eq!(times(&document)[2], 7.123);
        for left in [2, 1] {
            remove(&mut document, [0, 0]).expect("a key");
            assert_eq!(times(&document).len(), left);
        }
        remove(&mut document, [0, 0]).expect("the last");
        assert!(tracks(&document).is_empty() && document.root().get("key").is_none());
        assert!(remove(&mut document, [0, 0]).is_err(), "none is left");
        assert!(document.to_string().contains("# at rest"), "{document}");
    }

    #[test]
    fn what_a_hand_changes_of_a_pose_goes_into_its_moment() {
        let rest = document();
        let timeline = rest.timeline(&mut Assets::default()).expect("a timeline");
        let keys: Vec<Key> = timeline.keys().cloned().collect();
        let mut posed = rest.clone();
        pose(&mut posed, &keys, 1.0).expect("a pose");
        let translate = |document: &Document| {
            let node = document.get("part.box.translate").expect("a number");
            node.items().iter().filter_map(number).collect::<Vec<_>>()
        };
        assert_eq!(translate(&posed), [2.0, 0.0, 0.0]);
        posed
            .set("part.box.translate", vec![2.0, 5.0, 0.0])
            .expect("a number");
        keep(&mut posed, &rest, &keys, 1.0).expect("kept");
        assert_eq!(translate(&posed), [0.0; 3], "at rest as it was");
        assert_eq!(times(&posed), [0.0, 1.0, 2.0]);
        let timeline = posed.timeline(&mut Assets::default()).expect("a timeline");
        let key = timeline.keys().next().expect("a key");
        assert_eq!(key.at(1.0), [2.0, 5.0, 0.0]);
    }

    #[test]
    fn rows_go_with_what_they_move() {
        let mut document = document();
        assert!(is_target(&document, "part.0.translate"));
        assert!(!is_target(&document, "part.0.scale"));
        remove_below(&mut document, "part.0").expect("a row");
        assert!(tracks(&document).is_empty());
    }
}
