//! `--box` and `--wedge`: regions of the command line that one word says.

use clap::Args;

use super::sections::HEADING;
use crate::scene::{Block, Bounds, ClipSurface, Face, Up, Wedge};
use crate::{Error, Result};

#[derive(Args, Clone, Debug, Default)]
pub(super) struct RegionArgs {
    /// Removes a box: `MIN:MAX`, as `0,0,0:1,1,1` or `50%,50%,50%:` (open where a corner is left out). Repeatable
    #[arg(long = "box", value_name = "MIN:MAX", allow_hyphen_values = true, help_heading = HEADING)]
    boxes: Vec<String>,
    /// Removes a slice of pie: `AXIS:FROM:TO[@X,Y,Z]` in degrees counter-clockwise about the axis, from the next axis (x for z,
    /// y for x, z for y), as `z:0:90` or `-y:-30:200@0,50%,0`. Repeatable
    #[arg(long = "wedge", value_name = "SPEC", allow_hyphen_values = true, help_heading = HEADING)]
    wedges: Vec<String>,
}

/// A region as it is called, and as the union of intersections of removed sides that it is.
pub(super) type Named = (String, Vec<Vec<ClipSurface>>);

impl RegionArgs {
    /// Whether there is none.
    pub(super) fn is_empty(&self) -> bool {
        self.boxes.is_empty() && self.wedges.is_empty()
    }

    /// The regions, boxes first, with faces that are upright for an up axis.
    pub(super) fn read(&self, bounds: &Bounds, up: Up) -> Result<Vec<Named>> {
        let planes = |faces: Vec<Face>| faces.into_iter().map(|f| f.plane).collect();
        let hollow = |option: &str, text: &str| {
            let mend = "let the first end be less than the second";
            Error::input(format!("{option} {text}"), "it has no inside", mend)
        };
        let boxes = self.boxes.iter().map(|text| {
            let block = Block::parse(text, bounds)?;
            if block.is_empty() {
                return Err(hollow("--box", text));
            }
            let faces = block.faces(bounds.centre(), up);
            Ok((format!("box {text}"), vec![planes(faces)]))
        });
        let wedges = self.wedges.iter().map(|text| {
            let wedge = Wedge::parse(text, bounds)?;
            if wedge.is_empty() {
                return Err(hollow("--wedge", text));
            }
            let alternatives = wedge.alternatives(false, up).into_iter().map(planes);
            Ok((format!("wedge {text}"), alternatives.collect()))
        });
        boxes.chain(wedges).collect()
    }
}
