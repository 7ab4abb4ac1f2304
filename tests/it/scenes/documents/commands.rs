//! Commands of README and the book: they run in a folder with files of the names that they use, in a small size; what would take minutes, a
//! window or another program is parsed. Scenes open.

use std::fs;
use std::thread;

use super::command::{Ran, Scratch};
use crate::common::shares::{Share, in_shares};

use super::{blocks, documents, root, stand_ins};

/// Pages whose commands other tests run (`cli::gallery`), or that are lists made from tables.
const ELSEWHERE: [&str; 4] = [
    "docs/SUMMARY.md",
    "docs/gallery/index.md",
    "docs/images/README.md",
    "docs/reference/",
];

/// Commands that are parsed and not run, and why.
const PARSED: [(&str, &str); 4] = [
    ("view", "opens a window"),
    ("demo", "takes a minute"),
    ("measure", "takes minutes"),
    ("report", "wants what `measure` leaves"),
];

/// Commands of other programs that documents show.
const OTHERS: [&str; 3] = ["make ", "cargo ", "sbatch "];

/// Pages for users, by name.
fn pages() -> Vec<(String, String)> {
    let all = documents().into_iter();
    let is_page = |name: &str| {
        (name == "README.md" || name == "CONTRIBUTING.md" || name.starts_with("docs/"))
            && !ELSEWHERE.iter().any(|e| name.starts_with(e))
    };
    all.filter(|(name, _)| is_page(name)).collect()
}

/// Words of a line as a shell has them: quotes hold them together, and a comment ends them.
pub(crate) fn words(line: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let (mut word, mut is_open, mut quote) = (String::new(), false, None);
    for sign in line.chars() {
        match (quote, sign) {
            (Some(q), sign) if q == sign => quote = None,
            (None, '\'' | '"') => (quote, is_open) = (Some(sign), true),
            (None, '#') if !is_open => break,
            (None, ' ') => {
                if is_open {
                    words.push(std::mem::take(&mut word));
                }
                is_open = false;
            }
            (_, sign) => {
                word.push(sign);
                is_open = true;
            }
        }
    }
    words.extend(is_open.then_some(word));
    words
}

/// Lines of the blocks for a shell.
fn lines(text: &str) -> Vec<String> {
    let blocks = blocks(text).into_iter();
    let of_shell = blocks.filter(|(language, _)| language == "sh");
    let lines =
        of_shell.flat_map(|(_, block)| block.lines().map(str::to_owned).collect::<Vec<_>>());
    let lines = lines.map(|line| line.trim().to_owned());
    lines.filter(|line| !line.is_empty()).collect()
}

/// Commands within the text, which are parsed.
fn inline(text: &str) -> Vec<String> {
    let spans = text.split('`').skip(1).step_by(2);
    let commands = spans.filter_map(|span| span.strip_prefix("cutaway "));
    let whole = commands.filter(|c| !c.contains('\n') && !c.starts_with("help"));
    whole.map(str::to_owned).collect()
}

/// The same in a small size. Nothing else of the line is changed.
pub(crate) fn small(line: &[String]) -> Vec<String> {
    let drawn: &[(&str, &str)] = match line[0].as_str() {
        "render" => &[("--resolution", "48,36"), ("--supersample", "1")],
        "animate" => &[
            ("--resolution", "48,36"),
            ("--supersample", "1"),
            ("--frames", "2"),
        ],
        "compare" => &[("--resolution", "48,36"), ("--rounds", "1")],
        _ => &[],
    };
    let mut kept: Vec<String> = Vec::new();
    let mut rest = line.iter();
    while let Some(word) = rest.next() {
        let replaced = drawn.iter().any(|(option, _)| option == word);
        // As long as it is: two frames are.
        let is_duration = line[0] == "animate" && word == "--duration";
        match replaced || is_duration {
            true => drop(rest.next()),
            false => kept.push(word.clone()),
        }
    }
    kept.extend(drawn.iter().flat_map(|(o, v)| [(*o).into(), (*v).into()]));
    kept
}

pub(crate) fn run(folder: &Scratch, words: &[String]) -> Ran {
    let line = words.join(" ");
    let output = folder.command("").args(words).output().unwrap();
    Ran::of(&line, output)
}

/// Parses a command: options are read in order, and help ends it before anything is done.
fn parse(folder: &Scratch, mut words: Vec<String>) -> Ran {
    words.push("--help".into());
    run(folder, &words)
}

