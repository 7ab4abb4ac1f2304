//! Choice of the pictures that are embedded in the page, linked, or left out.
//!
//! A page with embedded pictures can be opened from anywhere, but browsers struggle with very large pages. So there is a budget of bytes;
//! each point gets an equal share of what is left: exact first, then the strategies in the order of the record, each with its heat map.

use std::fs;
use std::path::{Path, PathBuf};

use cutaway_io::load::place_of;

use super::figures::{counted, times};
use super::point::{Points, RecordedPoint};
use crate::compare::{LegendEntry, legend};
use crate::experiment::RecordedPicture;
use crate::report::document::{
    Cell, Gallery, GalleryImage, PictureLocation, ReportBlock, Shot, Swatch, Tone,
};
use crate::report::look::look;

/// Options for the pictures of the page.
#[derive(Clone, Debug)]
pub struct PictureOptions {
    /// Folder to which the report is written; links are relative to this folder.
    pub out: PathBuf,
    /// True to link picture files instead of embedding them.
    pub link: bool,
    /// Maximum total size of embedded pictures in bytes. Encoding them as text later makes four bytes of three.
    pub most_bytes: u64,
}

impl PictureOptions {
    /// Total size of pictures, in bytes, that gives a page of about 24 MB.
    pub const MOST_BYTES: u64 = 17_000_000;
}

/// The galleries of all points.
pub(super) struct Galleries {
    galleries: Vec<Gallery>,
    /// Identifies the point of each gallery: run folder, experiment, and identity of the record.
    of: Vec<(PathBuf, String, String)>,
    /// Number of pictures in each gallery whose file is missing.
    gone: Vec<usize>,
}

/// A picture that may or may not fit into the page.
struct PictureCandidate {
    name: String,
    caption: Cell,
    path: PathBuf,
    /// File of the heat map of the picture's errors.
    errors: Option<PathBuf>,
    /// Number of decided wrong pixels in the picture; `None` for the reference.
    wrong_px: Option<usize>,
}

/// Why a picture is not in the page.
enum Lack {
    /// There is no such file.
    Gone,
    /// The file exceeds the budget.
    TooLarge,
}

impl Galleries {
    pub(super) fn of(points: &Points<'_>, options: &PictureOptions) -> Self {
        let with = || points.all.iter().filter(|p| !p.record.pictures.is_empty());
        let (mut left, mut waiting) = (options.most_bytes, with().count() as u64);
        let mut chosen = Self {
            galleries: Vec::new(),
            of: Vec::new(),
            gone: Vec::new(),
        };
        for point in with() {
            let share = left / waiting.max(1);
            let (gallery, used, gone) = gallery(points, point, options, share);
            left = left.saturating_sub(used);
            waiting -= 1;
            chosen.gone.push(gone);
            chosen.galleries.push(gallery);
            chosen.of.push(key(point));
        }
        chosen
    }

    /// The pictures of a point, and a note on those that were left out.
    pub(super) fn gallery(&self, point: &RecordedPoint<'_>) -> Vec<ReportBlock> {
        let Some(index) = self.of.iter().position(|k| *k == key(point)) else {
            return Vec::new();
        };
        let gallery = &self.galleries[index];
        let mut blocks = Vec::new();
        if !gallery.shots.is_empty() {
            blocks.push(ReportBlock::Gallery(gallery.clone()));
        }
        if !gallery.left_out.is_empty() {
            blocks.push(ReportBlock::Text(format!(
                "Not in this page, which would be too large (see --link): {}.",
                gallery.left_out.join(", ")
            )));
        }
        blocks
    }

    /// Returns true if there are pictures of a point.
    pub(super) fn has(&self, point: &RecordedPoint<'_>) -> bool {
        let index = self.of.iter().position(|k| *k == key(point));
        index.is_some_and(|index| !self.galleries[index].shots.is_empty())
    }

    /// Notice of how many picture files are missing, and how to make them; `None` if none is missing.
    pub(super) fn gone(&self) -> Option<ReportBlock> {
        let gone: usize = self.gone.iter().sum();
        let points = self.gone.iter().filter(|gone| **gone > 0).count();
        (gone > 0).then(|| {
            ReportBlock::Notice(
                Tone::Plain,
                format!(
                    "{} of {} not beside the records, and not in this page. To make them, repeat the commands that made the measurements with another \
                     --out. For one point, add `--heatmaps DIR` to its `cutaway compare`.",
                    counted(gone, "picture"),
                    match points {
                        1 => "1 point is".to_owned(),
                        points => format!("{points} points are"),
                    },
                ),
            )
        })
    }

    /// Number of pictures that are embedded or linked, and number of pictures left out.
    pub(super) fn counts(&self) -> [usize; 2] {
        let files = |s: &Shot| 1 + usize::from(s.errors.is_some());
        let shown = self
            .galleries
            .iter()
            .flat_map(|g| &g.shots)
            .map(files)
            .sum();
        let left_out = self.galleries.iter().map(|g| g.left_out.len()).sum();
        [shown, left_out]
    }
}

fn key(point: &RecordedPoint<'_>) -> (PathBuf, String, String) {
    let record = point.record;
    let values: Vec<String> = record
        .parameters
        .values()
        .map(ToString::to_string)
        .collect();
    let name = format!("{}.{}", record.run, values.join("."));
    (point.folder.path.clone(), record.experiment.clone(), name)
}

