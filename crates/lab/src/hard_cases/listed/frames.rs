//! Cases 39 to 50: frames that follow each other, buffers that overflow, sections.

use super::{Listed, listed};

pub(super) const FRAMES: &[Listed] = &[
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
        "equal; the overflow is reported",
        &["lists case_45_slots_for_all_are_enough_and_one_less_is_told"],
    ),
    listed(
        "46",
        "a pool too small by one node",
        "reported, then grown to what is needed",
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
            "cuts filters_and_offsets_that_change_nothing_cost_nothing",
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
];
