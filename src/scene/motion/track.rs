//! Tracks: values interpolated over time between keys, like glTF's animation samplers.
//!
//! Before its first key a track has the first value, after its last key the last one. In between it is constant, linear, or a
//! cubic Hermite spline. Linear rotations follow the shorter arc at constant speed; splines of rotations are normalised.
//! Where such a spline passes through zero it defines no rotation, and the previous key's value is kept. The caller that
//! chooses the time decides whether a motion repeats. Cost: a binary search for the adjacent keys.

use glam::{DQuat, DVec3};

/// Interpolation of a track between keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Keeps the value until the next key.
    Step,
    /// Interpolates linearly to the next key.
    Straight,
    /// Cubic spline: every key has an in-tangent, its value and an out-tangent, in that order.
    Cubic,
}

/// Type of the values of a track.
pub trait Interpolated: Clone {
    /// Sum of values multiplied by factors.
    fn sum(terms: &[(f64, &Self)]) -> Self;

    /// Interpolates between two values; `share` is from 0 to 1.
    fn between(a: &Self, b: &Self, share: f64) -> Self {
        Self::sum(&[(1.0 - share, a), (share, b)])
    }

    /// The value made valid for use (a rotation is normalised); `otherwise` if that is impossible.
    fn preclassified(self, otherwise: &Self) -> Self {
        let _ = otherwise;
        self
    }

    /// Returns true if all its numbers are finite.
    fn is_finite(&self) -> bool;

    /// Returns the reason if the value cannot be that of a key; finiteness is checked separately.
    fn fault(&self) -> Option<&'static str> {
        None
    }
}

impl Interpolated for DVec3 {
    fn sum(terms: &[(f64, &Self)]) -> Self {
        terms.iter().map(|(f, v)| **v * *f).sum()
    }

    fn is_finite(&self) -> bool {
        Self::is_finite(*self)
    }
}

/// Weights of morph targets.
impl Interpolated for Vec<f64> {
    fn sum(terms: &[(f64, &Self)]) -> Self {
        let width = terms.first().map_or(0, |(_, v)| v.len());
        let at = |i| terms.iter().map(|(f, v)| f * v[i]).sum();
        (0..width).map(at).collect()
    }

    fn is_finite(&self) -> bool {
        self.iter().all(|v| v.is_finite())
    }
}

/// A quaternion shorter than this no longer defines a rotation.
const SHORTEST_ROTATION: f64 = 1e-6;

impl Interpolated for DQuat {
    fn sum(terms: &[(f64, &Self)]) -> Self {
        let zero = Self::from_xyzw(0.0, 0.0, 0.0, 0.0);
        terms.iter().fold(zero, |sum, (f, v)| sum + **v * *f)
    }

    fn between(a: &Self, b: &Self, share: f64) -> Self {
        let b = if a.dot(*b) < 0.0 { -*b } else { *b };
        // Accurate for angles of any size, unlike the arc cosine of the dot product, which loses small ones.
        let angle = 2.0 * (b - *a).length().atan2((b + *a).length());
        let whole = angle.sin();
        if whole <= f64::MIN_POSITIVE {
            return *a;
        }
        let part = |share: f64| (share * angle).sin() / whole;
        (*a * part(1.0 - share) + b * part(share)).preclassified(a)
    }

    fn preclassified(self, otherwise: &Self) -> Self {
        match self.fault() {
            None => self.normalize(),
            Some(_) => *otherwise,
        }
    }

    fn is_finite(&self) -> bool {
        Self::is_finite(*self)
    }

    fn fault(&self) -> Option<&'static str> {
        // Written so that NaN is a fault, too.
        let is_long = self.length() > SHORTEST_ROTATION;
        (!is_long).then_some("is a rotation of length 0")
    }
}

/// Keys and the interpolation between them.
#[derive(Clone, Debug)]
pub struct Track<V> {
    /// Key times, ascending, at least one.
    times_s: Vec<f64>,
    way: Way,
    /// One value per key, or three per key of a cubic track.
    values: Vec<V>,
}

