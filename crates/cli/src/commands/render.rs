//! `render`: a cut model as a picture.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use cutaway::gpu::Preparation;
use cutaway::layers::{Kind, Layers};
use cutaway::passes::Model;
use cutaway::plan::Clock;
use cutaway::scene::View;
use cutaway::session::{Outcome, Session};
use cutaway::{Error, Result};
use cutaway_lab::compare::may_be_wrong;
use cutaway_lab::experiment::{PerClock, Renderer, SceneAtTime, Stopwatch, picture};
use serde_json::{Value, json};

use crate::console::{Console, ConsoleArgs};
use crate::image_test::{self, ImageTestResult};
use crate::input::args::{AdapterArgs, DrawOptionArgs, SceneArgs};
use crate::input::look::{Defaults, LookArgs};
use crate::input::subject::SceneInput;
use crate::input::when::TimeArgs;
use crate::notes::{adapter_in_words, note_what_is_not_seen, unreliable_px, warn_of_doubt};
use crate::renderer_request::RendererChoice;
use crate::verdict::Verdict;
use crate::writing::layers_file;
use crate::writing::output::Output;
use crate::writing::places::{no_place_twice, paths_of};
use crate::writing::results::Results;

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway render bracket.stl --section x=50% -o cut.png
  cutaway render shape:crank --section -z=50% --relief fractal:amplitude=5% -o ragged.png
  cutaway render engine.glb --section x=50% --section z=50% --cut intersection --exclude 'bolt*' -o quarter.png
  cutaway render shape:gears --section z=50% --strategy exact --no-background -o - | display
  cutaway render walk.glb --time 0.5 --section x=50% -o step.png
  cutaway render part.ply --section z=50% -o part.png --reference good.png   # exit 1 where it differs";

/// Options of `render`.
#[derive(Args)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    when: TimeArgs,
    /// Output picture, .png; `-` for standard output
    #[arg(long, short, value_name = "FILE|-", help_heading = "Output")]
    output: String,
    #[command(flatten)]
    look: LookArgs,
    /// Outcome, times, bytes and pixel counts as JSON
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    /// Layers per pixel, .exr: depth (infinite for background), kind (0 background, 1 surface, 2 cap), part and clip-surface (from 0; -1
    /// for none), normal, and whether the pixel may be wrong; names of the parts, the camera and the units are
    /// stored as attributes
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    layers: Option<String>,
    /// Compare the picture with this one; if it differs, exit with 1 and write a .diff.png next to the output
    #[arg(long, value_name = "IMAGE", help_heading = "Test")]
    reference: Option<PathBuf>,
    /// Largest allowed difference in any channel of any pixel, 0 to 1
    #[arg(
        long,
        value_name = "X",
        default_value_t = 0.04,
        value_parser = parse_threshold,
        help_heading = "Test"
    )]
    reference_threshold: f64,
    #[command(flatten)]
    device: AdapterArgs,
    #[command(flatten)]
    options: DrawOptionArgs,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Runs `render`.
