//! Canonical file paths, which are absolute and contain no links and no `..`. The file need not exist yet.

use std::fs;
use std::path::{Component, Path, PathBuf};

/// The canonical path that a file will have once its missing folders exist. If the folder `new` is missing, `new/../a.stl` is `a.stl`.
///
/// Two paths with the same canonical path lead to the same file. Hard links are not detected. A link without a target is kept unchanged.
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
    // If the path exists, its links are resolved. A missing path has no links.
    walked(&absolute, |place| fs::canonicalize(&place).unwrap_or(place))
}

/// Removes `.` and resolves `..` in a path. `follow` may replace each intermediate folder, for example to resolve links.
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
