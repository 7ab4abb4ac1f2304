// Sine and cosine accurate to the last bits of f32. The built-in ones may be off by 2^-11, which would move a vertex by a pixel.
//
// The angle is reduced by the nearest quarter turn, whose length is subtracted in three parts so that no precision is lost up to some
// thousand turns (Cody and Waite 1980); for the remainder, at most pi / 4, Taylor series are accurate to 2^-27.

#define_import_path cutaway::trig

// For -pi/4 to pi/4.
fn sin_near(a: f32) -> f32 {
    let s = a * a;
    return a + a * s * (-1.6666667e-1 + s * (8.3333333e-3 + s * (-1.9841270e-4 + s * 2.7557319e-6)));
}

fn cos_near(a: f32) -> f32 {
    let s = a * a;
    return 1.0 + s * (-0.5 + s * (4.1666667e-2 + s * (-1.3888889e-3 + s * (2.4801587e-5 - s * 2.7557319e-7))));
}

// Sine in x, cosine in y.
fn sin_cos(angle: f32) -> vec2<f32> {
    let quarters = round(angle * 0.63661977);
    let a = ((angle - quarters * 1.5703125) - quarters * 4.8375129699707031e-4) - quarters * 7.5497899548918822e-8;
    let near = vec2<f32>(sin_near(a), cos_near(a));
    switch u32(i32(quarters)) & 3u {
        case 0u: { return near; }
        case 1u: { return vec2<f32>(near.y, -near.x); }
        case 2u: { return -near; }
        default: { return vec2<f32>(-near.y, near.x); }
    }
}

// sin(a) / a, which is 1 at 0.
fn sinc(a: f32) -> f32 {
    if abs(a) < 1e-3 {
        return 1.0 - a * a / 6.0;
    }
    return sin_cos(a).x / a;
}
