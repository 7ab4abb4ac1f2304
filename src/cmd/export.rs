//! `export`: what cuts leave of a model, and what they remove, as mesh files with their caps. Needs no adapter.
//!
//! Parts are cut in f64, in world space, in their poses; nothing is rounded but for the format of the file. The file of what is removed
//! has the name of the other with `.removed` before its extension, as the material library of an OBJ file has `.mtl` behind its stem.
//! All of them are in memory before the first takes its place.

use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};

use super::Verdict;
use super::console::{Console, ConsoleArgs};
use super::defects::DefectArgs;
use super::edits::EditArgs;
use super::holes::HoleArgs;
use super::look::Usual;
use super::output::{Output, Pending, begun_with};
use super::places::{no_place_twice, paths_of};
use super::section::Unit;
use super::sections::SectionArgs;
use super::split::SplitArgs;
use super::stdin::StdinArgs;
use super::subject::{Subject, document};
use super::when::TimeArgs;
use crate::save::{Format, Solid, encoded, material_library};
use crate::scene::weld::thousands;
use crate::scene::{Edges, Mesh, Scene, doubts};
use crate::slice::{CappedPart, Half, RELIEF_CELLS, capped_with};
use crate::{Error, Result};

pub(super) const EXAMPLES: &str = "\
Examples:
  cutaway export bracket.stl --section x=50% -o half.stl
  cutaway export bracket.stl --section x=50% -o half.stl --both              # and half.removed.stl
  cutaway export shape:gears --wedge z:0:90 -o open.3mf --unit mm            # parts, names and colours, to print
  cutaway export engine.glb --box 50%,50%,50%: --exclude 'bolt*' -o cut.glb
  cutaway export bracket.stl --section x=50% --relief fractal:amplitude=5% -o ragged.stl
  cutaway export walk.glb --clip run --time 0.5 --section y=30% -o step.ply

What is written is closed where the model is, and all faces of it agree which side is out where those of the model do. Each part is a
solid of its own. Caps are a group of their own: a group in OBJ, a primitive in GLB, triangles of a material in 3MF, a property in PLY;
STL has no groups. OBJ, PLY and 3MF hold every bit of a coordinate, STL and GLB the 24 of f32. Planes cut exactly, and open meshes too; reliefs
and cutters cut closed meshes, by Boolean operations. Exit code 1 where a cap is missing, because the mesh is open there.";

/// Options of `export`.
#[derive(Args)]
pub(super) struct ExportArgs {
    /// Meshes, `shape:NAME?param=value`, or one scene (.toml), which brings its own cuts
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
    /// What is left: .stl, .ply, .obj (with .mtl), .glb or .3mf
    #[arg(
        long,
        short,
        required = true,
        value_name = "FILE",
        help_heading = "Output"
    )]
    output: String,
    /// Write what is removed as well, to FILE with .removed before its extension
    #[arg(long, help_heading = "Output")]
    both: bool,
    /// Triangles, volumes, areas of caps and open edges as JSON
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    /// How long a unit of the model is, for 3MF; other formats do not say it [default: mm]
    #[arg(long, value_enum, value_name = "UNIT", help_heading = "Output")]
    unit: Option<Unit>,
    /// Cells of a relief along the longer side of a part, 1 to 4096
    #[arg(
        long,
        value_name = "N",
        default_value_t = RELIEF_CELLS,
        value_parser = clap::value_parser!(u32).range(1..=4096),
        help_heading = "Output"
    )]
    relief_cells: u32,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Runs `export`.
