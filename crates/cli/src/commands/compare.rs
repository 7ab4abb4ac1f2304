//! `compare`: measures strategies against the exact reference and against one another.

use std::path::{Path, PathBuf};

use clap::Args;
use cutaway::Result;
use cutaway::session::Session;
use cutaway::strategies::DrawOptions;
use cutaway_lab::compare::legend;
use cutaway_lab::experiment::{
    Judgement, MOST_UNDECIDED, Measurement, Renderer, SceneAtTime, Warning, check_memory, picture,
};
use cutaway_lab::report;
use image::{Rgba, RgbaImage};

use crate::console::{Console, ConsoleArgs};
use crate::input::args::{AdapterArgs, DrawOptionArgs, SceneArgs};
use crate::input::look::Defaults;
use crate::input::subject::SceneInput;
use crate::input::when::TimeArgs;
use crate::judge::{self, judge};
use crate::verdict::Verdict;
use crate::writing::output::{Output, checked_folder, write_stdout};
use crate::writing::places::paths_of;
use crate::writing::results::Results;

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway compare shape:crank --section -z=50% --relief fractal
  cutaway compare part.stl --section x=50% --strategies raycast+mask,grid:64+vds:512 --rounds 25
  cutaway compare scene.toml --json result.json --heatmaps wrong/
  cutaway compare part.stl --section x=50% --strategies raycast+mask,raycast+mask@compute
  cutaway compare scan.ply --section x=50% --strategies raycast+mask,winding     # caps of a mesh with holes
  cutaway compare walk.glb --time 0.5 --section x=50%                         # the mesh as it stands then
  cutaway compare scene.toml --strategies raycast+mask --max-decided-wrong 0   # exit 1 if it is not exact

Columns: `decided wrong` counts wrong pixels where the exact reference is sure; an exact strategy has none. `x draw only` is the
frame time divided by the time of the same scene drawn uncut by hardware, in the same rounds. `x uncut` divides by the uncut time
of the same rasteriser, and `cut alone` is the difference from that time, in ms and in ns per pixel that shows something.";

/// Options of `compare`.
#[derive(Args)]
pub(crate) struct CompareArgs {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    when: TimeArgs,
    /// Strategies to measure, or all built-in ones with their usual parameters; `winding` computes winding numbers on the CPU,
    /// which handles open meshes. After an @, deviations from the default: hardware,
    /// compute, 32-bit (no 64-bit atomics), cells, pyramid
    #[arg(long, value_name = "A,B,..|all", default_value = "all")]
    strategies: String,
    /// Number of measured rounds, after one warm-up round
    #[arg(
        long,
        value_name = "N",
        default_value_t = 9,
        value_parser = clap::value_parser!(u32).range(1..=10_000)
    )]
    rounds: u32,
    /// All results as JSON; `-` prints them instead of the table
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    /// Folder for a picture and a heat map per strategy, the exact picture, and a legend
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    heatmaps: Option<PathBuf>,
    /// Exit 1 if a strategy that draws has more decided wrong pixels than this, or if more than 1/1000 of the non-background pixels are
    /// undecided
    #[arg(long, value_name = "N", help_heading = "Test")]
    max_decided_wrong: Option<usize>,
    #[command(flatten)]
    device: AdapterArgs,
    #[command(flatten)]
    options: DrawOptionArgs,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Runs `compare`.