pub(crate) fn run(args: &RenderArgs) -> Result<Verdict> {
    let console = Console::new(args.console, 4);
    console.step("opening");
    let outputs = Outputs::checked(args)?;
    let reference = args
        .reference
        .as_deref()
        .map(image_test::open)
        .transpose()?;
    let mut document = args.scene.document(None)?;
    args.when.amend(&mut document)?;
    args.look.amend(&mut document)?;
    args.options.amend(&mut document)?;
    let subject = args
        .scene
        .open(document, None, Defaults::of_pictures()?, &console)?;
    subject.files.add(args.reference.clone());
    let renderer_request = subject.renderer_request()?;
    subject.save_beside(outputs.paths.clone(), &args.scene.edits)?;
    let mut session = args.device.session(args.json.is_some())?;
    console.detail_by(|| adapter_in_words(session.gpu()));
    let shown = subject.shown()?;
    let view = subject.view(&shown.model.prepared);

    let chosen = renderer_request.classify(Some(session.gpu()), (&shown.model, &view), &console);
    let renderer = chosen.renderer;
    console.step(renderer.to_string());
    let facts = PlainFrame::of(&mut session, &shown, &view, renderer, &outputs)?;
    let mut verdict = Verdict::Done;
    if let Some(layers) = &facts.layers {
        // Pixels dropped by a full buffer are reported below; they do not mean that the mesh is defective.
        if facts.outcome == Outcome::Complete {
            let drawn = (&subject.scene, &shown.model);
            verdict = warn_of_doubt(&facts.may_be_wrong, renderer, drawn, &console);
        }
        note_what_is_not_seen(layers, &subject.scene, &console);
    }
    if let Renderer::Method(_) = renderer {
        console.detail(in_words(&session.gpu().preparation()));
    }
    console.step("picture");
    let has_shadow = shown.model.prepared.style.shadow.is_drawn();
    let drawn = match renderer {
        // Without supersampling, the picture is the frame that was checked.
        Renderer::Method(method) if subject.supersample() == 1 && !has_shadow => {
            picture::plain(&session.picture(method)?, view.size_px)
        }
        _ => picture::draw(&mut session, &shown, &view, renderer, subject.supersample())?.image,
    };

    console.step("writing");
    let mut results = Results::default();
    results.add(&outputs.picture, picture::png(&drawn)?)?;
    if let (Some(output), Some(layers)) = (&outputs.layers, &facts.layers) {
        let drawn = session.style_channels(&shown.model, &view, layers)?;
        let about = layers_file::LayersSource {
            scene: &subject.scene,
            prepared: &shown.model.prepared,
            view: &view,
            may_be_wrong: &facts.may_be_wrong,
            drawn: &drawn,
        };
        results.add(output, layers_file::exr(layers, &about)?)?;
    }
    if let Some(output) = &outputs.json {
        let json = facts.json(&subject, &session, &shown.model, &chosen);
        results.add(output, format!("{json:#}\n").into_bytes())?;
    }
    if let Outcome::Overflowed(reason) = &facts.outcome {
        console.failed(format!("{renderer} drew an incomplete picture: {reason}"));
        verdict = Verdict::Failed;
    }
    if let (Some(reference), Some(path)) = (reference, outputs.picture.path()) {
        let finding = image_test::compare(&drawn, &reference, args.reference_threshold);
        if let ImageTestResult::Different { what, difference } = finding {
            let beside = image_test::difference_path(path);
            console.failed(format!("{}: {what}", path.display()));
            if let Some(difference) = difference {
                let output = Output::File(beside.clone());
                results.add(&output, picture::png(&difference)?)?;
                console.note(format!("the difference is in {}", beside.display()));
            }
            verdict = Verdict::Failed;
        }
    }
    results.place()?;
    Ok(verdict)
}

/// Output files.
struct Outputs {
    picture: Output,
    json: Option<Output>,
    layers: Option<Output>,
    /// The outputs that are files, with the options that name them.
    paths: Vec<(&'static str, PathBuf)>,
}

impl Outputs {
    fn checked(args: &RenderArgs) -> Result<Self> {
        let optional = |option: &str, value: &Option<String>, extensions: &[&str]| {
            let checked = value
                .as_ref()
                .map(|v| Output::checked(option, v, extensions));
            checked.transpose()
        };
        let picture = Output::checked("--output", &args.output, &["png"])?;
        let json = optional("--json", &args.json, &[])?;
        let layers = optional("--layers", &args.layers, &["exr"])?;
        // The difference image goes next to the picture.
        let difference = match (&args.reference, picture.path()) {
            (Some(_), Some(path)) => Some(Output::File(image_test::difference_path(path))),
            (Some(_), None) => {
                return Err(Error::input(
                    "--reference",
                    "the difference image is written next to the picture, but the picture goes to standard output",
                    "write the picture to a file: --output FILE.png",
                ));
            }
            (None, _) => None,
        };
        let named = [
            ("--output", Some(&picture)),
            ("--json", json.as_ref()),
            ("--layers", layers.as_ref()),
            ("--output's difference image", difference.as_ref()),
        ];
        no_place_twice(&named)?;
        let paths = paths_of(&named).collect();
        Ok(Self {
            picture,
            json,
            layers,
            paths,
        })
    }

