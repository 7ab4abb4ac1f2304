//! `demo`: the main job on data of our own. No download, nothing to prepare.

use std::path::{Path, PathBuf};

use clap::Args;
use image::RgbaImage;

use super::Verdict;
use super::args::{AdapterArgs, MeansArgs};
use super::compare::{file_stem, legend_text};
use super::console::{Console, ConsoleArgs};
use super::edits::EditArgs;
use super::judge::{self, judge};
use super::output::{checked_folder, write_file, write_stdout};
use super::picture::{self, Backdrop, Style};
use super::subject::Subject;
use crate::Result;
use crate::document::{Document, cut, part, section};
use crate::experiment::{Judgement, Renderer, Shown};
use crate::report::{self, Figure};
use crate::session::Session;

pub(super) const EXAMPLES: &str = "\
Examples:
  cutaway demo
  cutaway demo --out /tmp/cutaway --resolution 1920,1080

Open report.html in the folder: the tabs show every strategy and where it is wrong, in the same place.";

/// The scene of the demo: a corner cut out of the crank along two ragged reliefs.
fn scene(size_px: [u32; 2]) -> Result<Document> {
    let mut document = Document::new();
    document.add_part(part("shape:crank"))?;
    document.add_cut(cut([
        section("-z=50%").relief("fractal:amplitude=4%,period=45%,seed=7"),
        section("x=60%").relief("fractal:amplitude=5%,period=30%,seed=4"),
    ]))?;
    document.set("camera.azimuth_deg", -26.0)?;
    document.set("camera.elevation_deg", 20.0)?;
    document.set("camera.zoom", 1.25)?;
    document.set("resolution", size_px.map(i64::from).to_vec())?;
    Ok(document)
}

/// Options of `demo`.
#[derive(Args)]
pub(super) struct DemoArgs {
    /// Folder for the pictures and the report
    #[arg(long, value_name = "DIR", default_value = "target/demo")]
    out: PathBuf,
    /// Width and height of the pictures in pixels
    #[arg(
        long,
        value_name = "W,H",
        default_value = "1000,520",
        value_parser = super::args::parse_resolution
    )]
    resolution: [u32; 2],
    /// Measured rounds, after one to warm up
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
    means: MeansArgs,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Runs `demo`.
pub(super) fn run(args: &DemoArgs) -> Result<Verdict> {
    checked_folder("--out", &args.out)?;
    let renderers = Renderer::named("all")?;
    let rounds = args.rounds as usize;
    let steps = 2 + renderers.len() + judge::steps(renderers.len(), rounds);
    let console = Console::new(args.console, steps);
    console.step("opening");
    let mut document = scene(args.resolution)?;
    args.means.amend(&mut document)?;
    let text = document.to_string();
    let subject = Subject::open(document, None, &EditArgs::default(), &console)?;
    let mut session = args.device.session(false)?;
    let shown = Shown::of(&subject.scene);
    let judgement = judge(&mut session, &shown, &subject, &renderers, rounds, &console)?;

    let mut pictures = Vec::new();
    for renderer in std::iter::once(Renderer::EXACT).chain(renderers) {
        console.step(format!("picture by {renderer}"));
        pictures.extend(pictures_of(
            &mut session,
            &shown,
            &subject,
            &judgement,
            renderer,
        )?);
    }
    write(&args.out, &judgement, &pictures)?;
    write_file(&args.out.join("scene.toml"), text.as_bytes())?;
    drop(console);
    say(&args.out, &judgement)?;
    Ok(Verdict::Done)
}

/// A picture with what there is to say about it.
struct Picture {
    file: String,
    title: String,
    caption: String,
    png: Vec<u8>,
}

