//! A second opinion on fills: how much of a straight line a region covers, from the loops by counting crossings along it, and
//! from the triangles by adding up.

use cutaway::scene::Fill;
use cutaway::slice::Section;
use glam::DVec2;

fn crossed(a: DVec2, b: DVec2, y: f64) -> Option<f64> {
    ((a.y > y) != (b.y > y)).then(|| a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)))
}

fn covered_by_loops(section: &Section, y: f64, rule: Fill) -> f64 {
    let mut crossings = Vec::new();
    for one in &section.loops {
        let at = |i: usize| section.points[one.points[i % one.points.len()] as usize];
        for i in 0..one.points.len() {
            let (a, b) = (at(i), at(i + 1));
            crossings.extend(crossed(a, b, y).map(|x| (x, if b.y > y { 1 } else { -1 })));
        }
    }
    crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut winding, mut covered) = (0, 0.0);
    for pair in crossings.windows(2) {
        winding += pair[0].1;
        if rule.holds(winding) {
            covered += pair[1].0 - pair[0].0;
        }
    }
    covered
}

fn covered_by_triangles(section: &Section, y: f64) -> f64 {
    let of_triangle = |t: usize| {
        let [a, b, c] = section.corners(t);
        let ends = [(a, b), (b, c), (c, a)].map(|(a, b)| crossed(a, b, y));
        let mut ends = ends.into_iter().flatten();
        match (ends.next(), ends.next()) {
            (Some(p), Some(q)) => (p - q).abs(),
            _ => 0.0,
        }
    };
    (0..section.triangles.len()).map(of_triangle).sum()
}

/// What is wrong with the triangles of a section, judged by its loops.
pub(crate) fn fault(section: &Section, rule: Fill) -> Option<String> {
    let low = section
        .points
        .iter()
        .fold(DVec2::INFINITY, |m, p| m.min(*p));
    let high = section
        .points
        .iter()
        .fold(DVec2::NEG_INFINITY, |m, p| m.max(*p));
    if section.points.is_empty() {
        return None;
    }
    let size = low.abs().max(high.abs()).max_element();
    let areas = (0..section.triangles.len()).map(|t| {
        let [a, b, c] = section.corners(t).map(|p| p / size);
        0.5 * (b - a).perp_dot(c - a)
    });
    let least = areas.clone().fold(0.0, f64::min);
    if least < -1e-13 {
        return Some(format!("a triangle of area {least}"));
    }
    let (sum, area) = (areas.sum::<f64>(), section.area() / size / size);
    if (sum - area).abs() > 1e-11 {
        return Some(format!("triangles of area {sum}, a boundary around {area}"));
    }
    // At no simple share, where whole edges may lie.
    for share in [0.017, 0.23, 0.377, 0.483, 0.618, 0.883] {
        let y = low.y + (high.y - low.y) * share;
        let by_loops = covered_by_loops(section, y, rule) / size;
        let by_triangles = covered_by_triangles(section, y) / size;
        if (by_loops - by_triangles).abs() > 1e-9 {
            return Some(format!(
                "at {share} the loops hold {by_loops}, the triangles {by_triangles}"
            ));
        }
    }
    None
}