pub(super) fn run(args: &ExportArgs) -> Result<Verdict> {
    let outputs = Outputs::checked(args)?;
    let console = Console::new(args.console, 3);
    console.step("opening");
    let mut document = document(&args.inputs, args.stdin, None)?;
    args.split.amend(&mut document)?;
    args.defects.amend(&mut document)?;
    args.holes.amend(&mut document)?;
    args.sections.amend(&mut document)?;
    args.when.amend(&mut document)?;
    let subject = Subject::open(document, None, Usual::default(), &args.edits, &console)?;
    subject.must_be_cut_by(&args.sections)?;
    subject.save_beside(outputs.all(), &args.edits)?;
    let scene = &subject.scene;
    if !scene.cuts.iter().any(|c| c.enabled) {
        let help = "add --section SPEC, for example --section z=50%";
        return Err(Error::input("export", "there is nothing to cut by", help));
    }
    doubts(scene).iter().for_each(|d| console.remark(d));

    console.step("cutting");
    let parts = capped_with(scene, args.relief_cells)?;
    let off = parts.iter().map(|p| p.relief_off).fold(0.0, f64::max);
    if off > 0.0 {
        let share = 100.0 * off / scene.bounds().size().length();
        console.note(format!(
            "caps follow their reliefs to {off:.2e} units, {share:.2} % of the size of the model; a larger --relief-cells does better"
        ));
    }
    console.step("writing");
    let kept = files(&outputs.kept, scene, &parts, |p| &p.halves.kept);
    let removed =
        (outputs.removed.iter()).map(|to| files(to, scene, &parts, |p| &p.halves.removed));
    let files: Vec<Pending> = std::iter::once(kept)
        .chain(removed)
        .collect::<Result<Vec<_>>>()?
        .into_iter()
        .flatten()
        .collect();
    files.into_iter().try_for_each(Pending::place)?;
    let facts: Vec<Facts> = parts.iter().map(|p| Facts::of(scene, p)).collect();
    if let Some(output) = &outputs.json {
        let all: Vec<Value> = facts.iter().map(Facts::to_json).collect();
        let json = json!({ "scene": scene.name, "parts": all });
        output.write(format!("{json:#}\n").as_bytes())?;
    }
    Ok(verdict(&facts, &parts, &console))
}

/// A mesh file, and what lies beside it.
struct MeshFile {
    path: PathBuf,
    format: Format,
    unit: &'static str,
    /// What is in it, in words.
    what: &'static str,
}

impl MeshFile {
    /// The material library of an OBJ file.
    fn library(&self) -> Option<PathBuf> {
        (self.format == Format::Obj).then(|| self.path.with_extension("mtl"))
    }
}

/// Where results go.
struct Outputs {
    kept: MeshFile,
    removed: Option<MeshFile>,
    json: Option<Output>,
}

impl Outputs {
    fn checked(args: &ExportArgs) -> Result<Self> {
        let value = args.output.as_str();
        let extensions = Format::BY_EXTENSION.map(|(extension, _)| extension);
        let path = match Output::checked("--output", value, &extensions)? {
            Output::File(path) => path,
            Output::Stdout => {
                let help = "name a file that ends in .stl, .ply, .obj, .glb or .3mf";
                return Err(Error::input(
                    "--output -",
                    "a mesh is written to a file",
                    help,
                ));
            }
        };
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let Some(format) = Format::of_extension(&extension) else {
            let what = "it is no file, and has no extension that names a format";
            let help = "name a file that ends in .stl, .ply, .obj, .glb or .3mf";
            return Err(Error::input(format!("--output {value}"), what, help));
        };
        if args.unit.is_some() && format != Format::ThreeMf {
            let what = format!("a .{extension} file does not say how long a unit is");
            return Err(Error::input("--unit", what, "leave it out, or write .3mf"));
        }
        let unit = args.unit.unwrap_or(Unit::Mm).in_3mf();
        let json = args
            .json
            .as_ref()
            .map(|v| Output::checked("--json", v, &[]));
        let removed = args.both.then(|| MeshFile {
            path: path.with_extension(format!("removed.{extension}")),
            format,
            unit,
            what: "removed",
        });
        let outputs = Self {
            kept: MeshFile {
                path: path.clone(),
                format,
                unit,
                what: "left",
            },
            removed,
            json: json.transpose()?,
        };
        let all: Vec<(&str, Output)> = (outputs.all().into_iter())
            .map(|(option, path)| (option, Output::File(path)))
            .collect();
        let all: Vec<(&str, Option<&Output>)> = all.iter().map(|(o, to)| (*o, Some(to))).collect();
        no_place_twice(&all)?;
        Ok(outputs)
    }

    /// All files, by the options that ask for them.
    fn all(&self) -> Vec<(&'static str, PathBuf)> {
        let mut all = vec![("--output", self.kept.path.clone())];
        all.extend(self.kept.library().map(|path| ("--output", path)));
        if let Some(removed) = &self.removed {
            all.push(("--both", removed.path.clone()));
            all.extend(removed.library().map(|path| ("--both", path)));
        }
        all.extend(paths_of(&[("--json", self.json.as_ref())]));
        all
    }
}

