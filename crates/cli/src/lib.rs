//! The command `cutaway`: one file per subcommand, and shared code. [`main`] runs the installed command, [`main_with`]
//! the same command with a window. The window also uses [`write_file`] and [`is_one_file`], so that both treat files alike.
//!
//! Imports: [`cutaway`], [`cutaway_io`], [`cutaway_lab`].
//!
//! All user input is checked before the work starts: options, scene files, meshes, and whether the
//! outputs can be written. Standard output carries only the requested results; notes, warnings, progress and errors go to
//! standard error. A file is written completely or not at all.
//!
//! Exit codes: 0 done; 1 done, but a stated expectation failed; 2 bad input or usage; 130 ended by Ctrl-C or SIGTERM, with
//! complete results kept.

mod commands;
mod console;
mod environment;
mod image_test;
mod input;
mod interrupt;
mod judge;
mod notes;
mod renderer_request;
mod verdict;
mod writing;

use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use cutaway::generate::shapes::SHAPES;

pub use commands::view::{Opened, Window};
pub use writing::output::write_file;
pub use writing::places::is_one_file;

const EXAMPLES: &str = "\
Examples:
  cutaway render bracket.stl --section x=50% -o cut.png
  cutaway render shape:crank --section -z=50% --relief fractal:amplitude=5% -o ragged.png
  cutaway view bracket.stl
  cutaway compare engine.glb --section y=40% --strategies all --heatmaps wrong/
  cutaway animate shape:crank --section -z=50% --turntable -o crank.gif
  cutaway section bracket.stl --section z=50% -o cut.svg
  cutaway export bracket.stl --section x=50% -o half.stl
  cutaway inspect scan.ply
  cutaway plan shape:crank --section z=50%
  cutaway measure experiments/curated/01-paper.toml --quick --out target/measure
  cutaway report target/measure
  cutaway doctor
  cutaway demo

Exit codes: 0 done; 1 done, but a stated expectation failed; 2 bad input or usage; 130 ended by Ctrl-C or SIGTERM.";

#[derive(Parser)]
#[command(
    name = "cutaway",
    version,
    about = "Cuts solid triangle meshes, draws the caps, and judges them against an exact reference",
    after_help = EXAMPLES,
    arg_required_else_help = true
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Draw a cut model to a PNG
    #[command(after_help = commands::render::EXAMPLES, after_long_help = with_shapes(commands::render::EXAMPLES))]
    Render(commands::render::RenderArgs),
    /// Open a window for dragging cuts and comparing strategies
    #[command(
        after_help = commands::view::EXAMPLES,
        after_long_help = with_shapes(commands::view::EXAMPLES),
        mut_arg("inputs", |inputs| inputs.required(false))
    )]
    View(commands::view::ViewArgs),
    /// Measure strategies against the exact reference and against each other
    #[command(after_help = commands::compare::EXAMPLES, after_long_help = with_shapes(commands::compare::EXAMPLES))]
    Compare(commands::compare::CompareArgs),
    /// Draw a scene over time, or from all sides, to a GIF, an animated PNG, a film or numbered pictures
    #[command(after_help = commands::animate::EXAMPLES, after_long_help = with_shapes(commands::animate::EXAMPLES))]
    Animate(commands::animate::AnimateArgs),
    /// Make one animation of numbered pictures
    #[command(after_help = commands::animate::encode::EXAMPLES)]
    Encode(commands::animate::encode::EncodeArgs),
    /// Show properties of a model: closed or not, number of bodies, depth complexity
    #[command(after_help = commands::inspect::EXAMPLES, after_long_help = with_shapes(commands::inspect::EXAMPLES))]
    Inspect(commands::inspect::InspectArgs),
    /// Slice a model by planes: areas, outlines as SVG or DXF, everything as JSON; needs no graphics adapter
    #[command(after_help = commands::section::EXAMPLES, after_long_help = with_shapes(commands::section::EXAMPLES))]
    Section(commands::section::SectionCommandArgs),
    /// Write a cut model as a mesh with caps: STL, PLY, OBJ, GLB or 3MF; needs no graphics adapter
    #[command(after_help = commands::export::EXAMPLES, after_long_help = with_shapes(commands::export::EXAMPLES))]
    Export(commands::export::ExportArgs),
    /// List the values of a scene file: every path, what it takes, its unit; needs no graphics adapter
    #[command(after_help = commands::scene::EXAMPLES, after_long_help = commands::scene::long_help())]
    Scene(commands::scene::SceneCommandArgs),
    /// Show the size, height and slope of a relief, and write its heights, normals and occlusion as images; needs no graphics adapter
    #[command(after_help = commands::relief::EXAMPLES)]
    Relief(commands::relief::ReliefCommandArgs),
    /// Show the passes of a frame and why each is there; needs no graphics adapter
    #[command(after_help = commands::plan::EXAMPLES, after_long_help = with_shapes(commands::plan::EXAMPLES))]
    Plan(commands::plan::PlanArgs),
    /// Run experiments, files that define varied values, methods and expectations; writes a record of each point
    #[command(after_help = commands::measure::EXAMPLES)]
    Measure(commands::measure::MeasureArgs),
    /// Make pages and tables of measured results; needs no graphics adapter
    #[command(after_help = commands::report::EXAMPLES)]
    Report(commands::report::ReportArgs),
    /// Cut the built-in crank with every strategy: pictures, heat maps, a report
    #[command(after_help = commands::demo::EXAMPLES)]
    Demo(commands::demo::DemoArgs),
    /// List the graphics adapters, and test the claims about strategies on one of them
    #[command(after_help = commands::doctor::EXAMPLES)]
    Doctor(commands::doctor::DoctorArgs),
    /// Print a shell script that completes this command's options
    #[command(after_help = commands::completions::EXAMPLES)]
    Completions(commands::completions::CompletionsArgs),
    /// Write the manual pages
    #[command(after_help = commands::completions::MAN_EXAMPLES)]
    Man(commands::completions::ManArgs),
}