pub(crate) fn run(args: &CompareArgs) -> Result<Verdict> {
    let renderers = parse_renderers(&args.strategies)?;
    let rounds = args.rounds as usize;
    let json = args
        .json
        .as_ref()
        .map(|v| Output::checked("--json", v, &[]));
    let json = json.transpose()?;
    if let Some(folder) = &args.heatmaps {
        checked_folder("--heatmaps", folder)?;
    }
    let console = Console::new(args.console, 1 + judge::steps(renderers.len(), rounds));
    console.step("opening");
    let mut document = args.scene.document(None)?;
    args.when.amend(&mut document)?;
    args.options.amend(&mut document)?;
    let subject = args
        .scene
        .open(document, None, Defaults::default(), &console)?;
    check_memory(subject.size_px(), renderers.len())?;
    let written = args
        .heatmaps
        .as_deref()
        .map(|folder| files_of(folder, &renderers));
    let written = written
        .into_iter()
        .flatten()
        .map(|path| ("--heatmaps", path));
    let json_file = [("--json", json.as_ref())];
    subject.save_beside(written.chain(paths_of(&json_file)), &args.scene.edits)?;
    let mut session = args.device.session(false)?;
    let shown = SceneAtTime::new(&subject.scene);
    let judgement = judge(&mut session, &shown, &subject, &renderers, rounds, &console)?;

    let mut results = Results::default();
    if let Some(folder) = &args.heatmaps {
        add_pictures(
            &mut results,
            folder,
            &mut session,
            &shown,
            &subject,
            &judgement,
        )?;
    }
    let report = &judgement.measurement;
    if let Some(output) = &json {
        let json = format!("{:#}\n", serde_json::json!(report));
        results.add(output, json.into_bytes())?;
    }
    results.place()?;
    if json != Some(Output::Stdout) {
        write_stdout(report::text(report).as_bytes())?;
    }
    Ok(verdict(report, args.max_decided_wrong, &console))
}

fn verdict(report: &Measurement, most: Option<usize>, console: &Console) -> Verdict {
    let mut verdict = Verdict::Done;
    let doubt = Warning::of_undecided(&report.exact);
    if let Some(doubt) = &doubt {
        let (undecided, judged) = (report.exact.undecided_px, report.exact.judged_px);
        let counts = format!("{undecided} px, {} are judged", judged.unwrap_or_default());
        console.warn(format!(
            "{} ({counts})\n  help: {}",
            doubt.text(),
            doubt.remedy()
        ));
    }
    if most.is_some() && doubt.is_some() {
        console.failed(format!(
            "exact: {} undecided pixels, at most {} of the non-background pixels are allowed",
            report.exact.undecided_px, MOST_UNDECIDED
        ));
        verdict = Verdict::Failed;
    }
    for (strategy, most) in report.strategies.iter().filter_map(|s| Some((s, most?))) {
        let Some(comparison) = &strategy.comparison else {
            continue;
        };
        let own = (strategy.undecided_px).filter(|px| report.exact.is_doubtful_with(*px));
        if let Some(undecided_px) = own {
            console.failed(format!(
                "{}: {undecided_px} undecided pixels, at most {MOST_UNDECIDED} of the non-background pixels are allowed: the rasteriser of {} \
                 leaves them to rounding\n  help: compare what the compute rasteriser draws, such as raycast+mask@compute",
                strategy.name, report.adapter.name
            ));
            verdict = Verdict::Failed;
        }
        if comparison.decided_wrong_px > most {
            console.failed(format!(
                "{}: {} decided wrong pixels, at most {most} are allowed",
                strategy.name, comparison.decided_wrong_px
            ));
            verdict = Verdict::Failed;
        }
    }
    verdict
}

/// Parses a list of strategies and removes duplicates.
fn parse_renderers(list: &str) -> Result<Vec<Renderer>> {
    let mut renderers: Vec<Renderer> = Vec::new();
    for name in split_list(list) {
        for renderer in Renderer::named(name)? {
            if !renderers.contains(&renderer) {
                renderers.push(renderer);
            }
        }
    }
    Ok(renderers)
}

/// Splits a list into names. The part after an `@` may contain commas: `a+b@compute,32-bit,c+d` is two names.
fn split_list(list: &str) -> Vec<&str> {
    let mut names = Vec::new();
    let mut from = 0;
    for (at, _) in list.match_indices(',').chain([(list.len(), "")]) {
        let next = list[at..].trim_start_matches(',').trim_start();
        let word = next.split([',', '@', '+']).next().unwrap_or(next).trim();
        if list[from..at].contains('@') && DrawOptions::is_word(word) {
            continue;
        }
        names.push(list[from..at].trim());
        from = (at + 1).min(list.len());
    }
    names
}

