//! Fragment stores for inside tests.

use crate::plan::{Access, Binding};

/// Store that the pass over the mesh fills for an inside test.
#[derive(Clone, Debug)]
pub(crate) struct Store {
    /// File that fills `cutaway::store`.
    pub file: &'static str,
    /// The file's bindings: the data that every fragment updates, and its parameters.
    pub bindings: Vec<Binding>,
    /// Loop rounds that one fragment may take.
    pub rounds: u32,
}

impl Store {
    /// No store, for an inside test that gets its data elsewhere or draws the mesh again. The bound data begins empty.
    pub(crate) fn nothing(bindings: Vec<Binding>) -> Self {
        Self {
            file: "lib/store/nothing.wgsl",
            bindings,
            rounds: 0,
        }
    }

    /// Bindings of the pass that prepares every pixel for its first fragment.
    pub(crate) fn begun(&self) -> impl Iterator<Item = Binding> + '_ {
        self.bindings.iter().map(|b| Binding {
            access: match b.access {
                Access::Read => Access::Read,
                Access::Write | Access::ReadWrite => Access::Write,
            },
            ..b.clone()
        })
    }
}
