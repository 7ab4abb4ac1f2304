//! `section`: plane sections of a model, as a drawing (SVG, DXF), as data, or as a table of areas. Needs no adapter.
//!
//! Every part is sliced by every plane of the cuts that apply to it: in f64, in world space, in its pose, without rounding to the
//! precision of a GPU. A section is the plane's cap: what the plane's cut and the other cuts leave of the slice ([`planes`]).

use std::cmp::Reverse;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use rayon::prelude::*;

mod planes;

use cutaway::scene::numbers::round;
use cutaway::scene::{Fill, LengthUnit, Part, Scene, SceneSpace, doubts, who_wins};
use cutaway::slice::{Section, Slicer, Trim};
use cutaway::{Error, Result};
use cutaway_io::save::section::{DrawingPlane, PartReport, PlaneReport, SectionReport, dxf, svg};
use cutaway_lab::report::TextTable;

use self::planes::{CutPlane, planes};
use crate::console::{Console, ConsoleArgs};
use crate::input::args::fill_by;
use crate::input::defects::DefectArgs;
use crate::input::edits::EditArgs;
use crate::input::holes::HoleArgs;
use crate::input::look::Defaults;
use crate::input::sections::SectionArgs;
use crate::input::split::SplitArgs;
use crate::input::stdin::StdinArgs;
use crate::input::subject::{SceneInput, document};
use crate::input::when::TimeArgs;
use crate::verdict::Verdict;
use crate::writing::output::{Output, write_stdout};
use crate::writing::places::{no_place_twice, paths_of};
use crate::writing::results::Results;

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway section bracket.stl --section z=50%                                # a table of areas
  cutaway section bracket.stl --section z=50% -o cut.svg --unit mm           # a drawing in the size of the model
  cutaway section bracket.stl --box 0,0,0: -o corner.svg                     # the three faces of a corner that is cut out
  cutaway section bracket.stl --section z=50% -o cut.dxf --unit mm           # closed polylines, a layer for each part
  cutaway section shape:gears --section z=10% --section z=90% --whole -o gears.svg   # two sections of all of it
  cutaway section engine.glb --section x=50% --exclude 'bolt*' --json - | jq '.sections[0].area'
  cutaway section walk.glb --clip run --time 0.5 --section y=30% -o step.json

A section is the plane's cap, trimmed by the other planes of its cut and by the other cuts. A drawing shows the section as seen from
the removed side, as `cutaway render` does. Areas and lengths are in units of the model. Exit code 1 if an outline does not close
because the mesh is open there: the area then counts only outlines that close, unless --close winding completes the others.";

/// Options of `section`.
#[derive(Args)]
pub(crate) struct SectionCommandArgs {
    /// Meshes, `-` for one from standard input, `shape:NAME?param=value`, or one scene (.toml) with its own cuts
    #[arg(required = true, value_name = "SCENE|MODEL")]
    inputs: Vec<String>,
    #[command(flatten)]
    stdin: StdinArgs,
    #[command(flatten)]
    edits: EditArgs,
    #[command(flatten)]
    sections: SectionArgs,
    #[command(flatten)]
    when: TimeArgs,
    #[command(flatten)]
    split: SplitArgs,
    #[command(flatten)]
    defects: DefectArgs,
    #[command(flatten)]
    holes: HoleArgs,
    /// Fill rule for each mesh's interior: even-odd or nonzero [default: the scene's rule, or even-odd]
    #[arg(long, value_name = "RULE", value_parser = crate::input::args::parse_fill)]
    fill: Option<Fill>,
    /// What closes outlines where the mesh is open [default: nothing, they bound no area]
    #[arg(long, value_enum, value_name = "BY")]
    close: Option<CloseBy>,
    /// Slice the whole model by every plane, ignoring the rest of its cut and all other cuts
    #[arg(long)]
    whole: bool,
    /// Output drawing, .svg or .dxf, or data, .json; `-` for an SVG drawing on standard output
    #[arg(long, short, value_name = "FILE|-", help_heading = "Output")]
    output: Option<String>,
    /// Areas, perimeters, loops and planes as JSON; `-` prints it instead of the table
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    /// Length unit of the model, for a true-size SVG drawing or the unit of a DXF drawing [default: SVG fitted to 1000 pixels; DXF none]
    #[arg(long, value_parser = crate::input::unit::parser(), value_name = "UNIT", help_heading = "Output")]
    unit: Option<LengthUnit>,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// What closes outlines where the mesh is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum CloseBy {
    /// The mesh's winding number: the area is where it rounds to inside, and straight lines complete its outline, which are reported
    Winding,
}

