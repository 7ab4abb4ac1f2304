//! Cases 1 to 21: solids, meshes and cameras.

use super::{Listed, listed};

pub(super) const SOLIDS: &[Listed] = &[
    listed(
        "1",
        "cube through its middle",
        "the cap is the unit square, 0 wrong",
        &["hard_cases case_01_the_cap_is_the_unit_square_to_the_pixel"],
    ),
    listed(
        "2",
        "plane in a face",
        "kept or removed as a whole, never speckle",
        &["hard_cases case_02_a_face_in_the_plane_flips_only_as_a_whole"],
    ),
    listed(
        "3",
        "plane through an edge, a vertex, a diagonal",
        "no hole, no odd pixel",
        &["slice planes_through_edges_and_vertices_leave_nothing_open"],
    ),
    listed(
        "4",
        "rays through vertices and edges",
        "every count is even",
        &[
            "hard_cases case_04_and_05_every_pixel_counts_even",
            "hard_cases case_04_the_vertices_do_lie_at_pixel_centres",
        ],
    ),
    listed(
        "5",
        "1000 needles meet at a pixel centre",
        "exactly even counts",
        &["hard_cases case_04_and_05_every_pixel_counts_even"],
    ),
    listed(
        "6",
        "needles and triangles without area",
        "the image of the mesh without them",
        &["hard_cases case_06_triangles_without_area_change_nothing"],
    ),
    listed(
        "7",
        "triangles far smaller than a pixel",
        "no odd pixel",
        &[
            "hard_cases case_07_a_million_triangles_leave_no_odd_pixel",
            "rasteriser triangles_far_smaller_than_a_pixel_leave_no_odd_one",
        ],
    ),
    listed(
        "8",
        "two triangles that cover 8192 x 8192 pixels",
        "what many small ones cover, bit for bit",
        &["rasteriser two_triangles_of_8192_px_cover_what_many_small_ones_do"],
    ),
    listed(
        "9",
        "vertices at the guard band, beyond it, and next to the plane of the eye",
        "no crack along clipped edges",
        &[
            "rasteriser vertices_at_the_guard_band_and_beyond_leave_no_crack",
            "rasteriser vertices_next_to_the_plane_of_the_eye_leave_no_crack",
            "rasteriser triangles_across_the_near_plane_leave_no_crack",
        ],
    ),
    listed(
        "10",
        "eye inside, kept side",
        "the near plane is capped over the whole picture",
        &["hard_cases case_10_inside_the_kept_side_the_near_cap_fills_the_picture"],
    ),
    listed(
        "11",
        "eye in a void",
        "its wall is seen, and no cap",
        &["hard_cases case_11_from_a_void_the_wall_is_seen_and_no_cap"],
    ),
    listed(
        "12",
        "near plane in the solid",
        "a cap at the near plane, or what the ray enters next",
        &[
            "hard_cases case_12_without_the_near_cap_the_ray_shows_what_it_enters_next_and_no_pixel_is_odd",
        ],
    ),
    listed(
        "13",
        "far plane in the solid",
        "depth ends nowhere: 0 wrong",
        &[
            "words what_was_cleared_is_infinitely_far_in_perspective",
            "exact the_horizon_of_the_view_does_not_matter_to_parity",
        ],
    ),
    listed(
        "14",
        "far away, tiny, huge",
        "the picture of the same scene at home",
        &["hard_cases case_14_far_tiny_and_huge_scenes_look_the_same"],
    ),
    listed(
        "15",
        "near to far as 1 to 100000",
        "reversed depth resolves 2^-24 at every distance",
        &["hard_cases case_15_reversed_depth_keeps_its_precision_at_every_distance"],
    ),
    listed(
        "16",
        "two nested shells",
        "by parity a ring both ways, by nonzero if the inner one is turned",
        &["hard_cases case_16_a_hollow_ball_is_hollow_if_its_inner_shell_is_turned"],
    ),
    listed(
        "17",
        "two balls overlap in one mesh",
        "by parity the lens is void, by nonzero they unite",
        &["hard_cases case_17_overlapping_balls_unite"],
    ),
    listed(
        "18",
        "solids that cross themselves",
        "the index of the profile, or its parity",
        &[
            "hard_cases case_18_winding_is_the_index_of_the_profile",
            "hard_cases case_18_the_mask_holds_the_winding_number_itself",
        ],
    ),
    listed(
        "19",
        "every face twice",
        "by parity nothing is inside, by nonzero all is; peeling fails",
        &[
            "hard_cases case_19_nothing_is_inside_a_doubled_mesh",
            "hard_cases case_19_a_doubled_mesh_is_as_solid_as_a_single_one",
            "lists case_19_faces_that_lie_in_one_another_are_kept_apart_by_lists_alone",
        ],
    ),
    listed(
        "20",
        "one triangle missing",
        "odd pixels marked, exactly those",
        &["hard_cases case_20_the_missing_triangle_is_marked_pixel_by_pixel"],
    ),
    listed(
        "21",
        "edges split on one side",
        "what leaks is no more than the sliver, and marked",
        &["hard_cases case_21_t_junctions_leak_no_more_than_their_slivers"],
    ),
];
