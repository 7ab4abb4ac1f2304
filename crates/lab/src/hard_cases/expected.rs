//! Expected results of a strategy in a case, and how the results found are compared with them.
//!
//! Bounds were found with 8 sub-pixel bits. With fewer bits, the exact reference decides fewer of the pixels along outlines,
//! which tessellations and depth images get wrong: on such an adapter, the number of wrong pixels may be below the lower bound.
//!
//! An expectation covers all pictures of a case. Each picture is judged by itself. If a failure is declared, some picture must be wrong; if
//! a refusal is declared, some must be refused. A declared failure that passes is a fault too: then the table is wrong and misleading.

use std::fmt;
use std::sync::Arc;

use cutaway::session::Outcome;
use cutaway::strategies::{Method, Unsupported};

use super::tolerances::RIM_SHARE;
use super::{Judged, Question, band};
use crate::compare::around;

/// Expected result of a strategy in a case.
#[derive(Clone, Debug, PartialEq)]
pub enum Expected {
    /// No decided pixel is wrong, a crack or odd.
    Exact,
    /// The mesh is open: exactly the odd pixels are marked, and no other pixel is wrong.
    Marked,
    /// As `Marked`, and there are at most this many unmarked wrong pixels per boundary pixel: a ray through two holes is not odd.
    Leaks(f64),
    /// The mesh is open: all wrong pixels are marked, and right pixels may be marked too.
    Doubted,
    /// Some picture overflows a buffer, with a reason that contains these words and all wrong pixels marked. The other pictures are exact.
    Overflows(Arc<str>),
    /// Each wrong cap pixel is as near to a mesh as the depth image's theoretical error allows; the cap surface is exact.
    Band,
    /// There are at most this many decided wrong pixels per boundary pixel.
    Share(f64),
    /// As `Share`; the text says why there are wrong pixels.
    Within(f64, Arc<str>),
    /// As `Share`, and no decided pixel is a back face, a crack or odd: for a tessellation that decides caps with one per-pixel list.
    Listed(f64),
    /// At least one picture is known to be wrong; the text gives the reason.
    Fails(Arc<str>),
    /// As `Fails`, with the minimum and maximum of decided wrong pixels per covered pixel over all pictures.
    FailsWithin(Arc<str>, f64, f64),
    /// All pictures are refused because of an unsupported feature.
    Refuses(Unsupported),
    /// Some pictures are refused because of an unsupported feature, and the others are exact.
    RefusesSome(Unsupported),
}

impl Expected {
    /// Why the result cannot be better, if a failure or a bound is declared.
    pub fn why(&self) -> Option<String> {
        let why = match self {
            Self::Exact | Self::Marked => return None,
            Self::Leaks(_) => "a ray that enters and leaves through holes is not odd",
            Self::Doubted => "it cannot tell which of the pixels it marks are right",
            Self::Overflows(_) => "its buffer is bounded",
            Self::Band => "a point is tested up to half a texel's diagonal away from its position",
            Self::Share(_) => "texels and the chord of its grid move what they draw",
            Self::Listed(_) => "the chord of its triangles moves what they draw",
            Self::Fails(why) | Self::FailsWithin(why, ..) | Self::Within(_, why) => why,
            Self::Refuses(unsupported) | Self::RefusesSome(unsupported) => {
                return Some(unsupported.to_string());
            }
        };
        Some(why.to_owned())
    }

