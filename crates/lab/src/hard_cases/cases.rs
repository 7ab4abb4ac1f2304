//! The table: what is hard, and who is expected to manage it. Here are the cases of the list; `user_cases` has those that users met.

use cutaway::scene::Scene;
use cutaway::strategies::Obstacle;

use super::case::Form::{self, FlatReliefs, Plane, Reliefs};
use super::case::{Case, Keeps};
use super::expected::Expected::{self, Band, Exact, Fails, Listed, Marked, Refuses, Share};
use super::user_cases::OF_USERS;
use super::{bumps, scenes, solids, tolerances, users, windings};

/// What the chord of a grid is wrong by, from the most that was found in one picture of 64 or 256 px, per boundary pixel.
pub(super) const fn chord(found: f64) -> Expected {
    Share(found * tolerances::FACTOR)
}

/// The same of a tessellation by one list.
const fn chord_by_list(found: f64) -> Expected {
    Listed(found * tolerances::FACTOR)
}

/// Why sprites draw open meshes wrong.
pub(super) const UNTOLD: Expected = Fails("a sprite cannot tell that a mesh is open");

/// Why the paper's rule is wrong where a face lies in the plane.
pub(super) const IN_FACE: Expected =
    Fails("chi of an interpolated point is rounding where the face lies in the plane");

/// Why sections differ from parity where a mesh is open beside the plane.
pub(super) const CLOSED: Expected =
    Fails("its section closes and is capped, whatever slips through a hole elsewhere");

/// All cases that are judged by their pictures.
pub fn cases() -> impl Iterator<Item = &'static Case> {
    NUMBERED.iter().chain(OF_USERS)
}

/// Who caps no near plane says so.
const NEAR_PLANE_MEETS: &[(&str, Expected)] = &[
    ("planar*", Refuses(Obstacle::NearPlane)),
    ("stencil", Refuses(Obstacle::NearPlane)),
];

const PEELED: Expected = Fails("peeling loses the second of two faces");

