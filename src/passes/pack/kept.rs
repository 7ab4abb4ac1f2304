//! Contents that depend only on a number and take time to make: every frame requests them, and the latest are cached.

use std::fmt;
use std::sync::{Mutex, PoisonError};

use crate::plan::Contents;

/// Cache of the contents that were requested last.
#[derive(Default)]
pub struct KeptContents(Mutex<Option<(u32, Contents)>>);

impl KeptContents {
    /// The contents for a number: the cached ones if they are for the same number, otherwise the result of `make`.
    pub fn get_or_make(&self, number: u32, make: impl FnOnce() -> Contents) -> Contents {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match &*kept {
            Some((of, contents)) if *of == number => contents.clone(),
            _ => {
                let contents = make();
                *kept = Some((number, contents.clone()));
                contents
            }
        }
    }
}

impl fmt::Debug for KeptContents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("KeptContents")
    }
}
