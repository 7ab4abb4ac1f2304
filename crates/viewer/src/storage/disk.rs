//! File storage on disk, which writes files in the same way as the `cutaway` command.

use std::path::Path;

use cutaway::Result;
use cutaway_cli::{is_one_file, write_file};
use cutaway_io::load::{Disk, place_of};

use crate::storage::files::FileStorage;

impl FileStorage for Disk {
    fn write(&self, path: &Path, bytes: &[u8]) -> Result<()> {
        write_file(path, bytes)
    }

    fn is_one(&self, a: &Path, b: &Path) -> bool {
        place_of(a) == place_of(b) || is_one_file(a, b)
    }
}
