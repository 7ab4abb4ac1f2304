//! `man --markdown`: the book's reference, generated from the definitions by which arguments and scene files are parsed.
//!
//! One page describes the commands, from the definitions of `clap`, and one describes scene files, from [`paths`]. This generator exists
//! because existing ones (`clap-markdown` 0.1) lose the headings of options.
//!
//! Takes milliseconds.

use std::fmt::Write as _;

use clap::{Arg, Command};
use cutaway::generate::shapes::SHAPES;
use cutaway_io::document::paths::{self, Path};

/// Heading of options without their own heading.
const OPTIONS: &str = "Options";

/// The page of all commands.
pub(crate) fn commands(mut root: Command) -> String {
    root.build();
    let mut text = String::from(
        "# Commands\n\n<!-- Written by `cutaway man --markdown docs/reference`; do not edit. -->\n\n\
         Every command and every option. `cutaway help COMMAND` prints the same in a terminal.\n\n| command | what it does |\n|---|---|\n",
    );
    let shown = |c: &&Command| !c.is_hide_set() && c.get_name() != "help";
    for command in root.get_subcommands().filter(shown) {
        let name = command.get_name();
        let about = about(command);
        let _ = writeln!(
            text,
            "| [`{name}`](#cutaway-{name}) | {} |",
            about.replace('|', "\\|")
        );
    }
    for command in root.get_subcommands().filter(shown) {
        text.push_str(&command_section(command));
    }
    text.push_str(&shapes());
    text
}

fn about(command: &Command) -> String {
    let about = command.get_about().map(ToString::to_string);
    escaped(&about.unwrap_or_default())
}

fn command_section(command: &Command) -> String {
    let usage = command.clone().render_usage().to_string();
    let mut text = format!(
        "\n## cutaway {}\n\n{}.\n\n```text\n{}\n```\n",
        command.get_name(),
        about(command),
        usage.trim_start_matches("Usage: ")
    );
    let arguments: Vec<&Arg> = command.get_positionals().collect();
    text.push_str(&list("Arguments", &arguments));
    for heading in headings(command) {
        let options: Vec<&Arg> = options(command)
            .filter(|a| heading_of(a) == heading)
            .collect();
        text.push_str(&list(heading, &options));
    }
    if let Some(examples) = command.get_after_help() {
        let _ = write!(text, "\n```text\n{}\n```\n", examples.to_string().trim());
    }
    text
}

/// All options except `--help`, which every command has.
fn options(command: &Command) -> impl Iterator<Item = &Arg> {
    let is_shown = |a: &&Arg| !a.is_positional() && !a.is_hide_set();
    let known = ["help", "version"];
    (command.get_arguments()).filter(move |a| is_shown(a) && !known.contains(&a.get_id().as_str()))
}

fn heading_of(arg: &Arg) -> &str {
    arg.get_help_heading().unwrap_or(OPTIONS)
}

/// Headings of a command's options, in the order in which help shows them.
fn headings(command: &Command) -> Vec<&str> {
    let mut found = vec![OPTIONS];
    for arg in options(command) {
        let heading = heading_of(arg);
        if !found.contains(&heading) {
            found.push(heading);
        }
    }
    found
}