const NUMBERED: &[Case] = &[
    case(
        "1",
        "cube through its middle",
        |_| vec![scenes::sectioned("cube", &["-z=0"])],
        Plane,
        Exact,
        Band,
    ),
    case(
        "2",
        "plane in a face",
        solids::planes_in_faces,
        Plane,
        Exact,
        Band,
    ),
    case(
        "3",
        "plane through an edge, a vertex, a diagonal",
        solids::through_edges,
        Plane,
        Exact,
        Band,
    ),
    case(
        "4",
        "rays through vertices and edges",
        |px| solids::aligned("cube?divisions=8", px),
        Plane,
        Exact,
        Band,
    ),
    case(
        "5",
        "1000 needles meet at a pixel centre",
        |px| solids::aligned("slivers", px),
        Plane,
        Exact,
        Band,
    ),
    case(
        "6",
        "needles and triangles without area",
        solids::degenerate,
        Plane,
        Exact,
        Band,
    ),
    case(
        "10",
        "eye inside, kept side",
        solids::eye_inside,
        Plane,
        Exact,
        Band,
    )
    .but(NEAR_PLANE_MEETS),
    case(
        "11",
        "eye in a void",
        solids::eye_in_void,
        Plane,
        Exact,
        Band,
    )
    .but(NEAR_PLANE_MEETS),
    case(
        "12",
        "near plane in the solid",
        solids::near_plane,
        Plane,
        Exact,
        Band,
    )
    .but(NEAR_PLANE_MEETS),
    case(
        "13",
        "a solid that goes on behind every far plane",
        users::far_plane,
        Plane,
        Exact,
        Band,
    ),
    case(
        "14",
        "far away, tiny, huge",
        solids::far_tiny_huge,
        Plane,
        Exact,
        Band,
    ),
    case(
        "15",
        "near to far as 1 to 100000",
        solids::near_and_far,
        Plane,
        Exact,
        Band,
    ),
    case(
        "16",
        "hollow ball, inner sphere either way round",
        solids::hollow,
        Plane,
        Exact,
        Band,
    ),
    case(
        "16",
        "hollow ball, nonzero",
        |px| windings::nonzero(solids::hollow(px)),
        Plane,
        Exact,
        Refuses(Obstacle::Nonzero),
    ),
    case(
        "17",
        "two balls overlap in one mesh: by parity the lens is void",
        solids::overlapping,
        Plane,
        Exact,
        Band,
    ),
    case(
        "17",
        "overlapping balls, nonzero",
        |px| windings::nonzero(solids::overlapping(px)),
        Plane,
        Exact,
        Refuses(Obstacle::Nonzero),
    ),
    case(
        "18",
        "solids that cross themselves",
        windings::self_crossing,
        Plane,
        Exact,
        chord(0.0461),
    ),
    case(
        "18",
        "solids that cross themselves, nonzero",
        |px| windings::nonzero(windings::self_crossing(px)),
        Plane,
        Exact,
        Refuses(Obstacle::Nonzero),
    ),
    case(
        "19",
        "every face twice",
        |_| vec![solids::doubled()],
        Plane,
        Exact,
        PEELED,
    )
    .but(&[("raycast+vds*", PEELED), ("grid*+ldi*", Band)]),
    case(
        "19",
        "every face twice, nonzero",
        |_| windings::nonzero(vec![solids::doubled()]),
        Plane,
        Exact,
        Refuses(Obstacle::Nonzero),
    ),
    case(
        "20",
        "one triangle missing, nonzero",
        |px| windings::nonzero(solids::open(px)),
        Plane,
        Marked,
        Refuses(Obstacle::Nonzero),
    )
    .but(&[("planar*", CLOSED)]),
    case(
        "20",
        "one triangle missing",
        solids::open,
        Plane,
        Marked,
        Fails("a sprite cannot tell that it is open"),
    )
    .but(&[("planar*", CLOSED)]),
    case(
        "21",
        "edges split on one side",
        users::t_junctions,
        Plane,
        Marked,
        UNTOLD,
    ),
    case("22", "flat map", bumps::flat, Plane, Exact, Band),
    case(
        "23",
        "ramp and saddle",
        bumps::ramp_and_saddle,
        Reliefs,
        Exact,
        chord(0.0244),
    ),
    case(
        "24",
        "rays along N, along U, along the plane",
        bumps::along_axes,
        Reliefs,
        Exact,
        chord(0.0403),
    ),
    case(
        "25",
        "rays along texel borders",
        bumps::along_texels,
        Reliefs,
        Exact,
        chord(0.0303),
    )
    .but(&[("grid*+mask", Exact)]),
    case(
        "26",
        "rays graze crests",
        bumps::grazing,
        Reliefs,
        Exact,
        chord(0.198),
    ),
    case(
        "28",
        "steps one texel wide, very high",
        bumps::plateaus,
        Reliefs,
        Exact,
        chord(0.00886),
    )
    .but(&[
        ("adaptive*", Exact),
        ("grid*+mask", Exact),
        ("grid*+ldi*", Exact),
    ]),
    case(
        "29",
        "wrap modes",
        bumps::wraps,
        Reliefs,
        Exact,
        chord(0.0319),
    )
    .but(&[("grid*+mask", Exact)]),
    case(
        "31",
        "maps of odd sizes",
        bumps::odd_sizes,
        FlatReliefs,
        Exact,
        chord(0.114),
    ),
    case(
        "32",
        "cut almost along a face",
        bumps::tangent,
        Reliefs,
        Exact,
        Fails("the chord of its grid over the sine of the angle opens a gap"),
    )
    .but(&[
        ("adaptive*", chord_by_list(0.203)),
        ("grid*+mask", chord_by_list(0.116)),
    ]),
    case(
        "37",
        "opposite signs",
        bumps::opposite,
        Reliefs,
        Exact,
        chord(0.0339),
    )
    .but(&[("grid*+mask", Exact), ("grid*+ldi*", Exact)]),
    case(
        "38",
        "two crossing surfaces, and, or",
        bumps::crossing,
        Reliefs,
        Exact,
        chord(0.0382),
    )
    .but(&[("grid*+mask", Exact), ("grid*+ldi*", Exact)]),
    case(
        "48",
        "U and V of different lengths",
        bumps::anisotropic,
        Reliefs,
        Exact,
        chord(0.0225),
    )
    .but(&[("grid*+ldi*", Exact)]),
];

pub(super) const fn case(
    id: &'static str,
    name: &'static str,
    scenes: fn(u32) -> Vec<Scene>,
    form: Form,
    exact: Expected,
    paper: Expected,
) -> Case {
    Case {
        id,
        name,
        scenes,
        form,
        exact,
        paper,
        apart: &[],
        keeps: Keeps::NOTHING,
    }
}

impl Case {
    pub(super) const fn keeping(self, keeps: Keeps) -> Self {
        Self { keeps, ..self }
    }

    pub(super) const fn but(self, apart: &'static [(&'static str, Expected)]) -> Self {
        Self { apart, ..self }
    }
}
