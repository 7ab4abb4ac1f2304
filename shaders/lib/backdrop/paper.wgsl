// The style's paper behind the model, or nothing.

#define_import_path cutaway::backdrop

#import cutaway::style::style

fn backdrop(row: u32) -> vec4<f32> {
    return style.paper;
}