/// The picture of a renderer and, for a strategy, its heat map. A strategy that refuses the scene has none.
fn pictures_of(
    session: &mut Session,
    shown: &Shown,
    subject: &Subject,
    judgement: &Judgement,
    renderer: Renderer,
) -> Result<Vec<Picture>> {
    let style = Style {
        supersample: 2,
        backdrop: Backdrop::Gradient,
    };
    let view = subject.view(&shown.model.prepared);
    if renderer == Renderer::EXACT {
        let exact = picture::draw(session, shown, &view, renderer, style)?.image;
        let caption =
            "Evaluated from the definition for every pixel, on the CPU in double precision.";
        return Ok(vec![picture("exact", "exact", caption, &exact)?]);
    }
    let frames = judgement
        .frames
        .iter()
        .zip(&judgement.measurement.strategies);
    let mut of_renderer = frames.filter(|(f, _)| f.renderer == renderer);
    let (Some((frame, found)), name) = (of_renderer.next(), renderer.to_string()) else {
        return Ok(Vec::new());
    };
    let (Some(heatmap), Some(comparison)) = (judgement.heatmap(frame), &found.comparison) else {
        return Ok(Vec::new());
    };
    let stem = file_stem(&renderer);
    let drawn = renderer.or(subject.means()?);
    let drawn = picture::draw(session, shown, &view, drawn, style)?.image;
    let wrong = comparison.decided_wrong_px;
    let caption = match wrong {
        0 => "No pixel is wrong where the exact reference is sure.".to_owned(),
        _ => format!("{wrong} pixels are wrong where the exact reference is sure."),
    };
    let legend = legend_text().trim_end().replace('\n', ", ");
    let where_wrong = format!("Where it differs from exact: {legend}.");
    Ok(vec![
        picture(&stem, &name, &caption, &drawn)?,
        picture(
            &format!("{stem}.heatmap"),
            &format!("{name}: where it is wrong"),
            &where_wrong,
            &heatmap,
        )?,
    ])
}

fn picture(stem: &str, title: &str, caption: &str, image: &RgbaImage) -> Result<Picture> {
    Ok(Picture {
        file: format!("{stem}.png"),
        title: title.to_owned(),
        caption: caption.to_owned(),
        png: picture::png(image)?,
    })
}

fn write(folder: &Path, judgement: &Judgement, pictures: &[Picture]) -> Result<()> {
    for picture in pictures {
        write_file(&folder.join(&picture.file), &picture.png)?;
    }
    let figures: Vec<Figure<'_>> = pictures
        .iter()
        .map(|p| Figure {
            title: &p.title,
            file: &p.file,
            caption: &p.caption,
            png: &p.png,
        })
        .collect();
    let title = "A crankshaft cut by a ragged relief";
    let report = &judgement.measurement;
    let pages = [
        ("report.md", report::markdown(title, report, &figures)),
        ("report.html", report::html(title, report, &figures)),
        ("report.json", format!("{:#}\n", serde_json::json!(report))),
    ];
    for (name, text) in pages {
        write_file(&folder.join(name), text.as_bytes())?;
    }
    Ok(())
}

/// The table, and where everything is.
fn say(folder: &Path, judgement: &Judgement) -> Result<()> {
    let text = format!(
        "{}\npictures, heat maps and the report are in {}\n  open {}\nanother view of the same scene:\n  cutaway render {} --camera-azimuth-angle=60 -o crank.png\n",
        report::text(&judgement.measurement),
        folder.display(),
        folder.join("report.html").display(),
        folder.join("scene.toml").display()
    );
    write_stdout(text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::Assets;
    use crate::scene::section_misses;

    #[test]
    fn the_scene_of_the_demo_is_cut() {
        let document = scene([64, 48]).unwrap();
        let scene = document.resolve(0.0, &mut Assets::default()).unwrap();
        let bounds = scene.bounds();
        assert_eq!(scene.cuts.len(), 1);
        for surface in &scene.cuts[0].surfaces {
            assert!(surface.relief.is_some(), "the cut is ragged");
            assert!(!section_misses(surface, &bounds), "it meets the crank");
        }
    }
}