    fn want_facts(&self) -> bool {
        self.json.is_some() || self.layers.is_some()
    }
}

/// Data of the frame without supersampling.
struct PlainFrame {
    outcome: Outcome,
    /// `None` unless the requested data needs a second, exact evaluation.
    layers: Option<Layers>,
    /// For each pixel, true if its layers may be wrong.
    may_be_wrong: Vec<bool>,
    times: Value,
    bytes: PerClock<u64>,
}

impl PlainFrame {
    fn of(
        session: &mut Session,
        shown: &SceneAtTime,
        view: &View,
        renderer: Renderer,
        outputs: &Outputs,
    ) -> Result<Self> {
        let mut facts = match renderer {
            Renderer::Cpu(evaluator) => {
                let watch = Stopwatch::start();
                let truth = shown.truth()?;
                let evaluated = (outputs.want_facts()).then(|| evaluator.evaluate(truth, view));
                let times = [(renderer.to_string(), watch.ms().into())];
                Self {
                    outcome: Outcome::Complete,
                    layers: evaluated.map(|e| e.layers),
                    may_be_wrong: Vec::new(),
                    times: Value::Object(times.into_iter().collect()),
                    bytes: PerClock::default(),
                }
            }
            Renderer::Method(method) => {
                let drawn = session.draw(&shown.model, view, method)?;
                if let Outcome::Refused(refusal) = &drawn.outcome {
                    return Err(picture::refused(renderer, refusal));
                }
                let bytes = session.bytes(method)?;
                Self {
                    bytes: PerClock::from_fn(|clock| bytes[clock as usize]),
                    times: json!(PerClock::from_fn(
                        |clock: Clock| drawn.times.clocks_ms[clock as usize]
                    )),
                    layers: Some(session.layers(method)?),
                    may_be_wrong: Vec::new(),
                    outcome: drawn.outcome,
                }
            }
        };
        if let Some(layers) = &facts.layers {
            facts.may_be_wrong = may_be_wrong(layers, &shown.model.prepared, view);
        }
        Ok(facts)
    }

    fn json(
        &self,
        subject: &SceneInput,
        session: &Session,
        model: &Model,
        chosen: &RendererChoice,
    ) -> Value {
        let options = chosen.renderer.options();
        let count = |kind| self.layers.as_ref().map(|l| l.count(kind));
        json!({
            "scene": subject.scene.name,
            "triangles": model.prepared.triangle_count(),
            "resolution": subject.size_px(),
            "time_s": subject.timeline.time_s(),
            "supersample": subject.supersample(),
            "adapter": session.gpu().report(),
            "strategy": picture::strategy_name(chosen.renderer),
            "chosen_for": chosen.reason,
            "rasteriser": options.rasteriser.unwrap_or_default().to_string(),
            "height_filter": options.height_filter.unwrap_or_default().to_string(),
            "outcome": self.outcome.name(),
            "reason": self.outcome.reason(),
            "cap_px": count(Kind::Cap),
            "surface_px": count(Kind::Surface),
            "background_px": count(Kind::Background),
            "overlap_px": self.layers.as_ref().map(Layers::overlap_px),
            "odd_parity_px": self.layers.as_ref().map_or(0, unreliable_px),
            "may_be_wrong_px": self.may_be_wrong.iter().filter(|w| **w).count(),
            "bytes": self.bytes,
            "time_ms": self.times,
        })
    }
}

fn parse_threshold(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|x| (0.0..=1.0).contains(x));
    number.ok_or_else(|| {
        "it must be a number from 0 to 1\n  help: 0.04 allows 10 steps of 255".to_owned()
    })
}

/// The times taken to prepare a device, as text.
fn in_words(took: &Preparation) -> String {
    let ms = |time: Duration| format!("{:.0} ms", time.as_secs_f64() * 1e3);
    format!(
        "device prepared: shaders composed in {}, {} pipelines compiled in {}, {:.1} MiB of buffers uploaded in {}",
        ms(took.composing),
        took.pipelines,
        ms(took.compiling),
        took.bytes as f64 / f64::from(1 << 20),
        ms(took.uploading),
    )
}