fn list(heading: &str, args: &[&Arg]) -> String {
    if args.is_empty() {
        return String::new();
    }
    let mut text = format!("\n**{heading}**\n\n");
    for arg in args {
        let help = arg.get_long_help().or(arg.get_help());
        let help = help.map(ToString::to_string).unwrap_or_default();
        let mut line = format!("- `{arg}`", arg = spelling(arg));
        if !help.is_empty() {
            let help = escaped(&help.replace('\n', " "));
            let _ = write!(line, ": {}.", help.trim_end_matches('.'));
        }
        let values: Vec<String> = match arg.is_hide_possible_values_set() {
            true => Vec::new(),
            false => (arg.get_possible_values().iter())
                .map(|v| format!("`{}`", v.get_name()))
                .collect(),
        };
        if arg.get_action().takes_values() && !values.is_empty() {
            let _ = write!(line, " One of {}.", values.join(", "));
        }
        let defaults: Vec<_> = (arg.get_default_values().iter())
            .map(|v| v.to_string_lossy())
            .collect();
        if arg.get_action().takes_values() && !defaults.is_empty() {
            let _ = write!(line, " Default: `{}`.", defaults.join(" "));
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// Spelling of an argument: `-o, --output <FILE|->`.
fn spelling(arg: &Arg) -> String {
    let long = arg.to_string();
    match arg.get_short().filter(|_| arg.get_long().is_some()) {
        Some(short) => format!("-{short}, {long}"),
        None => long,
    }
}

/// Help as Markdown: text in backticks is already code; elsewhere Markdown characters are escaped.
fn escaped(help: &str) -> String {
    let spans = help.split('`').enumerate();
    let spans = spans.map(|(at, span)| match at % 2 {
        1 => span.to_owned(),
        _ => {
            let mut text = String::with_capacity(span.len());
            for sign in span.chars() {
                if "*_<>[]".contains(sign) {
                    text.push('\\');
                }
                text.push(sign);
            }
            text
        }
    });
    spans.collect::<Vec<_>>().join("`")
}

fn shapes() -> String {
    let mut text = String::from(
        "\n## Built-in shapes\n\nWherever a command takes a model: `shape:NAME?param=value&param=value`.\n\n\
         | shape | what it is | parameters |\n|---|---|---|\n",
    );
    for shape in SHAPES {
        let parameters: Vec<String> = (shape.parameters.iter())
            .map(|p| format!("`{}`", p.name))
            .collect();
        let (name, summary) = (shape.name, cell(shape.summary));
        let _ = writeln!(text, "| `{name}` | {summary} | {} |", parameters.join(", "));
    }
    text
}

/// Text as a table cell.
fn cell(text: &str) -> String {
    escaped(text).replace('|', "\\|")
}

/// Sections of the scene-file page, each with the first word of its paths and a description. The first section has all other paths.
const SECTIONS: &[(&str, &str)] = &[
    ("", "Values at the top of the file."),
    (
        "part",
        "`[[part]]`: the meshes, their places and materials.",
    ),
    ("cut", "`[[cut]]`: what is removed."),
    (
        "relief",
        "`[relief.NAME]`: heights, which surfaces of cuts refer to by name.",
    ),
    (
        "roles",
        "`[roles]`: which parts are cut, by globs on their names.",
    ),
    (
        "camera",
        "`[camera]`: where the scene is seen from. What is left out is chosen so that the cut is seen.",
    ),
    ("strategy", "`[strategy]`: how caps are found."),
    (
        "style",
        "`[style]`: what a picture looks like. A file for `--style` has the same keys without `style.`.",
    ),
    ("key", "`[[key]]`: what moves, and when."),
];

/// The page of scene files.
pub(crate) fn scene() -> String {
    let mut text = String::from(
        "# Scene files\n\n<!-- Written by `cutaway man --markdown docs/reference`; do not edit. -->\n\n\
         Every value that a scene file can hold. [Scenes](../scenes.md) introduces them; `cutaway scene` prints this list, \
         `cutaway scene camera` a part of it. In a path, `*` stands for the name of an entry or for its number from 0: \
         `cut.*.surfaces.*.section` is `cut.front.surfaces.0.section`. `--set PATH=VALUE` sets a value on top of a file or of options. \
         Values marked *moves* can be the target of a `[[key]]`. Percentages are of the bounds of the model or of their diagonal. \
         Keys that are not listed are errors.\n",
    );
    for (group, about) in SECTIONS {
        let paths: Vec<&Path> = paths::all()
            .iter()
            .filter(|p| group_of(p) == *group)
            .collect();
        let title = if group.is_empty() { "Top level" } else { group };
        let _ = write!(
            text,
            "\n## {title}\n\n{about}\n\n| path | takes | what it is | example |\n|---|---|---|---|\n"
        );
        for p in paths {
            let moves = if p.moves { "; *moves*" } else { "" };
            let _ = writeln!(
                text,
                "| `{}` | {}{moves} | {} | `{}` |",
                p.path,
                cell(&p.takes.with_unit(p.unit)),
                cell(p.help),
                p.example.replace('|', "\\|"),
            );
        }
    }
    text
}

/// The section of a path.
fn group_of(path: &Path) -> &str {
    match path.path.split_once('.') {
        Some((first, _)) => first,
        None => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_path_has_a_section() {
        let has_one = |p: &Path| SECTIONS.iter().any(|(name, _)| *name == group_of(p));
        for path in paths::all() {
            assert!(has_one(path), "{} is in no section", path.path);
        }
        let planted = Path {
            path: "nowhere.at_all".to_owned(),
            ..paths::all()[0].clone()
        };
        assert!(!has_one(&planted), "the control");
    }

    #[test]
    fn code_stays_and_signs_are_escaped() {
        assert_eq!(escaped("as `a*b` or a*b <c>"), "as `a*b` or a\\*b \\<c\\>");
    }
}
