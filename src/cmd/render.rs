//! `render`: a cut model as a picture.

use std::time::Instant;

use clap::Args;
use serde_json::{Value, json};

use super::Verdict;
use super::args::{DeviceArgs, SceneArgs};
use super::console::{Console, ConsoleArgs};
use super::image_test::{self, Finding};
use super::layers_file;
use super::open::{Opened, open};
use super::output::{Output, no_place_twice, write_file};
use super::picture::{self, Backdrop, Drawer, Style};
use super::sections::words_of;
use crate::exact::evaluate;
use crate::layers::{Kind, Layers};
use crate::passes::Model;
use crate::plan::Clock;
use crate::report::PerClock;
use crate::scene::section_misses;
use crate::session::{Outcome, Session};
use crate::strategies::Strategy;
use crate::{Error, Result};

pub(super) const EXAMPLES: &str = "\
Examples:
  cutaway render bracket.stl --section x=50% -o cut.png
  cutaway render shape:crank --section -z=50% --relief fractal:amplitude=5% -o ragged.png
  cutaway render engine.glb --section x=50% --section z=50% --cut intersection --exclude 'bolt*' -o quarter.png
  cutaway render shape:gears --section z=50% --strategy exact --no-background -o - | display
  cutaway render part.ply --section z=50% -o part.png --reference good.png   # exit 1 where it differs";

/// Options of `render`.
#[derive(Args)]
pub(super) struct RenderArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// The picture, .png; `-` for standard output
    #[arg(long, short, value_name = "FILE|-", help_heading = "Output")]
    output: String,
    /// Who draws the caps: raycast+mask, raycast+stencil, stencil (one plane), grid:N+vds:RES, or exact for the reference
    /// [default: that of the scene, or raycast+mask]
    #[arg(long, value_name = "NAME")]
    strategy: Option<String>,
    /// Draw N times as fine along each side and average in linear light, 1 to 4
    #[arg(
        long,
        value_name = "N",
        default_value_t = 2,
        value_parser = clap::value_parser!(u32).range(1..=4),
        help_heading = "Output"
    )]
    supersample: u32,
    /// Leave what shows no model transparent
    #[arg(long, help_heading = "Output")]
    no_background: bool,
    /// Outcome, times, bytes and counts of pixels as JSON
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    /// Depth (infinite where nothing is), kind (0 nothing, 1 surface, 2 cap), part and clip-surface (numbered from 0; -1
    /// is none) and normal of every pixel, .exr
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    layers: Option<String>,
    /// Compare the picture with this one: exit 1 and a .diff.png beside the output where it differs
    #[arg(long, value_name = "IMAGE", help_heading = "Test")]
    reference: Option<std::path::PathBuf>,
    /// Largest allowed difference of a channel of any pixel, 0 to 1
    #[arg(
        long,
        value_name = "X",
        default_value_t = 0.04,
        value_parser = parse_threshold,
        help_heading = "Test"
    )]
    reference_threshold: f64,
    #[command(flatten)]
    device: DeviceArgs,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Runs `render`.
pub(super) fn run(args: &RenderArgs) -> Result<Verdict> {
    let console = Console::new(args.console, 4);
    console.step("opening");
    let outputs = Outputs::checked(args)?;
    let reference = args
        .reference
        .as_deref()
        .map(image_test::open)
        .transpose()?;
    let asked = args
        .strategy
        .as_deref()
        .map(str::parse::<Drawer>)
        .transpose()?;
    let opened = open(&args.scene, &console)?;
    let drawer = match (asked, &opened.strategy) {
        (Some(drawer), _) => drawer,
        (None, Some(name)) => name.parse()?,
        (None, None) => Drawer::By(Strategy::RAYCAST_MASK),
    };
    let mut session = args.device.open()?;
    session.set_options(opened.options(session.options()));
    console.detail(format!(
        "adapter: {}, {}",
        session.gpu().report().name,
        session.gpu().report().driver
    ));
    let model = Model::of(&opened.scene);

    console.step(drawer.to_string());
    let facts = Facts::of(&mut session, &model, &opened, drawer, &outputs)?;
    match facts.unreliable_px() {
        // What a full buffer dropped is told below, and need not be a fault of the mesh.
        Some(unreliable) if facts.outcome == Outcome::Complete => console.warn(format!(
            "{unreliable} pixels cannot be vouched for: along their rays the mesh is open\n  mend: `cutaway inspect` \
             says where; close the holes"
        )),
        _ => {}
    }
    if let Some(layers) = &facts.layers {
        note_what_is_not_seen(layers, &opened, &console);
    }
    console.step("picture");
    let style = Style {
        supersample: args.supersample,
        backdrop: match opened.background {
            _ if args.no_background => Backdrop::Transparent,
            Some(color) => Backdrop::Color(color),
            None => Backdrop::Gradient,
        },
    };
    let drawn = picture::draw(&mut session, &model, &opened, drawer, style)?;

    console.step("writing");
    outputs.picture.write(&picture::png(&drawn)?)?;
    if let (Some(output), Some(layers)) = (&outputs.layers, &facts.layers) {
        output.write(&layers_file::exr(layers, model.prepared.scale)?)?;
    }
    if let Some(output) = &outputs.json {
        let json = facts.json(&opened, &session, &model, drawer, args);
        output.write(format!("{json:#}\n").as_bytes())?;
    }
    let mut verdict = Verdict::Done;
    if let Outcome::Overflowed(reason) = &facts.outcome {
        console.failed(format!("{drawer} did not draw all of it: {reason}"));
        verdict = Verdict::Failed;
    }
    if let (Some(reference), Some(path)) = (reference, outputs.picture.path()) {
        let finding = image_test::compare(&drawn, &reference, args.reference_threshold);
        if let Finding::Different { what, difference } = finding {
            let beside = image_test::difference_path(path);
            console.failed(format!("{}: {what}", path.display()));
            if let Some(difference) = difference {
                write_file(&beside, &picture::png(&difference)?)?;
                console.note(format!("the difference is in {}", beside.display()));
            }
            verdict = Verdict::Failed;
        }
    }
    Ok(verdict)
}

