//! The part of the table that users of other programs wrote: what leaked, flickered, was filled in or turned over.

use super::case::Form::{Plane, Planes};
use super::case::{Case, Keeps};
use super::cases::{IN_FACE, UNTOLD, case, chord};
use super::expected::Expected::{self, Band, Exact, Fails, Marked, Overflows, Within};
use super::{tolerances, users};

/// Caps that are turned over are off by half a turn.
const FACING: Keeps = Keeps {
    normal_deg: tolerances::CAP_NORMAL_DEG,
    ..Keeps::NOTHING
};

/// Caps that lie where their plane is.
const IN_PLACE: Keeps = Keeps {
    depth_px: tolerances::CAP_DEPTH_PX,
    ..Keeps::NOTHING
};

/// A face between others that are wound the other way is seen from its front or from its back: at 256 px, at a single pixel.
const EITHER_SIDE: Expected = Within(
    tolerances::TIE_SHARE,
    "along an edge of faces that are wound against each other either side may be seen",
);

/// Who is asked about small pictures alone, where no pixel is that near to an edge.
const SMALL_PICTURES_EXACT: &[(&str, Expected)] = &[
    ("raycast+abuffer@compute", Exact),
    ("raycast+kbuffer*", Exact),
    ("raycast+ldi*", Exact),
    ("raycast+vds*", Exact),
    ("planar@compute", Exact),
    ("adaptive*", Exact),
    ("grid*+mask", Exact),
    ("grid*+ldi*", Exact),
];

/// Why depth images are wrong about faces in the plane.
const IN_IMAGE: Expected =
    Fails("of a point on a face a depth image says inside or outside as rounding has it");

/// A sponge has more fragments to a pixel than eight.
const DEEP: Expected = Overflows("of kbuffer:K");

pub(super) const OF_USERS: &[Case] = &[
    case(
        "B1",
        "no bottom, T-junctions, a face twice",
        users::leaking,
        Plane,
        Marked,
        UNTOLD,
    ),
    case("B2", "holes stay holes", users::holes, Plane, Exact, Band).but(&[("*kbuffer*", DEEP)]),
    case(
        "B3",
        "parts that are moved, and open",
        users::moved_and_open,
        Plane,
        Marked,
        UNTOLD,
    ),
    case(
        "B4",
        "triangles missing here and there",
        users::riddled,
        Plane,
        Marked,
        UNTOLD,
    ),
    case(
        "B5",
        "caps face away from what is removed",
        users::all_directions,
        Plane,
        Exact,
        Band,
    )
    .keeping(FACING),
    case("B6", "rooms stay empty", users::rooms, Plane, Exact, Band),
    case(
        "B7",
        "caps seen along their plane lie in it",
        users::oblique,
        Plane,
        Exact,
        Band,
    )
    .keeping(IN_PLACE),
    case(
        "B8",
        "a face in the plane, or an ulp beside it",
        users::coplanar,
        Plane,
        Exact,
        IN_FACE,
    ),
    case(
        "B9",
        "boxes that share an edge or a face",
        users::touching,
        Plane,
        Exact,
        Band,
    ),
    case(
        "B12",
        "three planes, together and apart",
        users::three_planes,
        Planes,
        Exact,
        Band,
    ),
    case(
        "B13",
        "corners of two planes, and holes",
        users::corners_and_holes,
        Planes,
        Exact,
        Band,
    )
    .but(&[("*kbuffer*", DEEP)]),
    case(
        "B14",
        "triangles without area in the section",
        users::degenerate_sections,
        Plane,
        Exact,
        Band,
    ),
    case(
        "U1",
        "two products face to face",
        users::face_to_face,
        Plane,
        Exact,
        Band,
    ),
    case(
        "U7",
        "a plane in the face between two products",
        users::between,
        Plane,
        Exact,
        IN_FACE,
    )
    .but(&[("raycast+vds*", IN_IMAGE), ("raycast+ldi*", IN_IMAGE)]),
    case(
        "U2",
        "mixed winding",
        users::mixed_winding,
        Plane,
        EITHER_SIDE,
        chord(0.00997),
    )
    .but(SMALL_PICTURES_EXACT),
    case(
        "U3",
        "copies of one mesh: turned, stretched, mirrored",
        users::instances,
        Plane,
        Exact,
        Band,
    ),
    case(
        "U4",
        "caps end where the sky begins",
        users::before_the_sky,
        Plane,
        Exact,
        Band,
    ),
    case(
        "U5",
        "caps behind what is nearer",
        users::behind_others,
        Plane,
        Exact,
        Band,
    ),
    case(
        "U6",
        "a plane turned over",
        users::flipped,
        Plane,
        Exact,
        Band,
    )
    .keeping(FACING),
];
