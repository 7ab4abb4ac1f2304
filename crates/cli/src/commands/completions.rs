//! `completions` and `man`: shell scripts and manual pages, generated from the definitions of the arguments.
//!
//! Takes milliseconds. The scripts complete options, commands and enumerated values, but not the names of parts or methods in a file.

use std::fs;
use std::path::PathBuf;

use clap::{Args, Command};
use clap_complete::Shell;
use cutaway::{Error, Result};

use super::reference;
use crate::verdict::Verdict;
use crate::writing::output::write_stdout;

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway completions bash > ~/.local/share/bash-completion/completions/cutaway
  cutaway completions zsh > ~/.zfunc/_cutaway             # a folder of $fpath
  cutaway completions fish > ~/.config/fish/completions/cutaway.fish";

pub(crate) const MAN_EXAMPLES: &str = "\
Examples:
  cutaway man ~/.local/share/man/man1 && man cutaway-render
  cutaway man --markdown docs/reference       # commands.md and scene.md, as the book has them";

/// Options of `completions`.
#[derive(Args)]
pub(crate) struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

/// Options of `man`.
#[derive(Args)]
pub(crate) struct ManArgs {
    /// Folder for cutaway.1 and a page for each command; created if missing
    folder: PathBuf,
    /// Write Markdown instead: commands.md with all commands, scene.md with all values of a scene file
    #[arg(long)]
    markdown: bool,
}

/// Runs `completions`.
pub(crate) fn completions(args: &CompletionsArgs, mut command: Command) -> Result<Verdict> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut command, "cutaway", &mut script);
    write_stdout(&script)?;
    Ok(Verdict::Done)
}

/// Runs `man`.
pub(crate) fn man(args: &ManArgs, command: Command) -> Result<Verdict> {
    let fault = |e: std::io::Error| {
        Error::file(
            &args.folder,
            format!("cannot be written: {e}"),
            "name a folder that you may write to",
        )
    };
    fs::create_dir_all(&args.folder).map_err(fault)?;
    if args.markdown {
        let pages = [
            ("commands.md", reference::commands(command)),
            ("scene.md", reference::scene()),
        ];
        for (name, text) in pages {
            fs::write(args.folder.join(name), text).map_err(fault)?;
        }
    } else {
        clap_mangen::generate_to(command, &args.folder).map_err(fault)?;
    }
    Ok(Verdict::Done)
}