/// Runs `section`.
pub(crate) fn run(args: &SectionCommandArgs) -> Result<Verdict> {
    let outputs = SectionOutputs::checked(args)?;
    let console = Console::new(args.console, 3);
    console.step("opening");
    let mut document = document(&args.inputs, args.stdin, None)?;
    args.split.amend(&mut document)?;
    args.defects.amend(&mut document)?;
    args.holes.amend(&mut document)?;
    fill_by(&mut document, args.fill)?;
    args.sections.amend(&mut document)?;
    args.when.amend(&mut document)?;
    let subject = SceneInput::open(document, None, Defaults::default(), &args.edits, &console)?;
    subject.must_be_cut_by(&args.sections)?;
    subject.save_beside(outputs.paths.clone(), &args.edits)?;
    let scene = &subject.scene;
    let planes = planes(scene)?;
    doubts(scene).iter().for_each(|d| console.print(d));

    console.step("slicing");
    let report = sliced(scene, &planes, args);
    console.step("writing");
    let mut results = Results::default();
    if let Some(output) = &outputs.drawing {
        let drawing = match has_extension(output, "dxf") {
            true => dxf(&report, args.unit),
            false => svg(&report, args.unit),
        };
        results.add(output, drawing.into_bytes())?;
    }
    if let Some(output) = &outputs.json {
        let json = serde_json::to_string_pretty(&report).map_err(|e| {
            let help = "leave --json out, and report this";
            Error::input("--json", format!("cannot be encoded: {e}"), help)
        })?;
        results.add(output, format!("{json}\n").into_bytes())?;
    }
    results.place()?;
    if outputs.drawing.is_none() && outputs.json != Some(Output::Stdout) {
        write_stdout(to_text(&report).as_bytes())?;
    }
    Ok(verdict(&report, &console))
}

