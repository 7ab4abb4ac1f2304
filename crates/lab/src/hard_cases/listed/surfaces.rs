//! Cases 22 to 38: reliefs, tessellations and sprites.

use super::{Listed, listed};

pub(super) const SURFACES: &[Listed] = &[
    listed(
        "22",
        "flat map",
        "the plane, bit for bit",
        &["hard_cases case_22_a_flat_map_is_the_plane_bit_for_bit"],
    ),
    listed(
        "23",
        "ramp and saddle",
        "roots as by formula; two hits or none",
        &[
            "hard_cases case_23_a_ramp_is_a_tilted_plane",
            "words roots_are_found_by_signs_and_located_to_rounding",
        ],
    ),
    listed(
        "24",
        "rays along N, along U, along the plane",
        "no NaN, the hits of exact",
        &["words the_list_of_a_ray_agrees_with_the_surface"],
    ),
    listed(
        "25",
        "rays along texel borders",
        "the parity that the two ends imply",
        &["words the_list_of_a_ray_agrees_with_the_surface"],
    ),
    listed(
        "26",
        "rays graze crests",
        "parity unchanged",
        &["words deciding_by_roots_breaks_the_parity"],
    ),
    listed(
        "27",
        "noise along its plane, more than 32 crossings",
        "lists grow and agree with exact; too short is reported",
        &[
            "hard_cases case_27_up_to_31_crossings_the_list_grows",
            "hard_cases case_27_beyond_31_crossings_lanes_are_several_words",
            "hard_cases case_27_counts_have_a_byte_for_each_crossing",
            "hard_cases case_27_what_finds_no_room_is_marked_and_told",
            "hard_cases case_27_a_lane_too_short_is_noticed",
        ],
    ),
    listed(
        "28",
        "steps one texel wide, very high",
        "no hole; the pyramid finds what the walk by cells finds",
        &["hard_cases case_28_checker_plateaus_with_steep_steps"],
    ),
    listed(
        "29",
        "borders of a map",
        "the rule of its wrap mode on either side",
        &["hard_cases case_29_a_map_goes_on_beyond_its_border"],
    ),
    listed(
        "30",
        "heights that are no numbers",
        "refused when loaded; denormals are 0",
        &["hard_cases case_30_heights_that_are_no_numbers_are_refused"],
    ),
    listed(
        "31",
        "maps of odd sizes",
        "one code path, all cells",
        &[
            "hard_cases case_31_a_map_of_4096_texels_a_side",
            "hard_cases case_31_maps_of_one_row_or_column",
        ],
    ),
    listed(
        "32",
        "cut almost along a face",
        "the paper's gap within its bound; by one list no back face",
        &[
            "hard_cases case_32_the_gap_of_the_grid_grows_as_the_cut_becomes_tangent",
            "hard_cases case_32_near_tangency_the_gap_of_the_paper_stays_under_its_bound_and_the_list_shows_no_back",
        ],
    ),
    listed(
        "33",
        "grids of 8 to 1024 cells by one list",
        "no back face at any; silhouette errors fall threefold with each doubling",
        &["hard_cases case_33_no_level_of_a_grid_shows_a_back_face_and_errors_fall_with_it"],
    ),
    listed(
        "34",
        "adaptive along a camera's way of 1000 frames",
        "no crack, the right parity along every ray",
        &[
            "hard_cases case_34_no_crack_along_a_cameras_way",
            "hard_cases case_34_a_list_of_the_wrong_parity_is_noticed",
        ],
    ),
    listed(
        "35",
        "sprites of 256 to 2048 texels",
        "the error halves as the resolution doubles",
        &["hard_cases case_35_the_error_of_the_sprite_halves_as_its_resolution_doubles"],
    ),
    listed(
        "36",
        "more layers than a sprite has",
        "reported; counted at the resolution used",
        &[
            "hard_cases case_36_layers_are_counted_and_too_many_are_told",
            "hard_cases case_36_layers_are_counted_at_the_resolution_used",
            "lists case_36_lists_hold_what_a_sprite_has_no_layers_for",
        ],
    ),
    listed(
        "37",
        "opposite signs",
        "complementary pictures, one cap",
        &["hard_cases case_37_opposite_signs_are_complementary"],
    ),
    listed(
        "38",
        "two crossing surfaces, and, or",
        "the Boolean of exact, no gap along the crossing",
        &[
            "hard_cases case_38_and_or_differ_and_have_both_caps",
            "cuts case_38_two_that_cross_have_no_gap_along_their_edge",
        ],
    ),
];
