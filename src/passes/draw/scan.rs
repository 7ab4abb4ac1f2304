//! Prefix sum: each word of a buffer becomes the sum of the words before it, in place, and the total is written out.
//!
//! The words are taken in blocks of [`BLOCK_WORDS`], one workgroup each: the block sums are summed in the same way,
//! level by level until one block is left, and are then added back, level by level, as block offsets. No workgroup waits for another, so
//! no execution order is assumed, and core WebGPU is enough. Up to 2^11 words take one pass, up to 2^22
//! three, up to 2^33 five; each word is read twice and written once, and the block sums take another 1/2048 of the words.
//!
//! Cannot: sums of 2^32 or more, which wrap. After Harris, Sengupta & Owens, *Parallel prefix sum (scan) with CUDA* (2007).

use crate::plan::{Binding, Clock, Pass, Plan, Resource, ResourceId, Work};

/// Number of words summed by one workgroup; must match `shaders/lib/rasterise/scan.wgsl`.
pub const BLOCK_WORDS: u32 = 2048;

/// A prefix sum to record.
#[derive(Clone, Copy, Debug)]
pub struct Scan<'a> {
    /// Prefix of the pass names, unique in the plan.
    pub name: &'a str,
    /// Description of the summed values for the plan listing: "fragments of each pixel".
    pub what: &'a str,
    /// Clock of the passes.
    pub clock: Clock,
    /// The buffer whose words are summed in place.
    pub items: ResourceId,
    /// Range of the words.
    pub run: ScanRange,
    /// Destination of the total.
    pub total: Total,
}

/// The range of words to sum.
#[derive(Clone, Copy, Debug)]
pub struct ScanRange {
    /// Index of the first word.
    pub first: u32,
    /// Maximum number of words. Passes are dispatched for this many; workgroups beyond the actual count return at once.
    pub length: u32,
    /// Index of the buffer's word that holds the count, if the count is computed on the device.
    pub count_at: Option<u32>,
}

impl ScanRange {
    /// A known number of words from the start of the buffer.
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
    /// Into the first three words of a buffer, as the arguments of a dispatch of at least that many workgroups. Totals of
    /// 2^31 or more exceed what WebGPU dispatches.
    Groups(ResourceId),
}

impl Scan<'_> {
    /// Records the passes.
    pub fn record(&self, plan: &mut Plan) {
        // Block sums, sums of block sums, and so on.
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
                "the sum of each block",
                "passes/scan/sums.wgsl",
                vec![Binding::read("items", below), Binding::write("sums", sums)],
                blocks,
            );
            plan.add_pass(pass.with_constants(run.constants()));
            levels.push((sums, ScanRange::known(blocks)));
        }
        let top = levels.pop().unwrap_or((self.items, self.run));
        let (total, form) = match self.total {
            Total::Word(total, word) => (total, ("total_at", f64::from(word))),
            Total::Groups(total) => (total, ("as_groups", 1.0)),
        };
        let pass = self.pass(
            "scan".to_owned(),
            "the start of each block, and the total",
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
                "each block starts at the total of the blocks before it",
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
