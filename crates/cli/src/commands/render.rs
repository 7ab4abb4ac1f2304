//! `render`: a cut model as a picture.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use cutaway::gpu::Preparation;
use cutaway::layers::Layers;
use cutaway::passes::Model;
use cutaway::plan::Clock;
use cutaway::scene::View;
use cutaway::session::{Outcome, Session};
use cutaway::{Error, Result};
use cutaway_lab::compare::{FrameCounts, may_be_wrong};
use cutaway_lab::experiment::{PerClock, Renderer, SceneAtTime, Stopwatch, picture};
use serde_json::{Value, json};

use crate::console::{Console, ConsoleArgs};
use crate::image_test::{self, ImageTestResult};
use crate::input::args::{AdapterArgs, DrawOptionArgs, SceneArgs};
use crate::input::look::{Defaults, LookArgs};
use crate::input::subject::SceneInput;
use crate::input::when::TimeArgs;
use crate::notes::{adapter_in_words, note_what_is_not_seen, warn_of_doubt};
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
    let has_shadow = shown.model.prepared.style.shadow.is_drawn();
    let wanted = Wanted {
        // Without supersampling, the picture is the frame that is checked.
        picture: subject.supersample() == 1 && !has_shadow,
        layers: outputs.layers.is_some(),
        counts: outputs.json.is_some(),
    };
    let mut frame = PlainFrame::of(&mut session, &shown, &view, renderer, wanted)?;
    let mut verdict = Verdict::Done;
    if let Some(counts) = &frame.counts {
        // Pixels dropped by a full buffer are reported below; they do not mean that the mesh is defective.
        if frame.outcome == Outcome::Complete {
            let drawn = (&subject.scene, &shown.model);
            verdict = warn_of_doubt(counts.may_be_wrong, renderer, drawn, &console);
        }
        note_what_is_not_seen(counts, &subject.scene, &console);
    }
    if let Renderer::Method(_) = renderer {
        console.detail(in_words(&session.gpu().preparation()));
    }
    console.step("picture");
    let drawn = match frame.picture.take() {
        Some(rgba) => picture::plain(rgba, view.size_px),
        None => picture::draw(&mut session, &shown, &view, renderer, subject.supersample())?.image,
    };

    console.step("writing");
    let mut results = Results::default();
    results.add(&outputs.picture, picture::png(&drawn)?)?;
    if let (Some(output), Some(layers)) = (&outputs.layers, &frame.layers) {
        let drawn = session.style_channels(&shown.model, &view, layers)?;
        let doubted = may_be_wrong(layers, &shown.model.prepared, &view);
        let about = layers_file::LayersSource {
            scene: &subject.scene,
            prepared: &shown.model.prepared,
            view: &view,
            may_be_wrong: &doubted,
            drawn: &drawn,
        };
        results.add(output, layers_file::exr(layers, &about)?)?;
    }
    if let Some(output) = &outputs.json {
        let json = frame.json(&subject, &session, &shown.model, &chosen);
        results.add(output, format!("{json:#}\n").into_bytes())?;
    }
    if let Outcome::Overflowed(reason) = &frame.outcome {
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
}

/// What is wanted of the frame without supersampling.
#[derive(Clone, Copy)]
struct Wanted {
    picture: bool,
    layers: bool,
    counts: bool,
}

/// Data of the frame without supersampling.
struct PlainFrame {
    outcome: Outcome,
    /// Counts of pixels. A method always has them; an evaluator on the CPU only if they are wanted, because they take a second evaluation.
    counts: Option<FrameCounts>,
    layers: Option<Layers>,
    /// RGBA8.
    picture: Option<Vec<u8>>,
    times: Value,
    /// Most bytes that a strip produced.
    bytes: PerClock<u64>,
}

impl PlainFrame {
    fn of(
        session: &mut Session,
        shown: &SceneAtTime,
        view: &View,
        renderer: Renderer,
        wanted: Wanted,
    ) -> Result<Self> {
        match renderer {
            Renderer::Cpu(evaluator) => {
                let watch = Stopwatch::start();
                let truth = shown.truth()?;
                let layers = (wanted.layers || wanted.counts)
                    .then(|| evaluator.evaluate(truth, view).layers);
                let times = [(renderer.to_string(), watch.ms().into())];
                let counts = layers.as_ref().map(|layers| {
                    let mut counts = FrameCounts::default();
                    counts.add(layers, truth, view, 0);
                    counts
                });
                Ok(Self {
                    outcome: Outcome::Complete,
                    counts,
                    layers,
                    picture: None,
                    times: Value::Object(times.into_iter().collect()),
                    bytes: PerClock::default(),
                })
            }
            Renderer::Method(method) => {
                let prepared = &shown.model.prepared;
                let mut counts = FrameCounts::default();
                let mut bytes = [0; 3];
                let (mut pixels, mut picture) = (Vec::new(), Vec::new());
                let mut note = |session: &Session, mut layers: Layers, row| {
                    counts.add(&layers, prepared, view, row);
                    if wanted.layers {
                        match pixels.is_empty() {
                            true => pixels = layers.pixels,
                            false => pixels.append(&mut layers.pixels),
                        }
                    }
                    for (most, bytes) in bytes.iter_mut().zip(session.bytes(method)?) {
                        *most = bytes.max(*most);
                    }
                    Ok(())
                };
                let model = &shown.model;
                let drawn = match session.strips(model, view, method) {
                    Some(strips) => {
                        session.draw_strips(model, method, &strips, |session, strip| {
                            if wanted.picture {
                                picture.extend_from_slice(strip.own(&session.picture(method)?, 4));
                            }
                            let layers = strip.own_layers(session.layers(method)?);
                            note(session, layers, strip.rows()[0])
                        })?
                    }
                    None => {
                        let drawn = session.draw_layers(model, view, method)?;
                        let (drawn, layers) = drawn.map_err(|r| picture::refused(renderer, &r))?;
                        if wanted.picture {
                            picture = session.shade(model, view, &layers)?;
                        }
                        note(session, layers, 0)?;
                        drawn
                    }
                };
                if let Outcome::Refused(refusal) = &drawn.outcome {
                    return Err(picture::refused(renderer, refusal));
                }
                let size_px = view.size_px;
                Ok(Self {
                    outcome: drawn.outcome,
                    counts: Some(counts),
                    layers: wanted.layers.then_some(Layers { size_px, pixels }),
                    picture: wanted.picture.then_some(picture),
                    times: json!(PerClock::from_fn(
                        |clock: Clock| drawn.times.clocks_ms[clock as usize]
                    )),
                    bytes: PerClock::from_fn(|clock| bytes[clock as usize]),
                })
            }
        }
    }

    fn json(
        &self,
        subject: &SceneInput,
        session: &Session,
        model: &Model,
        chosen: &RendererChoice,
    ) -> Value {
        let options = chosen.renderer.options();
        let count = |of: fn(&FrameCounts) -> usize| self.counts.as_ref().map(of);
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
            "cap_px": count(|c| c.cap),
            "surface_px": count(|c| c.surface),
            "background_px": count(|c| c.background),
            "overlap_px": count(|c| c.overlap),
            "odd_parity_px": count(|c| c.unreliable).unwrap_or(0),
            "may_be_wrong_px": count(|c| c.may_be_wrong).unwrap_or(0),
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
