// Between which depths crossings of a ray are asked for.

#define_import_path cutaway::asked

struct Interval {
    // Empty where x >= y.
    all: vec2<f32>,
    // The part of it in which crossings are asked for; what is found there hangs on all of it alone.
    part: vec2<f32>,
}
