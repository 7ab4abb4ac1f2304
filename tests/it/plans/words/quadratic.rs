//! `roots_in` against roots in f64.
//!
//! Bounds. Coefficients are zero or of a magnitude from 2^-50 to 2^50, where no square leaves f32. The discriminant errs by at
//! most 4 u (b² + 4 |ac|), each root is a square root and a quotient away from it, and so a root r has a residual
//! |p(r)| <= 16 u (|a| r² + |b| r + |c|): the bound that no formula in f32 can do much better than, for it is what rounding
//! the coefficients alone does. Clamping to the cell moves a root towards the true one, which lies inside. Where the
//! discriminant has not cancelled, the residual over the slope bounds the distance from the root in f64.

use crate::plans::words::{Random, U, answers, words_of};

const SEED: u64 = 0x0b11_1ea2;
/// Half of the residual's worst case in units of u: see above.
const RESIDUAL: f64 = 16.0 * U;

#[derive(Clone, Copy, Debug)]
struct Case {
    a: f32,
    b: f32,
    c: f32,
    length: f32,
    kept: bool,
    kept_at_exit: bool,
}

impl Case {
    fn p(&self, s: f64) -> f64 {
        f64::from(self.c) + s * (f64::from(self.b) + f64::from(self.a) * s)
    }

    /// What p(s) is a sum of.
    fn size(&self, s: f64) -> f64 {
        let [a, b, c] = [self.a, self.b, self.c].map(|x| f64::from(x).abs());
        a * s * s + b * s.abs() + c
    }

    fn slope(&self, s: f64) -> f64 {
        f64::from(self.b) + 2.0 * f64::from(self.a) * s
    }

    /// Whether the signs given are those of the polynomial beyond doubt.
    fn signs_are_true(&self) -> bool {
        let end = f64::from(self.length);
        let doubt = self.size(end) * 1e-14;
        let at_end = self.p(end);
        (self.c >= 0.0) == self.kept && (at_end >= 0.0) == self.kept_at_exit && at_end.abs() > doubt
    }

    /// Roots in 0..length, in f64, ascending.
    fn roots(&self) -> Vec<f64> {
        let [a, b, c] = [self.a, self.b, self.c].map(f64::from);
        let d = b * b - 4.0 * a * c;
        if d < 0.0 {
            return Vec::new();
        }
        let q = -0.5 * (b + b.signum() * d.sqrt());
        let mut roots: Vec<f64> = [(c, q), (q, a)]
            .into_iter()
            .filter(|(_, below)| *below != 0.0)
            .map(|(above, below)| above / below)
            .filter(|r| (0.0..=f64::from(self.length)).contains(r))
            .collect();
        roots.sort_by(f64::total_cmp);
        roots
    }

    fn is_well_conditioned(&self) -> bool {
        let [a, b, c] = [self.a, self.b, self.c].map(f64::from);
        b * b - 4.0 * a * c > (b * b + 4.0 * (a * c).abs()) / 1024.0
    }
}

/// Signs as they are, and every combination that a walk could carry in by rounding.
fn with_signs(random: &mut Random, cases: &mut Vec<Case>, [a, b, c, length]: [f32; 4]) {
    let mut case = Case {
        a,
        b,
        c,
        length,
        kept: c >= 0.0,
        kept_at_exit: false,
    };
    case.kept_at_exit = case.p(f64::from(length)) >= 0.0;
    cases.push(case);
    cases.push(Case {
        kept: random.bit(),
        kept_at_exit: random.bit(),
        ..case
    });
}

