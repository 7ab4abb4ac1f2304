// The samples of a row on the inner side of an edge: exact, since edge functions are integers.

#define_import_path cutaway::span

// Longer than any row.
const LONGEST: i32 = 255;

// floor(value / step) of value >= 0 and step > 0 if that is at most LONGEST, else one more. A float division is off by at most one, which
// integers correct: most devices divide integers one lane at a time.
fn quotient(value: i32, step: i32) -> i32 {
    let near = i32(min(f32(value) / f32(step), f32(LONGEST)));
    let rest = value - near * step;
    return near + select(select(0, 1, rest >= step), -1, rest < 0);
}

// Narrows span.x to span.y to the steps n where value + n * step >= 0; empty if x > y. Spans end before LONGEST, magnitudes are below 2^31
// - step, and those of steps below 2^23.
fn narrowed(span: vec2<i32>, value: i32, step: i32) -> vec2<i32> {
    let steps = quotient(select(max(value, 0), max(-value, 0) + step - 1, step > 0), max(abs(step), 1));
    if step > 0 {
        return vec2<i32>(max(span.x, steps), span.y);
    }
    if value < 0 {
        return vec2<i32>(1, 0);
    }
    return vec2<i32>(span.x, select(span.y, min(span.y, steps), step < 0));
}
