//! `--section`, `--relief`, `--flip`, `--box`, `--wedge`, `--cut`, `--cutter`, `--exclude`: the command line's cuts.
//!
//! The order of the options counts: a relief or a flip belongs to the section before it, or to the first section if none
//! precedes it, so with a single section any order works.

use clap::{ArgMatches, Args, Command, FromArgMatches, ValueEnum};
use cutaway::scene::{Cut, Scene};
use cutaway::{Error, Result};
use cutaway_io::document::{CutDraft, Document, Node, SurfaceDraft, cut, section};

use super::roles::{self, RoleWord};
use super::subject::check_model;

const HEADING: &str = "Cuts";

#[derive(Args)]
struct SectionOptions {
    /// Cuts by a plane and keeps the side its normal points to: `z=10`, `-z=50%` (of the bounds), `nx,ny,nz@px,py,pz`,
    /// `nx,ny,nz,d`. Repeatable
    #[arg(long, value_name = "SPEC", allow_hyphen_values = true, help_heading = HEADING)]
    section: Vec<String>,
    /// Turns the preceding section (not a box or wedge) into a relief: sawtooth, waves, fractal, cracks, steps, constant or an image,
    /// with parameters such as `:amplitude=5%,period=40%,seed=7,size=256,wrap=mirror`
    #[arg(long, value_name = "SPEC", help_heading = HEADING)]
    relief: Vec<String>,
    /// Keeps the other side of the preceding section
    #[arg(
        long,
        action = clap::ArgAction::Append,
        num_args = 0,
        default_missing_value = "true",
        help_heading = HEADING
    )]
    flip: Vec<bool>,
    /// Removes a box `MIN:MAX`, such as `0,0,0:1,1,1` or `50%,50%,50%:` (unbounded at an omitted corner). Repeatable
    #[arg(long = "box", value_name = "MIN:MAX", allow_hyphen_values = true, help_heading = HEADING)]
    boxes: Vec<String>,
    /// Removes a wedge `AXIS:FROM:TO[@X,Y,Z]`, in degrees counter-clockwise about the axis, counted from the next axis
    /// (x for z, y for x, z for y), such as `z:0:90` or `-y:-30:200@0,50%,0`. Repeatable
    #[arg(long = "wedge", value_name = "SPEC", allow_hyphen_values = true, help_heading = HEADING)]
    wedges: Vec<String>,
    /// Removes a wedge of N degrees (default 110) about the main axis, facing the camera; or `axis=z,angle_deg=90,turn_deg=20`
    #[arg(
        long,
        value_name = "DEG|SPEC",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "",
        help_heading = HEADING
    )]
    cutout: Option<String>,
    /// Removes what hides the interior parts from the camera, with a margin (default 1%); or `distance=3%,bevel_deg=0,view=first`.
    /// Interior parts are detected unless --roles or the scene sets them
    #[arg(
        long,
        value_name = "DIST|SPEC",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "",
        help_heading = HEADING
    )]
    breakaway: Option<String>,
    /// Sets parts that are never cut: `auto`, parts not visible from outside; or `interior=GLOB`, `whole=GLOB` (hidden if entirely
    /// removed), `exterior=GLOB`. Repeatable
    #[arg(long, value_name = "ROLES", value_parser = roles::parse, help_heading = HEADING)]
    roles: Vec<RoleWord>,
    /// How several sections, boxes and wedges combine: remove what any of them removes (union) or what all of them remove (intersection)
    #[arg(long, value_enum, default_value = "union", help_heading = HEADING)]
    cut: Combination,
    /// Removes the interior of a closed mesh, or of a `shape:NAME?param=value`, at its position. Repeatable
    #[arg(long, value_name = "MESH", help_heading = HEADING)]
    cutter: Vec<String>,
    /// Exempts parts from the command line's sections and cutters, by name with the wildcards `*` and `?`. Repeatable
    #[arg(long, value_name = "PART-GLOB", help_heading = HEADING)]
    exclude: Vec<String>,
}

/// How several sections combine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Combination {
    /// Removes what any section removes.
    Union,
    /// Removes only what all sections remove.
    Intersection,
}

/// A section with its relief and flip.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct SectionOption {
    section: String,
    relief: Option<String>,
    flip: bool,
}

/// An option without a section to apply to.
#[derive(Clone, Debug)]
struct Stray {
    option: String,
    what: &'static str,
    help: &'static str,
}

impl Stray {
    fn without_section(option: impl Into<String>) -> Self {
        Self {
            option: option.into(),
            what: "there is no section for it",
            help: "add --section SPEC before it, for example --section z=50%",
        }
    }

    fn relief_of_region(relief: &str) -> Self {
        Self {
            option: format!("--relief {relief}"),
            what: "it applies to a section, and there is none",
            help: "a box or wedge face gets a relief in a scene file, or by --set relief.ragged.kind=fractal --set \
                   cut.0.wedge.relief=ragged --set cut.0.wedge.amplitude=4%",
        }
    }
}

/// The cuts of the command line.
#[derive(Clone, Debug)]
pub(crate) struct SectionArgs {
    sections: Vec<SectionOption>,
    boxes: Vec<String>,
    wedges: Vec<String>,
    /// Option without a section to apply to, if any.
    stray: Option<Stray>,
    combination: Combination,
    cutters: Vec<String>,
    cutout: Option<String>,
    breakaway: Option<String>,
    roles: Vec<RoleWord>,
    exclude: Vec<String>,
}

