//! Watched files: whether one was written since it was read. Polled from time to time; a poll reads the files' metadata.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Modification times of files.
#[derive(Debug, Default)]
pub struct Watch(BTreeMap<PathBuf, SystemTime>);

impl Watch {
    /// Returns true if the modification time of a file differs from the last check. A file seen for the first time is unchanged.
    pub fn has_changed<'a>(&mut self, files: impl Iterator<Item = &'a Path>) -> bool {
        let mut has_changed = false;
        for file in files {
            // A missing file is probably about to be rewritten.
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
