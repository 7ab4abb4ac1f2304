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
    /// Opens files: a scene replaces the present one, models are added as parts, and an image becomes the selected cut's relief.
    Take(Vec<PathBuf>),
    /// Saves the scene to a new file, which becomes the scene's own file, or to its present own file.
    Save(PathBuf),
    /// Saves the scene to a file; any existing file is replaced, except an input of the scene.
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
    /// Resets the style value at a path, so that the named style's own value applies again.
    TakeBack(String),
    /// Shows or hides a part of the document.
    ShowPart(usize, bool),
    /// Adds a cut and selects it.
    Add(NewCut),
    /// Appends a copy of a cut to the list of cuts.
    Duplicate(usize),
    /// Removes a cut.
    Remove(usize),
    /// Moves the plane of the selected cut.
    MovePlane(PlaneMove),
    /// Moves a face of the selected cut's box or wedge.
    MoveRegion(RegionMove),
    /// Moves the selected cut's plane, or adds one, through a point with a normal that points to the kept side.
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
    /// Sets the position of the line between the slots, as a fraction of the width from the left.
    Wipe(f32),
    /// Shows errors over the slots, or hides them.
    ShowErrors(bool),
    /// Adds a key for the selection at the displayed time.
    AddKey,
    /// In a scene without animation, adds keys for the selection at 0 s and at 2 s.
    Animate,
    /// Moves a key, given by row and index, to another time in seconds.
    MoveKey([usize; 2], f64),
    /// Removes a key, given by row and index.
    RemoveKey([usize; 2]),
    /// Shows the open edges of meshes over the picture, or hides them.
    ShowOpenEdges(bool),
    /// Displays the scene at a time.
    Seek(f64),
}
