//! Prefix sum: each word of a buffer becomes the sum of the words before it, in place, and the total is written out.
//!
//! The words are taken in blocks of [`BLOCK_WORDS`], one workgroup each: the sums of the blocks are summed in the same way,
//! level by level until one block is left, and go back down as where each block begins. No workgroup waits for another, so
//! nothing is assumed of the order in which they run, and core WebGPU is enough. Up to 2^11 words are one pass, up to 2^22
//! three, up to 2^33 five; each word is read twice and written once, and there are 1/2048 words beside them.
//!
//! Cannot: sums from 2^32 on, which wrap. After Harris, Sengupta & Owens, *Parallel prefix sum (scan) with CUDA* (2007).

use crate::plan::{Binding, Clock, Pass, Plan, Resource, ResourceId, Work};

/// Words that a workgroup sums: `shaders/lib/scan.wgsl`.
pub const BLOCK_WORDS: u32 = 2048;

/// A prefix sum to be recorded.
#[derive(Clone, Copy, Debug)]
pub struct Scan<'a> {
    /// What the passes are named after, unique in the plan.
    pub name: &'a str,
    /// What is summed, for the reader of the plan: "fragments of each pixel".
    pub what: &'a str,
    /// When.
    pub clock: Clock,
    /// The buffer whose first words are summed in place.
    pub items: ResourceId,
    /// How many words.
    pub length: u32,
    /// Buffer and word that the total goes to.
    pub total: (ResourceId, u32),
}

impl Scan<'_> {
    /// Records the passes.
    pub fn record(&self, plan: &mut Plan) {
        // Sums of blocks, of blocks of sums, and so on.
        let mut levels = vec![(self.items, self.length)];
        while let Some((below, length)) = levels.last().copied()
            && length > BLOCK_WORDS
        {
            let level = levels.len();
            let blocks = length.div_ceil(BLOCK_WORDS);
            let sums = plan.add_resource(Resource::storage(
                format!("{} sums {level}", self.name),
                u64::from(blocks) * 4,
                self.clock,
            ));
            let pass = self.pass(
                format!("sum {level}"),
                "what each block adds up to",
                "passes/scan/sums.wgsl",
                vec![Binding::read("items", below), Binding::write("sums", sums)],
                blocks,
            );
            plan.add_pass(pass.with_constants(vec![("length", f64::from(length))]));
            levels.push((sums, blocks));
        }
        let top = levels.pop().unwrap_or((self.items, self.length));
        let (total, word) = self.total;
        let pass = self.pass(
            "scan".to_owned(),
            "where each begins, and how many there are",
            "passes/scan/top.wgsl",
            vec![
                Binding::update("items", top.0),
                Binding::write("total", total),
            ],
            1,
        );
        let constants = vec![("length", f64::from(top.1)), ("total_at", f64::from(word))];
        plan.add_pass(pass.with_constants(constants));
        let mut sums = top.0;
        while let Some((items, length)) = levels.pop() {
            let pass = self.pass(
                format!("spread {}", levels.len() + 1),
                "each block begins where those before it end",
                "passes/scan/blocks.wgsl",
                vec![Binding::update("items", items), Binding::read("sums", sums)],
                length.div_ceil(BLOCK_WORDS),
            );
            plan.add_pass(pass.with_constants(vec![("length", f64::from(length))]));
            sums = items;
        }
    }

    /// A pass of so many workgroups.
    fn pass(
        &self,
        name: String,
        reason: &str,
        shader: &'static str,
        bindings: Vec<Binding>,
        blocks: u32,
    ) -> Pass {
        let pass = Pass::new(
            format!("{} {name}", self.name),
            format!("{}: {reason}", self.what),
            shader,
            bindings,
            Work::Compute {
                groups: [blocks.max(1), 1, 1],
            },
        );
        pass.on(self.clock)
    }
}