/// The pictures of a point that fit into its share of the budget, the bytes they use, and the number of missing files.
fn gallery(
    points: &Points<'_>,
    point: &RecordedPoint<'_>,
    options: &PictureOptions,
    share: u64,
) -> (Gallery, u64, usize) {
    let mut gallery = Gallery {
        label: format!("pictures of {}{}", point.name(), points.on_whom(point)),
        ..Gallery::default()
    };
    let (mut used, mut gone) = (0, 0);
    let mut wrong_px: Vec<Option<usize>> = Vec::new();
    for wanted in wanted(point) {
        let picture = match image(&wanted.path, options, share - used) {
            Ok((picture, bytes)) => {
                used += bytes;
                picture
            }
            Err(Lack::Gone) => {
                gone += 1 + usize::from(wanted.errors.is_some());
                continue;
            }
            Err(Lack::TooLarge) => {
                gallery.left_out.push(wanted.name);
                continue;
            }
        };
        let errors = wanted
            .errors
            .and_then(|path| match image(&path, options, share - used) {
                Ok((errors, bytes)) => {
                    used += bytes;
                    Some(errors)
                }
                Err(Lack::Gone) => {
                    gone += 1;
                    None
                }
                Err(Lack::TooLarge) => {
                    gallery.left_out.push(format!("errors of {}", wanted.name));
                    None
                }
            });
        gallery.shots.push(Shot {
            look: wanted.wrong_px.map(|_| look(&wanted.name)),
            name: wanted.name,
            caption: wanted.caption,
            picture,
            errors,
        });
        wrong_px.push(wanted.wrong_px);
    }
    gallery.opens_at = opens_at(&wrong_px);
    if gallery.shots.iter().any(|s| s.errors.is_some()) {
        gallery.legend = colors();
    }
    (gallery, used, gone)
}

/// The two pictures that a slider shows initially: the first, which is the reference if present, and the one with the most wrong pixels.
fn opens_at(wrong_px: &[Option<usize>]) -> [usize; 2] {
    let strategies = wrong_px.iter().enumerate().skip(1);
    let worst = strategies
        .filter_map(|(index, wrong)| Some((index, (*wrong)?)))
        .fold(None, |worst: Option<(usize, usize)>, next| match worst {
            Some(worst) if worst.1 >= next.1 => Some(worst),
            _ => Some(next),
        });
    [0, worst.map_or(1, |(index, _)| index)]
}

fn wanted(point: &RecordedPoint<'_>) -> Vec<PictureCandidate> {
    let folder = point.folder.pictures(point.experiment);
    let strategies = &point.record.measurement.strategies;
    let of = |picture: &RecordedPicture| {
        let found = strategies.iter().find(|s| s.name == picture.drawer);
        let wrong_px = found.and_then(|s| s.comparison).map(|c| c.decided_wrong_px);
        let ratio = found.and_then(|s| s.frame_over_draw_only);
        let ratio = ratio.map_or_else(String::new, |r| format!(", {}", times(r)));
        PictureCandidate {
            name: picture.drawer.clone(),
            caption: match wrong_px {
                None => Cell::from("the reference, evaluated for every pixel"),
                Some(0) => Cell::from(format!("exact{ratio}")).toned(Tone::Good),
                Some(px) => Cell::from(format!("{px} px wrong{ratio}")).toned(Tone::Fair),
            },
            path: folder.join(&picture.file),
            errors: picture.heatmap.as_ref().map(|file| folder.join(file)),
            wrong_px,
        }
    };
    point.record.pictures.iter().map(of).collect()
}

/// A picture, and the number of bytes of the budget that it uses.
fn image(path: &Path, options: &PictureOptions, left: u64) -> Result<(GalleryImage, u64), Lack> {
    let bytes = fs::metadata(path).map_err(|_| Lack::Gone)?.len();
    let image = |source| GalleryImage {
        link: relative(&options.out, path),
        source,
    };
    if options.link {
        return Ok((image(PictureLocation::Beside), 0));
    }
    if bytes > left {
        return Err(Lack::TooLarge);
    }
    let png = fs::read(path).map_err(|_| Lack::Gone)?;
    Ok((image(PictureLocation::Inside(png)), bytes))
}

/// Makes a path relative to a folder.
fn relative(from: &Path, to: &Path) -> String {
    let (from, to) = (place_of(from), place_of(to));
    let common = from.components().zip(to.components());
    let common = common.take_while(|(a, b)| a == b).count();
    let up = from.components().skip(common).map(|_| "..".to_owned());
    let down = to.components().skip(common);
    let down = down.map(|c| c.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

/// Legend of the heat map colours.
pub(super) fn colors() -> Vec<Swatch> {
    let swatch = |e: &LegendEntry| {
        let [r, g, b] = e.rgb;
        Swatch {
            color: format!("#{r:02x}{g:02x}{b:02x}"),
            name: e.name.to_owned(),
            meaning: e.meaning.to_owned(),
        }
    };
    legend().iter().map(swatch).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slider_opens_on_what_differs_most() {
        // The reference, an exact strategy, a wrong one, another picture of the reference, and two strategies that are more wrong.
        let all = [None, Some(0), Some(7), None, Some(90), Some(90)];
        assert_eq!(opens_at(&all), [0, 4]);
        assert_eq!(opens_at(&all[..2]), [0, 1], "all are exact");
        assert_eq!(opens_at(&[]), [0, 1]);
    }

    #[test]
    fn links_go_up_and_down() {
        let describe = |from: &str, to: &str| relative(Path::new(from), Path::new(to));
        assert_eq!(describe("/no/a/b", "/no/a/c/d.png"), "../c/d.png");
        assert_eq!(describe("/no/a", "/no/a/c/d.png"), "c/d.png");
    }
}
