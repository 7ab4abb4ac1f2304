//! The kept height `F` of a relief along a ray within one cell, as a function of the depth.

/// `F(start + s) = a s^2 + b s + c` over `0..length`.
pub(super) struct Quadratic {
    pub(super) a: f64,
    pub(super) b: f64,
    pub(super) c: f64,
    pub(super) length: f64,
}

impl Quadratic {
    pub(super) fn at(&self, s: f64) -> f64 {
        self.c + s * (self.b + s * self.a)
    }

    /// Both roots, the smaller first, by `c / q` and `q / a`, which avoid division by a small number.
    pub(super) fn roots(&self) -> [f64; 2] {
        let root = (self.b * self.b - 4.0 * self.a * self.c).max(0.0).sqrt();
        let q = -0.5 * (self.b + root.copysign(self.b));
        let (r, s) = (self.c / q, q / self.a);
        // A double root at 0 gives 0 / 0.
        let [r, s] = [r, s].map(|x| if x.is_nan() { 0.0 } else { x });
        [r.min(s), r.max(s)]
    }

    /// The root, if the signs at the two ends differ.
    pub(super) fn crossing(&self) -> f64 {
        let miss = |r: f64| (r - r.clamp(0.0, self.length)).abs();
        let [r, s] = self.roots();
        let best = if miss(r) <= miss(s) { r } else { s };
        best.clamp(0.0, self.length)
    }
}

#[cfg(test)]
mod tests {
    use super::Quadratic;

    #[test]
    fn roots_survive_a_vanishing_square_term() {
        for a in [0.0, 1e-300, 1e-17, -1e-17, 1e-9] {
            let f = Quadratic {
                a,
                b: 2.0,
                c: -1.0,
                length: 1.0,
            };
            let r = f.crossing();
            assert!((r - 0.5).abs() < 1e-9, "root {r} for a = {a}");
        }
    }

    #[test]
    fn roots_are_those_of_the_factors() {
        for (r, s) in [(0.25, 0.75), (0.0, 0.5), (0.5, 0.5), (1e-12, 1.0)] {
            let f = Quadratic {
                a: -3.0,
                b: 3.0 * (r + s),
                c: -3.0 * r * s,
                length: 1.0,
            };
            let found = f.roots();
            assert!(
                (found[0] - r).abs() < 1e-9 && (found[1] - s).abs() < 1e-9,
                "{found:?} for {r}, {s}"
            );
        }
    }
}
