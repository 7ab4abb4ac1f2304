//! `--section`, `--relief`, `--flip`, `--box`, `--wedge`, `--cut`, `--cutter`, `--exclude`: the cuts of the command line.
//!
//! The order of the words counts: a relief or a flip belongs to the section before it, or to the first one where none
//! is before it, so that with one section any order will do.

use std::path::{Path, PathBuf};

use clap::{ArgMatches, Args, Command, FromArgMatches, ValueEnum};

use super::console::Console;
use super::regions::{Named, RegionArgs};
use crate::error::did_you_mean;
use crate::scene::{
    Bounds, ClipSurface, Cut, Cutter, Part, ReliefSpec, Scene, SectionSpec, Up, apply_relief,
    in_common, section_misses,
};
use crate::{Error, Result};

pub(super) const HEADING: &str = "Cuts";

#[derive(Args)]
struct Words {
    /// A plane; the side its normal points to stays. `z=10`, `-z=50%` (of the bounds), `nx,ny,nz@px,py,pz`,
    /// `nx,ny,nz,d`. Repeatable
    #[arg(long, value_name = "SPEC", allow_hyphen_values = true, help_heading = HEADING)]
    section: Vec<String>,
    /// Makes the section before it a relief: sawtooth, waves, fractal, cracks, steps, constant or an image, with
    /// `:amplitude=5%,period=40%,seed=7,size=256,wrap=mirror` and the like
    #[arg(long, value_name = "SPEC", help_heading = HEADING)]
    relief: Vec<String>,
    /// Keeps the other side of the section before it
    #[arg(
        long,
        action = clap::ArgAction::Append,
        num_args = 0,
        default_missing_value = "true",
        help_heading = HEADING
    )]
    flip: Vec<bool>,
    #[command(flatten)]
    regions: RegionArgs,
    /// Several sections, boxes and wedges: remove what any of them removes (union) or all of them (intersection)
    #[arg(long, value_enum, default_value = "union", help_heading = HEADING)]
    cut: Combination,
    /// Removes what is inside a closed mesh, or a `shape:NAME?param=value`, where it is. Repeatable
    #[arg(long, value_name = "MESH", help_heading = HEADING)]
    cutter: Vec<String>,
    /// Parts that no section and no cutter of the command line cuts; `*` and `?` are understood. Repeatable
    #[arg(long, value_name = "PART-GLOB", help_heading = HEADING)]
    exclude: Vec<String>,
}

/// How several sections go together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Combination {
    /// Each section removes its side.
    Union,
    /// Only what all sections remove is removed.
    Intersection,
}

/// A section and what belongs to it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Section {
    section: String,
    relief: Option<String>,
    flip: bool,
}

/// The cuts of the command line.
#[derive(Clone, Debug)]
pub(super) struct SectionArgs {
    sections: Vec<Section>,
    regions: RegionArgs,
    /// What had no section to belong to.
    stray: Option<String>,
    combination: Combination,
    cutters: Vec<String>,
    exclude: Vec<String>,
}

impl Args for SectionArgs {
    fn augment_args(cmd: Command) -> Command {
        Words::augment_args(cmd)
    }

    fn augment_args_for_update(cmd: Command) -> Command {
        Words::augment_args_for_update(cmd)
    }
}

