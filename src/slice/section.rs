//! Section of a mesh by a plane: points, loops, triangles and defects.

use glam::{DVec2, DVec3};

/// The section of a mesh by a plane. Points are coordinates along `Û` and `V̂` relative to the plane's `zero`, in input units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// All points, no two equal. Points at which loops cross come after the points of the loops.
    pub points: Vec<DVec2>,
    /// Closed curves. Loops may nest, touch, cross and repeat; the fill rule of the section decides what they enclose.
    pub loops: Vec<Loop>,
    /// Curves that end where the mesh is open. They bound nothing.
    pub open: Vec<Vec<u32>>,
    /// The region that the loops enclose, counter-clockwise seen from the kept side, without overlap.
    pub triangles: Vec<[u32; 3]>,
    /// Outline of the region: edges of `triangles` with the region only on their left, in no particular order.
    pub boundary: Vec<[u32; 2]>,
    /// Straight lines of `boundary` that complete the outline where the mesh is open ([`Slicer::section_by_winding`]).
    ///
    /// [`Slicer::section_by_winding`]: super::Slicer::section_by_winding
    pub bridges: Vec<[u32; 2]>,
    /// Defects of the mesh that make the section unreliable.
    pub defects: Vec<SectionDefect>,
}

/// A closed curve. If the mesh's triangles face outward, it has the solid on its left, seen from the kept side: outlines run
/// counter-clockwise, holes clockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loop {
    /// Indices of at least three points, of which consecutive ones differ; the last point connects to the first.
    pub points: Vec<u32>,
}

/// A defect of a section that its user should know about.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SectionDefect {
    /// The plane is invalid.
    #[error("the plane has an origin that is not finite or directions that are not of length 1")]
    Plane,
    /// Triangles that cannot be used in computations.
    #[error(
        "{triangles} triangles have missing corners or coordinates beyond 1e300 and are left out"
    )]
    Unusable {
        /// Number of such triangles in the whole mesh.
        triangles: usize,
    },
    /// The mesh is open at the plane.
    #[error(
        "the mesh is open: {chains} curves of the section do not close, one ends at {at}; they bound no cap"
    )]
    Open {
        /// Number of curves.
        chains: usize,
        /// An end of one of the curves.
        at: DVec3,
    },
    /// The mesh is open at the plane, and its winding numbers decide what is inside.
    #[error(
        "the mesh is open: straight lines complete the outline where its winding number passes a half ({lines} of length {length:.4} in \
        all, one ends at {at})"
    )]
    Bridged {
        /// Number of lines.
        lines: usize,
        /// Their length in all.
        length: f64,
        /// An end of one of the lines.
        at: DVec3,
    },
    /// Neighbouring triangles with opposite orientation: the *nonzero* rule has to guess which of them are wrong.
    #[error("{pieces} pieces of the outline face the other way from the rest of their loops")]
    Turned {
        /// Number of pieces.
        pieces: usize,
    },
    /// The mesh intersects itself.
    #[error(
        "the outline crosses itself {crossings} times, for example at {at}; the fill rule decides"
    )]
    Crossing {
        /// Points at which loops were cut.
        crossings: usize,
        /// One of the points.
        at: DVec3,
    },
    /// Loops that f64 cannot separate from other loops, or that cross other loops too often.
    #[error(
        "{loops} loops cross other loops too often, or lie too close to them, one at {at}, and are not capped"
    )]
    LeftOut {
        /// Number of loops.
        loops: usize,
        /// A point of one of the loops.
        at: DVec3,
    },
}

impl SectionDefect {
    /// Advice on how to repair the defect.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Plane => "give the plane a finite origin and a finite normal",
            Self::Unusable { .. } => "use a mesh with coordinates within 1e300, or scale it down",
            Self::Open { .. } => {
                "close the mesh there (`cutaway inspect` says where it is open), or move the section"
            }
            Self::Bridged { .. } => {
                "look at the lines; `--close-holes` closes the mesh where that is unambiguous"
            }
            Self::Turned { .. } => "turn the faces, or fill by even-odd, which ignores orientation",
            Self::Crossing { .. } | Self::LeftOut { .. } => {
                "remove the mesh's self-intersections, or move the section"
            }
        }
    }

    /// Returns true if some of the solid may lack a cap, or have one where it should not.
    pub fn loses_cap(&self) -> bool {
        !matches!(
            self,
            Self::Bridged { .. } | Self::Turned { .. } | Self::Crossing { .. }
        )
    }
}

