//! Prefix sum: each word of a buffer becomes the sum of the words before it, in place, and the total is written out.
//!
//! The words are taken in blocks of [`BLOCK_WORDS`], one workgroup each: the sums of the blocks are summed in the same way,
//! level by level until one block is left, and go back down as where each block begins. No workgroup waits for another, so
//! nothing is assumed of the order in which they run, and core WebGPU is enough. Up to 2^11 words are one pass, up to 2^22
//! three, up to 2^33 five; each word is read twice and written once, and the block sums take another 1/2048 of the words.
//!
//! Cannot: sums from 2^32 on, which wrap. After Harris, Sengupta & Owens, *Parallel prefix sum (scan) with CUDA* (2007).

use crate::plan::{Binding, Clock, Pass, Plan, Resource, ResourceId, Work};

/// Words that a workgroup sums: `shaders/lib/rasterise/scan.wgsl`.
pub const BLOCK_WORDS: u32 = 2048;

/// A prefix sum to be recorded.
#[derive(Clone, Copy, Debug)]
pub struct Scan<'a> {
    /// Prefix of the pass names, unique in the plan.
    pub name: &'a str,
    /// Description of the summed values for the plan listing: "fragments of each pixel".
    pub what: &'a str,
    /// When.
    pub clock: Clock,
    /// The buffer whose words are summed in place.
    pub items: ResourceId,
    /// Range of the words.
    pub run: Run,
    /// Destination of the total.
    pub total: Total,
}

/// The words of a buffer that are summed.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// The first of them.
    pub first: u32,
    /// Largest number of words. Passes are dispatched for all of them; blocks beyond the count end at once.
    pub length: u32,
    /// Word of the buffer that gives the count, where it is found on the device.
    pub count_at: Option<u32>,
}

impl Run {
    /// The first words of a buffer, of a count known beforehand.
    pub fn known(length: u32) -> Self {
        Self {
            first: 0,
            length,
            count_at: None,
        }
    }

    fn constants(&self) -> Vec<(&'static str, f64)> {
        let mut all = vec![("length", f64::from(self.length))];
        if let Some(word) = self.count_at {
            all.push(("count_at", f64::from(word)));
        }
        if self.first > 0 {
            all.push(("first", f64::from(self.first)));
        }
        all
    }
}

/// Destination of the total of a prefix sum.
#[derive(Clone, Copy, Debug)]
pub enum Total {
    /// Into one word of a buffer.
    Word(ResourceId, u32),
    /// Into the first three words of a buffer, as the arguments of a dispatch of that many workgroups, or a few more. Totals from
    /// 2^31 on are more than WebGPU dispatches.
    Groups(ResourceId),
}

impl Scan<'_> {
    /// Records the passes.
    pub fn record(&self, plan: &mut Plan) {
        // Sums of blocks, of blocks of sums, and so on.
        let mut levels = vec![(self.items, self.run)];
        while let Some((below, run)) = levels.last().copied()
            && run.length > BLOCK_WORDS
        {
            let level = levels.len();
            let blocks = run.length.div_ceil(BLOCK_WORDS);
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
            plan.add_pass(pass.with_constants(run.constants()));
            levels.push((sums, Run::known(blocks)));
        }
        let top = levels.pop().unwrap_or((self.items, self.run));
        let (total, form) = match self.total {
            Total::Word(total, word) => (total, ("total_at", f64::from(word))),
            Total::Groups(total) => (total, ("as_groups", 1.0)),
        };
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
        let mut constants = top.1.constants();
        constants.push(form);
        plan.add_pass(pass.with_constants(constants));
        let mut sums = top.0;
        while let Some((items, run)) = levels.pop() {
            let pass = self.pass(
                format!("spread {}", levels.len() + 1),
                "each block begins where those before it end",
                "passes/scan/blocks.wgsl",
                vec![Binding::update("items", items), Binding::read("sums", sums)],
                run.length.div_ceil(BLOCK_WORDS),
            );
            plan.add_pass(pass.with_constants(run.constants()));
            sums = items;
        }
    }

    /// A pass with a given number of workgroups.
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
