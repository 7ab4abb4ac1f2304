// Depths between which crossings of a ray are requested.

#define_import_path cutaway::asked

struct Interval {
    // Empty where x >= y.
    all: vec2<f32>,
    // The part of the interval in which crossings are requested; the results there depend only on all of the interval.
    part: vec2<f32>,
}