impl Args for SectionArgs {
    fn augment_args(cmd: Command) -> Command {
        SectionOptions::augment_args(cmd)
    }

    fn augment_args_for_update(cmd: Command) -> Command {
        SectionOptions::augment_args_for_update(cmd)
    }
}

impl FromArgMatches for SectionArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let words = SectionOptions::from_arg_matches(matches)?;
        let places =
            |id: &str| -> Vec<usize> { matches.indices_of(id).into_iter().flatten().collect() };
        let places_of_sections = places("section");
        let mut sections: Vec<SectionOption> = words
            .section
            .into_iter()
            .map(|section| SectionOption {
                section,
                ..SectionOption::default()
            })
            .collect();
        // The last section before a position on the command line; if there is none, the first section after it.
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
                    stray = Some(Stray {
                        option: format!("--relief {relief}"),
                        what: "its section has a relief already",
                        help: "leave one out, or add another --section SPEC before it",
                    });
                }
                None if words.boxes.is_empty() && words.wedges.is_empty() => {
                    stray = Some(Stray::without_section(format!("--relief {relief}")));
                }
                None => stray = Some(Stray::relief_of_region(&relief)),
            }
        }
        for place in places("flip").into_iter().take(words.flip.len()) {
            match sections.get_mut(owner(place)) {
                Some(section) => section.flip = !section.flip,
                None => stray = Some(Stray::without_section("--flip")),
            }
        }
        let regions = [&words.boxes, &words.wedges, &words.cutter];
        let opens = words.cutout.is_some() || words.breakaway.is_some();
        let cuts_nothing = !opens && sections.is_empty() && regions.iter().all(|r| r.is_empty());
        // A sweeping plane is a cut as well.
        let sweeps = matches!(matches.try_contains_id("sweep"), Ok(true));
        if cuts_nothing && !sweeps && !words.exclude.is_empty() {
            stray = Some(Stray::without_section("--exclude"));
        }
        Ok(Self {
            sections,
            boxes: words.boxes,
            wedges: words.wedges,
            stray,
            combination: words.cut,
            cutters: words.cutter,
            cutout: words.cutout,
            breakaway: words.breakaway,
            roles: words.roles,
            exclude: words.exclude,
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl SectionArgs {
    /// Adds the cuts to a document.
    pub(crate) fn amend(&self, document: &mut Document) -> Result<()> {
        if let Some(stray) = &self.stray {
            return Err(Error::input(&stray.option, stray.what, stray.help));
        }
        self.cutters.iter().try_for_each(|c| check_model(c))?;
        for cut in self.drafts() {
            document.add_cut(self.spare(cut))?;
        }
        roles::amend(document, &self.roles, self.breakaway.is_some())
    }

    /// The cut, except for the parts that the command line excludes.
    pub(crate) fn spare(&self, cut: CutDraft) -> CutDraft {
        cut.except(&self.exclude)
    }

    fn drafts(&self) -> Vec<CutDraft> {
        let sections = self.sections.iter().map(|words| cut([words.draft()]));
        let boxes = self.boxes.iter().map(|words| cut([]).block(words));
        let wedges = self.wedges.iter().map(|words| cut([]).wedge(words));
        let cutout = self.cutout.iter().map(|words| cut([]).cutout(words));
        let breakaway = self.breakaway.iter().map(|words| cut([]).breakaway(words));
        let regions = boxes.chain(wedges).chain(cutout).chain(breakaway);
        let mut cuts: Vec<CutDraft> = sections.chain(regions).collect();
        if self.combination == Combination::Intersection {
            cuts = cuts.into_iter().reduce(CutDraft::and).into_iter().collect();
        }
        cuts.extend(self.cutters.iter().map(|cutter| cut([]).volume(cutter)));
        cuts
    }

    /// Rejects boxes and wedges of the command line that remove nothing. A scene file may contain such a region: it may be animated,
    /// or disabled.
    pub(crate) fn must_be_of_use(&self, document: &Document, scene: &Scene) -> Result<()> {
        let cuts = document.root().get("cut").map_or(&[] as &[_], Node::items);
        let own = cuts.iter().rev().take(self.drafts().len());
        let own: Vec<&str> = (own.filter(|cut| cut.get("enabled").is_none()))
            .filter_map(Node::name)
            .collect();
        let is_empty = |cut: &&Cut| !cut.enabled && own.contains(&&*cut.name);
        match scene.cuts.iter().find(is_empty) {
            Some(cut) => {
                let help = "let the first end be less than the second";
                Err(Error::input(&cut.name, "it is empty", help))
            }
            None => Ok(()),
        }
    }
}

impl SectionOption {
    fn draft(&self) -> SurfaceDraft {
        let mut surface = section(&self.section);
        if let Some(relief) = &self.relief {
            surface = surface.relief(relief);
        }
        if self.flip { surface.flip() } else { surface }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;
    use cutaway_io::document::part;
    use cutaway_io::load::Assets;

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
        let mut document = Document::new();
        document.add_part(part("shape:shells"))?;
        let args = read(line);
        args.amend(&mut document)?;
        let scene = document.timeline(&mut Assets::default())?.scene()?;
        args.must_be_of_use(&document, &scene)?;
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
}
