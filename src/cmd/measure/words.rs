//! Words of an experiment, read by the same parser as those of a user after `cutaway compare`.

use std::path::Path;

use clap::Parser;

use crate::cmd::args::{MeansArgs, SceneArgs};
use crate::cmd::console::Console;
use crate::cmd::open::open;
use crate::cmd::when::TimeArgs;
use crate::experiment::{Opener, Shown, Staged};
use crate::scene::frames::Pattern;
use crate::scene::shapes;
use crate::{Error, Result};

/// Everything that says what is drawn, and nothing that says what is measured of it.
#[derive(Parser)]
#[command(name = "cutaway compare", disable_help_flag = true)]
struct PointWords {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    when: TimeArgs,
    #[command(flatten)]
    means: MeansArgs,
}

fn parsed(words: &[String]) -> Result<PointWords> {
    let all = std::iter::once("cutaway").chain(words.iter().map(String::as_str));
    PointWords::try_parse_from(all).map_err(|e| {
        let told = e.to_string();
        let told = told.trim_start_matches("error: ").split("\n\n").next();
        let told = told.unwrap_or_default();
        // Values bring their own mend.
        let (what, mend) = told.split_once("\n  help: ").unwrap_or((
            told,
            "write words as after `cutaway compare`, options as `--name=value`; `--strategies` and `--rounds` are keys here",
        ));
        Error::input(format!("`{}`", words.join(" ")), what, mend)
    })
}

/// Checks words without opening what they name.
pub(super) fn check(words: &[String]) -> Result<()> {
    let inputs = parsed(words)?.scene.inputs;
    let mut shapes = inputs.iter().filter(|i| i.starts_with("shape:"));
    shapes.try_for_each(|s| shapes::check(s))?;
    let is_missing = |i: &&String| {
        let is_file = !i.starts_with("shape:") && !Pattern::is_in(i);
        is_file && !Path::new(i).exists()
    };
    match inputs.iter().find(is_missing) {
        None => Ok(()),
        Some(missing) => Err(Error::file(
            Path::new(missing),
            "there is no such file",
            "check the path: it is seen from where the command is run; built-in shapes are written shape:NAME",
        )),
    }
}

/// Opens words, and hears what there is to say about them.
pub(super) struct OpensWords;

impl Opener for OpensWords {
    fn open(&self, words: &[String]) -> Result<Staged> {
        let words = parsed(words)?;
        let console = Console::hearing();
        let opened = open(&words.scene, &words.when, &console)?;
        let shown = Shown::of(&opened.scene);
        Ok(Staged {
            name: opened.scene.name.clone(),
            view: opened.view(&shown.model.prepared),
            options: opened.options(words.means.options()),
            shown,
            remarks: console.heard(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_those_of_the_command_line() {
        let check = |text: &str| {
            let words: Vec<String> = text.split(' ').map(str::to_owned).collect();
            check(&words).map_err(|e| e.to_string())
        };
        for text in [
            "shape:crank --section=-z=50% --relief=fractal:amplitude=1% --resolution=64,48",
            "shape:crank --camera-azimuth-angle=-26 --time=0 --rasteriser=compute",
        ] {
            assert_eq!(check(text), Ok(()), "{text}");
        }
        for (text, told) in [
            ("shape:crank --sektion=z=50%", "--sektion"),
            ("shape:crank --resolution=64", "64"),
            ("shape:spong", "did you mean `sponge`"),
            ("shape:sponge?levl=1", "did you mean `level`"),
            ("shape:sponge?level=1 --section=z=50% shape:spher", "sphere"),
            ("shape:crank --strategies=all", "keys here"),
            ("shape:crank --help", "--help"),
            ("nowhere.stl", "nowhere.stl"),
        ] {
            let message = check(text).unwrap_err();
            assert!(message.contains(told), "{message}");
            assert_eq!(message.matches("help:").count(), 1, "{message}");
        }
    }
}
