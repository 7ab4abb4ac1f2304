//! Canonical file paths: absolute, without links and `..`, whether or not the file exists yet.

use std::fs;
use std::path::{Component, Path, PathBuf};

/// The canonical path of a file once its missing folders are created: if the folder `new` does not exist yet, `new/../a.stl` is `a.stl`.
///
/// Two paths with the same canonical path are the same file; hard links are not detected. A link with a missing target is kept as it is.
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
    // An existing path is resolved through its links; a missing one has none.
    walked(&absolute, |place| fs::canonicalize(&place).unwrap_or(place))
}

/// Removes `.` and resolves `..` in a path; `follow` may replace each intermediate folder.
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
