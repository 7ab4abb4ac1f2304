// Lines keep their spacing in the scene.

#define_import_path cutaway::hatch_zoom

#import cutaway::pulses::pulse_cover
#import cutaway::style::style

// Line spacing relative to the family's.
fn spacing_at(scale: f32) -> f32 {
    return 1.0;
}

// Fraction of a pixel covered by lines of a width at whole numbers, if the sides of a pixel advance by `steps` across them.
fn lines_cover(across: f32, steps: vec2<f32>, width: f32, scale: f32) -> f32 {
    return pulse_cover(across, min(width, 1.0), steps / style.fineness);
}
