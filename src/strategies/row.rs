//! Rows of the strategy table: all facts about a cap surface or an inside test, in one place.
//!
//! A row is a `static` in the file that records its passes, and is listed in [`table`](super::table). Names, parameters, help texts,
//! refusals, the tables in the documentation and the hard cases are generated from it.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::Range;

use super::surface::tessellation::Tessellation;
use crate::effects::FrameOutput;
use crate::passes::{Crossings, Input, Refusal, SceneBuffers, Store, Unsupported, Volume};
use crate::plan::{CpuWork, Plan};

/// A parameter that follows the name of a row, as in `grid:256`.
#[derive(Clone, Copy, Debug)]
pub struct StrategyParameter {
    /// Placeholder in help texts.
    pub letter: &'static str,
    /// Description, with the unit.
    pub about: &'static str,
    /// Default value, in steps.
    pub usual: u32,
    /// Least value, in steps.
    pub least: u32,
    /// Greatest value, in steps.
    pub most: u32,
    /// Number of steps in 1.
    pub steps_per_unit: u32,
}

impl StrategyParameter {
    /// A value in steps, converted to a number.
    pub(super) fn number(&self, steps: u32) -> f64 {
        f64::from(steps) / f64::from(self.steps_per_unit)
    }

    /// A number in steps; `None` if it is out of range.
    fn steps(&self, number: f64) -> Option<u32> {
        let steps = number * f64::from(self.steps_per_unit);
        let is_whole = self.steps_per_unit > 1 || steps.fract() == 0.0;
        let range = f64::from(self.least)..=f64::from(self.most);
        (is_whole && range.contains(&steps)).then(|| steps.round() as u32)
    }
}

/// Features supported in addition to plane cuts through parts filled by parity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Abilities {
    /// Parts filled by the nonzero rule.
    pub nonzero: bool,
    /// Marking caps that several solids share.
    pub overlaps: bool,
    /// Cuts by closed meshes.
    pub cutters: bool,
    /// Reliefs.
    pub reliefs: bool,
    /// More than one clip-surface.
    pub surfaces: bool,
    /// Drawing by the compute rasteriser.
    pub compute: bool,
}

impl Abilities {
    /// All abilities.
    pub const ALL: Self = Self {
        nonzero: true,
        overlaps: true,
        cutters: true,
        reliefs: true,
        surfaces: true,
        compute: true,
    };

    /// Abilities that both have.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            nonzero: self.nonzero && other.nonzero,
            overlaps: self.overlaps && other.overlaps,
            cutters: self.cutters && other.cutters,
            reliefs: self.reliefs && other.reliefs,
            surfaces: self.surfaces && other.surfaces,
            compute: self.compute && other.compute,
        }
    }
}

/// Facts about a cap surface or an inside test.
#[derive(Debug)]
pub struct StrategyInfo {
    /// Its name.
    pub name: &'static str,
    /// Its parameter, if it has one.
    pub parameter: Option<StrategyParameter>,
    /// Description in one line.
    pub about: &'static str,
    /// Limitations in a few words; empty if there are none.
    pub limit: &'static str,
    /// Data rebuilt when a mesh changes; empty if none.
    pub rebuilds: &'static str,
    /// Features that it supports.
    pub can: Abilities,
    /// Methods for the hard-case pictures; each flag is true if the method is also used in large pictures.
    pub hard_cases: &'static [(&'static str, bool)],
}

impl StrategyInfo {
    /// Name, with a placeholder for the parameter: `kbuffer:K`.
    pub(super) fn pattern(&self) -> String {
        match &self.parameter {
            Some(parameter) => format!("{}:{}", self.name, parameter.letter),
            None => self.name.to_owned(),
        }
    }
}

/// A cap surface.
#[derive(Debug)]
pub struct CapSurfaceRow {
    /// Facts for reports and help.
    pub facts: StrategyInfo,
    /// Why it cannot read relief heights through a sampler; empty if it can, or draws no reliefs.
    pub(super) exact_heights: &'static str,
    /// The inside tests with which `all` combines it.
    pub(super) usual_tests: fn(&InsideTestRow) -> bool,
    /// How caps are produced.
    pub(crate) caps: Caps,
}

impl CapSurfaceRow {
    /// Returns true if it draws the whole frame and needs no inside test.
    pub(super) fn is_alone(&self) -> bool {
        matches!(self.caps, Caps::Alone(_))
    }
}

/// How caps are produced.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Caps {
    /// Crossings of each pixel's ray go into the per-pixel list, for every inside test.
    Rays(ListCrossings),
    /// Clip-surfaces become triangles: sheets in the per-pixel list, or drawn by the paper's rule if the inside test answers for points.
    Triangles(Tessellate),
    /// The cap surface draws the whole frame and needs no inside test.
    Alone(RecordAlone),
}

