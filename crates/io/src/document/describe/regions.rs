//! `box`, `wedge` and `cutout` of a cut.

use cutaway::scene::Amount;
use cutaway::scene::describe::{Described, Leaf, OrWord, ValueType, joined, words};
use glam::{DVec2, DVec3};

use super::ReliefUse;

/// Axis directions by name.
pub(crate) const AXES: [(&str, DVec3); 6] = [
    ("x", DVec3::X),
    ("y", DVec3::Y),
    ("z", DVec3::Z),
    ("-x", DVec3::NEG_X),
    ("-y", DVec3::NEG_Y),
    ("-z", DVec3::NEG_Z),
];
/// Names of the axis directions.
pub(super) const AXIS_NAMES: [&str; 6] = words(&AXES);
/// Words for the axis of a cutout.
const CUTOUT_AXES: [&str; 9] = joined(&["auto", "main", "symmetry"], &AXIS_NAMES);

/// A box as stored in a file.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct BoxDesc {
    /// Lower corner of the box; a box without one is unbounded below.
    #[value(unit = "units", example = ["50%", 0, 0])]
    pub(crate) min: Option<[Amount; 3]>,
    /// Upper corner of the box; a box without one is unbounded above.
    #[value(unit = "units", example = ["100%", 1, 1])]
    pub(crate) max: Option<[Amount; 3]>,
    /// Centre of the box, used with `size` instead of corners.
    #[value(unit = "units", example = [0, 0, 0])]
    pub(crate) centre: Option<[Amount; 3]>,
    /// Side lengths.
    #[value(takes = ValueType::OneOrMore(&Amount::TYPE, 3), unit = "units", example = 0.5)]
    pub(crate) size: Option<[Amount; 3]>,
    /// Relief on the box.
    #[value(flat)]
    pub(crate) ruffle: ReliefUse,
    /// Faces that have the relief, named -x, +x, -y, +y, -z and +z.
    #[value(example = ["+z"])]
    pub(crate) faces: Vec<String>,
}

/// A wedge as stored in a file.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct WedgeDesc {
    /// Axis of the wedge.
    #[value(words = AXIS_NAMES, example = [0, 0, 1])]
    pub(crate) axis: Option<OrWord<DVec3>>,
    /// Point on the axis, by default the middle of the model.
    #[value(unit = "units", example = ["50%", "50%", 0])]
    pub(crate) origin: Option<[Amount; 3]>,
    /// Start angle, counter-clockwise from the axis that follows the wedge's axis.
    #[value(unit = "degrees", example = 0)]
    pub(crate) from_deg: Option<f64>,
    /// End angle, at most 360 degrees more than the start angle.
    #[value(unit = "degrees", example = 90)]
    pub(crate) to_deg: Option<f64>,
    /// Smallest coordinate along the axis.
    #[value(unit = "units", example = "10%")]
    pub(crate) min: Option<Amount>,
    /// Largest coordinate along the axis.
    #[value(unit = "units", example = "90%")]
    pub(crate) max: Option<Amount>,
    /// Relief on the wedge.
    #[value(flat)]
    pub(crate) ruffle: ReliefUse,
    /// Faces that have the relief, named from, to, min and max.
    #[value(example = ["from"])]
    pub(crate) faces: Vec<String>,
}

/// A cutout as stored in a file.
#[derive(Clone, Debug, PartialEq, Described)]
pub(crate) struct CutoutDesc {
    /// Axis of the wedge: a direction, or one found from the faces: automatic, their principal axis of inertia or their axis of symmetry.
    #[value(words = CUTOUT_AXES, fixed, example = "auto")]
    pub(crate) axis: Option<OrWord<DVec3>>,
    /// Angle between the two faces, less than a full turn because that would remove everything.
    #[value(range = 0.0..=359.0, unit = "degrees", example = 110)]
    pub(crate) angle_deg: f64,
    /// Rotation of the opening relative to the first camera; with `fixed`, relative to the second axis.
    #[value(unit = "degrees", example = 0)]
    pub(crate) turn_deg: f64,
    /// Keeps the cutout in place when the camera moves.
    #[value(example = true)]
    pub(crate) fixed: bool,
    /// Translation along the second and third axes.
    #[value(unit = "units", example = [0, 0])]
    pub(crate) offset: DVec2,
    /// Relief on the cutout.
    #[value(flat)]
    pub(crate) ruffle: ReliefUse,
    /// Faces that have the relief, named from and to.
    #[value(example = ["from"])]
    pub(crate) faces: Vec<String>,
}

impl Default for CutoutDesc {
    fn default() -> Self {
        Self {
            axis: None,
            // Diepstraten, Weiskopf and Ertl 2003.
            angle_deg: 110.0,
            turn_deg: 0.0,
            fixed: false,
            offset: DVec2::ZERO,
            ruffle: ReliefUse::default(),
            faces: Vec::new(),
        }
    }
}
