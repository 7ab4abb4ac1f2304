//! `doctor`: lists the adapters and the features of the chosen one, and tests the claims about exact strategies on it.
//!
//! The self-test has a budget of [`SELF_TEST_S`] seconds. It draws small pictures of the [hard cases](cutaway_lab::hard_cases), then
//! of random scenes, with each exact strategy on each rasteriser, and prints how many it completed. A wrong result is a fault of the
//! adapter's driver or of this program; please report it with the complete output.
//!
//! Limit: the self-test cannot prove correctness. A table without faults means that none was found in N pictures of 64 px.

use clap::Args;
use cutaway::gpu::Gpu;
use cutaway::session::{Outcome, Session};
use cutaway::strategies::Method;
use cutaway::{Error, Result};
use cutaway_lab::experiment::Stopwatch;
use cutaway_lab::hard_cases::{CaseSelection, found, list, random};
use cutaway_lab::report::TextTable;
use serde::Serialize;
use serde_json::json;

use crate::console::{Console, ConsoleArgs};
use crate::input::args::AdapterArgs;
use crate::verdict::Verdict;
use crate::writing::output::{Output, write_stdout};

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway doctor
  cutaway doctor --adapter llvmpipe --json doctor.json

Include the output in every bug report. Exit code 1: a claim about a strategy does not hold on this adapter.";

/// Time budget of the self-test in seconds; when it is used up, the picture in progress is still completed.
const SELF_TEST_S: f64 = 20.0;
/// Part of the budget for hard cases, in seconds.
const CASES_S: f64 = 12.0;
/// Side lengths of the hard cases' pictures.
const SIDE_PX: u32 = 64;
/// Maximum number of faults per strategy in random scenes: further faults add no information.
const MOST_FAULTS: usize = 5;
/// Seed of the random scenes, fixed so that two reports are comparable.
const SEED: u64 = 34;
/// The strategies claimed to be exact, with each rasteriser that draws them.
const EXACT: [&str; 8] = [
    "raycast+mask@hardware",
    "raycast+mask@compute",
    "raycast+abuffer@hardware",
    "raycast+abuffer@compute",
    "raycast+stencil",
    "stencil",
    "planar",
    "planar@compute",
];

