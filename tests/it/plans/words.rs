//! Words in, words out: the numeric WGSL functions that frames are drawn with, held against their definition in f64.
//!
//! Each check is a function of what the device answered, so that it can be given the answers of a planted wrong variant and
//! be required to fail. Outputs are poisoned before every run.

use std::sync::LazyLock;

use cutaway::gpu::{Gpu, POISON, run_words, run_words_with};

mod depths;
mod fixed_point;
mod height_filter;
mod lists;
mod normals;
mod pulses;
mod pyramid;
mod quadratic;
mod reliefs;
mod runs;
mod sides;
mod walk;
mod winding;

/// Half a unit in the last place of an f32 near 1: the relative error of one correctly rounded operation.
const U: f64 = 1.0 / (1 << 24) as f64;

static GPU: LazyLock<Gpu> = LazyLock::new(crate::common::gpu);

/// Runs a shader whose invocation `i` writes the words `per_case * i ..` of `words`; every one of them must be written.
fn answers(
    wgsl: &str,
    inputs: &[(&str, Vec<u32>)],
    cases: usize,
    per_case: usize,
) -> Vec<Vec<u32>> {
    answers_with(wgsl, &[], inputs, cases, per_case)
}

/// As [`answers`], with files that fill open modules.
fn answers_with(
    wgsl: &str,
    with: &[&str],
    inputs: &[(&str, Vec<u32>)],
    cases: usize,
    per_case: usize,
) -> Vec<Vec<u32>> {
    let words = run_words_with(&GPU, wgsl, with, inputs, &[], cases * per_case)
        .unwrap_or_else(|e| panic!("{e}\n{wgsl}"));
    if let Some(at) = words.iter().position(|w| *w == POISON) {
        panic!(
            "nobody wrote word {} of case {}",
            at % per_case,
            at / per_case
        );
    }
    words.chunks(per_case).map(<[u32]>::to_vec).collect()
}

/// The plain words of values.
fn words_of<T: bytemuck::NoUninit>(values: &[T]) -> Vec<u32> {
    bytemuck::pod_collect_to_vec(bytemuck::cast_slice::<T, u8>(values))
}

/// SplitMix64: the same numbers on every machine, from a seed with a name.
struct Random(u64);

impl Random {
    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: u32) -> u32 {
        (self.word() % u64::from(n)) as u32
    }

    fn bit(&mut self) -> bool {
        self.word() & 1 == 1
    }

    /// In -1..1, with all 24 bits.
    fn signed(&mut self) -> f32 {
        (self.word() >> 39) as f32 / (1 << 24) as f32 - 1.0
    }

    /// Of a magnitude between 2^low and 2^high, each power as likely as another, of either sign.
    fn scaled(&mut self, low: i32, high: i32) -> f32 {
        let exponent = low + self.below((high - low) as u32) as i32;
        (1.5 + 0.5 * self.signed()) * (exponent as f32).exp2() * if self.bit() { 1.0 } else { -1.0 }
    }
}

#[test]
fn a_word_that_nobody_wrote_is_poisoned() {
    let half = "@group(0) @binding(0) var<storage, read_write> words: array<u32>;\n\
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3<u32>) {\n\
            if id.x % 2u == 0u && id.x < arrayLength(&words) { words[id.x] = 0u; } }";
    let words = run_words(&GPU, half, &[], 100).unwrap_or_else(|e| panic!("{e}"));
    for (i, word) in words.iter().enumerate() {
        assert_eq!(*word, if i % 2 == 0 { 0 } else { POISON }, "word {i}");
    }
}

#[test]
fn inputs_that_do_not_fit_the_shader_are_refused() {
    let shader = "@group(0) @binding(0) var<storage, read_write> words: array<u32>;\n\
        @group(0) @binding(1) var<storage, read> given: array<u32>;\n\
        @compute @workgroup_size(1) fn main() { words[0] = given[0]; }";
    for (inputs, phrase) in [
        (vec![], "`given` is given no words"),
        (
            vec![("given", vec![1]), ("other", vec![1])],
            "reads no `other`",
        ),
    ] {
        let refusal = run_words(&GPU, shader, &inputs, 1).expect_err(phrase);
        assert!(refusal.to_string().contains(phrase), "{refusal}");
    }
}
