//! Exact sums of products of f64 values, for signs that must be right.
//!
//! Every product is an integer of 106 bits times a power of two; the products are added as one integer with as many bits as their exponents
//! span, at most 4,200, and the sum is rounded once. No intermediate result overflows or underflows. Cost: some 100 ns for six products of
//! similar size.

/// Bits per digit; digits are summed before carries are propagated.
const DIGIT_BITS: u32 = 32;
/// Digits from the lowest bit of two subnormals' product to the highest bit of two maxima's product, with room for carries.
const DIGITS: usize = 4_200 / DIGIT_BITS as usize + 5;

/// The sum of products of pairs, rounded once to the nearest f64: zero only if it is exactly zero, and infinite only if it is too
/// large. Numbers must be finite.
pub(crate) fn sum_of_products<const N: usize>(pairs: [[f64; 2]; N]) -> f64 {
    let products = pairs.map(|[a, b]| {
        let ((m, e), (n, f)) = (integer_and_exponent(a), integer_and_exponent(b));
        let is_negative = a.is_sign_negative() != b.is_sign_negative();
        (u128::from(m) * u128::from(n), e + f, is_negative)
    });
    let exponents = || products.iter().filter(|p| p.0 != 0).map(|p| p.1);
    let (Some(least), Some(most)) = (exponents().min(), exponents().max()) else {
        return 0.0;
    };
    let used = ((most - least) as u32).div_ceil(DIGIT_BITS) as usize + 6;
    let mut digits = [0_i64; DIGITS];
    let digits = &mut digits[..used];
    for (product, exponent, is_negative) in products {
        if product == 0 {
            continue;
        }
        let shift = (exponent - least) as u32;
        let first = (shift / DIGIT_BITS) as usize;
        for chunk in 0..4 {
            let chunk_bits = (product >> (chunk as u32 * DIGIT_BITS)) as u32;
            let moved = u64::from(chunk_bits) << (shift % DIGIT_BITS);
            let sign = if is_negative { -1 } else { 1 };
            digits[first + chunk] += sign * (moved & 0xffff_ffff) as i64;
            digits[first + chunk + 1] += sign * (moved >> DIGIT_BITS) as i64;
        }
    }
    carry(digits);
    let is_negative = digits[used - 1] < 0;
    if is_negative {
        digits.iter_mut().for_each(|d| *d = -*d);
        carry(digits);
    }
    let magnitude = rounded(digits, least);
    if is_negative { -magnitude } else { magnitude }
}

/// The integer mantissa and the power of two of a finite number, without its sign.
fn integer_and_exponent(x: f64) -> (u64, i32) {
    let bits = x.to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    match exponent {
        0 => (fraction, -1074),
        _ => (fraction | (1 << 52), exponent - 1075),
    }
}

/// Propagates carries so that all digits except the last are in 0..2^32; the last one keeps the sign.
fn carry(digits: &mut [i64]) {
    let last = digits.len() - 1;
    for i in 0..last {
        let over = digits[i] >> DIGIT_BITS;
        digits[i] -= over << DIGIT_BITS;
        digits[i + 1] += over;
    }
}

/// The number with these digits in 0..2^32; the first digit has the weight `2^exponent`.
fn rounded(digits: &[i64], exponent: i32) -> f64 {
    let Some(top) = digits.iter().rposition(|d| *d != 0) else {
        return 0.0;
    };
    let first = top.saturating_sub(2);
    let leading = digits[first..=top].iter().rev();
    let mut integer = leading.fold(0_u128, |sum, d| (sum << DIGIT_BITS) | *d as u128);
    // If any bits follow, at least 65 leading bits are kept; the lowest of them is a sticky bit for the rounding.
    integer |= u128::from(digits[..first].iter().any(|d| *d != 0));
    let value = scaled(
        integer as f64,
        exponent + (first as i32) * DIGIT_BITS as i32,
    );
    value.max(f64::from_bits(1))
}

/// `x * 2^exponent`, where the power alone may be outside the range of f64.
fn scaled(mut x: f64, mut exponent: i32) -> f64 {
    let power = |e: i32| f64::from_bits(((e + 1023) as u64) << 52);
    while exponent > 1000 {
        x *= power(1000);
        exponent -= 1000;
    }
    while exponent < -1000 {
        x *= power(-1000);
        exponent += 1000;
    }
    x * power(exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_f64_loses_is_kept() {
        // Each is a sum that plain f64 arithmetic gets wrong.
        for (pairs, exact) in [
            ([[1e16, 1.0], [1.0, 1.0], [-1e16, 1.0]], 1.0),
            ([[1e200, 1e100], [1e-200, 1e-100], [-1e200, 1e100]], 1e-300),
            ([[1e300, 1e300], [-1e300, 1e300], [5e-324, 1.0]], 5e-324),
            (
                [[0.1, 10.0], [-1.0, 1.0], [0.0, 7.0]],
                0.1_f64.mul_add(10.0, -1.0),
            ),
            ([[3.0, 0.0], [0.0, -2.0], [-0.0, 5.0]], 0.0),
            ([[-1e308, 1.0], [-1.0, 2.0], [1e308, 1.0]], -2.0),
        ] {
            assert_eq!(sum_of_products(pairs), exact, "{pairs:?}");
            let negated = pairs.map(|[a, b]| [-a, b]);
            assert_eq!(sum_of_products(negated), -exact, "{negated:?}");
        }
        let naive = 1e16 * 1.0 + 1.0 * 1.0 + -1e16 * 1.0;
        assert_eq!(naive, 0.0, "f64 alone would do: the cases prove nothing");
    }

    #[test]
    fn a_sum_below_every_f64_keeps_its_sign() {
        assert!(sum_of_products([[1e-300, 1e-300]]) > 0.0, "positive");
        assert!(sum_of_products([[-1e-300, 1e-300]]) < 0.0, "negative");
        assert_eq!(
            sum_of_products([[1e300, 1e300]]),
            f64::INFINITY,
            "too large"
        );
    }

    #[test]
    fn one_product_is_rounded_as_f64_rounds_it() {
        let mut x = 0.123_456_789_f64;
        for _ in 0..2000 {
            let y = (x * 7919.0).fract() - 0.5;
            assert_eq!(sum_of_products([[x, y]]), x * y, "{x} * {y}");
            x = (x * 1.618_033 + 0.577_215).fract();
        }
    }
}