/// Output files.
struct SectionOutputs {
    drawing: Option<Output>,
    json: Option<Output>,
    /// The outputs that are files, with the options that name them.
    paths: Vec<(&'static str, PathBuf)>,
}

impl SectionOutputs {
    fn checked(args: &SectionCommandArgs) -> Result<Self> {
        let output = args.output.as_ref();
        let output = output.map(|v| Output::checked("--output", v, &["svg", "dxf", "json"]));
        let json = args
            .json
            .as_ref()
            .map(|v| Output::checked("--json", v, &[]));
        let (output, json) = (output.transpose()?, json.transpose()?);
        let named = [("--output", output.as_ref()), ("--json", json.as_ref())];
        no_place_twice(&named)?;
        let paths = paths_of(&named).collect();
        let is_json = |o: &Output| has_extension(o, "json");
        match output {
            Some(output) if is_json(&output) && json.is_some() => Err(Error::input(
                "--json",
                "--output asks for the same data",
                "give one of them, or let --output name a drawing (.svg, .dxf)",
            )),
            Some(output) if is_json(&output) => Ok(Self {
                drawing: None,
                json: Some(output),
                paths,
            }),
            drawing => Ok(Self {
                drawing,
                json,
                paths,
            }),
        }
    }
}

fn has_extension(output: &Output, wanted: &str) -> bool {
    let extension = output.path().and_then(|p| p.extension());
    extension.is_some_and(|e| e.eq_ignore_ascii_case(wanted))
}

fn sliced(scene: &Scene, planes: &[CutPlane], args: &SectionCommandArgs) -> SectionReport {
    let mut parts: Vec<(usize, &Part)> = scene.parts.iter().enumerate().collect();
    // Where solids share a point, the part that is shown is drawn last, over the others; of equal parts, the first is shown.
    parts.sort_by_cached_key(|(index, p)| {
        Reverse(who_wins(p, p.placed_volume(p.mesh.volume()), *index))
    });
    let space = SceneSpace::new(&scene.bounds());
    let drawn: Vec<DrawingPlane> = (planes.iter())
        .map(|p| DrawingPlane::of(&p.plane, scene.camera.up))
        .collect();
    let of_parts: Vec<Vec<PartSection>> = (parts.par_iter())
        .map(|(_, part)| {
            let is_cut = |p: &&CutPlane| scene.cuts[p.cut].applies_to(part);
            if !planes.iter().any(|p| is_cut(&p)) {
                return planes.iter().map(|_| PartSection::Missed).collect();
            }
            let (slicer, bounds) = (Slicer::of_part_in(part, &space), part.bounds_in_world());
            let of_plane = |(p, drawn): (&CutPlane, &DrawingPlane)| {
                if !is_cut(&p) {
                    return PartSection::Missed;
                }
                let at = p.for_part(scene, part).seen_from(bounds.centre());
                let whole = match args.close {
                    Some(CloseBy::Winding) => slicer.section_by_winding(&at, part.fill),
                    None => slicer.section_by(&at, part.fill),
                };
                if is_nothing(&whole) {
                    return PartSection::Missed;
                }
                let all = args.whole.then(Trim::default);
                let size = bounds.radius();
                let trim = all.or_else(|| p.trim((scene, planes), part, &at, size));
                let Some(trim) = trim else {
                    return PartSection::Trimmed(None);
                };
                let Some(section) = trim.of(&whole, &at) else {
                    return PartSection::Whole(PartReport::new(part, &whole, &at, drawn));
                };
                let report = || PartReport::new(part, &section, &at, drawn);
                PartSection::Trimmed((!is_nothing(&section)).then(report))
            };
            planes.iter().zip(&drawn).map(of_plane).collect()
        })
        .collect();
    let of_plane = |(i, (p, drawn)): (usize, (&CutPlane, &DrawingPlane))| {
        let of_plane = || of_parts.iter().map(|all| &all[i]);
        let is_trimmed = of_plane().any(|s| matches!(s, PartSection::Trimmed(_)));
        let met = of_plane()
            .filter_map(PartSection::report)
            .cloned()
            .collect();
        let name = &scene.cuts[p.cut].name;
        PlaneReport {
            trimmed: is_trimmed,
            ..PlaneReport::new(name, p.face.clone(), p.number, *drawn, met)
        }
    };
    SectionReport {
        scene: scene.name.clone(),
        sections: (planes.iter().zip(&drawn).enumerate())
            .map(of_plane)
            .collect(),
    }
}

/// A part's section by a plane.
enum PartSection {
    /// No section: the plane misses the part, or does not apply to it.
    Missed,
    /// The whole section in the plane.
    Whole(PartReport),
    /// The section trimmed by the rest of its cut and by other cuts, if anything is left.
    Trimmed(Option<PartReport>),
}

impl PartSection {
    fn report(&self) -> Option<&PartReport> {
        match self {
            Self::Missed => None,
            Self::Whole(report) => Some(report),
            Self::Trimmed(report) => report.as_ref(),
        }
    }
}

fn is_nothing(section: &Section) -> bool {
    section.is_empty() && section.defects.is_empty()
}

fn to_text(report: &SectionReport) -> String {
    let mut table = TextTable::new(["cut", "part", "area", "perimeter", "loops", "open"]);
    for plane in &report.sections {
        for part in &plane.parts {
            table.row([
                plane.name(),
                part.part.clone(),
                round(part.area),
                round(part.perimeter),
                part.loops.len().to_string(),
                part.open_chains.len().to_string(),
            ]);
        }
        if plane.parts.len() != 1 {
            let all = match plane.parts.len() {
                0 if plane.trimmed => "nothing is left (--whole shows all of it)".to_owned(),
                0 => "meets no part".to_owned(),
                count => format!("all {count} parts"),
            };
            let (area, perimeter) = (round(plane.area), round(plane.perimeter));
            table.row([plane.name(), all, area, perimeter]);
        }
    }
    table.to_text()
}

/// Warns of outlines that do not close, and of other results that may be wrong.
fn verdict(report: &SectionReport, console: &Console) -> Verdict {
    let mut verdict = Verdict::Done;
    for plane in &report.sections {
        for part in &plane.parts {
            let message = format!(
                "{} by {}: {}",
                part.part,
                plane.name(),
                part.defects.join("; ")
            );
            if !part.closed {
                let help = part.help.unwrap_or("move the section");
                console.failed(format!("{message}\n  help: {help}"));
                verdict = Verdict::Failed;
            } else if !part.defects.is_empty() {
                console.note(message);
            }
        }
    }
    verdict
}
