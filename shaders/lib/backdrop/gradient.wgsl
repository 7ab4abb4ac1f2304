// The default background behind the model.

#define_import_path cutaway::backdrop

#import cutaway::background::background
#import cutaway::color::linear_from_srgb

fn backdrop(row: u32) -> vec4<f32> {
    return vec4<f32>(linear_from_srgb(unpack4x8unorm(background(row)).rgb), 1.0);
}
