//! `export`: the kept and removed halves of a cut model as mesh files with caps. Needs no adapter.
//!
//! Parts are cut in f64, in world space, in their poses; only the file format rounds coordinates. The removed half's file has
//! the same name with `.removed` before the extension; an OBJ file's material library ends in `.mtl` instead of `.obj`, and an
//! image of an OBJ or PLY file ends in `.0.png`.
//! All files are written next to their destinations before the first is renamed ([`Results`]); if a destination is a folder, no file is.

mod summary;

use std::path::PathBuf;

use clap::Args;
use cutaway::scene::numbers::round;
use cutaway::scene::weld::thousands;
use cutaway::scene::{Fill, LengthUnit, Scene, SceneSpace, Texture, doubts};
use cutaway::slice::{CappedPart, Half, RELIEF_CELLS, capped_with};
use cutaway::{Error, Result};
use cutaway_io::save::{MeshFormat, Solid, encoded, leaves_out, rounding};
use serde_json::{Value, json};

use self::summary::ExportSummary;
use crate::console::{Console, ConsoleArgs};
use crate::input::args::{fill_by, parse_fill};
use crate::input::defects::DefectArgs;
use crate::input::edits::EditArgs;
use crate::input::holes::HoleArgs;
use crate::input::look::Defaults;
use crate::input::sections::SectionArgs;
use crate::input::split::SplitArgs;
use crate::input::stdin::StdinArgs;
use crate::input::subject::{SceneInput, document};
use crate::input::when::TimeArgs;
use crate::interrupt::Interrupt;
use crate::verdict::Verdict;
use crate::writing::output::Output;
use crate::writing::places::{no_place_twice, paths_of};
use crate::writing::results::Results;

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway export bracket.stl --section x=50% -o half.stl
  cutaway export bracket.stl --section x=50% -o half.stl --both              # and half.removed.stl
  cutaway export shape:gears --wedge z:0:90 -o open.3mf --unit mm            # parts, names and colours, to print
  cutaway export engine.glb --box 50%,50%,50%: --exclude 'bolt*' -o cut.glb
  cutaway export bracket.stl --section x=50% --relief fractal:amplitude=5% -o ragged.stl
  cutaway export walk.glb --clip run --time 0.5 --section y=30% -o step.ply

The output is closed if the model is, and consistently oriented if the model is. Each part is a separate solid. Caps are a group in
OBJ, a primitive in GLB, triangles with their own material in 3MF, and a property in PLY; STL has no groups. OBJ, PLY and 3MF store every
bit of a coordinate, STL and GLB the 24 bits of f32. Planes cut exactly, even open meshes; reliefs and cutters cut only closed meshes,
by Boolean operations. Exit code 1 if a cap is missing because the mesh is open there; 130, without a file, if Ctrl-C or SIGTERM ended
the command.";