/// Options of `doctor`.
#[derive(Args)]
pub(crate) struct DoctorArgs {
    /// The same as JSON; `-` prints it instead of the text
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    #[command(flatten)]
    adapter: AdapterArgs,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Self-test result of a strategy.
#[derive(Clone, Debug, Default, Serialize)]
struct Examined {
    /// Name of the strategy, with the rasteriser.
    strategy: String,
    /// Number of hard cases with the expected result.
    cases: usize,
    /// Number of random scenes drawn.
    scenes: usize,
    /// Deviations from the claims; at most one per hard case.
    faults: Vec<String>,
}

/// Runs `doctor`.
pub(crate) fn run(args: &DoctorArgs) -> Result<Verdict> {
    let json = (args.json.as_ref()).map(|v| Output::checked("--json", v, &[]));
    let json = json.transpose()?;
    let adapters = Gpu::adapters();
    let mut session = args.adapter.session(false)?;
    let gpu = session.gpu();
    let can = [
        ("timestamps", gpu.has_timestamps()),
        ("64-bit atomics", gpu.limits().wide_atomics),
        ("32-bit depth-stencil format", gpu.limits().depth32_stencil8),
        ("f32 heights through a sampler", gpu.limits().filters_f32),
    ];
    let is_text = json != Some(Output::Stdout);
    if is_text {
        // Printed before the self-test, which may crash a driver.
        write_stdout(about(&adapters, gpu, &can).as_bytes())?;
    }
    let console = Console::new(args.console, list().count());
    let (examined, took_s) = examine(&mut session, &console)?;
    if let Some(output) = &json {
        let gpu = session.gpu();
        let report = json!({
            "version": env!("CARGO_PKG_VERSION"),
            "adapters": adapters,
            "adapter": gpu.report(),
            "can": can.iter().copied().collect::<std::collections::BTreeMap<_, _>>(),
            "limits": gpu.limits().by_name(),
            "self_test_s": took_s,
            "strategies": examined,
        });
        output.write(format!("{report:#}\n").as_bytes())?;
    }
    if is_text {
        let table = table_of(&examined).to_text();
        write_stdout(format!("\nself-test, {took_s:.0} s:\n{table}").as_bytes())?;
    }
    let mut verdict = Verdict::Done;
    for examined in &examined {
        for fault in &examined.faults {
            console.failed(format!("{}: {fault}", examined.strategy));
            verdict = Verdict::Failed;
        }
    }
    Ok(verdict)
}

/// The adapters, the chosen one and its features.
fn about(adapters: &[String], gpu: &Gpu, can: &[(&str, bool)]) -> String {
    let report = gpu.report();
    let chosen = report.in_words();
    let bits = (report.sub_pixel_bits).map_or("unknown".to_owned(), |bits| bits.to_string());
    let mut text = format!("cutaway {}\n\nadapters:\n", env!("CARGO_PKG_VERSION"));
    for name in adapters {
        let mark = if *name == chosen { '*' } else { ' ' };
        text.push_str(&format!("{mark} {name}\n"));
    }
    text.push_str(&format!("\nsub-pixel bits: {bits}\n"));
    for (what, has) in can {
        text.push_str(&format!("{what}: {}\n", if *has { "yes" } else { "no" }));
    }
    for (name, limit) in gpu.limits().by_name() {
        text.push_str(&format!("{name}: {limit}\n"));
    }
    text
}

fn table_of(examined: &[Examined]) -> TextTable {
    let mut table = TextTable::new(["strategy", "hard cases", "random scenes", "verdict"]);
    for e in examined {
        let verdict = match (e.faults.len(), e.cases + e.scenes) {
            (0, 0) => "not tried".to_owned(),
            (0, _) => "as claimed here".to_owned(),
            (1, _) => "not as claimed here: 1 fault".to_owned(),
            (count, _) => format!("not as claimed here: {count} faults"),
        };
        let [cases, scenes] = [e.cases, e.scenes].map(|n| n.to_string());
        table.row([e.strategy.clone(), cases, scenes, verdict]);
    }
    table
}

/// Runs as many tests as the budget allows.
fn examine(session: &mut Session, console: &Console) -> Result<(Vec<Examined>, f64)> {
    let watch = Stopwatch::start();
    let is_before = |seconds: f64| watch.ms() < seconds * 1e3;
    let methods = EXACT.iter().map(|name| name.parse::<Method>());
    let methods = methods.collect::<std::result::Result<Vec<_>, Error>>()?;
    let mut all: Vec<Examined> = (methods.iter())
        .map(|method| Examined {
            strategy: method.to_string(),
            ..Examined::default()
        })
        .collect();
    for listed in list() {
        if !is_before(CASES_S) {
            break;
        }
        let asked = CaseSelection {
            ids: std::slice::from_ref(&listed.id),
            sizes_px: &[SIDE_PX],
            methods: Some(&methods),
        };
        let cases = found(session, &asked, &mut |what| console.step(what), &|| {
            is_before(SELF_TEST_S)
        })?;
        for (case, reached) in
            (cases.iter().flatten()).flat_map(|c| c.reached.iter().map(move |r| (c, r)))
        {
            let Some(examined) = all.iter_mut().find(|e| e.strategy == reached.strategy) else {
                continue;
            };
            match reached.holds {
                true => examined.cases += 1,
                false => examined.faults.push(format!(
                    "hard case {} ({}): {} is expected, found: {}",
                    case.id, case.name, reached.expected, reached.found
                )),
            }
        }
    }
    for scene in 0.. {
        if !is_before(SELF_TEST_S) {
            break;
        }
        let recipe = random::recipe(SEED, scene);
        let question = recipe.question();
        for (method, examined) in methods.iter().zip(&mut all) {
            if !is_before(SELF_TEST_S) {
                break;
            }
            let judged = question.answer(session, method)?;
            examined.scenes += usize::from(judged.outcome == Outcome::Complete);
            let fault = random::fault(&question, &judged, method);
            if let Some(what) = fault.filter(|_| examined.faults.len() < MOST_FAULTS) {
                (examined.faults).push(format!("random scene {scene}: {what}; {recipe:?}"));
            }
        }
    }
    Ok((all, watch.ms() / 1e3))
}