/// Records the passes that write the per-pixel list of crossings, with the given capacity, and that prepare every pixel for its first
/// fragment.
pub(super) type ListCrossings =
    fn(&mut Plan, &SceneBuffers<'_>, u32, &Store) -> Result<Crossings, Refusal>;

/// Records the clip-surfaces as triangles, planes only on request. The number is the parameter, in steps.
pub(super) type Tessellate =
    fn(&mut Plan, &SceneBuffers<'_>, u32, bool) -> Result<Tessellation, Refusal>;

/// Records the frame; returns the CPU work spent on it, as in [`Recorded`](crate::plan::Recorded).
pub(super) type RecordAlone =
    fn(&mut Plan, &Input<'_>) -> Result<(FrameOutput, Vec<CpuWork>), Refusal>;

/// An inside test.
#[derive(Debug)]
pub struct InsideTestRow {
    /// Facts for reports and help.
    pub facts: StrategyInfo,
    /// Kind of query that it answers.
    pub(crate) answers: InsideTestKind,
}

/// Kind of query that an inside test answers.
#[derive(Clone, Copy, Debug)]
pub(crate) enum InsideTestKind {
    /// The crossings of the camera's rays: it records the frame of a cap surface.
    Rays(RecordRays),
    /// Any points of a part: it records images of volumes.
    Points(RecordImages),
}

/// Records the frame of a cap surface that lists crossings. The number is the parameter, in steps.
pub(super) type RecordRays =
    fn(&mut Plan, &Input<'_>, CapSurface, u32) -> Result<FrameOutput, Refusal>;

/// Records images of all cut parts, each with the part-table indices that it covers. The number is the parameter, in steps.
pub(super) type RecordImages =
    fn(&mut Plan, &SceneBuffers<'_>, u32) -> Result<Vec<(Range<usize>, Volume)>, Refusal>;

/// A row of one of the two tables.
pub trait StrategyRow: fmt::Debug + 'static {
    /// Facts for reports and help.
    fn facts(&self) -> &StrategyInfo;
}

impl StrategyRow for CapSurfaceRow {
    fn facts(&self) -> &StrategyInfo {
        &self.facts
    }
}

impl StrategyRow for InsideTestRow {
    fn facts(&self) -> &StrategyInfo {
        &self.facts
    }
}

/// A row with its parameter value: compared by name and value.
#[derive(Debug)]
pub struct SelectedRow<R: StrategyRow> {
    row: &'static R,
    /// The parameter in steps; 0 if there is none.
    steps: u32,
}

/// A way to produce cap points per pixel.
pub type CapSurface = SelectedRow<CapSurfaceRow>;

/// A way to determine whether a point is inside a solid.
pub type InsideTest = SelectedRow<InsideTestRow>;

impl<R: StrategyRow> SelectedRow<R> {
    /// A row with its parameter in steps.
    pub(super) const fn new(row: &'static R, steps: u32) -> Self {
        Self { row, steps }
    }

    /// A row with its default parameter.
    pub(super) fn usual(row: &'static R) -> Self {
        let usual = row.facts().parameter.map_or(0, |p| p.usual);
        Self::new(row, usual)
    }

    /// A row with its parameter as a number; `None` if that is out of range.
    pub(super) fn with(row: &'static R, number: f64) -> Option<Self> {
        let steps = row.facts().parameter?.steps(number)?;
        Some(Self::new(row, steps))
    }

    pub fn row(&self) -> &'static R {
        self.row
    }

    /// Facts for reports and help.
    pub fn facts(&self) -> &'static StrategyInfo {
        self.row.facts()
    }

    /// The parameter in steps; 0 if the row has no parameter.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// The parameter; `None` if the row has no parameter.
    pub fn parameter(&self) -> Option<f64> {
        let parameter = self.facts().parameter?;
        Some(parameter.number(self.steps))
    }

    fn key(&self) -> (&'static str, u32) {
        (self.facts().name, self.steps)
    }
}

impl<R: StrategyRow> Clone for SelectedRow<R> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R: StrategyRow> Copy for SelectedRow<R> {}

impl<R: StrategyRow> PartialEq for SelectedRow<R> {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl<R: StrategyRow> Eq for SelectedRow<R> {}

impl<R: StrategyRow> PartialOrd for SelectedRow<R> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<R: StrategyRow> Ord for SelectedRow<R> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key().cmp(&other.key())
    }
}

impl<R: StrategyRow> Hash for SelectedRow<R> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key().hash(state);
    }
}

/// Refusal of a cap surface and an inside test that do not work together.
pub(super) fn unpaired(who: impl fmt::Display, what: &str) -> Refusal {
    Refusal::new(Unsupported::Pairing, format!("{who} {what}"))
}

impl<R: StrategyRow> fmt::Display for SelectedRow<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.facts().name)?;
        match self.parameter() {
            Some(number) => write!(f, ":{number}"),
            None => Ok(()),
        }
    }
}
