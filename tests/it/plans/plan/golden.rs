//! Plans as text, read by a person once and held to since.

use super::*;

// The figures, by hand: 64,000 pixels take 28 bytes of targets (8 + 4), layers (12) and picture (4); a list of one crossing
// and its mask 16 more. A sprite of 64 x 64 is two layers of 16 KiB and a count of as much; the word of need is on the clock
// of what reports it. A grid of 8 x 8 cells has 128 triangles, 1536 bytes of indices, and a quad of 64.

#[test]
fn the_crank_cut_by_a_plane() {
    let scene = scene_of(&["crank?throws=1&detail=16"], vec![planes(0.0, 1)]);
    let text = plan_of(&scene, &Strategy::RAYCAST_MASK).to_text();
    insta::assert_snapshot!(text, @r"
per frame: 4 passes, 2.7 MiB
  crossings  [compute 20 x 13 x 1 groups]
    why     the list of depths per pixel; only planes, so no walk
    reads   frame, cut_table, ray_table
    writes  crossing_heads, crossing_z, crossing_surface, need, mask
  solid  [draw 1992 triangles in 1 draw]
    why     1 cut part: each fragment marks the crossings in front of it, and stays if it is kept
    reads   frame, cut_table, parts, mask, crossing_heads, crossing_z, crossing_surface, vertices, indices
    writes  mask, surface_words, surface_depth
  resolve  [compute 20 x 13 x 1 groups]
    why     the nearest crossing that is inside a part and enters it is a cap, unless a surface is in front of it
    reads   frame, cut_table, parts, surface_words, surface_depth, mask, crossing_heads, crossing_z, crossing_surface
    writes  layers
  shade  [compute 20 x 13 x 1 groups]
    why     lit shading turns layers into a picture
    reads   frame, parts, layers
    writes  picture
");
}

#[test]
fn the_cube_cut_by_a_relief_in_the_way_of_the_paper() {
    let scene = scene_of(&["cube"], vec![reliefs(0.0, 1)]);
    let text = plan_of(&scene, &strategy("grid:8+vds:64")).to_text();
    insta::assert_snapshot!(text, @r"
per solid: 4 passes, 48.0 KiB
  sprite clear 0  [compute 4 x 4 x 1 groups]
    why     the layer count of `cube 0` starts at zero
    reads   sprite 0
    writes  sprite counts, need
  sprite count 0  [draw 12 triangles in 1 draw]
    why     the sprite needs as many layers as the depth complexity at this resolution
    reads   sprite 0, sprite counts, need, vertices, indices
    writes  sprite counts, need
  sprite peel 0.0  [draw 12 triangles in 1 draw]
    why     layer 0 of `cube 0`, behind the previous layer
    reads   sprite 0, vertices, indices
    writes  sprite layers 0
  sprite peel 0.1  [draw 12 triangles in 1 draw]
    why     layer 1 of `cube 0`, behind the previous layer
    reads   sprite 0, sprite layers 0, vertices, indices
    writes  sprite layers 0
per cut: 0 passes, 1.6 KiB
per frame: 4 passes, 1.7 MiB
  clip  [draw 12 triangles in 1 draw]
    why     1 cut part: chi decides at every fragment
    reads   frame, cut_table, parts, heights, vertices, indices
    writes  surface_words, surface_depth
  cap 0  [draw 128 triangles in 1 draw]
    why     the displaced triangles of `cube 0`, cut to the solid by its image
    reads   frame, cut_table, parts, heights, quads, sprite 0, sprite layers 0, grid indices, surface_words, surface_depth
    writes  surface_words, surface_depth
  gather  [compute 20 x 13 x 1 groups]
    why     layers are what the picture and the comparison read
    reads   frame, surface_words, surface_depth
    writes  layers
  shade  [compute 20 x 13 x 1 groups]
    why     lit shading turns layers into a picture
    reads   frame, parts, layers
    writes  picture
");
}