/// An empty picture, or one without caps, is nearly always a slip of the camera or of the side that stays.
fn note_what_is_not_seen(layers: &Layers, opened: &Opened, console: &Console) {
    let mut surfaces = opened.scene.cuts.iter().flat_map(|c| &c.surfaces);
    let bounds = opened.scene.bounds();
    if surfaces.any(|s| section_misses(s, &bounds)) {
        // That has been said.
    } else if layers.count(Kind::Background) == layers.pixels.len() {
        console.warn(format!(
            "the picture is empty: all of the model is cut away or outside the view\n  bounds: {}\n  mend: keep the \
             other side (--flip), move the section, or leave the camera options out",
            words_of(&bounds)
        ));
    } else if !opened.scene.cuts.is_empty() && layers.count(Kind::Cap) == 0 {
        console.note(
            "no cap is seen in this picture: the cut misses the solid, or is seen from behind (see \
             --camera-azimuth-angle and --flip)",
        );
    }
}

/// Where results go.
struct Outputs {
    picture: Output,
    json: Option<Output>,
    layers: Option<Output>,
}

impl Outputs {
    fn checked(args: &RenderArgs) -> Result<Self> {
        let optional = |option: &str, value: &Option<String>, extensions: &[&str]| {
            let checked = value
                .as_ref()
                .map(|v| Output::checked(option, v, extensions));
            checked.transpose()
        };
        let outputs = Self {
            picture: Output::checked("--output", &args.output, &["png"])?,
            json: optional("--json", &args.json, &[])?,
            layers: optional("--layers", &args.layers, &["exr"])?,
        };
        no_place_twice(&[
            ("--output", Some(&outputs.picture)),
            ("--json", outputs.json.as_ref()),
            ("--layers", outputs.layers.as_ref()),
        ])?;
        if args.reference.is_some() && outputs.picture == Output::Stdout {
            return Err(Error::input(
                "--reference",
                "there is no place for the difference image beside standard output",
                "write the picture to a file: --output FILE.png",
            ));
        }
        Ok(outputs)
    }

    fn want_facts(&self) -> bool {
        self.json.is_some() || self.layers.is_some()
    }
}

/// What is known of the frame at the plain resolution.
struct Facts {
    outcome: Outcome,
    /// None where nobody asked for what only a second, exact evaluation could tell.
    layers: Option<Layers>,
    times: Value,
    bytes: PerClock<u64>,
}

impl Facts {
    fn of(
        session: &mut Session,
        model: &Model,
        opened: &Opened,
        drawer: Drawer,
        outputs: &Outputs,
    ) -> Result<Self> {
        let view = opened.view(&model.prepared);
        match drawer {
            Drawer::Exact => {
                let started = now();
                let exact = outputs
                    .want_facts()
                    .then(|| evaluate(&model.prepared, &view));
                Ok(Self {
                    outcome: Outcome::Complete,
                    layers: exact.map(|e| e.layers),
                    times: json!({ "exact": started.elapsed().as_secs_f64() * 1e3 }),
                    bytes: PerClock::default(),
                })
            }
            Drawer::By(strategy) => {
                let drawn = session.draw(model, &view, &strategy)?;
                if let Outcome::Refused(reason) = &drawn.outcome {
                    return Err(picture::refused(drawer, reason));
                }
                let plan = session.plan(&strategy)?;
                Ok(Self {
                    bytes: PerClock::of(|clock| plan.bytes_on(clock)),
                    times: json!(PerClock::of(
                        |clock: Clock| drawn.times.clocks_ms[clock as usize]
                    )),
                    layers: Some(session.layers(&strategy)?),
                    outcome: drawn.outcome,
                })
            }
        }
    }

    /// Number of pixels the strategy does not vouch for, if any.
    fn unreliable_px(&self) -> Option<usize> {
        let layers = self.layers.as_ref()?;
        let count = layers.pixels.iter().filter(|p| p.unreliable).count();
        Some(count).filter(|c| *c > 0)
    }

    fn json(
        &self,
        opened: &Opened,
        session: &Session,
        model: &Model,
        drawer: Drawer,
        args: &RenderArgs,
    ) -> Value {
        let count = |kind| self.layers.as_ref().map(|l| l.count(kind));
        json!({
            "scene": opened.scene.name,
            "triangles": model.prepared.triangle_count(),
            "resolution": opened.size_px,
            "supersample": args.supersample,
            "adapter": session.gpu().report(),
            "strategy": drawer.to_string(),
            "rasteriser": session.options().rasteriser.to_string(),
            "outcome": self.outcome.name(),
            "reason": self.outcome.reason(),
            "cap_px": count(Kind::Cap),
            "surface_px": count(Kind::Surface),
            "background_px": count(Kind::Background),
            "overlap_px": self.layers.as_ref().map(Layers::overlap_px),
            "odd_parity_px": self.unreliable_px().unwrap_or(0),
            "bytes": self.bytes,
            "time_ms": self.times,
        })
    }
}

fn parse_threshold(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|x| (0.0..=1.0).contains(x));
    number.ok_or_else(|| {
        "it must be a number from 0 to 1\n  mend: 0.04 allows 10 steps of 255".to_owned()
    })
}

#[allow(
    clippy::disallowed_methods,
    reason = "the time of the reference is measured here"
)]
fn now() -> Instant {
    Instant::now()
}
