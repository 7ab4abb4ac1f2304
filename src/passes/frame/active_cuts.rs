//! Per-part cut culling: which cuts can affect which part. The minimal plan follows from it.
//!
//! A cut does not affect a part whose box lies wholly on the kept side of one of its clip-surfaces; a part whose box lies
//! wholly in the removed region is not drawn. Only the remaining parts need an inside test. The box is conservative: a part may
//! be classified as cut although only its box is.

use super::refusal::{Refusal, Unsupported};
use crate::plan::pack::{MAX_CUTS, MAX_SURFACES};
use crate::scene::{Bounds, Prepared, PreparedPart, PreparedSurface, View};

/// Number of parts that a layer's 16 bits can number.
const MOST_PARTS: usize = 1 << 16;
/// Number of clip-surfaces that a layer's 8 bits can number in addition to the near plane.
const MOST_NAMED_SURFACES: usize = 255;
/// Distance from an origin, in texels, up to which f32 has two bits left for the position within a texel.
const MOST_TEXELS: f64 = (1 << 22) as f64;
/// Largest product of relief height and texels per unit. Its square, a term of a crossing's discriminant, must fit an f32.
const STEEPEST: f64 = 1e18;

/// Draw mode of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartDrawMode {
    /// No cut reaches it.
    Plain,
    /// A cut removes the whole part.
    Removed,
    /// These cuts (bits of [`ActiveCuts::cuts`]) may remove some of the part, which therefore needs an inside test. If no bit is set, only
    /// the near plane opens it.
    Cut(u32),
}

/// The cuts that can affect a frame, and how each part is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct ActiveCuts {
    /// Scene numbers of the clip-surfaces that these cuts use.
    pub surfaces: Vec<usize>,
    /// One bit set per cut; its bits are indices into `surfaces`.
    pub cuts: Vec<u32>,
    /// Draw mode of each part, indexed by rank.
    pub parts: Vec<PartDrawMode>,
    /// Ranks in the order of the part table: first the parts that need an inside test, then the others, each sorted by rank.
    pub order: Vec<usize>,
    /// Position of each part in `order`, indexed by rank.
    places: Vec<usize>,
    /// Number of parts that need an inside test.
    pub lanes: usize,
    /// True if the near plane meets a part that needs an inside test.
    pub near_inside: bool,
    /// Box around the parts that cuts reach; if cuts reach no part, box around the parts that the near plane opens.
    pub cut_box: Bounds,
}

/// A box that comes closer than this to a clip-surface counts as crossed by it: the crossing list then decides.
const TOUCHING: f64 = 1e-5;

/// Side of a clip-surface that a box lies on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum BoxSide {
    Kept,
    Removed,
    Across,
}

impl ActiveCuts {
    /// The cuts that affect a view of a scene; returns the reason if a frame cannot number all parts, cuts or clip-surfaces.
    pub fn new(prepared: &Prepared, view: &View) -> Result<Self, Refusal> {
        if prepared.parts.len() > MOST_PARTS {
            return Err(Refusal::amount(format!(
                "{} parts are more than the {MOST_PARTS} that layers can number",
                prepared.parts.len()
            )));
        }
        let mut surfaces: Vec<usize> = Vec::new();
        let mut cuts: Vec<(usize, u32)> = Vec::new();
        let mut parts = Vec::with_capacity(prepared.parts.len());
        for part in &prepared.parts {
            if part.is_hidden || part.is_removed {
                parts.push(PartDrawMode::Removed);
                continue;
            }
            // A cut that removes the whole part comes first: the part's other cuts do not matter then.
            let reached: Vec<(usize, bool)> = (part.cuts.iter())
                .filter_map(|cut| Some((*cut, removes_all(prepared, *cut, part)?)))
                .collect();
            if reached.iter().any(|(_, all)| *all) {
                parts.push(PartDrawMode::Removed);
                continue;
            }
            let mut bits = 0_u32;
            for (cut, _) in &reached {
                let numbers = &prepared.cuts[*cut].surfaces;
                let index = match cuts.iter().position(|(c, _)| c == cut) {
                    Some(index) => index,
                    None => {
                        let first = surfaces.len();
                        surfaces.extend(numbers);
                        if surfaces.len() > MAX_SURFACES || cuts.len() == MAX_CUTS {
                            return Err(Refusal::new(
                                Unsupported::Cuts,
                                format!(
                                    "more than {MAX_SURFACES} clip-surfaces or {MAX_CUTS} cuts meet the parts"
                                ),
                            ));
                        }
                        cuts.push((*cut, (first..surfaces.len()).fold(0, |b, i| b | 1 << i)));
                        cuts.len() - 1
                    }
                };
                bits |= 1 << index;
            }
            let near = view.near_cap && view.near_plane_meets(&part.bounds);
            parts.push(match bits {
                0 if !near => PartDrawMode::Plain,
                bits => PartDrawMode::Cut(bits),
            });
        }
        let of_kind = |wanted: fn(&PartDrawMode) -> bool| {
            parts
                .iter()
                .enumerate()
                .filter(move |(_, t)| wanted(t))
                .map(|(i, _)| i)
                .collect::<Vec<_>>()
        };
        let mut order = of_kind(|t| matches!(t, PartDrawMode::Cut(_)));
        let lanes = order.len();
        order.extend(of_kind(|t| *t == PartDrawMode::Plain));
        // If any cut is active, a part opened only by the near plane uses no crossings. That part must not enlarge the box, because values
        // derived from the box would then change with the camera.
        let asks = |i: &&usize| surfaces.is_empty() || parts[**i] != PartDrawMode::Cut(0);
        let cut_box = (order[..lanes].iter().filter(asks))
            .map(|i| prepared.parts[*i].bounds)
            .fold(Bounds::EMPTY, Bounds::union);
        let near_inside = order[..lanes]
            .iter()
            .any(|i| view.near_plane_meets(&prepared.parts[*i].bounds));
        for number in &surfaces {
            if let Some(reason) = beyond_words(*number, &prepared.surfaces[*number], &cut_box) {
                return Err(Refusal::amount(reason));
            }
        }
        let mut places = vec![0; parts.len()];
        for (place, rank) in order.iter().enumerate() {
            places[*rank] = place;
        }
        Ok(Self {
            surfaces,
            cuts: cuts.into_iter().map(|(_, bits)| bits).collect(),
            parts,
            order,
            places,
            lanes,
            near_inside,
            cut_box,
        })
    }

