//! `section`: what planes cut out of a model, as a drawing, as data, or as a table of areas. Needs no adapter.
//!
//! Every part is sliced by every plane of the cuts that apply to it, whole, whatever else is cut away: in f64, in world space, in its
//! pose. Nothing is rounded to what a GPU draws.

use std::cmp::Reverse;
use std::path::PathBuf;
use std::sync::Arc;

use clap::{Args, ValueEnum};
use glam::DVec3;
use rayon::prelude::*;

use super::Verdict;
use super::console::{Console, ConsoleArgs};
use super::defects::DefectArgs;
use super::open::{Inputs, open_model};
use super::output::{Output, write_stdout};
use super::places::{no_place_twice, paths_of};
use super::sections::{SectionArgs, round, warn_of_misses};
use super::when::TimeArgs;
use crate::report::{self, Drawn, PartReport, PlaneReport, SectionReport, Table, svg};
use crate::scene::{Bounds, ClipSurface, Fill, Part, Scene, who_wins};
use crate::slice::{SlicePlane, Slicer};
use crate::{Error, Result};

pub(super) const EXAMPLES: &str = "\
Examples:
  cutaway section bracket.stl --section z=50%                                # a table of areas
  cutaway section bracket.stl --section z=50% -o cut.svg --unit mm           # a drawing in the size of the model
  cutaway section shape:gears --section z=10% --section z=90% -o gears.svg   # both in one drawing, side by side
  cutaway section engine.glb --section x=50% --exclude 'bolt*' --json - | jq '.sections[0].area'
  cutaway section walk.glb --clip run --time 0.5 --section y=30% -o step.json

A drawing shows a plane as it is seen from the side that is removed, as `cutaway render` shows the cap. Areas and lengths are in
units of the model. Exit code 1 where an outline does not close, because the mesh is open there: the area is then that of what
closes.";

/// Options of `section`.
#[derive(Args)]
pub(super) struct SectionCommandArgs {
    /// Meshes, `shape:NAME?param=value`, or one scene (.toml), which brings its own cuts
    #[arg(required = true, value_name = "SCENE|MODEL")]
    inputs: Vec<String>,
    #[command(flatten)]
    sections: SectionArgs,
    #[command(flatten)]
    when: TimeArgs,
    #[command(flatten)]
    defects: DefectArgs,
    /// Which points each mesh encloses: even-odd or nonzero [default: that of the scene, or even-odd]
    #[arg(long, value_name = "RULE", value_parser = super::args::parse_fill)]
    fill: Option<Fill>,
    /// The drawing, .svg, or the data, .json; `-` for a drawing on standard output
    #[arg(long, short, value_name = "FILE|-", help_heading = "Output")]
    output: Option<String>,
    /// Areas, perimeters, loops and planes as JSON; with `-` instead of the table
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    /// How long a unit of the model is: the drawing gets the size of the model [default: fitted to 1000 pixels]
    #[arg(long, value_enum, value_name = "UNIT", help_heading = "Output")]
    unit: Option<Unit>,
    #[command(flatten)]
    console: ConsoleArgs,
}

#[derive(Clone, Copy, ValueEnum)]
enum Unit {
    /// Millimetres
    Mm,
    /// Centimetres
    Cm,
    /// Metres
    M,
    /// Inches
    In,
}

impl From<Unit> for report::Unit {
    fn from(unit: Unit) -> Self {
        match unit {
            Unit::Mm => Self::Mm,
            Unit::Cm => Self::Cm,
            Unit::M => Self::M,
            Unit::In => Self::In,
        }
    }
}

