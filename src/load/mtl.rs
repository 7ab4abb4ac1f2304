//! The colours of a Wavefront material library; everything else in it is passed over.

use glam::Vec3;

/// Names and `Kd` colours, as sRGB in 0..=1. A colour that does not parse leaves its material without one.
pub(super) fn colors(text: &str) -> Vec<(String, Option<Vec3>)> {
    let mut all: Vec<(String, Option<Vec3>)> = Vec::new();
    for line in text.lines().map(str::trim) {
        if let Some(name) = line.strip_prefix("newmtl") {
            all.push((name.trim().to_owned(), None));
        } else if let Some(rest) = line.strip_prefix("Kd ")
            && let Some((_, color)) = all.last_mut()
        {
            let parsed: Vec<f32> = rest
                .split_whitespace()
                .map_while(|w| w.parse().ok())
                .collect();
            // A single number stands for all three channels.
            *color = match parsed.as_slice() {
                [r, g, b, ..] => Some(Vec3::new(*r, *g, *b)),
                [grey] => Some(Vec3::splat(*grey)),
                _ => None,
            }
            .filter(|c| c.is_finite())
            .map(|c| c.clamp(Vec3::ZERO, Vec3::ONE));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_read_and_odd_ones_survive() {
        let text = "newmtl red steel\n  Kd 1 0.25 0\nnewmtl grey\nKd 0.5\nnewmtl odd\nKd spectral x\nKa 1 1 1\n";
        let all = colors(text);
        assert_eq!(
            all[0],
            ("red steel".to_owned(), Some(Vec3::new(1.0, 0.25, 0.0)))
        );
        assert_eq!(all[1].1, Some(Vec3::splat(0.5)));
        assert_eq!(all[2].1, None);
    }
}