fn cases() -> Vec<Case> {
    let random = &mut Random(SEED);
    let mut cases = Vec::new();
    for _ in 0..2000 {
        let [a, b, c] = [random.signed(), random.signed(), random.signed()];
        let length = random.signed().abs() + 1e-3;
        let mut add = |random: &mut Random, abc: [f32; 3]| {
            with_signs(random, &mut cases, [abc[0], abc[1], abc[2], length]);
        };
        // Any cell; cells along a row of texels or without a twist; level at the entry; level throughout.
        for abc in [
            [a, b, c],
            [0.0, b, c],
            [-0.0, b, c],
            [a, 0.0, c],
            [a, b, 0.0],
            [a, b, -0.0],
        ] {
            add(random, abc);
        }
        for abc in [[0.0, 0.0, c], [a, 0.0, 0.0], [0.0, b, 0.0], [0.0; 3]] {
            add(random, abc);
        }
        // Almost flat, almost level.
        let tiny = random.scaled(-50, -20);
        for abc in [
            [tiny, b, c],
            [a, tiny, c],
            [a, b, tiny],
            [tiny, tiny, c],
            [tiny, b, tiny],
        ] {
            add(random, abc);
        }
        // A product of two heights along the ray, as on a saddle.
        let (y, dy) = (random.signed(), random.signed());
        add(random, [a * dy, a * y + c * dy, c * y]);
        // Touching zero inside the cell, to a few units in the last place.
        let at = length * random.signed().abs();
        for ulps in -2..=2_i32 {
            let c = a * at * at;
            let c = f32::from_bits(c.to_bits().wrapping_add_signed(ulps));
            add(random, [a, -2.0 * a * at, c]);
        }
        // Both roots inside, however close; one root at the exit, to a unit in the last place.
        let other = at + (length - at) * random.scaled(-20, 0).abs();
        add(random, [a, -a * (at + other), a * at * other]);
        add(random, [a, -a * (length + other), a * length * other]);
        add(random, [0.0, b, -b * length]);
        // Huge and small.
        let [a, b, c] = [(); 3].map(|()| random.scaled(-50, 50));
        with_signs(random, &mut cases, [a, b, c, random_length(length)]);
        with_signs(random, &mut cases, [a, b, c, 0.0]);
    }
    cases
}

/// Lengths from a thousandth of a unit to a thousand.
fn random_length(length: f32) -> f32 {
    length * length * 1e3
}

fn ask(roots_in: &str, cases: &[Case]) -> Vec<Vec<u32>> {
    let shader = format!(
        "{roots_in}
struct Case {{ a: f32, b: f32, c: f32, length: f32, kept: u32, kept_at_exit: u32 }}
@group(0) @binding(0) var<storage, read> cases: array<Case>;
@group(0) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if id.x >= arrayLength(&cases) {{ return; }}
    let x = cases[id.x];
    let roots = roots_in(x.a, x.b, x.c, x.length, x.kept != 0u, x.kept_at_exit != 0u);
    words[3u * id.x] = roots.count;
    words[3u * id.x + 1u] = bitcast<u32>(roots.at.x);
    words[3u * id.x + 2u] = bitcast<u32>(roots.at.y);
}}"
    );
    let rows: Vec<[u32; 6]> = cases
        .iter()
        .map(|x| {
            let [a, b, c, length] = [x.a, x.b, x.c, x.length].map(f32::to_bits);
            [
                a,
                b,
                c,
                length,
                u32::from(x.kept),
                u32::from(x.kept_at_exit),
            ]
        })
        .collect();
    answers(&shader, &[("cases", words_of(&rows))], cases.len(), 3)
}

/// What is wrong with an answer.
fn fault(case: &Case, answer: &[u32]) -> Option<String> {
    let count = answer[0];
    if count > 2 || (count == 1) != (case.kept != case.kept_at_exit) {
        return Some(format!("{count} roots contradict the signs"));
    }
    let end = f64::from(case.length);
    let roots: Vec<f64> = answer[1..=count as usize]
        .iter()
        .map(|w| f64::from(f32::from_bits(*w)))
        .collect();
    if let Some(r) = roots.iter().find(|r| !(0.0..=end).contains(*r)) {
        return Some(format!("{r} is outside the cell"));
    }
    if roots.windows(2).any(|w| w[0] > w[1]) {
        return Some(format!("{roots:?} are out of order"));
    }
    if !case.signs_are_true() {
        return None;
    }
    let is_root = |s: f64| case.p(s).abs() <= RESIDUAL * case.size(s);
    if let Some(r) = roots.iter().find(|r| !is_root(**r)) {
        return Some(format!("p({r}) = {} is no root", case.p(*r)));
    }
    let expected = case.roots();
    if count == 0 && expected.len() == 2 {
        // Only a graze within rounding may be missed.
        let vertex = 0.5 * (expected[0] + expected[1]);
        return (!is_root(vertex)).then(|| format!("the roots {expected:?} were missed"));
    }
    if case.is_well_conditioned() && expected.len() == roots.len() {
        for (r, e) in roots.iter().zip(&expected) {
            let bound = 2.0 * RESIDUAL * case.size(*e) / case.slope(*e).abs() + 1e-38;
            if (r - e).abs() > bound {
                return Some(format!("{r} should be {e}, to {bound}"));
            }
        }
    }
    None
}