/// Runs `section`.
pub(super) fn run(args: &SectionCommandArgs) -> Result<Verdict> {
    let outputs = Outputs::checked(args)?;
    let console = Console::new(args.console, 3);
    console.step("opening");
    let inputs = Inputs::open(&args.inputs, &args.when, &console)?;
    let (mut scene, timeline) = inputs.at(&args.when)?;
    args.defects.apply_and_say(&mut scene, &console)?;
    args.when.note_of_still(&timeline, &console);
    for part in &mut scene.parts {
        part.fill = args.fill.unwrap_or(part.fill);
    }
    args.sections.apply(&mut scene)?;
    // To be refused as those of scene files are: by the name of the cut.
    args.sections
        .add_cutters(&mut scene, |input| Ok(open_model(input, &inputs.files)?.0))?;
    inputs.files.add(args.sections.images());
    inputs.files.keep_from(outputs.paths.clone())?;
    let planes = planes(&scene)?;
    warn_of_misses(&scene, &console);

    console.step("slicing");
    let report = sliced(&scene, &planes);
    console.step("writing");
    if let Some(output) = &outputs.drawing {
        output.write(svg(&report, args.unit.map(Into::into)).as_bytes())?;
    }
    if let Some(output) = &outputs.json {
        let json = serde_json::to_string_pretty(&report).map_err(|e| {
            let mend = "leave --json out, and report this";
            Error::input("--json", format!("cannot be encoded: {e}"), mend)
        })?;
        output.write(format!("{json}\n").as_bytes())?;
    }
    if outputs.drawing.is_none() && outputs.json != Some(Output::Stdout) {
        write_stdout(to_text(&report).as_bytes())?;
    }
    Ok(verdict(&report, &console))
}

