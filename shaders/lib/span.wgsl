// Which samples of a row an edge leaves: exact, since edge functions are integers.

#define_import_path cutaway::span

// Of the steps n from span.x to span.y those where value + n * step >= 0; none where x > y. Magnitudes below 2^31 - step.
fn narrowed(span: vec2<i32>, value: i32, step: i32) -> vec2<i32> {
    if step > 0 {
        return vec2<i32>(max(span.x, (max(-value, 0) + step - 1) / step), span.y);
    }
    if value < 0 {
        return vec2<i32>(1, 0);
    }
    if step < 0 {
        return vec2<i32>(span.x, min(span.y, value / -step));
    }
    return span;
}
