//! Detects whether a file was written since it was last checked. The files are polled; a poll reads their metadata.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Modification times of files.
#[derive(Debug, Default)]
pub struct Watch(BTreeMap<PathBuf, SystemTime>);

impl Watch {
    /// Returns true if a file's modification time differs from the last check. A file checked for the first time counts as unchanged.
    pub fn has_changed<'a>(&mut self, files: impl Iterator<Item = &'a Path>) -> bool {
        let mut has_changed = false;
        for file in files {
            // A missing file is probably being rewritten, so it counts as unchanged.
            let Ok(written) = file.metadata().and_then(|m| m.modified()) else {
                continue;
            };
            let before = self.0.insert(file.to_owned(), written);
            has_changed |= before.is_some_and(|before| before != written);
        }
        has_changed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_file_that_was_written_is_noticed_once() {
        let file = tempfile::NamedTempFile::new().expect("a file");
        let mut watch = Watch::default();
        let mut asks = || watch.has_changed([file.path()].into_iter());
        assert!(!asks(), "it is new");
        assert!(!asks(), "nobody wrote it");
        let later = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000);
        file.as_file().set_modified(later).expect("a time");
        assert!(asks(), "it was written");
        assert!(!asks(), "which is known by now");
    }
}