/// The files of one half, not yet in their places.
fn files(
    to: &MeshFile,
    scene: &Scene,
    parts: &[CappedPart],
    half: impl Fn(&CappedPart) -> &Half,
) -> Result<Vec<Pending>> {
    let solids: Vec<Solid<'_>> = (parts.iter())
        .map(|p| Solid::of(&scene.parts[p.part], half(p)))
        .filter(|s| !s.mesh.triangles.is_empty())
        .collect();
    if solids.is_empty() {
        let what = format!(
            "nothing of the model is {}, and a mesh is not empty",
            to.what
        );
        let help = "move the section, keep the other side (--flip), or leave --both out";
        return Err(Error::file(&to.path, what, help));
    }
    let stem = to.path.file_stem().unwrap_or_default().to_string_lossy();
    let mesh = begun_with(&to.path, &encoded(to.format, &solids, &stem, to.unit))?;
    let library = to.library();
    let library = library.map(|path| begun_with(&path, &material_library(&solids)));
    Ok(std::iter::once(mesh).chain(library.transpose()?).collect())
}

/// What there is to say of a part.
struct Facts {
    part: String,
    cuts: Vec<String>,
    /// Of the part as it came in.
    open_edges: usize,
    kept: HalfFacts,
    removed: HalfFacts,
    relief_off: f64,
    defects: Vec<String>,
}

/// What there is to say of a half of it.
struct HalfFacts {
    triangles: usize,
    cap_triangles: usize,
    volume: f64,
    cap_area: f64,
    open_edges: usize,
}

impl Facts {
    fn of(scene: &Scene, part: &CappedPart) -> Self {
        let own = &scene.parts[part.part];
        Self {
            part: own.name.clone(),
            cuts: part
                .cuts
                .iter()
                .map(|c| scene.cuts[*c].name.clone())
                .collect(),
            open_edges: open_edges(&own.mesh),
            kept: HalfFacts::of(&part.halves.kept),
            removed: HalfFacts::of(&part.halves.removed),
            relief_off: part.relief_off,
            defects: part
                .halves
                .defects
                .iter()
                .map(ToString::to_string)
                .collect(),
        }
    }

    fn to_json(&self) -> Value {
        json!({
            "part": self.part, "cuts": self.cuts, "open_edges": self.open_edges,
            "kept": self.kept.to_json(), "removed": self.removed.to_json(), "relief_off": self.relief_off,
            "defects": self.defects,
        })
    }
}

impl HalfFacts {
    fn of(half: &Half) -> Self {
        Self {
            triangles: half.mesh.triangles.len(),
            cap_triangles: half.mesh.triangles.len() - half.surface_triangles(),
            volume: if half.mesh.triangles.is_empty() {
                0.0
            } else {
                half.mesh.volume()
            },
            cap_area: half.cap_area(),
            open_edges: open_edges(&half.mesh),
        }
    }

    fn to_json(&self) -> Value {
        json!({
            "triangles": self.triangles, "cap_triangles": self.cap_triangles, "volume": self.volume,
            "cap_area": self.cap_area, "open_edges": self.open_edges,
        })
    }
}

fn open_edges(mesh: &Mesh) -> usize {
    Edges::of(&mesh.triangles).count().open
}

/// Says which caps are missing, and which parts came in open.
fn verdict(facts: &[Facts], parts: &[CappedPart], console: &Console) -> Verdict {
    let mut verdict = Verdict::Done;
    for (facts, part) in facts.iter().zip(parts) {
        let Facts {
            part: name,
            open_edges,
            kept,
            ..
        } = facts;
        if let Some(defect) = part.halves.defects.iter().find(|d| d.loses_cap()) {
            console.failed(format!("{name}: {defect}\n  help: {}", defect.help()));
            verdict = Verdict::Failed;
        }
        if *open_edges > 0 {
            let [before, after] = [*open_edges, kept.open_edges].map(thousands);
            console.note(format!(
                "{name} came in with {before} open edges; what is left has {after}"
            ));
        }
    }
    verdict
}