/// A file name for a strategy: `grid-256+vds-1024`.
fn file_stem(name: &impl ToString) -> String {
    name.to_string().replace([':', ',', '@'], "-")
}

/// The files that [`add_pictures`] may write.
fn files_of(folder: &Path, renderers: &[Renderer]) -> Vec<PathBuf> {
    let of_renderer = |renderer: &Renderer| {
        let stem = file_stem(renderer);
        [format!("{stem}.png"), format!("{stem}.heatmap.png")]
    };
    let names = ["exact.png", "legend.png", "legend.txt"].map(str::to_owned);
    (names
        .into_iter()
        .chain(renderers.iter().flat_map(of_renderer)))
    .map(|name| folder.join(name))
    .collect()
}

fn add_pictures(
    results: &mut Results,
    folder: &Path,
    session: &mut Session,
    shown: &SceneAtTime,
    subject: &SceneInput,
    judgement: &Judgement,
) -> Result<()> {
    let mut write = |name: &str, bytes| results.add(&Output::File(folder.join(name)), bytes);
    let view = subject.view(&shown.model.prepared);
    let truth = session.shade(&shown.model, &view, &judgement.exact.layers)?;
    let exact = picture::plain(truth, view.size_px);
    write("exact.png", picture::png(&exact)?)?;
    write("legend.png", picture::png(&legend_picture())?)?;
    write("legend.txt", legend_text().into_bytes())?;
    for frame in &judgement.frames {
        let Some(heatmap) = judgement.heatmap(frame) else {
            continue;
        };
        let stem = file_stem(&frame.renderer);
        let drawn = picture::plain(judgement.picture(session, frame)?, view.size_px);
        write(&format!("{stem}.png"), picture::png(&drawn)?)?;
        write(&format!("{stem}.heatmap.png"), picture::png(&heatmap)?)?;
    }
    Ok(())
}

/// The class colours from left to right, in the order of [`legend_text`], without labels, because this crate does not
/// draw text.
fn legend_picture() -> RgbaImage {
    const SWATCH: u32 = 48;
    let entries = legend();
    RgbaImage::from_fn(SWATCH * entries.len() as u32, SWATCH, |x, _| {
        let [r, g, b] = entries[(x / SWATCH) as usize].rgb;
        Rgba([r, g, b, 255])
    })
}

/// The classes with their colours, the most serious first.
fn legend_text() -> String {
    legend()
        .iter()
        .map(|e| {
            format!(
                "#{:02x}{:02x}{:02x}  {}: {}\n",
                e.rgb[0], e.rgb[1], e.rgb[2], e.name, e.meaning
            )
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway::strategies::Strategy;

    #[test]
    fn a_strategy_named_twice_is_measured_once() {
        let all = parse_renderers("all").unwrap();
        let strategies: Vec<Renderer> = Strategy::all().into_iter().map(Renderer::from).collect();
        assert_eq!(all, strategies);
        assert_eq!(
            parse_renderers("raycast+mask, all").unwrap().len(),
            all.len()
        );
        let message = parse_renderers("raycats+mask").unwrap_err().to_string();
        assert!(message.contains("did you mean `raycast`"), "{message}");
        assert!(
            parse_renderers("exact").is_err(),
            "the yardstick is not measured"
        );
    }

    #[test]
    fn means_may_be_several() {
        let list = "raycast+mask@compute,32-bit, stencil,raycast+mask@cells";
        let names: Vec<String> = (parse_renderers(list).unwrap().iter())
            .map(ToString::to_string)
            .collect();
        let expected = [
            "raycast+mask@compute,32-bit",
            "stencil",
            "raycast+mask@cells",
        ];
        assert_eq!(names, expected);
        assert!(parse_renderers("stencil,").is_err(), "a name is missing");
    }

    #[test]
    fn the_legend_has_a_swatch_for_each_class() {
        assert_eq!(legend_text().lines().count(), legend().len());
        assert_eq!(legend_picture().get_pixel(0, 0).0[..3], legend()[0].rgb);
    }
}
