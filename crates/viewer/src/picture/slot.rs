//! The two comparison slots, each drawn by a method or by the reference, and their layout.

use std::fmt;
use std::str::FromStr;

use cutaway::gpu::Gpu;
use cutaway::scene::View;
use cutaway::strategies::{AUTO, DrawOptions, choose};
use cutaway::{Error, Model, Result};
use cutaway_lab::experiment::Renderer;

/// One of the two slots.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SlotSide {
    /// The slot shown when there is only one.
    A,
    /// The other slot.
    B,
}

impl SlotSide {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::A, Self::B];

    /// Index in an array of both slots.
    pub fn index(self) -> usize {
        match self {
            Self::A => 0,
            Self::B => 1,
        }
    }
}

impl fmt::Display for SlotSide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::A => "A",
            Self::B => "B",
        })
    }
}

/// Choice of the renderer of a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Painter {
    /// Chosen automatically for the scene, the view and the adapter.
    Auto,
    /// The renderer with this name.
    Named(Renderer),
}

impl Painter {
    /// The renderer that the choice means for this scene, view and device.
    pub fn classify(self, gpu: &Gpu, model: &Model, view: &View) -> Renderer {
        match self {
            Self::Named(renderer) => renderer,
            Self::Auto => choose(model, view, DrawOptions::default(), Some(gpu.traits()))
                .method
                .into(),
        }
    }
}

impl fmt::Display for Painter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str(AUTO),
            Self::Named(renderer) => renderer.fmt(f),
        }
    }
}

impl FromStr for Painter {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        match name.trim() {
            AUTO => Ok(Self::Auto),
            name => Ok(Self::Named(name.parse()?)),
        }
    }
}

/// Layout of the two slots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SlotLayout {
    /// Only A.
    #[default]
    Single,
    /// A to the left of a movable line, B to the right.
    Wipe,
    /// A and B next to each other, with the same view.
    SideBySide,
    /// A, or B while a key is held.
    Flicker,
    /// Colour difference between A and B.
    Difference,
}

impl SlotLayout {
    /// All layouts.
    pub const ALL: [Self; 5] = [
        Self::Single,
        Self::Wipe,
        Self::SideBySide,
        Self::Flicker,
        Self::Difference,
    ];

    /// Name of the layout.
    pub fn name(self) -> &'static str {
        match self {
            Self::Single => "Single",
            Self::Wipe => "Wipe",
            Self::SideBySide => "Side by side",
            Self::Flicker => "Flicker",
            Self::Difference => "Difference",
        }
    }

    /// Slots to draw.
    pub fn sides(self) -> &'static [SlotSide] {
        match self {
            Self::Single => &[SlotSide::A],
            _ => &SlotSide::BOTH,
        }
    }
}