/// Options of `export`.
#[derive(Args)]
pub(crate) struct ExportArgs {
    /// Meshes, `shape:NAME?param=value`, or one scene (.toml) with its own cuts
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
    /// Fill rule for overlapping bodies of a part: even-odd or nonzero, for all parts. Reliefs and cutters cut the resulting solid; planes
    /// keep the bodies separate, each with its own cap [default: the scene's rule, or even-odd]
    #[arg(long, value_name = "RULE", value_parser = parse_fill)]
    fill: Option<Fill>,
    #[command(flatten)]
    defects: DefectArgs,
    #[command(flatten)]
    holes: HoleArgs,
    /// Output file for the kept half: .stl, .ply, .obj (with .mtl), .glb or .3mf; images lie next to .ply and .obj
    #[arg(
        long,
        short,
        required = true,
        value_name = "FILE",
        help_heading = "Output"
    )]
    output: String,
    /// Also write the removed half, to FILE with .removed before its extension
    #[arg(long, help_heading = "Output")]
    both: bool,
    /// Triangles, volumes, cap areas and open edges as JSON
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
    /// Length unit of the model, for 3MF; other formats do not store it [default: the model's unit, or mm]
    #[arg(long, value_parser = crate::input::unit::parser(), value_name = "UNIT", help_heading = "Output")]
    unit: Option<LengthUnit>,
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
pub(crate) fn run(args: &ExportArgs) -> Result<Verdict> {
    let outputs = ExportOutputs::checked(args)?;
    // Listen before any file is begun: otherwise Ctrl-C would leave it half written.
    let interrupt = Interrupt::listen("export", "step")?;
    let console = Console::new(args.console, 3);
    console.step("opening");
    let mut document = document(&args.inputs, args.stdin, None)?;
    args.split.amend(&mut document)?;
    fill_by(&mut document, args.fill)?;
    args.defects.amend(&mut document)?;
    args.holes.amend(&mut document)?;
    args.sections.amend(&mut document)?;
    args.when.amend(&mut document)?;
    let subject = SceneInput::open(document, None, Defaults::default(), &args.edits, &console)?;
    subject.must_be_cut_by(&args.sections)?;
    let scene = &subject.scene;
    let vertex_paints = scene
        .parts
        .iter()
        .filter_map(|p| p.mesh.vertex_paint.as_ref());
    let mut images = Vec::new();
    for image in vertex_paints.flat_map(|vertex_paint| &vertex_paint.images) {
        Texture::number_among(&mut images, image);
    }
    subject.save_beside(outputs.with_images(images.len()), &args.edits)?;
    if !scene.cuts.iter().any(|c| c.enabled) {
        let help = "add --section SPEC, for example --section z=50%";
        return Err(Error::input("export", "there is nothing to cut by", help));
    }
    doubts(scene).iter().for_each(|d| console.print(d));

    console.step("cutting");
    let parts = capped_with(scene, args.relief_cells)?;
    if interrupt.is_wanted() {
        console.note("interrupted: no file was written");
        return Ok(Verdict::Interrupted);
    }
    let off = parts.iter().map(|p| p.relief_off).fold(0.0, f64::max);
    if off > 0.0 {
        let share = 100.0 * off / scene.bounds().size().length();
        console.note(format!(
            "caps follow their reliefs to within {off:.2e} units, {share:.2} % of the model's size; a larger --relief-cells reduces this"
        ));
    }
    console.step("writing");
    let unit = match (args.unit, subject.unit()) {
        (Some(unit), _) | (None, Some(unit)) => unit,
        (None, None) => {
            if outputs.kept.format == MeshFormat::ThreeMf {
                console.note("nothing says how long a unit of the model is: it is taken as a millimetre; --unit sets another length unit");
            }
            LengthUnit::Mm
        }
    };
    let writer = Writer {
        scene,
        unit,
        console: &console,
    };
    let mut results = Results::default();
    writer.add(&mut results, &outputs.kept, &parts, |p| &p.halves.kept)?;
    if let Some(to) = &outputs.removed {
        writer.add(&mut results, to, &parts, |p| &p.halves.removed)?;
    }
    let space = SceneSpace::new(&scene.bounds());
    let summary = parts.iter().map(|p| ExportSummary::of(scene, p, &space));
    let summary: Vec<ExportSummary> = summary.collect();
    let all: Vec<Value> = summary.iter().map(ExportSummary::to_json).collect();
    let json = format!("{:#}\n", json!({ "scene": scene.name, "parts": all }));
    if let Some(output) = &outputs.json {
        results.add(output, json.into_bytes())?;
    }
    results.place()?;
    if outputs.kept.format == MeshFormat::ThreeMf && summary.iter().any(|f| f.kept.open_edges > 0) {
        console.note("3MF requires closed meshes: programs may refuse or repair open ones");
    }
    Ok(verdict(&summary, &parts, &console))
}

/// A mesh file, and the files next to it.
struct MeshFile {
    path: PathBuf,
    format: MeshFormat,
    /// Which half is in the file, as a word for messages.
    what: &'static str,
}

impl MeshFile {
    /// Paths of the file and of the files that may be written with it, for solids with `images` images.
    fn all(&self, images: usize) -> impl Iterator<Item = PathBuf> {
        let stem = self.path.file_stem().unwrap_or_default();
        let beside = self.format.beside(&stem.to_string_lossy(), images);
        let beside = beside
            .into_iter()
            .map(|name| self.path.with_file_name(name));
        std::iter::once(self.path.clone()).chain(beside)
    }
}

/// Output files.
struct ExportOutputs {
    kept: MeshFile,
    removed: Option<MeshFile>,
    json: Option<Output>,
}

