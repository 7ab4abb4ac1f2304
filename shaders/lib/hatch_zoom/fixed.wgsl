// Lines are as far from each other as they are in the scene.

#define_import_path cutaway::hatch_zoom

#import cutaway::pulses::pulse_cover
#import cutaway::style::style

// The distance from line to line, over that of the family.
fn spacing_at(scale: f32) -> f32 {
    return 1.0;
}

// How much of a pixel lines of a width cover that are at whole numbers, where the sides of a pixel go by `steps` across them.
fn lines_cover(across: f32, steps: vec2<f32>, width: f32, scale: f32) -> f32 {
    return pulse_cover(across, min(width, 1.0), steps / style.fineness);
}
