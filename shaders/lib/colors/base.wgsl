// Colours of parts, unlit.
// The open module `overlap` determines how shared caps of several solids look.

#define_import_path cutaway::base

#import cutaway::color::linear_from_srgb
#import cutaway::cuts::parts
#import cutaway::layers::{CAP, kind_of}
#import cutaway::overlap::cap_base

// The colour of a part, or of its caps, in linear light, from the first word of a layer and the part's index in the table.
fn own_color(word: u32, place: u32) -> vec3<f32> {
    let is_cap = kind_of(word) == CAP;
    return linear_from_srgb(select(parts[place].color.rgb, parts[place].cap_color.rgb, is_cap));
}

// The colour of a pixel with a surface or a cap.
fn base_of(at: vec2<u32>, word: u32, place: u32) -> vec3<f32> {
    return cap_base(own_color(word, place), word, at);
}