    /// Bits of the cuts that reach the part with the given rank.
    pub fn cuts_of(&self, rank: usize) -> u32 {
        match self.parts[rank] {
            PartDrawMode::Cut(bits) => bits,
            PartDrawMode::Plain | PartDrawMode::Removed => 0,
        }
    }

    /// Table indices of the clip-surfaces whose cuts reach the part with the given rank.
    pub fn surfaces_of(&self, rank: usize) -> impl Iterator<Item = usize> {
        let cuts = self.cuts_of(rank);
        let bits = (self.cuts.iter().enumerate())
            .filter(|(cut, _)| cuts >> cut & 1 == 1)
            .fold(0, |bits, (_, of_cut)| bits | of_cut);
        (0..self.surfaces.len()).filter(move |slot| bits >> slot & 1 == 1)
    }

    /// For each part, by its index in the scene: the bits of the cuts that reach it, and whether a cut removes the whole part.
    pub(crate) fn clips_of_parts(&self, prepared: &Prepared) -> Vec<(u32, bool)> {
        let mut clips = vec![(0, false); prepared.parts.len()];
        for (rank, part) in prepared.parts.iter().enumerate() {
            let is_removed = self.parts[rank] == PartDrawMode::Removed;
            clips[part.part] = (self.cuts_of(rank), is_removed);
        }
        clips
    }

    /// Ranks of the parts that need an inside test, in table order.
    pub fn cut_parts(&self) -> &[usize] {
        &self.order[..self.lanes]
    }

    /// Ranks of the parts that are drawn plainly, in table order.
    pub fn plain_parts(&self) -> &[usize] {
        &self.order[self.lanes..]
    }

    /// Ranks of the parts that a cut removes completely.
    pub fn removed_parts(&self) -> impl Iterator<Item = usize> {
        let parts = self.parts.iter().enumerate();
        parts
            .filter(|(_, t)| **t == PartDrawMode::Removed)
            .map(|(rank, _)| rank)
    }

    /// Position in the part table of the part with the given rank; 0 for parts that are not drawn.
    pub fn place_of(&self, rank: usize) -> usize {
        self.places[rank]
    }
}

/// Reason why a clip-surface exceeds what a frame's words can hold, if it does.
fn beyond_words(number: usize, surface: &PreparedSurface, cut_box: &Bounds) -> Option<String> {
    if number >= MOST_NAMED_SURFACES {
        return Some(format!(
            "clip-surface {number} meets the parts, but layers can name only the first {MOST_NAMED_SURFACES}"
        ));
    }
    let map = surface.relief.as_ref()?;
    if surface.flat_height().is_some() {
        return None;
    }
    let axes = [surface.frame.u_hat, surface.frame.v_hat];
    let mut steepest = 1.0_f64;
    for (i, axis) in axes.into_iter().enumerate() {
        let per_unit = surface.map_per_unit[i].abs() * f64::from(map.size()[i]);
        let reach = cut_box
            .corners()
            .map(|c| ((c - surface.origin).dot(axis) * per_unit).abs())
            .into_iter()
            .fold(0.0, f64::max);
        if reach > MOST_TEXELS {
            return Some(format!(
                "the relief of clip-surface {number} reaches {reach:.1e} texels across the parts; f32 distinguishes \
                 at most {MOST_TEXELS:.1e}"
            ));
        }
        steepest = steepest.max(per_unit);
    }
    let [low, high] = surface.slab();
    let height = low.abs().max(high.abs());
    (height * steepest > STEEPEST).then(|| {
        format!(
            "the relief of clip-surface {number} is {height:.1e} high, more than f32 can square"
        )
    })
}

/// Returns whether a cut removes the whole box of a part; `None` if the cut does not reach it.
fn removes_all(prepared: &Prepared, cut: usize, part: &PreparedPart) -> Option<bool> {
    // Faces that count as lying in a surface may be this far off it.
    let touching = TOUCHING.max(part.plane_tolerance);
    let sides: Vec<BoxSide> = (prepared.cuts[cut].surfaces.iter())
        .map(|s| side_of(&prepared.surfaces[*s], &part.bounds, touching))
        .collect();
    (!sides.contains(&BoxSide::Kept)).then(|| sides.iter().all(|s| *s == BoxSide::Removed))
}

fn side_of(surface: &PreparedSurface, bounds: &Bounds, touching: f64) -> BoxSide {
    if let Some(volume) = &surface.volume {
        // A box that misses the cutter's box is outside the cutter; any other box is undecided.
        let apart = (volume.bounds.min - bounds.max).max_element() > touching
            || (bounds.min - volume.bounds.max).max_element() > touching;
        return match (apart, volume.keeps_inside) {
            (false, _) => BoxSide::Across,
            (true, false) => BoxSide::Kept,
            (true, true) => BoxSide::Removed,
        };
    }
    let [low, high] = surface.heights_of(bounds);
    let [lowest, highest] = surface.slab();
    if low + lowest > touching {
        BoxSide::Kept
    } else if high + highest < -touching {
        BoxSide::Removed
    } else {
        BoxSide::Across
    }
}