fn faults(cases: &[Case], answers: &[Vec<u32>]) -> Vec<(Case, String)> {
    cases
        .iter()
        .zip(answers)
        .filter_map(|(case, answer)| Some((*case, fault(case, answer)?)))
        .collect()
}

const LIBRARY: &str = "#import cutaway::quadratic::roots_in";

#[test]
fn roots_are_found_by_signs_and_located_to_rounding() {
    let cases = cases();
    let given = ask(LIBRARY, &cases);
    let faults = faults(&cases, &given);
    assert!(
        faults.is_empty(),
        "{} of {}: {:#?}",
        faults.len(),
        cases.len(),
        &faults[..faults.len().min(8)]
    );
    // The cases are worth something only if every outcome occurs often.
    for count in 0..3 {
        let met = given
            .iter()
            .zip(&cases)
            .filter(|(g, c)| g[0] == count && c.signs_are_true())
            .count();
        assert!(met > 3000, "only {met} cases with {count} roots");
    }
}

/// The form of the textbooks, deciding by the same signs.
const TEXTBOOK: &str = "
struct Roots { count: u32, at: vec2<f32> }
fn roots_in(a: f32, b: f32, c: f32, length: f32, kept: bool, kept_at_exit: bool) -> Roots {
    let d = sqrt(max(b * b - 4.0 * a * c, 0.0));
    let plus = clamp((-b + d) / (2.0 * a), 0.0, length);
    let minus = clamp((-b - d) / (2.0 * a), 0.0, length);
    if kept != kept_at_exit {
        return Roots(1u, vec2<f32>(select(minus, plus, kept_at_exit)));
    }
    let vertex = -b / (2.0 * a);
    if vertex > 0.0 && vertex < length && (c + vertex * (b + a * vertex) >= 0.0) != kept {
        return Roots(2u, vec2<f32>(min(plus, minus), max(plus, minus)));
    }
    return Roots(0u, vec2<f32>(0.0));
}";

#[test]
fn the_textbook_form_fails_on_flat_cells() {
    let flat: Vec<Case> = cases()
        .into_iter()
        .filter(|c| c.a.abs() < 1e-9 && c.signs_are_true() && c.kept != c.kept_at_exit)
        .collect();
    assert!(flat.len() > 1000, "only {} flat cells", flat.len());
    let wrong = faults(&flat, &ask(TEXTBOOK, &flat)).len();
    assert!(
        wrong * 2 > flat.len(),
        "the textbook form failed on only {wrong} of {} flat cells",
        flat.len()
    );
    assert_eq!(
        faults(&flat, &ask(LIBRARY, &flat)).len(),
        0,
        "ours on the same cells"
    );
}

/// Roots in order, counted where they fall: no signs.
const BY_ROOTS: &str = "
struct Roots { count: u32, at: vec2<f32> }
fn roots_in(a: f32, b: f32, c: f32, length: f32, kept: bool, kept_at_exit: bool) -> Roots {
    let q = -0.5 * (b + select(-1.0, 1.0, b >= 0.0) * sqrt(max(b * b - 4.0 * a * c, 0.0)));
    let first = c / q;
    let second = q / a;
    var roots = Roots(0u, vec2<f32>(0.0));
    if first >= 0.0 && first <= length { roots = Roots(1u, vec2<f32>(first)); }
    if second >= 0.0 && second <= length {
        roots = Roots(roots.count + 1u, select(vec2<f32>(second), vec2<f32>(min(first, second), max(first, second)), roots.count == 1u));
    }
    return roots;
}";

#[test]
fn deciding_by_roots_breaks_the_parity() {
    let cases: Vec<Case> = cases().into_iter().filter(Case::signs_are_true).collect();
    let broken = faults(&cases, &ask(BY_ROOTS, &cases))
        .iter()
        .filter(|(_, fault)| fault.contains("contradict"))
        .count();
    assert!(broken > 10, "only {broken} contradictions");
}
