//! A command's results, written all or not at all: if the disk is full or standard output fails, the error is reported and no file is left.
//!
//! Files are written next to their destinations as they are added. At the end standard output is written, and then each file is
//! renamed.

use cutaway::Result;

use super::output::{Output, Pending, begun_with, write_stdout};

/// Results of a command, not yet at their destinations.
#[derive(Default)]
pub(crate) struct Results {
    files: Vec<Pending>,
    stdout: Option<Vec<u8>>,
}

impl Results {
    /// Adds a result; only one may go to standard output.
    pub(crate) fn add(&mut self, output: &Output, bytes: Vec<u8>) -> Result<()> {
        match output {
            Output::Stdout => self.stdout = Some(bytes),
            Output::File(path) => self.files.push(begun_with(path, &bytes)?),
        }
        Ok(())
    }

    /// Moves all results to their destinations.
    pub(crate) fn place(mut self) -> Result<()> {
        self.files.iter().try_for_each(Pending::sync)?;
        if let Some(bytes) = &self.stdout {
            write_stdout(bytes)?;
        }
        std::mem::take(&mut self.files)
            .into_iter()
            .try_for_each(Pending::place_synced)
    }
}

impl Drop for Results {
    /// Drops files in reverse order: the first file may have created a folder for all, which is removed once it is empty.
    fn drop(&mut self) {
        while self.files.pop().is_some() {}
    }
}
