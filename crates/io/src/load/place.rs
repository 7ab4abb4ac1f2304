//! The place of a file by whichever words: absolute, without links and `..`, whether or not it exists yet.

use std::fs;
use std::path::{Component, Path, PathBuf};

/// The place that a path leads to once the folders on its way are made: where `new` is no folder yet, `new/../a.stl` is `a.stl`.
///
/// Two paths of one place are one file, but for hard links. A link that leads nowhere stays as it is.
///
/// ```
/// use cutaway_io::load::place_of;
/// assert_eq!(place_of("no/such/../../a.stl".as_ref()), place_of("a.stl".as_ref()));
/// ```
pub fn place_of(path: &Path) -> PathBuf {
    if let Ok(place) = fs::canonicalize(path) {
        return place;
    }
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    // What exists is followed through its links, what does not has none.
    walked(&absolute, |place| fs::canonicalize(&place).unwrap_or(place))
}

/// A path without `.` and with `..` taken back, where each folder on the way may be another.
pub(super) fn walked(path: &Path, follow: impl Fn(PathBuf) -> PathBuf) -> PathBuf {
    let mut place = PathBuf::new();
    for step in path.components() {
        let above = place.components().next_back();
        match (step, above) {
            (Component::CurDir, _) | (Component::ParentDir, Some(Component::RootDir)) => {}
            (Component::ParentDir, Some(Component::Normal(_))) => {
                place.pop();
            }
            _ => place.push(step),
        }
        place = follow(place);
    }
    place
}
