// Interval of depths in which crossings of a ray are requested.

#define_import_path cutaway::asked

struct Interval {
    // Empty where x >= y.
    all: vec2<f32>,
    // The part of `all` in which crossings are requested. It does not affect their values, which depend only on `all`.
    part: vec2<f32>,
}
