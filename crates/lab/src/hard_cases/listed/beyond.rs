//! Cases 51 to 61: faces that coincide, faces in cuts but for rounding, large pictures of long triangles, other adapters, open parts.

use super::{Listed, listed};

pub(super) const BEYOND: &[Listed] = &[
    listed(
        "51",
        "a cutter flush with a face",
        "the pocket is open: no lid without thickness",
        &["cutters a_shared_face_leaves_nothing_without_thickness"],
    ),
    listed(
        "52",
        "two triangles back to back, lists begun at every vertex",
        "the one that faces the eye, 0 wrong",
        &["doubled_faces a_fin_is_drawn_wherever_its_lists_begin"],
    ),
    listed(
        "53",
        "a needle that covers a sample only once its vertices are snapped",
        "nothing is decided beside it",
        &["agree regression_0009_beside_a_needle_nothing_is_decided"],
    ),
    listed(
        "54",
        "shells 1e-5, 1e-6 and 1e-7 of the size thick",
        "0 wrong; undecided where exact cannot tell",
        &["doubled_faces shells_on_each_other_show_the_face_that_faces_the_eye"],
    ),
    listed(
        "55",
        "eye close to the mesh, triangles larger than the picture",
        "the same masks by both rasterisers, no crack",
        &[
            "rasteriser frames_are_exact_and_those_of_the_hardware",
            "rasteriser vertices_next_to_the_plane_of_the_eye_leave_no_crack",
        ],
    ),
    listed(
        "56",
        "thousands of long triangles in large pictures",
        "no sample is lost, and no invocation's work grows with the data",
        &[
            "rasteriser every_sample_of_long_triangles_is_there_at_every_size",
            "shaders every_shader_keeps_the_rules",
        ],
    ),
    listed(
        "57",
        "a planar face in the cut whose vertices straddle it by f32 steps",
        "kept or gone as a whole; its coordinate as printed is the face",
        &[
            "face_cuts turned_parts_are_cut_in_their_faces",
            "face_cuts a_face_some_steps_off_its_plane_is_there_or_not_in_picture_section_and_halves",
        ],
    ),
    listed(
        "58",
        "touching faces of different size in the cut, of one part and of two",
        "told apart by the side that each solid is on",
        &[
            "face_cuts bodies_that_touch_in_the_plane_are_told_apart_by_their_sides",
            "shared_planes random_assemblies_are_shown_by_priority",
        ],
    ),
    listed(
        "59",
        "a face in the cut inside another body, filled nonzero",
        "the cap of that body",
        &["face_cuts a_face_inside_another_body_has_the_cap_of_that_body"],
    ),
    listed(
        "60",
        "adapters with 4, 6 and 8 sub-pixel bits",
        "as much is undecided as they snap; `auto` rasterises by compute where they are fewer than 8",
        &[
            "exact decided_pixels_survive_the_rounding_of_a_coarse_rasteriser",
            "auto adapter_wish_and_refusal_choose_who_rasterises",
        ],
    ),
    listed(
        "61",
        "an open part that is wholly removed",
        "no cap on it, in exact and in strategies",
        &["face_cuts an_open_part_that_is_wholly_removed_has_no_cap"],
    ),
];