impl Section {
    /// Returns true if everything that the plane meets has a cap.
    pub fn is_whole(&self) -> bool {
        !self.defects.iter().any(SectionDefect::loses_cap)
    }

    /// Returns true if the plane meets nothing of the mesh except open ends.
    pub fn is_empty(&self) -> bool {
        self.loops.is_empty() && self.open.is_empty()
    }

    /// Area of the region, in square units: the shoelace sum over `boundary`, which equals the area of `triangles`.
    pub fn area(&self) -> f64 {
        let edges = self.boundary.iter();
        self.shoelace(edges.map(|e| e.map(|i| self.points[i as usize])))
    }

    /// What bridges make of the section, if there are any; `in_space` locates a point of the plane.
    pub(super) fn bridged(&self, in_space: impl Fn(DVec2) -> DVec3) -> Option<SectionDefect> {
        let ends = |line: &[u32; 2]| line.map(|i| self.points[i as usize]);
        let [at, _] = self.bridges.first().map(ends)?;
        let lengths = self.bridges.iter().map(ends).map(|[a, b]| a.distance(b));
        Some(SectionDefect::Bridged {
            lines: self.bridges.len(),
            length: sum(lengths),
            at: in_space(at),
        })
    }

    /// Length of the region's outline, in units. Coincident loops that cancel have none.
    pub fn perimeter(&self) -> f64 {
        let lengths = self.boundary.iter().map(|e| {
            let [a, b] = e.map(|i| self.points[i as usize]);
            a.distance(b)
        });
        sum(lengths)
    }

    /// Signed area within a loop, counter-clockwise positive, where each point counts as often as the loop winds around it.
    pub fn loop_area(&self, one: &Loop) -> f64 {
        self.ring_area(&one.points)
    }

    /// [`Section::loop_area`] of a ring of points.
    pub(super) fn ring_area(&self, ring: &[u32]) -> f64 {
        let next = ring.iter().cycle().skip(1);
        let edges = ring.iter().zip(next);
        self.shoelace(edges.map(|(a, b)| [*a, *b].map(|i| self.points[i as usize])))
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [DVec2; 3] {
        self.triangles[triangle].map(|i| self.points[i as usize])
    }

    /// Shoelace sum over closed curves, relative to a point near them, because terms around a far origin would cancel. Scaled so that no
    /// term overflows.
    fn shoelace(&self, edges: impl Iterator<Item = [DVec2; 2]>) -> f64 {
        let size = self.points.iter().map(|p| p.abs().max_element());
        let unit = power_of_two_near(size.fold(0.0, f64::max));
        let mut edges = edges.map(|e| e.map(|p| p / unit)).peekable();
        let centre = edges.peek().map_or(DVec2::ZERO, |e| e[0]);
        let terms = edges.map(|[a, b]| (a - centre).perp_dot(b - centre));
        0.5 * sum(terms) * unit * unit
    }
}

/// A power of two that scales coordinates up to `size` to about 1, or as near to that as a factor can.
pub(super) fn power_of_two_near(size: f64) -> f64 {
    let exponent = if size > 0.0 { size.log2().ceil() } else { 0.0 };
    exponent.clamp(-1000.0, 1000.0).exp2()
}

/// Compensated sum that recovers the rounding error of each addition (Neumaier 1974).
fn sum(terms: impl Iterator<Item = f64>) -> f64 {
    let (sum, lost) = terms.fold((0.0_f64, 0.0), |(sum, lost), term| {
        let next = sum + term;
        let rest = if sum.abs() >= term.abs() {
            (sum - next) + term
        } else {
            (term - next) + sum
        };
        (next, lost + rest)
    });
    sum + lost
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_open_is_to_be_closed() {
        let at = DVec3::ZERO;
        for (defect, closes) in [
            (SectionDefect::Open { chains: 1, at }, true),
            (SectionDefect::LeftOut { loops: 1, at }, false),
            (SectionDefect::Unusable { triangles: 1 }, false),
            (SectionDefect::Plane, false),
        ] {
            assert!(defect.loses_cap(), "{defect}");
            let says_so = defect.help().contains("close the mesh");
            assert_eq!(says_so, closes, "{defect}");
        }
    }

    #[test]
    fn small_terms_are_not_lost_beside_large_ones() {
        let terms = || [1e17, 1.0, 3.0, -1e17, -3.0].into_iter();
        assert_eq!(sum(terms()), 1.0, "by compensation");
        assert_ne!(terms().sum::<f64>(), 1.0, "f64 alone would do");
    }
}
