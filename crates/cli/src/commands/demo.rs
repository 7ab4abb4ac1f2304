//! `demo`: cuts and measures a built-in model, without downloads or preparation.
//!
//! The command writes an experiment into the folder, then measures and reports it as `measure` and `report` do. A record's pictures have
//! one sample per pixel, so pictures are drawn again with more samples.

use std::path::{Path, PathBuf};

use clap::Args;
use cutaway::{Error, Result};
use cutaway_io::document::Value;
use cutaway_io::load::Assets;
use cutaway_lab::experiment::{Record, Renderer, Run, SceneAtTime, draw_options, picture};
use cutaway_lab::report::{RecordedFolders, text};

use super::measure::{self, MeasureArgs};
use super::report::{self, ReportArgs};
use crate::console::{Console, ConsoleArgs};
use crate::input::args::{AdapterArgs, DrawOptionArgs};
use crate::input::declared::declared;
use crate::input::look::Defaults;
use crate::verdict::Verdict;
use crate::writing::output::{checked_folder, write_file, write_stdout};

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway demo
  cutaway demo --out /tmp/cutaway --resolution 1920,1080

Open report.html in the folder: it says which method to use for this cut, shows each method's picture and, with one switch, where the
picture is wrong, and compares any two pictures with a slider.";

/// The experiment: a corner cut out of the crank along two ragged reliefs.
const EXPERIMENT: &str = include_str!("demo.toml");

/// Name of the experiment and of its file.
const NAME: &str = "demo";

/// Options of `demo`.
#[derive(Args)]
pub(crate) struct DemoArgs {
    /// Folder for the pictures and the report
    #[arg(long, value_name = "DIR", default_value = "target/demo")]
    out: PathBuf,
    /// Width and height of the pictures in pixels
    #[arg(
        long,
        value_name = "W,H",
        default_value = "1000,520",
        value_parser = declared("resolution")
    )]
    resolution: Value,
    /// Number of measured rounds, after one warm-up round
    #[arg(
        long,
        value_name = "N",
        default_value_t = 5,
        value_parser = clap::value_parser!(u32).range(1..=1000)
    )]
    rounds: u32,
    #[command(flatten)]
    device: AdapterArgs,
    #[command(flatten)]
    options: DrawOptionArgs,
    #[command(flatten)]
    console: ConsoleArgs,
}

impl DemoArgs {
    /// The experiment's text with the values of the options.
    fn experiment(&self) -> String {
        let set = self.options.values().map(|(path, _, value)| {
            value.map_or_else(String::new, |value| format!("\"{path}\" = {value}\n"))
        });
        let (size, set) = (&self.resolution, set.concat());
        format!("{EXPERIMENT}\n[run.set]\nresolution = {size}\n{set}")
    }
}

/// Runs `demo`.
pub(crate) fn run(args: &DemoArgs) -> Result<Verdict> {
    let out = &args.out;
    checked_folder("--out", out)?;
    if out.join(Run::FILE).exists() && !out.join(NAME).is_dir() {
        let help = "choose another folder with --out";
        return Err(Error::file(out, "the folder holds another run", help));
    }
    let experiment = out.join(NAME).with_extension("toml");
    write_file(&experiment, args.experiment().as_bytes())?;
    let measured = measure::run(&MeasureArgs {
        shard: None,
        experiments: vec![experiment],
        out: out.clone(),
        quick: false,
        force: true,
        prune: false,
        dry_run: false,
        only: None,
        rounds: Some(args.rounds),
        device: args.device.clone(),
        console: args.console,
    })?;
    if measured != Verdict::Done {
        return Ok(measured);
    }
    let recorded = RecordedFolders::read(std::slice::from_ref(out))?;
    let mut experiments = recorded.folders.iter().flat_map(|f| &f.experiments);
    let demo = experiments.find(|e| e.synopsis.name == NAME);
    let Some(record) = demo.and_then(|e| e.records.first()) else {
        return Err(Error::file(out, "the record is gone", "run it again"));
    };
    smooth(record, args)?;
    let scene = out.join("scene.toml");
    write_file(
        &scene,
        record.scene.moved_to(&scene)?.to_string().as_bytes(),
    )?;
    report::run(&ReportArgs {
        folders: vec![out.clone()],
        out: None,
        link: false,
        method: None,
        complete: false,
        console: args.console,
    })?;
    say(out, record)?;
    Ok(Verdict::Done)
}

/// Draws a record's pictures again, with four samples per pixel.
fn smooth(record: &Record, args: &DemoArgs) -> Result<()> {
    let console = Console::new(args.console, record.pictures.len());
    let timeline = record.scene.timeline(&mut Assets::default())?;
    let timeline = Defaults::of_pictures()?.of(timeline)?;
    let shown = SceneAtTime::new(&timeline.scene()?);
    let view = shown.model.prepared.view(timeline.settings().size_px());
    let mut session = args.device.session(false)?;
    for picture in &record.pictures {
        console.step(format!("picture by {}", picture.drawer));
        let renderer: Renderer = picture.drawer.parse()?;
        let renderer = renderer.or(draw_options(timeline.settings())?);
        let drawn = picture::draw(&mut session, &shown, &view, renderer, 2)?;
        let file = args.out.join(NAME).join(&picture.file);
        write_file(&file, &picture::png(&drawn.image)?)?;
    }
    Ok(())
}

/// Prints the table and the locations of all results.
fn say(folder: &Path, record: &Record) -> Result<()> {
    let text = format!(
        "\n{}\npictures, heat maps and the report are in {}\n  open {}\nanother view of the same scene:\n  cutaway render {} --camera-azimuth-angle=60 -o crank.png\n",
        text(&record.measurement),
        folder.display(),
        folder.join("report.html").display(),
        folder.join("scene.toml").display()
    );
    write_stdout(text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway_lab::experiment::Definition;
    use cutaway_lab::experiment::definition::Asked;

    #[test]
    fn the_scene_of_the_demo_is_cut() {
        let definition = Definition::read(Path::new("demo.toml"), EXPERIMENT).unwrap();
        let Asked::Scenes(run) = &definition.runs[0].full else {
            panic!("it asks for no scene");
        };
        let scene = &run.points[0].scene;
        let scene = scene.resolve(0.0, &mut Assets::default()).unwrap();
        let bounds = scene.bounds();
        assert_eq!(scene.cuts.len(), 1);
        for surface in &scene.cuts[0].surfaces {
            assert!(surface.relief.is_some(), "the cut is ragged");
            assert!(!surface.misses(&bounds), "it meets the crank");
        }
    }
}