/// What is wrong with the commands of a page.
fn faults(name: &str, text: &str) -> Vec<String> {
    let folder = Scratch::new("documents");
    stand_ins::fill(&folder);
    let scenes = scenes(&folder, text);
    let mut faults = Vec::new();
    let mut must_work = |ran: Ran| {
        if ran.code != Some(0) {
            faults.push(format!("{name}: {}\n{}", ran.line, ran.stderr));
        }
    };
    for line in lines(text) {
        let Some(command) = line.strip_prefix("cutaway ") else {
            continue;
        };
        let words = words(command);
        let is_parsed = PARSED.iter().any(|(name, _)| *name == words[0]);
        // Films want another program, and a cluster its folder.
        let wants = [".mp4", "/shared/"];
        match is_parsed || wants.iter().any(|w| command.contains(w)) {
            true => must_work(parse(&folder, words)),
            false => must_work(run(&folder, &small(&words))),
        }
    }
    for command in inline(text) {
        must_work(parse(&folder, words(&command)));
    }
    for scene in scenes {
        let line = format!("render {scene} -o scene-of-page.png --quiet");
        must_work(run(&folder, &small(&words(&line))));
    }
    faults
}

/// Writes the files of TOML of a page by the names in their first lines, and returns those that are scenes.
fn scenes(folder: &Scratch, text: &str) -> Vec<String> {
    let blocks = blocks(text).into_iter();
    let mut scenes = Vec::new();
    for (_, block) in blocks.filter(|(language, _)| language == "toml") {
        let first = block.lines().next().unwrap();
        let name = first.strip_prefix("# ").unwrap_or_else(|| {
            panic!(
                "the first line of this says what the file is called, as `# scene.toml`:\n{block}"
            )
        });
        folder.write(name, &block);
        if block.contains("[[part]]") || block.contains("part = [") {
            scenes.push(name.to_owned());
        }
    }
    scenes
}

in_shares!(every_command_of_readme_and_the_book_runs, 4);

fn every_command_of_readme_and_the_book_runs(share: Share) {
    let pages = pages();
    let counted = pages.iter().map(|(_, text)| lines(text).len());
    let counted: usize = counted.sum();
    assert!(counted > 70, "{counted} commands");
    let faults: Vec<String> = thread::scope(|scope| {
        let runs = (share.part(&pages)).map(|(name, text)| scope.spawn(|| faults(name, text)));
        let runs: Vec<_> = runs.collect();
        runs.into_iter()
            .flat_map(|run| run.join().unwrap())
            .collect()
    });
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_command_that_does_not_run_is_found() {
    for (page, count) in [
        ("```sh\ncutaway render nowhere.stl -o a.png\n```\n", 1),
        ("```sh\ncutaway view bracket.stl --nonsense\n```\n", 1),
        ("as `cutaway section --nonsense` does", 1),
        ("```toml\n# a.toml\n[[part]]\nshape = \"cubus\"\n```\n", 1),
        ("```sh\ncutaway inspect bracket.stl # of it\n```\n", 0),
    ] {
        let faults = faults("planted", page);
        assert_eq!(faults.len(), count, "{page}: {faults:?}");
    }
    assert_eq!(words("a 'b c' --d=\"e\" # f"), ["a", "b c", "--d=e"]);
}

#[test]
fn commands_of_other_programs_are_known() {
    let makefile = fs::read_to_string(root().join("Makefile")).unwrap();
    let is_known = |line: &str| match line.strip_prefix("make ") {
        Some(rest) => {
            let target = rest.split(' ').next().unwrap();
            makefile.contains(&format!("\n{target}:"))
        }
        None => line.starts_with("cutaway ") || OTHERS.iter().any(|o| line.starts_with(o)),
    };
    for (name, text) in pages() {
        for line in lines(&text) {
            assert!(is_known(&line), "{name}: {line}");
        }
        let spans = text.split('`').skip(1).step_by(2);
        for span in spans.filter(|s| s.starts_with("make ")) {
            assert!(is_known(span), "{name}: {span}");
        }
        let scripts = text.split('`').skip(1).step_by(2);
        for span in scripts.filter(|s| s.starts_with("scripts/")) {
            let script = span.split(' ').next().unwrap();
            assert!(root().join(script).is_file(), "{name}: {script}");
        }
    }
    assert!(!is_known("make nothing"), "the control");
    assert!(!is_known("cutway render"), "the control");
}
