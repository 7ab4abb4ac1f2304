//! Promise: a scene over time is what its keys, deformers and frames say, at every time; what does not change stays the same
//! object; and a timeline that makes no sense is refused with its line and a mend.

mod common;

#[path = "timelines/deformers.rs"]
mod deformers;
#[path = "timelines/frames.rs"]
mod frames;
#[path = "timelines/hostile.rs"]
mod hostile;
#[path = "timelines/keys.rs"]
mod keys;
#[path = "timelines/stages.rs"]
mod stages;

use std::fs;
use std::path::{Path, PathBuf};

use cutaway::error::Result;
use cutaway::scene::{
    OpenedMesh, Part, Scene, SceneFile, Timeline, load_mesh_file, load_scene_file, shapes,
};

/// A folder of its own for each test, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let name = format!("cutaway-timelines-{name}-{}", std::process::id());
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).expect("a temporary folder");
        Self(path)
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, text).expect("a temporary file");
        path
    }

    /// A scene file of this text.
    fn load(&self, text: &str) -> Result<SceneFile> {
        let path = self.write("scene.toml", text);
        load_scene_file(&path, &open_mesh, &shapes::shape)
    }

    /// The timeline of a sound text.
    fn timeline(&self, text: &str) -> Timeline {
        self.load(text).unwrap_or_else(|e| panic!("{e}")).timeline
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that stays behind in the temporary directory harms nobody.
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn open_mesh(path: &Path) -> OpenedMesh {
    let loaded = load_mesh_file(path)?;
    Ok((loaded.parts, loaded.notes))
}

/// The scene at a time at which it is sound.
fn at(timeline: &Timeline, time_s: f64) -> Scene {
    let scene = timeline.at(time_s);
    scene.unwrap_or_else(|e| panic!("at {time_s} s: {e}"))
}

fn part<'a>(scene: &'a Scene, name: &str) -> &'a Part {
    let found = scene.parts.iter().find(|p| p.name == name);
    found.unwrap_or_else(|| panic!("no part {name}"))
}
