//! The prefix sum against the sum: lengths about its blocks and its levels.

use cutaway::gpu::{ClockSet, Program};
use cutaway::passes::{BLOCK_WORDS, Scan, ScanRange, Total};
use cutaway::plan::{BufferRole, Clock, Contents, Plan, Resource};

use crate::common::numbers::Numbers;
use crate::common::session;

fn plan_of(values: &[u32]) -> Plan {
    let mut plan = Plan::default();
    let contents = Contents::from_values(values);
    let items = plan.add_resource(Resource::upload(
        "items",
        BufferRole::Storage,
        contents,
        Clock::Frame,
    ));
    let total = plan.add_resource(Resource::storage("total", 8, Clock::Frame));
    plan.need = Some(total);
    Scan {
        name: "test",
        what: "values",
        clock: Clock::Frame,
        items,
        run: ScanRange::known(values.len() as u32),
        total: Total::Word(total, 1),
    }
    .record(&mut plan);
    plan
}

/// What the device makes of a plan: the sums, and the total.
fn run(plan: Plan) -> (Vec<u32>, u32) {
    let session = session();
    let gpu = session.gpu();
    let mut program = Program::default();
    program.load(gpu, plan).unwrap_or_else(|e| panic!("{e}"));
    program
        .run(gpu, ClockSet::ALL)
        .unwrap_or_else(|e| panic!("{e}"));
    let words = |name| program.words(gpu, name).unwrap_or_else(|e| panic!("{e}"));
    (words("items"), words("total")[1])
}

/// The first sum that is not that of the values before it.
fn fault(values: &[u32], (sums, total): &(Vec<u32>, u32)) -> Option<String> {
    let mut expected = 0_u64;
    for (i, (value, sum)) in values.iter().zip(sums).enumerate() {
        if u64::from(*sum) != expected {
            return Some(format!("sum {i} is {sum}, not {expected}"));
        }
        expected += u64::from(*value);
    }
    (u64::from(*total) != expected).then(|| format!("the total is {total}, not {expected}"))
}

/// Values whose sum stays below 2^32, a third of them 0.
fn values(length: usize, seed: u64) -> Vec<u32> {
    let mut numbers = Numbers(seed);
    let most = (u64::from(u32::MAX) / length as u64).min(1 << 20);
    (0..length)
        .map(|_| match numbers.below(3) {
            0 => 0,
            _ => numbers.below(most) as u32,
        })
        .collect()
}

#[test]
fn sums_are_exact_about_every_block_and_level() {
    let block = BLOCK_WORDS as usize;
    let mut lengths = vec![1, 2, 7, 8, 9, 255, 256, 257, 3 * block + 1000];
    for power in [block / 2, block, 2 * block, block * block] {
        lengths.extend([power - 1, power, power + 1]);
    }
    for (i, length) in lengths.into_iter().enumerate() {
        let values = values(length, i as u64);
        let answered = run(plan_of(&values));
        assert_eq!(fault(&values, &answered), None, "{length} words");
    }
    for (value, length) in [(0, 5000), (1, 5000), (u32::MAX, 1), (u32::MAX / 4097, 4097)] {
        let values = vec![value; length];
        let answered = run(plan_of(&values));
        assert_eq!(fault(&values, &answered), None, "{length} times {value}");
    }
}

#[test]
fn a_level_more_is_two_passes_more() {
    let names = |length: usize| {
        let plan = plan_of(&vec![1; length]);
        plan.passes.len()
    };
    let block = BLOCK_WORDS as usize;
    assert_eq!(names(1), 1, "one word");
    assert_eq!(names(block), 1, "a block");
    assert_eq!(names(block + 1), 3, "a word more");
    assert_eq!(names(block * block), 3, "a block of blocks");
    assert_eq!(names(block * block + 1), 5, "a word more");
}

#[test]
fn a_sum_that_misses_a_step_is_noticed() {
    let values = values(3 * BLOCK_WORDS as usize, 77);
    let mut plan = plan_of(&values);
    let last = plan.passes.len() - 1;
    plan.passes[last].constants[0].1 -= 1.0;
    assert!(
        fault(&values, &run(plan)).is_some(),
        "a word left as it was"
    );
    let mut plan = plan_of(&values);
    plan.passes.swap(0, 1);
    // What is summed before it is there would be refused; an empty buffer stands for it.
    plan.resources[2].contents = Some(Contents::from_values(&[0_u32; 3]));
    assert!(fault(&values, &run(plan)).is_some(), "blocks out of order");
}
