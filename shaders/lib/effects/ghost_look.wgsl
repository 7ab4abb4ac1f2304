// Appearance of removed material. Bound as @group(2) @binding(0).

#define_import_path cutaway::ghost_look

struct Ghost {
    // Colour in linear light.
    color: vec4<f32>,
    // Half the width of a line in pixels.
    half_px: f32,
    // Opacity of a line.
    alpha: f32,
    // Opacity of glass.
    glass: f32,
    // Reciprocal of the line width in scene units.
    widths_per_unit: f32,
}

@group(2) @binding(0) var<uniform> ghost: Ghost;