/// Runs the command given by this process's arguments.
pub fn main() -> ExitCode {
    main_with(None)
}

/// Suppresses the message that a panic in the Boolean crate prints; such a panic is reported as an error.
fn silence_booleans() {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !cutaway::slice::is_at_work() {
            usual(panic);
        }
    }));
}

/// Runs the command given by this process's arguments; the command `view` opens the given window.
pub fn main_with(window: Option<Window>) -> ExitCode {
    environment::calm_drivers();
    silence_booleans();
    let cli = Cli::parse();
    let ended = match cli.command {
        Command::View(args) => return commands::view::run(&args, window),
        Command::Render(args) => commands::render::run(&args),
        Command::Compare(args) => commands::compare::run(&args),
        Command::Animate(args) => commands::animate::run(&args),
        Command::Encode(args) => commands::animate::encode::run(&args),
        Command::Inspect(args) => commands::inspect::run(&args),
        Command::Section(args) => commands::section::run(&args),
        Command::Export(args) => commands::export::run(&args),
        Command::Scene(args) => commands::scene::run(&args),
        Command::Relief(args) => commands::relief::run(&args),
        Command::Plan(args) => commands::plan::run(&args),
        Command::Measure(args) => commands::measure::run(&args),
        Command::Report(args) => commands::report::run(&args),
        Command::Demo(args) => commands::demo::run(&args),
        Command::Doctor(args) => commands::doctor::run(&args),
        Command::Completions(args) => commands::completions::completions(&args, Cli::command()),
        Command::Man(args) => commands::completions::man(&args, Cli::command()),
    };
    verdict::exit_code(ended)
}

/// Help with the list of built-in shapes, which is too long for `-h`.
fn with_shapes(examples: &str) -> String {
    let mut text = examples.to_owned();
    text.push_str("\n\nBuilt-in shapes (shape:NAME?param=value&param=value):\n");
    for shape in SHAPES {
        let parameters: Vec<&str> = shape.parameters.iter().map(|p| p.name).collect();
        text.push_str(&format!(
            "  {:<9} {}\n            {}\n",
            shape.name,
            shape.summary,
            parameters.join(", ")
        ));
    }
    text.trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_contradict_nothing() {
        Cli::command().debug_assert();
    }

    #[test]
    fn every_shape_is_in_the_long_help() {
        let help = with_shapes("");
        for shape in SHAPES {
            assert!(help.contains(shape.name), "{} is missing", shape.name);
        }
    }
}