/// Where results go.
struct Outputs {
    drawing: Option<Output>,
    json: Option<Output>,
    /// Those that are files, by the options that name them.
    paths: Vec<(&'static str, PathBuf)>,
}

impl Outputs {
    fn checked(args: &SectionCommandArgs) -> Result<Self> {
        let output = args.output.as_ref();
        let output = output.map(|v| Output::checked("--output", v, &["svg", "json"]));
        let json = args
            .json
            .as_ref()
            .map(|v| Output::checked("--json", v, &[]));
        let (output, json) = (output.transpose()?, json.transpose()?);
        let named = [("--output", output.as_ref()), ("--json", json.as_ref())];
        no_place_twice(&named)?;
        let paths = paths_of(&named).collect();
        let is_json = |o: &Output| {
            let extension = o.path().and_then(|p| p.extension());
            extension.is_some_and(|e| e.eq_ignore_ascii_case("json"))
        };
        match output {
            Some(output) if is_json(&output) && json.is_some() => Err(Error::input(
                "--json",
                "--output asks for the same data",
                "give one of them, or let --output name a drawing (.svg)",
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

/// A plane, the cut that it belongs to, and its number in the scene.
struct Plane {
    cut: usize,
    number: usize,
    plane: SlicePlane,
}

impl Plane {
    /// Where the plane cuts a part, whose middle is given: the cut may be offset for it.
    fn for_part(&self, scene: &Scene, part: &Part, middle: DVec3) -> SlicePlane {
        let offset = scene.cuts[self.cut].offset_for(part);
        self.plane.keeping(offset).seen_from(middle)
    }
}

/// The planes of all cuts; the culprit where there is none, or where one is no plane.
fn planes(scene: &Scene) -> Result<Vec<Plane>> {
    let mut planes = Vec::new();
    // Clip-surfaces of a cut that is off keep their numbers, and a cutter is one after the others of its cut.
    let mut next = 0;
    for (index, cut) in scene.cuts.iter().enumerate() {
        let first = next;
        next += cut.surfaces.len() + usize::from(cut.volume.is_some());
        if !cut.enabled {
            continue;
        }
        if let Some(cutter) = &cut.volume {
            return Err(Error::input(
                format!("cut `{}`", cut.name),
                format!(
                    "{} is a mesh that cuts, and a section is flat",
                    cutter.name()
                ),
                "leave it out, or see the cap with `cutaway render`",
            ));
        }
        for (number, surface) in (first..).zip(&cut.surfaces) {
            let Some(plane) = plane_of(surface) else {
                return Err(Error::input(
                    format!("cut `{}`", cut.name),
                    format!("clip-surface {number} has a relief, and a section is flat"),
                    "leave the relief out, or see the ragged cap with `cutaway render`",
                ));
            };
            planes.push(Plane {
                cut: index,
                number,
                plane,
            });
        }
    }
    if planes.is_empty() {
        return Err(Error::input(
            "section",
            "there is no plane to cut by",
            "add --section SPEC, for example --section z=50%",
        ));
    }
    Ok(planes)
}

/// The plane of a clip-surface, where a relief does not bend it.
fn plane_of(surface: &ClipSurface) -> Option<SlicePlane> {
    let plane = SlicePlane::from(surface);
    if let Some(map) = &surface.relief {
        let [low, high] = map.range().map(|h| f64::from(h) * surface.scale.z);
        if low != high {
            return None;
        }
        return Some(plane.keeping(low));
    }
    Some(plane)
}

fn sliced(scene: &Scene, planes: &[Plane]) -> SectionReport {
    let mut parts: Vec<(usize, &Part)> = scene.parts.iter().enumerate().collect();
    // Who wins where solids share a point is drawn last, over the others: of equals the first.
    parts.sort_by_cached_key(|(index, p)| {
        Reverse(who_wins(p, p.placed_volume(p.mesh.volume()), *index))
    });
    let drawn: Vec<Drawn> = (planes.iter())
        .map(|p| Drawn::of(&p.plane, scene.camera.up))
        .collect();
    let of_parts: Vec<Vec<Option<PartReport>>> = (parts.par_iter())
        .map(|(_, part)| {
            let is_cut = |p: &&Plane| scene.cuts[p.cut].applies_to(part);
            if !planes.iter().any(|p| is_cut(&p)) {
                return planes.iter().map(|_| None).collect();
            }
            let (slicer, middle) = slicer_of(part);
            let of_plane = |(p, drawn): (&Plane, &Drawn)| {
                let plane = is_cut(&p).then(|| p.for_part(scene, part, middle))?;
                let section = slicer.section_by(&plane, part.fill);
                let is_met = !section.is_empty() || !section.defects.is_empty();
                is_met.then(|| PartReport::of(part, &section, &plane, drawn))
            };
            planes.iter().zip(&drawn).map(of_plane).collect()
        })
        .collect();
    let of_plane = |(i, (p, drawn)): (usize, (&Plane, &Drawn))| {
        let met = of_parts.iter().filter_map(|all| all[i].clone()).collect();
        PlaneReport::of(&scene.cuts[p.cut].name, p.number, *drawn, met)
    };
    SectionReport {
        scene: scene.name.clone(),
        sections: (planes.iter().zip(&drawn).enumerate())
            .map(of_plane)
            .collect(),
    }
}

/// The slicer of a part as it stands in the world, and the middle of its bounds.
fn slicer_of(part: &Part) -> (Slicer, DVec3) {
    let mesh = part.posed_mesh();
    let placed = part.world_from_part;
    let positions: Vec<DVec3> = (mesh.positions.par_iter())
        .map(|p| placed.transform_point3(*p))
        .collect();
    let middle = Bounds::of(positions.iter().copied()).centre();
    if placed.matrix3.determinant() >= 0.0 {
        return (Slicer::of(Arc::new(positions), &mesh.triangles), middle);
    }
    // What a placement mirrors is turned round, so that outside stays outside.
    let turned: Vec<[u32; 3]> = mesh
        .triangles
        .iter()
        .map(|[a, b, c]| [*a, *c, *b])
        .collect();
    (Slicer::of(Arc::new(positions), &turned), middle)
}

fn to_text(report: &SectionReport) -> String {
    let mut table = Table::new(["cut", "part", "area", "perimeter", "loops", "open"]);
    for plane in &report.sections {
        for part in &plane.parts {
            table.row([
                plane.cut.clone(),
                part.part.clone(),
                round(part.area),
                round(part.perimeter),
                part.loops.len().to_string(),
                part.open_chains.len().to_string(),
            ]);
        }
        if plane.parts.len() != 1 {
            let all = match plane.parts.len() {
                0 => "meets no part".to_owned(),
                count => format!("all {count} parts"),
            };
            let (area, perimeter) = (round(plane.area), round(plane.perimeter));
            table.row([plane.cut.clone(), all, area, perimeter]);
        }
    }
    table.to_text()
}

/// Says which outlines do not close, and notes what else is doubtful.
fn verdict(report: &SectionReport, console: &Console) -> Verdict {
    let mut verdict = Verdict::Done;
    for plane in &report.sections {
        for part in &plane.parts {
            let told = format!(
                "{} by {}: {}",
                part.part,
                plane.cut,
                part.defects.join("; ")
            );
            if !part.closed {
                let mend = part.mend.unwrap_or("move the section");
                console.failed(format!("{told}\n  mend: {mend}"));
                verdict = Verdict::Failed;
            } else if !part.defects.is_empty() {
                console.note(told);
            }
        }
    }
    verdict
}