    /// Fault of one picture.
    pub fn fault(&self, question: &Question, judged: &Judged, method: &Method) -> Option<String> {
        if let Self::Refuses(unsupported) | Self::RefusesSome(unsupported) = self {
            return match self {
                _ if matches!(&judged.outcome, Outcome::Refused(r) if r.unsupported == *unsupported) => {
                    None
                }
                Self::RefusesSome(_) => judged.fault_of_exact(),
                _ => Some(format!("outcome {:?}", judged.outcome)),
            };
        }
        if let (Self::Overflows(words), Outcome::Overflowed(reason)) = (self, &judged.outcome) {
            return match reason.contains(&**words) {
                true => unmarked_fault(judged),
                false => Some(format!("overflowed: {reason}")),
            };
        }
        if judged.outcome != Outcome::Complete {
            return Some(format!("outcome {:?}", judged.outcome));
        }
        match self {
            Self::Exact | Self::Overflows(_) => judged.fault_of_exact(),
            Self::Marked => mismarked_fault(judged).or_else(|| unmarked_fault(judged)),
            Self::Leaks(most) => mismarked_fault(judged).or_else(|| {
                let leaked = (judged.comparison.unmarked_wrong_px, "wrong and not marked");
                excess(question, leaked, *most)
            }),
            Self::Doubted => unmarked_fault(judged),
            Self::Band => band::fault(question, judged, method.strategy.resolution()?),
            Self::Share(most) | Self::Within(most, _) => share_fault(question, judged, *most),
            Self::Listed(most) => {
                list_fault(judged, 1).or_else(|| share_fault(question, judged, *most))
            }
            // Judged over all pictures of the case.
            Self::Fails(_) | Self::FailsWithin(..) | Self::Refuses(_) | Self::RefusesSome(_) => {
                None
            }
        }
    }
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exact => f.write_str("0 decided wrong, no crack, none odd"),
            Self::Marked => f.write_str("odd pixels marked, exactly those, and no other wrong"),
            Self::Leaks(most) => write!(
                f,
                "odd pixels marked, exactly those, and at most {most} other wrong per boundary pixel"
            ),
            Self::Doubted => f.write_str("all wrong pixels marked"),
            Self::Overflows(_) => f.write_str("overflow reported, and all wrong pixels marked"),
            Self::Band => f.write_str("wrong within reach of a texel alone"),
            Self::Share(most) | Self::Within(most, _) => {
                write!(f, "at most {most} wrong per boundary pixel")
            }
            Self::Listed(most) => write!(
                f,
                "no back face, no crack, at most {most} wrong per boundary pixel"
            ),
            Self::Fails(_) => f.write_str("fails"),
            Self::FailsWithin(_, least, most) => {
                write!(f, "fails, {least:.5} to {most:.5} wrong per covered pixel")
            }
            Self::Refuses(_) => f.write_str("refuses"),
            Self::RefusesSome(_) => f.write_str("refuses some pictures, the others exact"),
        }
    }
}

/// Fault if a pixel that is not odd is marked, or an odd pixel is not marked. A sample next to the rim of a hole, even a hidden rim, may
/// count either way: a few such pixels are accepted if a neighbouring pixel differs in whether it is odd.
fn mismarked_fault(judged: &Judged) -> Option<String> {
    let odd = &judged.exact.odd_parity;
    let is_rim = |i: usize| around(judged.layers.size_px, i, 1).any(|j| odd[j] != odd[i]);
    let differs =
        |i: &usize| judged.layers.pixels[*i].unreliable != odd[*i] && !judged.exact.undecided[*i];
    let (rim, away): (Vec<usize>, Vec<usize>) =
        (0..odd.len()).filter(differs).partition(|i| is_rim(*i));
    let allowed = (0..odd.len()).filter(|i| is_rim(*i)).count() as f64 * RIM_SHARE;
    (!away.is_empty() || rim.len() as f64 > allowed).then(|| {
        let (away, rim) = (away.len(), rim.len());
        format!("{away} pixels are marked that should not be, or the reverse, and {rim} along rims")
    })
}

/// Fault if a wrong pixel is not marked.
pub(super) fn unmarked_fault(judged: &Judged) -> Option<String> {
    let first = judged.first_unmarked_wrong()?;
    Some(format!("wrong and not marked: {}", judged.describe(first)))
}

fn share_fault(question: &Question, judged: &Judged, most: f64) -> Option<String> {
    let wrong = (judged.comparison.decided_wrong_px, "decided wrong");
    excess(question, wrong, most)
}

/// Fault if there are more than `most` of some pixels per boundary pixel, and one more.
fn excess(question: &Question, (px, what): (usize, &str), most: f64) -> Option<String> {
    let boundary = question.boundary_px();
    (px as f64 > most * boundary as f64 + 1.0)
        .then(|| format!("{px} {what} along {boundary} boundary pixels"))
}

/// Number of background pixels in a tessellation's frame that are not counted as a hole: a kept solid may be thinner than the
/// displacement of its cap, and vanish although exact has no background nearby. Seen in one pixel of scene 13 of the search from
/// seed 1, drawn by `adaptive:0.5+mask`, and in single pixels of thin wings of real meshes. Inner sides never show.
const REMNANT_PX: usize = 1;

/// Fault that no tessellation with one per-pixel list has. Background within `outline_px` of exact's background is a displaced outline.
pub(super) fn list_fault(judged: &Judged, outline_px: usize) -> Option<String> {
    let holes = judged.holes(outline_px);
    let counts = [
        (judged.back_faces(), 0, "back faces"),
        (holes, REMNANT_PX, "cracks"),
        (judged.comparison.odd_parity_px, 0, "odd pixels"),
    ];
    let found = counts.iter().find(|(count, most, _)| count > most)?;
    Some(format!("{} {}", found.0, found.2))
}

