//! Cases that users of other programs met.

use super::{Listed, listed};

pub(super) const USERS: &[Listed] = &[
    listed(
        "B1",
        "no bottom, T-junctions, a face twice",
        "odd pixels marked, exactly those",
        &[],
    ),
    listed(
        "B2",
        "holes stay holes",
        "0 wrong; the section has the area of its loops",
        &["hard_cases case_b02_a_plate_with_holes_has_the_area_of_what_is_left"],
    ),
    listed(
        "B3",
        "parts that are moved, and open",
        "odd pixels marked, exactly those",
        &[],
    ),
    listed(
        "B4",
        "triangles missing here and there",
        "odd pixels marked, exactly those",
        &[],
    ),
    listed(
        "B5",
        "caps face away from what is removed",
        "normals of caps within a tenth of a degree",
        &[],
    ),
    listed("B6", "rooms stay empty", "0 wrong", &[]),
    listed(
        "B7",
        "caps seen along their plane lie in it",
        "depths within a hundredth of a pixel",
        &[],
    ),
    listed(
        "B8",
        "a face in the plane, or an ulp beside it",
        "0 wrong, no speckle",
        &["hard_cases case_02_a_face_in_the_plane_flips_only_as_a_whole"],
    ),
    listed(
        "B9",
        "boxes that share an edge or a face",
        "0 wrong",
        &["slice solids_that_touch_are_two_loops"],
    ),
    listed(
        "B10",
        "what a cut leaves is closed",
        "every edge of a section belongs to two triangles, or to one and an outline",
        &["hard_cases case_b10_edges_of_a_section_are_inner_or_of_an_outline"],
    ),
    listed(
        "B11",
        "halves make the whole",
        "one area from either side, and the volume of the solid over all heights",
        &[
            "hard_cases case_b11_halves_make_the_whole",
            "slice areas_add_up_to_the_volume",
        ],
    ),
    listed(
        "B12",
        "three planes, together and apart",
        "0 wrong, no cap that none asked for",
        &[],
    ),
    listed("B13", "corners of two planes, and holes", "0 wrong", &[]),
    listed(
        "B14",
        "triangles without area in the section",
        "0 wrong",
        &["slice nonsense_is_left_out_and_reported"],
    ),
    listed("U1", "two products face to face", "0 wrong", &[]),
    listed(
        "U2",
        "mixed winding",
        "single wrong pixels along edges of faces that disagree which side is out",
        &[],
    ),
    listed(
        "U3",
        "copies of one mesh: turned, stretched, mirrored",
        "0 wrong",
        &["planar a_mirrored_part_and_a_new_rule_are_sliced_right"],
    ),
    listed("U4", "caps end where the sky begins", "0 wrong", &[]),
    listed("U5", "caps behind what is nearer", "0 wrong", &[]),
    listed(
        "U6",
        "a plane turned over",
        "0 wrong, normals of caps within a tenth of a degree",
        &[],
    ),
    listed(
        "U7",
        "a plane in the face between two products",
        "kept as a whole",
        &[],
    ),
];
