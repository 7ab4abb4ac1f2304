//! The list: every hard case by its number, what is expected in words, and the tests that hold what is more than its pictures.

/// A line of the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Listed {
    /// Its number, or its letter and number where users of other projects met it: `B` by the thread of a project, `U` by many.
    pub id: &'static str,
    /// What it is.
    pub name: &'static str,
    /// What is expected of an exact strategy, in words.
    pub expected: &'static str,
    /// Test binaries and functions in them, separated by a space.
    pub tests: &'static [&'static str],
}

impl Listed {
    /// The tests as one would type them after `cargo test`, one after the other; none if pictures are all of it.
    pub fn held_by(&self) -> Option<String> {
        let typed: Vec<String> = self.tests.iter().map(|t| format!("--test {t}")).collect();
        (!typed.is_empty()).then(|| typed.join("; "))
    }
}

/// All of them, in order.
pub const LIST: &[Listed] = &[
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
        "a cap at the near plane, or the inner walls",
        &["hard_cases case_12_without_the_near_cap_the_inner_walls_show_and_no_pixel_is_odd"],
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
        "lists grow and agree with exact; too short is told",
        &[
            "hard_cases case_27_up_to_31_crossings_the_list_grows",
            "hard_cases case_27_beyond_31_crossings_lanes_are_several_words",
            "hard_cases case_27_what_finds_no_room_is_marked_and_told",
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
        "told; counted at the resolution used",
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
    listed(
        "39",
        "another topology in every frame",
        "0 wrong in each, nothing left of the one before",
        &["moving meshes_of_another_topology_every_frame_leave_nothing_behind"],
    ),
    listed(
        "40",
        "a camera that drifts by 1/64 of a pixel",
        "pixels flip where those of exact do",
        &[
            "hard_cases case_40_a_drifting_camera_flips_what_exact_flips",
            "moving a_camera_that_drifts_flips_what_the_exact_camera_flips",
        ],
    ),
    listed(
        "41",
        "repeats, other orders, other numbers of threads",
        "bit-identical",
        &[
            "hard_cases case_41_fifty_repeats_are_bit_identical",
            "hard_cases case_41_the_order_of_triangles_changes_nothing",
            "hard_cases case_41_one_thread_and_two_find_the_same",
            "rasteriser fifty_frames_are_the_same_to_the_bit",
        ],
    ),
    listed(
        "42",
        "both rasterisers",
        "equal but for undecided pixels",
        &["rasteriser frames_are_exact_and_those_of_the_hardware"],
    ),
    listed(
        "43",
        "fragments counted before and behind a candidate",
        "the same mask to the bit: the k-buffer counts what is before, the mask what is behind",
        &["lists masks_are_the_same_to_the_bit"],
    ),
    listed(
        "44",
        "stencil against mask",
        "equal bit for bit",
        &[
            "hard_cases case_44_the_stencil_leaves_the_mask_bit_for_bit",
            "hard_cases case_44_nonzero_leaves_whether_the_count_is_0",
        ],
    ),
    listed(
        "45",
        "slots for all fragments, and for one less",
        "equal; the overflow is told",
        &["lists case_45_slots_for_all_are_enough_and_one_less_is_told"],
    ),
    listed(
        "46",
        "a pool too small by one node",
        "told, then grown to what is needed",
        &[
            "lists case_46_a_pool_too_small_by_one_is_told_and_grows_to_what_is_needed",
            "lists case_46_a_session_tries_again_with_the_size_it_was_told",
        ],
    ),
    listed(
        "47",
        "nothing cut, nothing asked for",
        "the passes of plain drawing and no other",
        &[
            "plan without_a_cut_every_strategy_draws_the_same_and_nothing_more",
            "plan filters_and_offsets_that_change_nothing_cost_nothing",
        ],
    ),
    listed(
        "48",
        "U and V of different lengths",
        "the definition; directions that are not at right angles are refused",
        &["hard_cases case_48_the_length_of_v_counts_and_its_angle_must_be_right"],
    ),
    listed(
        "49",
        "sections that are stars, touch, nest, or have 100,000 points",
        "the area of the shoelace sum to 1e-12; the pixels of exact",
        &[
            "slice a_loop_of_many_points_has_its_shoelace_area",
            "slice loops_may_touch_and_nest",
            "planar stars_touching_loops_and_islands_in_holes",
            "planar a_loop_of_a_hundred_thousand_points",
        ],
    ),
    listed(
        "50",
        "ball cut at a height",
        "the area converges with the square of the edges",
        &["slice a_sphere_converges_with_the_square_of_its_edges"],
    ),
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
    listed("U2", "mixed winding", "0 wrong", &[]),
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
];

const fn listed(
    id: &'static str,
    name: &'static str,
    expected: &'static str,
    tests: &'static [&'static str],
) -> Listed {
    Listed {
        id,
        name,
        expected,
        tests,
    }
}
