//! User actions: every button, key, drag and dropped file becomes an action, which [`State`](crate::State) carries out.

use std::path::PathBuf;

use cutaway_io::document::Value;
use glam::DVec3;

use crate::editing::cuts::{NewCut, PlaneMove};
use crate::editing::regions::RegionMove;
use crate::picture::camera::CameraMove;
use crate::picture::slot::{Painter, SlotLayout, SlotSide};

/// Subject of the panels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Selection {
    /// The scene as a whole.
    #[default]
    Scene,
    /// A cut, by its index in the document.
    Cut(usize),
    /// A part, by its index in the document.
    Part(usize),
}

/// A user action.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Opens files: a scene replaces this one, models become additional parts, an image becomes the selected cut's relief.
    Take(Vec<PathBuf>),
    /// Saves the scene to a new file, or to its own file, which becomes the current one.
    Save(PathBuf),
    /// The same, replacing any existing file except an input of the scene.
    SaveOver(PathBuf),
    /// Reloads all files.
    Reload,
    /// Undoes the last step.
    Undo,
    /// Redoes the step that was undone.
    Redo,
    /// Sets a value of the document.
    Set {
        /// Dotted path.
        path: String,
        /// The new value.
        value: Value,
    },
    /// Sets several values in one step, or removes them so that their defaults apply.
    Change(Vec<(String, Option<Value>)>),
    /// Resets a change to the style, by its path, so that the style's own value applies again.
    TakeBack(String),
    /// Shows or hides a part of the document.
    ShowPart(usize, bool),
    /// Adds a cut and selects it.
    Add(NewCut),
    /// Adds a copy of a cut after the others.
    Duplicate(usize),
    /// Removes a cut.
    Remove(usize),
    /// Moves the plane of the selected cut.
    MovePlane(PlaneMove),
    /// Moves a face of a box or of a wedge of the selected cut.
    MoveRegion(RegionMove),
    /// Moves the selected cut's plane, or a new one, through a point; the normal points to the kept side.
    CutThrough(DVec3, DVec3),
    /// Turns the selected cut's plane to face the eye.
    FaceEye,
    /// Ends a gesture: the next change is a separate undo step.
    Release,
    /// Selects the subject of the panels.
    Select(Selection),
    /// Moves the eye.
    MoveCamera(CameraMove),
    /// Selects the renderer of a slot.
    Choose(SlotSide, Painter),
    /// Swaps the slots.
    Swap,
    /// Sets the layout of the slots.
    Arrange(SlotLayout),
    /// Sets the position of the line between the slots: 0 at the left end.
    Wipe(f32),
    /// Shows errors over the slots, or hides them.
    ShowErrors(bool),
    /// Adds a key for the selection at the displayed time.
    AddKey,
    /// Adds keys for the selection at the beginning and two seconds later, if nothing moves yet.
    Animate,
    /// Moves a key of a row to another time in seconds.
    MoveKey([usize; 2], f64),
    /// Removes a key from a row.
    RemoveKey([usize; 2]),
    /// Shows the open edges of meshes over the picture, or hides them.
    ShowOpenEdges(bool),
    /// Displays the scene at a time.
    Seek(f64),
}
