// The numbers of a style. Colours are in linear light. Bound as @group(2) @binding(0).

#define_import_path cutaway::style

struct Style {
    ink: vec4<f32>,
    // Alpha is 0 if nothing is drawn behind the model.
    paper: vec4<f32>,
    // Cool blue, warm yellow, and the fractions of the part's own colour in cool and in warm light.
    gooch: vec4<f32>,
    // Half the stroke width in pixels for each border class, indexed by class minus one.
    stroke_halves: array<vec4<f32>, 2>,
    // Cosine of the least fold angle that is a crease.
    crease_cos: f32,
    // The least depth jump that is a contour, in pixel widths.
    depth_px: f32,
    // Strength of the lighting on caps.
    cap_light: f32,
    // Fraction of the light on caps that depends on the cap's orientation.
    cap_relief: f32,
    // Greatest distance in pixels to a border whose stroke is visible: half the greatest width, rounded up, plus one for the edge.
    stroke_reach_px: i32,
    // Supersampling factor along each side of a pixel.
    fineness: f32,
    // Strength of occlusion on surfaces and on caps.
    occlusion_surface: f32,
    occlusion_cap: f32,
    // Unit vectors across the engraving lines, and the approximate line spacing in pixels.
    engraving: array<vec4<f32>, 2>,
}

@group(2) @binding(0) var<uniform> style: Style;
