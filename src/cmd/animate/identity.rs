//! Which run a numbered frame is of: the words of the command, the files that it reads, the program and the device. A frame of the
//! same run would be drawn to the same pixels, and need not be drawn again.

use super::super::stdin;
use super::super::subject::Subject;
use super::AnimateArgs;
use crate::experiment::Identity;
use crate::session::Session;

/// What tells this program from others: its length and when it was written. Reading all of it would take as long as a frame.
fn program() -> String {
    let file = std::env::current_exe().and_then(std::fs::metadata);
    let written = file.and_then(|m| Ok((m.len(), m.modified()?)));
    format!("{:?}", written.ok())
}

/// The identity of a run. Where results go and which share of them is drawn is not part of it.
pub(super) fn of(args: &AnimateArgs, subject: &Subject, session: &Session) -> Identity {
    let outputs = [Some(&args.output), args.json.as_ref()];
    let names_output = |word: &String| {
        let is_option = ["-o", "--output", "--json"].contains(&word.as_str());
        is_option
            || outputs.into_iter().flatten().any(|output| {
                word.strip_suffix(output.as_str()).is_some_and(|option| {
                    ["", "-o", "-o=", "--output=", "--json="].contains(&option)
                })
            })
    };
    let mut run = Identity::default();
    run.add(env!("CARGO_PKG_VERSION"));
    run.add(program());
    run.add(format!("{:?}", session.gpu().report()));
    let words = std::env::args_os().skip(1);
    let words: Vec<String> = words
        .map(|word| word.to_string_lossy().into_owned())
        .collect();
    // Which share draws a frame makes no difference to it.
    let is_of_share = |i: usize| {
        let (word, before) = (&words[i], i.checked_sub(1).map(|i| words[i].as_str()));
        word == "--shard" || word.starts_with("--shard=") || before == Some("--shard")
    };
    for (i, word) in words.iter().enumerate() {
        if !names_output(word) && !is_of_share(i) {
            run.add(word);
        }
    }
    if let Some(bytes) = stdin::bytes() {
        run.add_bytes(bytes);
    }
    for file in subject.files.all() {
        run.add_file(&file);
    }
    run
}
