//! Options that several subcommands share.

use clap::Args;
use cutaway::Result;
use cutaway::gpu::{Gpu, GpuOptions};
use cutaway::scene::range::LARGEST;
use cutaway::scene::{Fill, HeightFilter, color_help, parse_color};
use cutaway::session::Session;
use cutaway::strategies::Rasteriser;
use cutaway_io::document::{Document, Node, Origin, Value};

use super::camera::CameraArgs;
use super::defects::DefectArgs;
use super::edits::EditArgs;
use super::holes::HoleArgs;
use super::look::Defaults;
use super::sections::SectionArgs;
use super::split::SplitArgs;
use super::stdin::StdinArgs;
use super::subject::{Subject, document};
use crate::console::Console;

/// Most pixels along a side of a picture.
const LARGEST_SIDE: u32 = 16_384;

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
    /// Rule for the points that each mesh encloses: even-odd, where an odd number of crossings lies before them, or nonzero, wherever it
    /// winds around them, which unites shells that overlap [default: that of the scene, or even-odd]
    #[arg(long, value_name = "RULE", value_parser = parse_fill)]
    fill: Option<Fill>,
    /// Hatch the caps that several solids share, by default in #ff00aa [default: that of the scene, or not at all]
    #[arg(
        long,
        value_name = "COLOUR",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "#ff00aa",
        value_parser = parse_color_word,
        help_heading = "Output"
    )]
    interference: Option<String>,
    /// Width and height of the picture in pixels [default: that of the scene, or 1024,768]
    #[arg(long, value_name = "W,H", value_parser = parse_resolution, allow_hyphen_values = true, help_heading = "Output")]
    resolution: Option<[u32; 2]>,
    #[command(flatten)]
    pub(crate) edits: EditArgs,
}

impl SceneArgs {
    /// The document of these options; numbered meshes are played at a rate, where the output has one.
    pub(crate) fn document(&self, played_fps: Option<f64>) -> Result<Document> {
        let mut document = document(&self.inputs, self.stdin, played_fps)?;
        self.split.amend(&mut document)?;
        self.defects.amend(&mut document)?;
        self.holes.amend(&mut document)?;
        fill_by(&mut document, self.fill)?;
        self.camera.amend(&mut document)?;
        self.sections.amend(&mut document)?;
        let size = (self.resolution).map(|size| size.map(i64::from).to_vec().into());
        say(&mut document, "resolution", "--resolution", size)?;
        let interference = self.interference.as_deref().map(Value::from);
        say(
            &mut document,
            "interference",
            "--interference",
            interference,
        )?;
        Ok(document)
    }

    /// Opens the document of these options with what others have amended, and says what is doubtful about it.
    pub(crate) fn open(
        &self,
        document: Document,
        at_s: Option<f64>,
        usual: Defaults,
        console: &Console,
    ) -> Result<Subject> {
        let subject = Subject::open(document, at_s, usual, &self.edits, console)?;
        subject.must_be_cut_by(&self.sections)?;
        subject.doubt(console)?;
        Ok(subject)
    }
}

/// Sets a value that an option says, if it does.
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

/// Fills all parts by the rule that an option says.
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
    /// Part of the adapter's name [default: that in $CUTAWAY_ADAPTER, or the fastest]
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
    /// A session on the device, which takes the times of what it draws where they are reported.
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

/// By which means frames are drawn.
#[derive(Args)]
pub(crate) struct DrawOptionArgs {
    /// Rasteriser of the mesh: hardware, or compute (mask, abuffer and kbuffer, and raycast with ldi) [default: that of the scene, or
    /// hardware; with the strategy auto whichever takes less time on the adapter]
    #[arg(long, value_name = "WHO", value_parser = parse_rasteriser, help_heading = "Device")]
    rasteriser: Option<Rasteriser>,
    /// Interpolation of the heights of reliefs: exact, from four texels, or hardware, the sampler of the GPU (grid alone, for
    /// the error that it makes) [default: that of the scene, or exact]
    #[arg(long, value_name = "WHO", value_parser = parse_height_filter, help_heading = "Device")]
    height_filter: Option<HeightFilter>,
}

impl DrawOptionArgs {
    /// Path in a document, option and value of each setting.
    pub(crate) fn values(&self) -> [(&'static str, &'static str, Option<String>); 2] {
        let rasteriser = self.rasteriser.map(|r| r.to_string());
        let filter = self.height_filter.map(|f| f.to_string());
        [
            ("strategy.rasteriser", "--rasteriser", rasteriser),
            ("height_filter", "--height-filter", filter),
        ]
    }

    /// Puts them into a document.
    pub(crate) fn amend(&self, document: &mut Document) -> Result<()> {
        let mut values = self.values().into_iter();
        values.try_for_each(|(path, option, value)| {
            say(document, path, option, value.map(Value::from))
        })
    }
}

pub(crate) fn parse_fill(text: &str) -> Result<Fill, String> {
    text.parse().map_err(|_: cutaway::Error| {
        "there is no such rule\n  help: say even-odd or nonzero".to_owned()
    })
}

/// Reads a colour, which a document is to hold as it is written.
pub(crate) fn parse_color_word(text: &str) -> Result<String, String> {
    match parse_color(text) {
        Some(_) => Ok(text.to_owned()),
        None => Err(format!("it is no colour\n  help: {}", color_help(text))),
    }
}

fn parse_rasteriser(text: &str) -> Result<Rasteriser, String> {
    text.parse().map_err(|_: cutaway::Error| {
        "there is no such rasteriser\n  help: say hardware or compute".to_owned()
    })
}

fn parse_height_filter(text: &str) -> Result<HeightFilter, String> {
    text.parse().map_err(|_: cutaway::Error| {
        "there is no such filter\n  help: say exact or hardware".to_owned()
    })
}

/// Reads `W,H`.
pub(crate) fn parse_resolution(text: &str) -> Result<[u32; 2], String> {
    let fault = || {
        format!(
            "it must be two whole numbers from 1 to {LARGEST_SIDE}\n  help: write for example --resolution 1024,768"
        )
    };
    let (width, height) = text.split_once([',', 'x']).ok_or_else(fault)?;
    let side = |t: &str| {
        t.trim()
            .parse()
            .ok()
            .filter(|n| (1..=LARGEST_SIDE).contains(n))
    };
    match (side(width), side(height)) {
        (Some(width), Some(height)) => Ok([width, height]),
        _ => Err(fault()),
    }
}

pub(crate) fn parse_finite(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok();
    let number = number.filter(|n| n.abs() <= LARGEST);
    number.ok_or_else(|| {
        format!("it must be a finite number, {LARGEST:.0e} at most, for example 1.5")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_or_refused_with_an_example() {
        assert_eq!(parse_resolution("640,480"), Ok([640, 480]));
        assert_eq!(parse_resolution("640x480"), Ok([640, 480]));
        for text in ["640", "0,480", "640,-1", "640,480,2", "99999,1", "a,b", ""] {
            assert!(parse_resolution(text).is_err(), "{text}");
        }
    }
}
