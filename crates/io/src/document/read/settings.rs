//! Settings of a document in addition to the scene itself: drawing method, size, and displayed moment.

use cutaway::error::Result;
use cutaway::scene::{HeightFilter, color_help, parse_color};
use glam::Vec3;

use super::reader::{Entry, Table};
use crate::document::{Keys, Value};

/// Default settings of a document. A setting that the document lacks is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// Name of the strategy that draws; whether there is such a one is for others to say.
    pub strategy: Option<String>,
    /// Name of the rasteriser that it uses.
    pub rasteriser: Option<String>,
    /// Width and height of the picture in pixels.
    pub size_px: Option<[u32; 2]>,
    /// Interpolator of the heights of reliefs.
    pub height_filter: Option<HeightFilter>,
    /// Supersampling factor along each side.
    pub supersample: Option<u32>,
    /// The moment that is shown, in seconds.
    pub time_s: Option<f64>,
    /// The animation that is played, by its name or its number.
    pub clip: Option<String>,
}

/// Default size.
const USUAL_SIZE_PX: [u32; 2] = [1024, 768];

impl Settings {
    /// Width and height of the picture in pixels, given or default.
    pub fn size_px(&self) -> [u32; 2] {
        self.size_px.unwrap_or(USUAL_SIZE_PX)
    }
}

static STRATEGY: Keys = Keys::below("strategy");

pub(super) fn read(root: &Table<'_>) -> Result<Settings> {
    let mut settings = Settings::default();
    if let Some(entry) = root.get("strategy") {
        let table = entry.table(STRATEGY.all())?;
        let name = table.get("name").map(|name| name.text()).transpose()?;
        settings.strategy = name.map(str::to_owned);
        settings.rasteriser = (table.get("rasteriser"))
            .map(|e| e.choice(&[("hardware", "hardware"), ("compute", "compute")]))
            .transpose()?
            .map(str::to_owned);
    }
    settings.size_px = root.get("resolution").map(|e| size_px(&e)).transpose()?;
    interference(root)?;
    if let Some(entry) = root.get("height_filter") {
        let [exact, hardware] = [HeightFilter::Exact, HeightFilter::Hardware];
        settings.height_filter = Some(entry.choice(&[("exact", exact), ("hardware", hardware)])?);
    }
    if let Some(entry) = root.get("supersample") {
        let fineness: u32 = entry.whole()?;
        if !(1..=4).contains(&fineness) {
            return Err(entry.fault(
                "it must be from 1 to 4",
                "2 is usual, 1 is as it is measured",
            ));
        }
        settings.supersample = Some(fineness);
    }
    if let Some(entry) = root.get("time_s") {
        let time_s = entry.number()?;
        if time_s < 0.0 {
            let help = "times are seconds from the beginning";
            return Err(entry.fault("it must be 0 or more", help));
        }
        settings.time_s = Some(time_s);
    }
    settings.clip = root.get("clip").map(|e| clip(&e)).transpose()?;
    Ok(settings)
}

fn clip(entry: &Entry<'_>) -> Result<String> {
    match &entry.node.value {
        Value::Number(_) => entry.whole::<u32>().map(|number| number.to_string()),
        _ => entry.text().map(str::to_owned),
    }
}

/// The colour of caps that several solids share, where they are to be shown.
pub(super) fn interference(root: &Table<'_>) -> Result<Option<Vec3>> {
    root.get("interference").map(|e| color(&e)).transpose()
}

/// `#rrggbb`, `#rgb` or a name of CSS.
pub(super) fn color(entry: &Entry<'_>) -> Result<Vec3> {
    let text = entry.text()?;
    parse_color(text)
        .ok_or_else(|| entry.fault(format_args!("{text:?} is no colour"), color_help(text)))
}

fn size_px(entry: &Entry<'_>) -> Result<[u32; 2]> {
    const LARGEST: u32 = 16_384;
    let fault = || {
        let what = format!("it must be two whole numbers from 1 to {LARGEST}");
        entry.fault(what, "write for example `resolution = [1024, 768]`")
    };
    match entry.list()?.as_slice() {
        [w, h] => {
            let size = [w.whole::<u32>()?, h.whole::<u32>()?];
            if size.iter().all(|n| (1..=LARGEST).contains(n)) {
                Ok(size)
            } else {
                Err(fault())
            }
        }
        _ => Err(fault()),
    }
}