impl FromArgMatches for SectionArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let words = Words::from_arg_matches(matches)?;
        let places =
            |id: &str| -> Vec<usize> { matches.indices_of(id).into_iter().flatten().collect() };
        let places_of_sections = places("section");
        let mut sections: Vec<Section> = words
            .section
            .into_iter()
            .map(|section| Section {
                section,
                ..Section::default()
            })
            .collect();
        // The last section before a place, else the first one.
        let owner = |place: usize| {
            places_of_sections
                .iter()
                .filter(|s| **s < place)
                .count()
                .saturating_sub(1)
        };
        let mut stray = None;
        for (relief, place) in words.relief.into_iter().zip(places("relief")) {
            match sections.get_mut(owner(place)) {
                Some(section) if section.relief.is_none() => section.relief = Some(relief),
                Some(_) => {
                    stray = Some(format!(
                        "--relief {relief}: its section has a relief already"
                    ))
                }
                None => stray = Some(format!("--relief {relief}: there is no section for it")),
            }
        }
        for place in places("flip").into_iter().take(words.flip.len()) {
            match sections.get_mut(owner(place)) {
                Some(section) => section.flip = !section.flip,
                None => stray = Some("--flip: there is no section for it".to_owned()),
            }
        }
        let cuts_nothing =
            sections.is_empty() && words.regions.is_empty() && words.cutter.is_empty();
        if cuts_nothing && !words.exclude.is_empty() {
            stray = Some("--exclude: there is no section for it".to_owned());
        }
        Ok(Self {
            sections,
            regions: words.regions,
            stray,
            combination: words.cut,
            cutters: words.cutter,
            exclude: words.exclude,
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl SectionArgs {
    /// Adds the cuts to a scene, whose camera says which axis is up.
    pub(super) fn apply(&self, scene: &mut Scene) -> Result<()> {
        if let Some(stray) = &self.stray {
            let (culprit, what) = stray.split_once(": ").unwrap_or((stray, ""));
            let mend = "add --section SPEC before it, for example --section z=50%";
            return Err(Error::input(culprit, what, mend));
        }
        self.check_excluded(scene)?;
        let (bounds, up) = (scene.bounds(), scene.camera.up);
        let mut named: Vec<Named> = Vec::new();
        for words in &self.sections {
            let surface = words.surface(&bounds, up)?;
            named.push((words.section.clone(), vec![vec![surface]]));
        }
        named.extend(self.regions.read(&bounds, up)?);
        if self.combination == Combination::Intersection {
            named = named.into_iter().reduce(both).into_iter().collect();
        }
        let cuts = named.into_iter().flat_map(|(name, alternatives)| {
            let cut = move |surfaces| Cut::of(name.clone(), surfaces);
            alternatives.into_iter().map(cut)
        });
        let mut cuts: Vec<Cut> = cuts.collect();
        for cut in &cuts {
            let mut defects = cut.surfaces.iter().filter_map(|s| s.defect_beside(&bounds));
            if let Some(what) = defects.next() {
                let mend = "give positions and lengths near those of the model";
                return Err(Error::input(format!("section {}", cut.name), what, mend));
            }
        }
        for cut in &mut cuts {
            cut.except.clone_from(&self.exclude);
        }
        scene.cuts.extend(cuts);
        Ok(())
    }

    /// The images of reliefs.
    pub(super) fn images(&self) -> Vec<PathBuf> {
        let words = self.sections.iter().filter_map(|s| s.relief.as_ref());
        let specs = words.filter_map(|words| ReliefSpec::parse(words).ok());
        specs
            .filter_map(|spec| spec.relief.image().map(Path::to_owned))
            .collect()
    }

    /// Adds a cut by each closed mesh, which `open` opens.
    pub(super) fn add_cutters(
        &self,
        scene: &mut Scene,
        open: impl Fn(&str) -> Result<Vec<Part>>,
    ) -> Result<()> {
        let bounds = scene.bounds();
        for input in &self.cutters {
            let cutter = Cutter::of_parts(input, &open(input)?)?;
            let mut cut = Cut::by(cutter.beside(&bounds)?);
            cut.except.clone_from(&self.exclude);
            scene.cuts.push(cut);
        }
        Ok(())
    }

    /// A glob that matches no part can only be a slip.
    fn check_excluded(&self, scene: &Scene) -> Result<()> {
        for glob in &self.exclude {
            let mut cut = Cut::of("", Vec::new());
            cut.applies_to = vec![glob.clone()];
            let mut parts = scene.parts.clone();
            // Whether the name fits is the question, not whether such a part is ever cut.
            parts
                .iter_mut()
                .for_each(|p| p.role = crate::scene::Role::Exterior);
            if !parts.iter().any(|p| cut.applies_to(p)) {
                return Err(Error::input(
                    format!("--exclude {glob}"),
                    "no part has such a name",
                    did_you_mean(glob, scene.parts.iter().map(|p| p.name.as_str())),
                ));
            }
        }
        Ok(())
    }
}

impl Section {
    fn surface(&self, bounds: &Bounds, up: Up) -> Result<ClipSurface> {
        let mut surface = SectionSpec::parse(&self.section)?.surface(bounds, up)?;
        if let Some(relief) = &self.relief {
            surface = apply_relief(surface, &ReliefSpec::parse(relief)?, bounds)?;
        }
        Ok(if self.flip {
            surface.flipped()
        } else {
            surface
        })
    }
}

/// What two regions have in common.
fn both((a, of_a): Named, (b, of_b): Named) -> Named {
    (format!("{a} and {b}"), in_common(&of_a, &of_b))
}

/// Cuts that pass by the model, and whether all of it stays. A face of several that lies beyond the model on the removed side
/// does no harm, as where a box sticks out.
pub(super) fn misses(scene: &Scene) -> impl Iterator<Item = (&Cut, bool)> {
    let bounds = scene.bounds();
    let cuts = (scene.cuts.iter()).filter(|c| c.enabled && !c.surfaces.is_empty());
    cuts.filter_map(move |cut| {
        let missing = cut.surfaces.iter().filter(|s| section_misses(s, &bounds));
        let stays: Vec<bool> = missing
            .map(|s| s.kept_height(bounds.centre()) > 0.0)
            .collect();
        let is_said = stays.contains(&true) || stays.len() == cut.surfaces.len();
        is_said.then(|| (cut, stays.contains(&true)))
    })
}

/// Warns of cuts that pass by the model: nearly always a slip of units or of the axis.
pub(super) fn warn_of_misses(scene: &Scene, console: &Console) {
    for (cut, stays) in misses(scene) {
        let side = if stays { "stays" } else { "is removed" };
        console.warn(format!(
            "section {} misses the model: all of it is on the side that {side}\n  bounds: {}\n  help: give a position within \
             the bounds, or a percentage of them such as z=50%",
            cut.name,
            words_of(&scene.bounds())
        ));
    }
    let cuts = scene.cuts.iter().filter(|c| c.enabled);
    for cutter in cuts.filter_map(|c| c.volume.as_ref()) {
        warn_of_missing(cutter, &scene.bounds(), console);
    }
}

fn warn_of_missing(cutter: &Cutter, bounds: &Bounds, console: &Console) {
    let of_cutter = cutter.bounds_in_world();
    let apart = (of_cutter.min.cmpgt(bounds.max) | bounds.min.cmpgt(of_cutter.max)).any();
    if apart {
        let (name, own, of_model) = (cutter.name(), words_of(&of_cutter), words_of(bounds));
        console.warn(format!(
            "the cutter {name} misses the model\n  bounds: {own}; of the model: {of_model}\n  help: in a scene file `translate`, \
             `scale` and `rotate_deg` place it"
        ));
    }
}

/// Bounds for readers.
pub(super) fn words_of(bounds: &Bounds) -> String {
    let (min, max) = (bounds.min.to_array(), bounds.max.to_array());
    let axis = |i: usize| {
        format!(
            "{} {} to {}",
            ["x", "y", "z"][i],
            round(min[i]),
            round(max[i])
        )
    };
    format!("{}, {}, {}", axis(0), axis(1), axis(2))
}

/// A number with six significant digits and no more zeros than it needs.
pub(super) fn round(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !(-5..=9).contains(&magnitude) {
        return format!("{value:.5e}");
    }
    let text = format!("{value:.*}", (5 - magnitude).max(0) as usize);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::shapes::shape;
    use clap::Parser;

    #[derive(Parser)]
    struct Only {
        #[command(flatten)]
        sections: SectionArgs,
    }

    fn read(line: &str) -> SectionArgs {
        let words = std::iter::once("cutaway").chain(line.split(' '));
        Only::try_parse_from(words)
            .map(|o| o.sections)
            .unwrap_or_else(|e| panic!("{e}"))
    }

    fn cuts(line: &str) -> Result<Vec<Cut>> {
        let mut scene = Scene {
            parts: shape("shells").unwrap(),
            ..Scene::default()
        };
        read(line).apply(&mut scene)?;
        Ok(scene.cuts)
    }

    #[test]
    fn reliefs_and_flips_belong_to_the_section_before_them() {
        let args = read(
            "--section z=1 --section -x=50% --relief waves --flip --section y=2 --flip --flip",
        );
        let got: Vec<(&str, Option<&str>, bool)> = (args.sections.iter())
            .map(|w| (w.section.as_str(), w.relief.as_deref(), w.flip))
            .collect();
        assert_eq!(
            got,
            [
                ("z=1", None, false),
                ("-x=50%", Some("waves"), true),
                ("y=2", None, false)
            ]
        );
        let args = read("--flip --relief steps --section z=1");
        assert_eq!(args.sections[0].relief.as_deref(), Some("steps"));
        assert!(args.sections[0].flip, "with one section any order will do");
    }

    #[test]
    fn what_has_no_section_is_refused() {
        for (line, culprit) in [
            ("--relief waves", "--relief waves"),
            ("--flip", "--flip"),
            ("--exclude core", "--exclude"),
            (
                "--section z=0 --relief waves --relief steps",
                "--relief steps",
            ),
            ("--section z=0 --exclude nothing", "--exclude nothing"),
        ] {
            let message = cuts(line).expect_err(line).to_string();
            assert!(message.starts_with(culprit), "{message}");
            assert!(message.contains("help:"), "{message}");
        }
    }

    #[test]
    fn sections_unite_or_intersect() {
        let union = cuts("--section z=0 --section x=0").unwrap();
        assert_eq!(
            union.iter().map(|c| c.surfaces.len()).collect::<Vec<_>>(),
            [1, 1]
        );
        let one = cuts("--section z=0 --section x=0 --cut intersection").unwrap();
        assert_eq!(
            one.iter().map(|c| c.surfaces.len()).collect::<Vec<_>>(),
            [2]
        );
        assert!(
            cuts("--cut intersection").unwrap().is_empty(),
            "no section, no cut"
        );
    }

    #[test]
    fn boxes_and_wedges_unite_and_intersect_like_sections() {
        let counts = |line: &str| -> Vec<usize> {
            let cuts = cuts(line).unwrap_or_else(|e| panic!("{e}"));
            cuts.iter().map(|c| c.surfaces.len()).collect()
        };
        let line = "--section z=0 --box 0,0,0: --wedge z:0:90 --wedge y:0:200";
        assert_eq!(counts(line), [1, 3, 2, 1, 1]);
        assert_eq!(counts(&format!("{line} --cut intersection")), [7, 7]);
        let cut = &cuts("--wedge z:0:90 --exclude s*").unwrap()[0];
        assert_eq!((cut.name.as_str(), cut.except.len()), ("wedge z:0:90", 1));
        for line in [
            "--box 0,0,0",
            "--wedge q:0:90",
            "--box 1,1,1:0,2,2",
            "--wedge z:5:5",
        ] {
            let message = cuts(line).expect_err(line).to_string();
            assert!(message.contains("help:"), "{message}");
        }
    }

    #[test]
    fn numbers_are_written_short() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (-0.25, "-0.25"),
            (1_234_567.8, "1234568"),
            (0.000_123_456_7, "0.000123457"),
            (100.0, "100"),
            (1e12, "1.00000e12"),
            (1.0 / 3.0, "0.333333"),
        ] {
            assert_eq!(round(value), text);
        }
    }
}