impl<V: Interpolated> Track<V> {
    /// Checks the data of a file; the error states the defect.
    pub fn new(times_s: Vec<f64>, way: Way, mut values: Vec<V>) -> Result<Self, String> {
        let per_key = if way == Way::Cubic { 3 } else { 1 };
        if times_s.is_empty() || values.len() != per_key * times_s.len() {
            return Err(format!(
                "{} values for {} keys",
                values.len(),
                times_s.len()
            ));
        }
        if let Some(key) = times_s.iter().position(|t| !t.is_finite() || *t < 0.0) {
            return Err(format!("the time of key {key} is {}", times_s[key]));
        }
        if let Some(key) = times_s.windows(2).position(|w| w[0] >= w[1]) {
            let (a, b) = (times_s[key], times_s[key + 1]);
            return Err(format!("times do not ascend: {a} s, then {b} s"));
        }
        if let Some(bad) = values.iter().position(|v| !v.is_finite()) {
            return Err(format!(
                "key {} has a value that is not finite",
                bad / per_key
            ));
        }
        for key in 0..times_s.len() {
            let value = &mut values[per_key * key + per_key / 2];
            if let Some(fault) = value.fault() {
                return Err(format!("key {key} {fault}"));
            }
            if way != Way::Cubic {
                let preclassified = value.clone().preclassified(value);
                *value = preclassified;
            }
        }
        Ok(Self {
            times_s,
            way,
            values,
        })
    }

    /// Time of the last key.
    pub fn end_s(&self) -> f64 {
        self.times_s.last().copied().unwrap_or_default()
    }

    /// Times and values of the keys.
    pub fn keys(&self) -> impl Iterator<Item = (f64, &V)> {
        (self.times_s.iter().enumerate()).map(|(key, time_s)| (*time_s, self.value(key)))
    }

    fn value(&self, key: usize) -> &V {
        match self.way {
            Way::Cubic => &self.values[3 * key + 1],
            Way::Step | Way::Straight => &self.values[key],
        }
    }

    /// The value at a time.
    pub(crate) fn at(&self, time_s: f64) -> V {
        let next = self.times_s.partition_point(|t| *t <= time_s);
        let key = next.saturating_sub(1);
        let value = self.value(key);
        if next == 0 || next == self.times_s.len() {
            return value.clone().preclassified(value);
        }
        let step_s = self.times_s[next] - self.times_s[key];
        let share = (time_s - self.times_s[key]) / step_s;
        match self.way {
            Way::Step => value.clone(),
            Way::Straight => V::between(value, self.value(next), share),
            Way::Cubic => {
                let (two, three) = (share.powi(2), share.powi(3));
                let (out, into) = (&self.values[3 * key + 2], &self.values[3 * next]);
                V::sum(&[
                    (2.0 * three - 3.0 * two + 1.0, value),
                    ((three - 2.0 * two + share) * step_s, out),
                    (3.0 * two - 2.0 * three, self.value(next)),
                    ((three - two) * step_s, into),
                ])
                .preclassified(value)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shorter_arc_is_taken_at_constant_speed() {
        let turn = |degrees: f64| DQuat::from_rotation_z(degrees.to_radians());
        for (a, b) in [(turn(10.0), turn(80.0)), (turn(10.0), -turn(80.0))] {
            for share in [0.0, 0.1, 0.5, 0.9, 1.0] {
                let wanted = turn(10.0 + 70.0 * share);
                let is = DQuat::between(&a, &b, share);
                assert!(is.dot(wanted).abs() > 1.0 - 1e-15, "{is} at {share}");
            }
        }
        // An angle so small that its cosine rounds to 1.
        let small = DQuat::between(&turn(0.0), &turn(1e-7), 0.25);
        assert!((small.z / turn(1e-7).z - 0.25).abs() < 1e-9);
        assert_eq!(DQuat::between(&turn(5.0), &turn(5.0), 0.5), turn(5.0));
    }

    #[test]
    fn a_spline_through_zero_keeps_its_key() {
        let still = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        let keys = vec![
            still,
            DQuat::IDENTITY,
            still,
            still,
            -DQuat::IDENTITY,
            still,
        ];
        let track = Track::new(vec![0.0, 1.0], Way::Cubic, keys).expect("a track");
        assert_eq!(track.at(0.5), DQuat::IDENTITY);
    }

    #[test]
    fn faults_are_told_apart() {
        let said = |times: &[f64], values: &[f64]| {
            let values = values.iter().map(|v| DVec3::splat(*v)).collect();
            match Track::new(times.to_vec(), Way::Straight, values) {
                Ok(_) => String::new(),
                Err(why) => why,
            }
        };
        assert_eq!(said(&[0.0, 1.0], &[1.0, 2.0]), "");
        assert!(said(&[0.0, 1.0], &[1.0]).contains("1 values for 2 keys"));
        assert!(said(&[], &[]).contains("0 keys"));
        assert!(said(&[0.0, 0.0], &[1.0, 2.0]).contains("do not ascend"));
        assert!(said(&[0.0, f64::NAN], &[1.0, 2.0]).contains("NaN"));
        assert!(said(&[0.0, 1.0], &[1.0, f64::INFINITY]).contains("not finite"));
        let zero = vec![DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0)];
        let why = Track::new(vec![0.0], Way::Step, zero).map(|_| ());
        assert!(why.is_err_and(|why| why.contains("length 0")));
    }
}
