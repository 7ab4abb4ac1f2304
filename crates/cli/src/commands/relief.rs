//! `relief`: writes a relief's heights, normals and ambient occlusion (the visible share of the sky) as images.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use clap::Args;
use cutaway::scene::Bounds;
use cutaway::scene::numbers::round;
use cutaway::scene::relief::MapScale;
use cutaway::{Error, Result};
use cutaway_io::document::section;
use cutaway_io::load::Assets;
use glam::DVec3;
use image::{DynamicImage, GrayImage, ImageBuffer, ImageFormat, Luma, RgbImage};

use crate::console::{Console, ConsoleArgs};
use crate::verdict::Verdict;
use crate::writing::output::{Output, checked_folder, write_stdout};
use crate::writing::places::InputFiles;
use crate::writing::results::Results;

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway relief sawtooth                                        # how large, how high, how steep
  cutaway relief fractal:amplitude=5%,seed=7 --maps maps/        # maps/offset.png, normal.png and occlusion.png
  cutaway relief rock.png:amplitude=3%,period=50% --maps maps/

offset.png is 16-bit grey, from the lowest to the highest point. normal.png stores unit normals, with x, y and z along U, V and the plane's
normal, and -1 to 1 as 0 to 255. occlusion.png is white where the whole sky is visible. Normals and occlusion depend on the ratio of
`amplitude` to `period`; percentages of either refer to a cube's diagonal.";

/// File names of the height, normal and occlusion images.
const MAPS: [&str; 3] = ["offset.png", "normal.png", "occlusion.png"];

/// Minimum size of an image along each side, in pixels.
const FEWEST_TEXELS: u32 = 128;

/// Options of `relief`.
#[derive(Args)]
pub(crate) struct ReliefCommandArgs {
    /// A relief, in the syntax of `--relief`: sawtooth, waves, fractal, cracks, steps, constant or an image, with
    /// `:amplitude=5%,period=40%,seed=7,size=256` and the like
    relief: String,
    /// Write offset.png, normal.png and occlusion.png into this folder
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    maps: Option<PathBuf>,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Runs `relief`.
pub(crate) fn run(args: &ReliefCommandArgs) -> Result<Verdict> {
    let console = Console::new(args.console, 2);
    let cube = Bounds {
        min: DVec3::ZERO,
        max: DVec3::ONE,
    };
    let mut assets = Assets::default();
    let surface = section("z=50%").relief(&args.relief);
    let surface = surface.on_from(&cube, &mut assets)?;
    let Some(map) = &surface.relief else {
        let help = "write for example sawtooth, or the name of an image";
        return Err(Error::input(&args.relief, "it is not a relief", help));
    };
    if let Some(folder) = &args.maps {
        checked_folder("--maps", folder)?;
        let inputs = InputFiles::default();
        inputs.add(assets.files().map(Path::to_owned));
        inputs.keep_from(MAPS.map(|name| ("--maps", folder.join(name))))?;
    }
    let scale = MapScale::of(&surface);
    // A small map is enlarged: its slopes lie between its texels.
    let texels = map.size();
    let map = &map.at_least(FEWEST_TEXELS);
    console.step("normals");
    let normals = map.normals(&scale);
    if let Some(folder) = &args.maps {
        console.step("occlusion");
        let size = map.size();
        let [offset_name, normal_name, occlusion_name] = MAPS;
        let mut results = Results::default();
        let mut write = |name: &str, image: DynamicImage| {
            results.add(&Output::File(folder.join(name)), png(&image, name)?)
        };
        let [low, high] = map.range().map(f64::from);
        let span = if high > low { high - low } else { 1.0 };
        let heights = map.texels().iter();
        let heights = heights.map(|h| ((f64::from(*h) - low) / span * 65535.0).round() as u16);
        let offset: Option<ImageBuffer<Luma<u16>, Vec<u16>>> =
            ImageBuffer::from_raw(size[0], size[1], heights.collect());
        write(offset_name, offset.unwrap_or_default().into())?;
        let byte = |v: f32| (v.clamp(0.0, 1.0) * 255.0).round() as u8;
        let colors = normals
            .iter()
            .flat_map(|n| (*n * 0.5 + 0.5).to_array().map(byte));
        let normal = RgbImage::from_raw(size[0], size[1], colors.collect());
        write(normal_name, normal.unwrap_or_default().into())?;
        let visibility = map.visibility(&scale).into_iter().map(byte);
        let occlusion = GrayImage::from_raw(size[0], size[1], visibility.collect());
        write(occlusion_name, occlusion.unwrap_or_default().into())?;
        results.place()?;
    }
    let steepest = normals.iter().map(|n| n.z).fold(1.0_f32, f32::min);
    let [width, rows] = texels;
    let text = format!(
        "{width} x {rows} texels, {} high over a repeat of {} x {}, at most {} degrees steep\n",
        round((f64::from(map.range()[1] - map.range()[0]) * scale.height).abs()),
        round(scale.repeat.x),
        round(scale.repeat.y),
        round(f64::from(steepest).acos().to_degrees()),
    );
    write_stdout(text.as_bytes())?;
    Ok(Verdict::Done)
}

fn png(image: &DynamicImage, name: &str) -> Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, ImageFormat::Png).map_err(|e| {
        let help = "use a smaller relief: `size=256`";
        Error::input(
            Path::new(name).display().to_string(),
            format!("cannot be encoded: {e}"),
            help,
        )
    })?;
    Ok(bytes.into_inner())
}
