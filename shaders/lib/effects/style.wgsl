// The numbers of a style. Colours are in linear light. Bound as @group(2) @binding(0).

#define_import_path cutaway::style

struct Style {
    ink: vec4<f32>,
    // Alpha is 0 where nothing is behind the model.
    paper: vec4<f32>,
    // Cool blue, warm yellow, and the shares of the own colour in cool and in warm light.
    gooch: vec4<f32>,
    // Half the widths of strokes in pixels, by the class of the border less one.
    stroke_halves: array<vec4<f32>, 2>,
    // Cosine of the least fold that is a crease.
    crease_cos: f32,
    // The least jump in depth that is a contour, in widths of a pixel.
    depth_px: f32,
    // How much of the light a cap takes.
    cap_light: f32,
    // Share of that light that depends on the orientation of the cap.
    cap_relief: f32,
    // How many pixels away a border may be whose stroke is seen: half the greatest width, rounded up, and one for the edge.
    stroke_reach_px: i32,
    // Samples per pixel of the picture along each side: each covers that fraction of the pixel.
    fineness: f32,
    // How much of occlusion surfaces and caps have.
    occlusion_surface: f32,
    occlusion_cap: f32,
    // Unit vectors across the lines of engraving, and about the distance from line to line in pixels.
    engraving: array<vec4<f32>, 2>,
}

@group(2) @binding(0) var<uniform> style: Style;
