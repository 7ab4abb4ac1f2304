//! Actions of the user: every button, key, drag and dropped file becomes an action, which [`State`](crate::State) carries out.

use std::path::PathBuf;

use cutaway_io::document::Value;
use glam::DVec3;

use crate::editing::cuts::{NewCut, PlaneMove};
use crate::editing::regions::RegionMove;
use crate::picture::camera::CameraMove;
use crate::picture::slot::{Layout, Painter, SlotSide};

/// Subject of the panels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Selection {
    /// The scene as a whole.
    #[default]
    Scene,
    /// A cut, by its place in the document.
    Cut(usize),
    /// A part, by its place in the document.
    Part(usize),
}

/// Something to be done.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Takes files in: a scene in the place of this one, models as further parts, an image as the relief of the selected cut.
    Take(Vec<PathBuf>),
    /// Writes the scene to a new file, or to that which it was read from, and goes on with that.
    Save(PathBuf),
    /// The same, in the place of any file that is no input of the scene.
    SaveOver(PathBuf),
    /// Reads all files again.
    Reload,
    /// Takes the last step back.
    Undo,
    /// Does the step again that was taken back.
    Redo,
    /// Sets a value of the document.
    Set {
        /// Dotted path.
        path: String,
        /// The new value.
        value: Value,
    },
    /// Sets several values, or takes them out, after which what is usual holds, in one step.
    Change(Vec<(String, Option<Value>)>),
    /// Takes a change of the style back, by its path: what the style itself has holds again.
    TakeBack(String),
    /// Shows a part of the document, or hides it.
    ShowPart(usize, bool),
    /// Adds a cut and selects it.
    Add(NewCut),
    /// Adds a copy of a cut behind the others.
    Duplicate(usize),
    /// Takes a cut away.
    Remove(usize),
    /// Moves the plane of the selected cut.
    MovePlane(PlaneMove),
    /// Moves a face of a box or of a wedge of the selected cut.
    MoveRegion(RegionMove),
    /// Puts the plane of the selected cut, or a new one, through a point: the normal points to what stays.
    CutThrough(DVec3, DVec3),
    /// Turns the plane of the selected cut to the eye.
    FaceEye,
    /// Ends what is held: the next change is a step of its own.
    Release,
    /// Selects what the panels are about.
    Select(Selection),
    /// Moves the eye.
    MoveCamera(CameraMove),
    /// Chooses the painter of a slot.
    Choose(SlotSide, Painter),
    /// Exchanges the slots.
    Swap,
    /// Sets the layout of the slots.
    Arrange(Layout),
    /// Sets the position of the line between the slots: 0 at the left end.
    Wipe(f32),
    /// Shows errors over the slots, or hides them.
    ShowErrors(bool),
    /// Puts a key of what is selected at the moment that is shown.
    AddKey,
    /// Puts keys of what is selected at the beginning and two seconds later, where nothing moves yet.
    Animate,
    /// Moves a key of a row to another time in seconds.
    MoveKey([usize; 2], f64),
    /// Takes a key of a row away.
    RemoveKey([usize; 2]),
    /// Shows the open edges of meshes over the picture, or hides them.
    ShowOpenEdges(bool),
    /// Shows a moment.
    Seek(f64),
}
