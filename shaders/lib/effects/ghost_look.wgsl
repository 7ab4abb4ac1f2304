// How what is gone looks. Bound as @group(2) @binding(0).

#define_import_path cutaway::ghost_look

struct Ghost {
    // Linear light.
    color: vec4<f32>,
    // Half the width of a line in pixels.
    half_px: f32,
    // How much of the colour a line has.
    alpha: f32,
    // How much glass is seen.
    glass: f32,
    // Widths of a line in a scene unit.
    widths_per_unit: f32,
}

@group(2) @binding(0) var<uniform> ghost: Ghost;
