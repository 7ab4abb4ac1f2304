//! The table: what is hard, and who is expected to manage it.

use cutaway::scene::Scene;

use super::table::{Case, Expected};
use super::{bumps, solids, windings};
use crate::common::{scenes, tolerances};

use Expected::{Band, Exact, Fails, Marked, Refuses, Share};

const MILD: Expected = Share(tolerances::PAPER_MILD);
const ROUGH: Expected = Share(tolerances::PAPER_ROUGH);

/// All cases that are judged by their picture alone.
pub(crate) const CASES: &[Case] = &[
    case(
        1,
        "cube through its middle",
        |_| vec![scenes::sectioned("cube", &["-z=0"])],
        Exact,
        Band,
    ),
    case(
        2,
        "plane in a face",
        solids::planes_in_faces,
        Exact,
        Fails("chi of an interpolated point is rounding where the face lies in the plane"),
    ),
    case(
        3,
        "plane through an edge, a vertex, a diagonal",
        solids::through_edges,
        Exact,
        Band,
    ),
    case(
        4,
        "rays through vertices and edges",
        |px| solids::aligned("cube?divisions=8", px),
        Exact,
        Band,
    ),
    case(
        5,
        "1000 needles meet at a pixel centre",
        |px| solids::aligned("slivers", px),
        Exact,
        Band,
    ),
    case(
        6,
        "needles and triangles without area",
        solids::degenerate,
        Exact,
        Band,
    ),
    case(
        10,
        "eye inside, kept side",
        solids::eye_inside,
        Exact,
        Fails("it has no cap at the near plane"),
    ),
    case(11, "eye in a void", solids::eye_in_void, Exact, Band),
    case(
        12,
        "near plane in the solid",
        solids::near_plane,
        Exact,
        Fails("it has no cap at the near plane"),
    ),
    case(
        14,
        "far away, tiny, huge",
        solids::far_tiny_huge,
        Exact,
        Band,
    ),
    case(
        15,
        "near to far as 1 to 100000",
        solids::near_and_far,
        Exact,
        Band,
    ),
    case(
        16,
        "hollow bumps::ball, inner sphere either way round",
        solids::hollow,
        Exact,
        Band,
    ),
    case(
        17,
        "two balls overlap in one mesh: by parity the lens is void",
        solids::overlapping,
        Exact,
        Band,
    ),
    case(
        19,
        "every face twice",
        |_| vec![solids::doubled()],
        Exact,
        Fails("peeling loses the second of two faces"),
    ),
    case(
        16,
        "hollow ball, nonzero",
        |px| windings::nonzero(solids::hollow(px)),
        Exact,
        Refuses("nonzero"),
    ),
    case(
        17,
        "overlapping balls, nonzero",
        |px| windings::nonzero(solids::overlapping(px)),
        Exact,
        Refuses("nonzero"),
    ),
    case(
        18,
        "solids that cross themselves",
        windings::self_crossing,
        Exact,
        ROUGH,
    ),
    case(
        18,
        "solids that cross themselves, nonzero",
        |px| windings::nonzero(windings::self_crossing(px)),
        Exact,
        Refuses("nonzero"),
    ),
    case(
        19,
        "every face twice, nonzero",
        |_| windings::nonzero(vec![solids::doubled()]),
        Exact,
        Refuses("nonzero"),
    ),
    case(
        20,
        "one triangle missing, nonzero",
        |px| windings::nonzero(solids::open(px)),
        Marked,
        Refuses("nonzero"),
    ),
    case(
        20,
        "one triangle missing",
        solids::open,
        Marked,
        Fails("a sprite cannot tell that it is open"),
    ),
    case(22, "flat map", bumps::flat, Exact, Band),
    case(23, "ramp and saddle", bumps::ramp_and_saddle, Exact, MILD),
    case(
        24,
        "rays along N, along U, along the plane",
        bumps::along_axes,
        Exact,
        ROUGH,
    ),
    case(
        25,
        "rays along texel borders",
        bumps::along_texels,
        Exact,
        ROUGH,
    ),
    case(26, "rays graze crests", bumps::grazing, Exact, ROUGH),
    case(
        28,
        "steps one texel wide, very high",
        bumps::plateaus,
        Exact,
        ROUGH,
    ),
    case(29, "wrap modes", bumps::wraps, Exact, MILD),
    case(31, "maps of odd sizes", bumps::odd_sizes, Exact, ROUGH),
    case(32, "cut almost along a face", bumps::tangent, Exact, MILD),
    case(37, "opposite signs", bumps::opposite, Exact, MILD),
    case(
        38,
        "two crossing surfaces, and, or",
        bumps::crossing,
        Exact,
        MILD,
    ),
    case(
        48,
        "U and V of different lengths",
        bumps::anisotropic,
        Exact,
        MILD,
    ),
];

const fn case(
    number: u32,
    name: &'static str,
    scenes: fn(u32) -> Vec<Scene>,
    mask: Expected,
    paper: Expected,
) -> Case {
    Case {
        number,
        name,
        scenes,
        mask,
        paper,
    }
}
