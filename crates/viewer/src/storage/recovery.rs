//! Saves the scene when the program cannot continue, to a file next to the list of recent files.

use std::path::{Path, PathBuf};
use std::{fs, process};

use cutaway::{Error, Result};
use cutaway_cli::write_file;

use crate::state::State;
use crate::storage::recent::Recent;

/// Writes a scene with unsaved changes to a separate file, and returns the path; `None` if there are no unsaved changes.
///
/// # Errors
///
/// The folder cannot be created or written.
pub fn keep(state: &State) -> Result<Option<PathBuf>> {
    if !state.has_unsaved_changes() {
        return Ok(None);
    }
    let usual = Recent::usual_file().unwrap_or_default();
    let name = format!("recovered-{}.toml", process::id());
    let path = usual.with_file_name(name);
    keep_in(state, &path)?;
    Ok(Some(path))
}

fn keep_in(state: &State, path: &Path) -> Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(|e| {
            let help = "set $XDG_STATE_HOME to a folder that can be written";
            Error::file(folder, format!("cannot be created: {e}"), help)
        })?;
    }
    let document = state.as_moving()?.moved_to(path)?;
    write_file(path, document.to_string().as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::action::Action;
    use crate::editing::cuts::NewCut;
    use cutaway_io::Document;
    use cutaway_io::document::part;
    use cutaway_io::load::Assets;

    #[test]
    fn what_is_kept_is_opened_again() {
        let mut document = Document::new();
        document.add_part(part("shape:cube")).expect("a part");
        let mut state = State::open(document, Assets::default()).expect("a scene");
        assert!(
            keep(&state).expect("no file").is_none(),
            "nothing has changed"
        );
        state.apply(Action::Add(NewCut::Plane(2)));
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("new/recovered.toml");
        keep_in(&state, &path).expect("a file");
        let document = Document::read(&path).expect("a scene");
        let kept = State::open(document, Assets::default()).expect("a scene");
        assert_eq!(kept.cuts(), state.cuts());
    }
}
