//! `plan`: lists a frame's passes and the reason for each. Needs no adapter.

use clap::Args;
use cutaway::gpu::{Gpu, GpuOptions};
use cutaway::plan::Capacities;
use cutaway::strategies::{self, AUTO, DrawOptions, Method, table};
use cutaway::{Error, Result};
use cutaway_io::document::Value;
use cutaway_lab::experiment::picture::refused;
use cutaway_lab::experiment::{Renderer, SceneAtTime};

use crate::console::{Console, ConsoleArgs};
use crate::input::args::{DrawOptionArgs, SceneArgs, say};
use crate::input::look::{AUTO_IN_WORDS, Defaults};
use crate::input::when::TimeArgs;
use crate::renderer_request::RendererRequest;
use crate::verdict::Verdict;
use crate::writing::output::{Output, write_stdout};
use crate::writing::places::paths_of;

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway plan shape:crank --section z=50%
  cutaway plan shape:crank --section z=50% --relief waves --strategy grid:256+vds:1024
  cutaway plan scene.toml --json - | jq '.passes[].name'

A plan contains only what its scene needs: without --section there is no pass for caps. The plan shows the first frame; a buffer
whose required size is known only after a frame may grow later.";

/// Options of `plan`.
#[derive(Args)]
pub(crate) struct PlanArgs {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    when: TimeArgs,
    #[arg(long, value_name = "NAME", help = strategy_help())]
    strategy: Option<String>,
    /// The same as JSON; `-` prints it instead of the text
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    #[command(flatten)]
    options: DrawOptionArgs,
    #[command(flatten)]
    console: ConsoleArgs,
}

fn strategy_help() -> String {
    format!(
        "Whose passes: {AUTO}, {AUTO_IN_WORDS}; {} [default: that of the scene, or {AUTO}]",
        table::names()
    )
}

/// Runs `plan`.
pub(crate) fn run(args: &PlanArgs) -> Result<Verdict> {
    let json = args
        .json
        .as_ref()
        .map(|v| Output::checked("--json", v, &[]));
    let json = json.transpose()?;
    let console = Console::new(args.console, 1);
    console.step("opening");
    let mut document = args.scene.document(None)?;
    args.when.amend(&mut document)?;
    args.options.amend(&mut document)?;
    let asked = args.strategy.as_deref();
    if let RendererRequest::Named(renderer) = RendererRequest::named(asked, DrawOptions::default())?
    {
        passes_of(renderer)?;
    }
    say(
        &mut document,
        "strategy.name",
        "--strategy",
        asked.map(Value::from),
    )?;
    let subject = args
        .scene
        .open(document, None, Defaults::default(), &console)?;
    let renderer_request = subject.renderer_request()?;
    if let RendererRequest::Named(renderer) = renderer_request {
        passes_of(renderer)?;
    }
    subject.save_beside(paths_of(&[("--json", json.as_ref())]), &args.scene.edits)?;
    let SceneAtTime { model, .. } = SceneAtTime::new(&subject.scene);
    let view = subject.view(&model.prepared);
    // A plan needs no device, but the automatic choice of the renderer may depend on the device.
    let gpu = match renderer_request {
        RendererRequest::Auto(_) => Gpu::open(&GpuOptions::default()).ok(),
        RendererRequest::Named(_) => None,
    };
    let chosen = renderer_request.classify(gpu.as_ref(), (&model, &view), &console);
    let method = passes_of(chosen.renderer)?;
    let plan = strategies::plan(&model, &view, method, &Capacities::UNKNOWN)
        .map_err(|refusal| refused(method.into(), &refusal))?;
    if let Some(output) = &json {
        let mut value = plan.to_json();
        value["strategy"] = method.strategy.to_string().into();
        value["chosen_for"] = chosen.reason.clone().into();
        output.write(format!("{value:#}\n").as_bytes())?;
    }
    if json != Some(Output::Stdout) {
        let why =
            (chosen.reason).map_or_else(String::new, |reason| format!("{AUTO}, for {reason}\n"));
        let text = format!("{method}\n{why}{}", plan.to_text());
        write_stdout(text.as_bytes())?;
    }
    Ok(Verdict::Done)
}

/// The method of a renderer; other renderers have no passes.
fn passes_of(renderer: Renderer) -> Result<Method> {
    renderer.method().ok_or_else(|| {
        Error::input(
            format!("--strategy {renderer}"),
            "it runs on the CPU and has no passes",
            "name a strategy, for example raycast+mask",
        )
    })
}