impl ExportOutputs {
    fn checked(args: &ExportArgs) -> Result<Self> {
        let value = args.output.as_str();
        let extensions = MeshFormat::BY_EXTENSION.map(|(extension, _)| extension);
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
        let Some(format) = MeshFormat::of_extension(&extension) else {
            let what = "it is not a regular file, and its name has no mesh extension";
            let help = "name a file that ends in .stl, .ply, .obj, .glb or .3mf";
            return Err(Error::input(format!("--output {value}"), what, help));
        };
        if args.unit.is_some() && format != MeshFormat::ThreeMf {
            let what = format!("a .{extension} file does not store a length unit");
            return Err(Error::input("--unit", what, "leave it out, or write .3mf"));
        }
        let json = args
            .json
            .as_ref()
            .map(|v| Output::checked("--json", v, &[]));
        let removed = args.both.then(|| MeshFile {
            path: path.with_extension(format!("removed.{extension}")),
            format,
            what: "removed",
        });
        let outputs = Self {
            kept: MeshFile {
                path: path.clone(),
                format,
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
        for (option, path) in outputs.all() {
            Output::checked(option, &path.to_string_lossy(), &[])?;
        }
        Ok(outputs)
    }

    /// All files except images, with the options that request them.
    fn all(&self) -> Vec<(&'static str, PathBuf)> {
        self.with_images(0)
    }

    /// All files for solids with `images` images.
    fn with_images(&self, images: usize) -> Vec<(&'static str, PathBuf)> {
        let kept = self.kept.all(images).map(|path| ("--output", path));
        let removed = self.removed.iter().flat_map(|file| file.all(images));
        let mut all: Vec<_> = kept.chain(removed.map(|path| ("--both", path))).collect();
        all.extend(paths_of(&[("--json", self.json.as_ref())]));
        all
    }
}

/// A note is printed if rounding moves a vertex by more than this share of the model's size.
const COARSE: f64 = 1e-5;

/// Everything needed to write the files.
struct Writer<'a> {
    scene: &'a Scene,
    unit: LengthUnit,
    console: &'a Console,
}

impl Writer<'_> {
    /// Adds the files of one half.
    fn add(
        &self,
        results: &mut Results,
        to: &MeshFile,
        parts: &[CappedPart],
        half: impl Fn(&CappedPart) -> &Half,
    ) -> Result<()> {
        let solids: Vec<Solid<'_>> = (parts.iter())
            .map(|p| Solid::of(&self.scene.parts[p.part], half(p)))
            .filter(|s| !s.mesh.triangles.is_empty())
            .collect();
        if solids.is_empty() {
            let what = format!(
                "nothing of the model is {}, and a mesh cannot be empty",
                to.what
            );
            let help = "move the section, keep the other side (--flip), or leave --both out";
            return Err(Error::file(&to.path, what, help));
        }
        let size = self.scene.bounds().size().length();
        let off = rounding(to.format, &solids).filter(|off| *off > COARSE * size);
        if let Some(off) = off {
            self.console.note(format!(
                "{}: the format rounds coordinates by up to {off:.1e} units, because the model is far from the origin: move it there, or \
                 write .ply, .obj or .3mf",
                to.path.display()
            ));
        }
        if let Some(what) = leaves_out(to.format, &solids) {
            self.console.note(format!(
                "{}: written without {what} of the model, which this format does not store here; .glb does",
                to.path.display()
            ));
        }
        let stem = to.path.file_stem().unwrap_or_default().to_string_lossy();
        let encoded = encoded(to.format, &solids, &stem, self.unit).map_err(|e| {
            let help = "write .ply or .obj, which hold all digits and any size";
            Error::file(&to.path, e.to_string(), help)
        })?;
        results.add(&Output::File(to.path.clone()), encoded.file)?;
        for (name, bytes) in encoded.beside {
            results.add(&Output::File(to.path.with_file_name(name)), bytes)?;
        }
        Ok(())
    }
}

/// Warns of missing caps and of open input parts.
fn verdict(summary: &[ExportSummary], parts: &[CappedPart], console: &Console) -> Verdict {
    let mut verdict = Verdict::Done;
    for (summary, part) in summary.iter().zip(parts) {
        let ExportSummary {
            part: name,
            open_edges,
            kept,
            ..
        } = summary;
        for defect in part.halves.defects.iter().filter(|d| !d.loses_cap()) {
            console.note(format!("{name}: {defect}; {}", defect.help()));
        }
        if let Some(defect) = part.halves.defects.iter().find(|d| d.loses_cap()) {
            console.failed(format!("{name}: {defect}\n  help: {}", defect.help()));
            verdict = Verdict::Failed;
        }
        if let Some([caps, section]) = summary.overlap().map(|areas| areas.map(round)) {
            console.note(format!(
                "bodies of {name} overlap, and each has a cap of its own: the caps cover {caps} square units, the section {section}"
            ));
        }
        if *open_edges > 0 {
            let [before, after] = [*open_edges, kept.open_edges].map(thousands);
            console.note(format!(
                "{name} has {before} open edges in the input, and {after} after the cut"
            ));
        }
    }
    verdict
}