/// Totals over the pictures of a case.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Number of pictures.
    pub pictures: usize,
    /// Decided wrong pixels in all pictures.
    pub wrong_px: usize,
    /// Pixels that exact covers, in the pictures that were not refused.
    pub covered_px: usize,
    /// Pixels that exact covers and decides, in the pictures that were not refused.
    pub judged_px: usize,
    /// Undecided pixels, in the pictures that were not refused.
    pub undecided_px: usize,
    /// Number of refused pictures.
    pub refused: usize,
    /// Number of overflowed pictures.
    pub overflowed: usize,
    /// Side lengths of the strategy's usual pictures that were not drawn. If there are any, a result without wrong pixels may be luck,
    /// and does not show that a bound is unnecessary.
    pub unasked_px: Vec<u32>,
    /// True if some pictures were drawn with fewer sub-pixel bits than the 8 for which bounds were found.
    pub is_coarse: bool,
    /// Unexpected results, picture by picture.
    pub faults: Vec<String>,
}

impl Tally {
    /// Adds a picture.
    pub fn add(&mut self, judged: &Judged, name: &str, fault: Option<String>) {
        self.pictures += 1;
        self.wrong_px += judged.comparison.decided_wrong_px;
        let is_refused = matches!(judged.outcome, Outcome::Refused(_));
        self.refused += usize::from(is_refused);
        if !is_refused {
            self.covered_px += judged.exact.covered_px();
            self.judged_px += judged.exact.judged_px();
            self.undecided_px += judged.exact.undecided_px();
        }
        self.overflowed += usize::from(matches!(judged.outcome, Outcome::Overflowed(_)));
        self.is_coarse |= judged.precision.is_coarse();
        self.faults.extend(fault.map(|f| format!("{name}: {f}")));
    }

    /// Adds the pictures of another size.
    pub fn join(&mut self, other: Self) {
        self.pictures += other.pictures;
        self.wrong_px += other.wrong_px;
        self.covered_px += other.covered_px;
        self.judged_px += other.judged_px;
        self.undecided_px += other.undecided_px;
        self.unasked_px.retain(|px| other.unasked_px.contains(px));
        self.refused += other.refused;
        self.overflowed += other.overflowed;
        self.is_coarse |= other.is_coarse;
        self.faults.extend(other.faults);
    }

    /// Fault of a failure that is worse or better than declared.
    fn fault_of_failure(&self, least: f64, most: f64) -> Option<String> {
        let (wrong, covered) = (self.wrong_px, self.covered_px);
        let share = wrong as f64 / covered.max(1) as f64;
        let than = match share {
            s if s > most => "worse",
            s if s < least && wrong > 0 && !self.is_coarse => "better",
            _ => return None,
        };
        Some(format!(
            "fails {than} than declared: {wrong} wrong of {covered} covered pixels, {share:.5}"
        ))
    }

    /// Returns true if the results are worse than those of an exact strategy.
    pub fn is_short_of_exact(&self) -> bool {
        self.wrong_px > 0 || self.refused > 0 || self.overflowed > 0
    }

    /// All unexpected results: those of single pictures, and faults that were declared for the case but did not occur.
    pub fn faults_of(&self, expected: &Expected) -> Vec<String> {
        let mut faults = self.faults.clone();
        if let Expected::FailsWithin(_, least, most) = expected {
            faults.extend(self.fault_of_failure(*least, *most));
        }
        let stale = match expected {
            Expected::Fails(_) | Expected::FailsWithin(..)
                if !self.is_coarse && self.wrong_px == 0 =>
            {
                "is declared to fail and passes"
            }
            Expected::Share(_) | Expected::Within(..) | Expected::Listed(_)
                if !self.is_coarse && self.unasked_px.is_empty() && self.wrong_px == 0 =>
            {
                "is declared to be wrong, and is not"
            }
            Expected::Overflows(_) if self.overflowed == 0 => {
                "is declared to overflow and does not"
            }
            Expected::RefusesSome(_) if self.refused == 0 => "is declared to refuse and draws all",
            Expected::RefusesSome(_) if self.refused == self.pictures => {
                "is declared to draw some and refuses all"
            }
            _ => return faults,
        };
        faults.push(stale.to_owned());
        faults
    }

    /// The totals as text.
    pub fn describe(&self, expected: &Expected) -> String {
        let mut line = match self.refused == self.pictures {
            true => "refused".to_owned(),
            false => format!(
                "{} decided wrong of {} judged px, {} undecided, in {} pictures",
                self.wrong_px,
                self.judged_px,
                self.undecided_px,
                self.pictures - self.refused
            ),
        };
        if self.refused > 0 && self.refused < self.pictures {
            line += &format!(", {} refused", self.refused);
        }
        if self.overflowed > 0 {
            line += &format!(", {} overflowed", self.overflowed);
        }
        let faults = self.faults_of(expected);
        if let Some(first) = faults.first() {
            line += &format!("; {} not as expected, the first: {first}", faults.len());
        }
        line
    }
}
