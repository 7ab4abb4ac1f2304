//! Options that several subcommands share.

use clap::Args;
use cutaway::Result;
use cutaway::gpu::{Gpu, GpuOptions};
use cutaway::scene::Fill;
use cutaway::scene::range::LARGEST;
use cutaway::session::Session;
use cutaway_io::document::{Document, Node, Origin, Value};

use super::camera::CameraArgs;
use super::declared::declared;
use super::defects::DefectArgs;
use super::edits::EditArgs;
use super::holes::HoleArgs;
use super::look::Defaults;
use super::sections::SectionArgs;
use super::split::SplitArgs;
use super::stdin::StdinArgs;
use super::subject::{SceneInput, document};
use crate::console::Console;

/// Model, cuts and camera of a picture.
#[derive(Args)]
pub(crate) struct SceneArgs {
    /// Meshes (.obj, .stl, .ply, .glb, .gltf, .3mf, .gz of the first three), `-` for one from standard input, `shape:NAME?param=value`, or one scene (.toml)
    #[arg(required = true, value_name = "SCENE|MODEL")]
    pub(crate) inputs: Vec<String>,
    #[command(flatten)]
    stdin: StdinArgs,
    #[command(flatten)]
    pub(crate) sections: SectionArgs,
    #[command(flatten)]
    pub(crate) camera: CameraArgs,
    #[command(flatten)]
    split: SplitArgs,
    #[command(flatten)]
    pub(crate) defects: DefectArgs,
    #[command(flatten)]
    holes: HoleArgs,
    /// Fill rule for each mesh's interior: even-odd (points that a ray reaches after an odd number of crossings) or nonzero (points with
    /// a nonzero winding number, which unites overlapping shells) [default: the scene's rule, or even-odd]
    #[arg(long, value_name = "RULE", value_parser = parse_fill)]
    fill: Option<Fill>,
    /// Hatch caps where several solids overlap; if no colour is given, #ff00aa is used [default: the scene's setting, or off]
    #[arg(
        long,
        value_name = "COLOUR",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "#ff00aa",
        value_parser = declared("interference"),
        help_heading = "Output"
    )]
    interference: Option<Value>,
    /// Width and height of the picture in pixels [default: the scene's resolution, or 1024,768]
    #[arg(long, value_name = "W,H", value_parser = declared("resolution"), allow_hyphen_values = true, help_heading = "Output")]
    resolution: Option<Value>,
    #[command(flatten)]
    pub(crate) edits: EditArgs,
}

impl SceneArgs {
    /// The document of these options. Numbered meshes play at the output's frame rate, if the output has one.
    pub(crate) fn document(&self, played_fps: Option<f64>) -> Result<Document> {
        let mut document = document(&self.inputs, self.stdin, played_fps)?;
        self.split.amend(&mut document)?;
        self.defects.amend(&mut document)?;
        self.holes.amend(&mut document)?;
        fill_by(&mut document, self.fill)?;
        self.camera.amend(&mut document)?;
        self.sections.amend(&mut document)?;
        for (path, option, value) in [
            ("resolution", "--resolution", &self.resolution),
            ("interference", "--interference", &self.interference),
        ] {
            say(&mut document, path, option, value.clone())?;
        }
        Ok(document)
    }

    /// Opens the document of these options as amended by other options, and notes probable mistakes.
    pub(crate) fn open(
        &self,
        document: Document,
        at_s: Option<f64>,
        usual: Defaults,
        console: &Console,
    ) -> Result<SceneInput> {
        let subject = SceneInput::open(document, at_s, usual, &self.edits, console)?;
        subject.must_be_cut_by(&self.sections)?;
        subject.doubt(console)?;
        Ok(subject)
    }
}

/// Sets a value if the option is given.
pub(crate) fn say(
    document: &mut Document,
    path: &str,
    option: &str,
    value: Option<Value>,
) -> Result<()> {
    match value {
        Some(value) => {
            let origin = Origin::Option(option.into());
            document.set_node(path, Node::new(value).said(&origin))
        }
        None => Ok(()),
    }
}

/// Sets the fill rule of all parts to the option's.
pub(crate) fn fill_by(document: &mut Document, rule: Option<Fill>) -> Result<()> {
    let Some(rule) = rule else {
        return Ok(());
    };
    let node = Node::new(rule.to_string());
    document.set_in_each("part", "fill", &node.said(&Origin::Option("--fill".into())))
}

/// Choice of the device.
#[derive(Args, Clone)]
pub(crate) struct AdapterArgs {
    /// Part of the adapter's name [default: $CUTAWAY_ADAPTER, or the fastest adapter]
    #[arg(
        long,
        value_name = "NAME",
        env = "CUTAWAY_ADAPTER",
        hide_env = true,
        help_heading = "Device"
    )]
    pub(crate) adapter: Option<String>,
}

impl AdapterArgs {
    /// A session on the device, with timing if times are reported.
    pub(crate) fn session(&self, is_timed: bool) -> Result<Session> {
        let session = Session::new(self.open()?);
        Ok(match is_timed {
            true => session.timed(),
            false => session,
        })
    }

    /// The device.
    pub(crate) fn open(&self) -> Result<Gpu> {
        Gpu::open(&GpuOptions {
            adapter: self.adapter.clone(),
            prefer_software: false,
        })
    }
}

/// Options that select how frames are drawn.
#[derive(Args)]
pub(crate) struct DrawOptionArgs {
    /// Rasteriser of the mesh: hardware, or compute (mask, abuffer and kbuffer, and raycast with ldi) [default: the scene's, or
    /// hardware; with the strategy auto, the faster one on the adapter]
    #[arg(long, value_name = "WHO", value_parser = declared("strategy.rasteriser"), help_heading = "Device")]
    rasteriser: Option<Value>,
    /// Interpolation of relief heights: exact, from four texels, or hardware, by the GPU's sampler (only grid, to show
    /// the sampler's error) [default: the scene's setting, or exact]
    #[arg(long, value_name = "WHO", value_parser = declared("height_filter"), help_heading = "Device")]
    height_filter: Option<Value>,
}

impl DrawOptionArgs {
    /// Document path, option and value of each setting.
    pub(crate) fn values(&self) -> [(&'static str, &'static str, Option<Value>); 2] {
        [
            (
                "strategy.rasteriser",
                "--rasteriser",
                self.rasteriser.clone(),
            ),
            (
                "height_filter",
                "--height-filter",
                self.height_filter.clone(),
            ),
        ]
    }

    /// Writes the settings into a document.
    pub(crate) fn amend(&self, document: &mut Document) -> Result<()> {
        let mut values = self.values().into_iter();
        values.try_for_each(|(path, option, value)| say(document, path, option, value))
    }
}

pub(crate) fn parse_fill(text: &str) -> Result<Fill, String> {
    text.parse().map_err(|_: cutaway::Error| {
        "there is no such rule\n  help: say even-odd or nonzero".to_owned()
    })
}

pub(crate) fn parse_finite(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok();
    let number = number.filter(|n| n.abs() <= LARGEST);
    number.ok_or_else(|| {
        format!("it must be a finite number, {LARGEST:.0e} at most, for example 1.5")
    })
}
