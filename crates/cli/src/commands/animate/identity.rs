//! Identity of the run that drew a numbered frame: the scene that results from all options, its times, its input files, the program and the
//! device. Runs of equal identity draw equal pixels, so their frames need not be drawn again.

use cutaway::session::Session;
use cutaway_lab::experiment::Identity;

use super::times::Times;
use crate::input::stdin;
use crate::input::subject::SceneInput;

/// Identity of this program: its file's length and modification time. Reading the whole file would take as long as a frame.
fn program() -> String {
    let file = std::env::current_exe().and_then(std::fs::metadata);
    let written = file.and_then(|m| Ok((m.len(), m.modified()?)));
    format!("{:?}", written.ok())
}

/// The identity of a run. It does not depend on output paths or on the share of frames.
pub(super) fn of(
    subject: &SceneInput,
    times: &Times,
    turn_deg: Option<f64>,
    session: &Session,
) -> Identity {
    let mut run = Identity::default();
    run.add(env!("CARGO_PKG_VERSION"));
    run.add(program());
    run.add(format!("{:?}", session.gpu().report()));
    run.add(subject.document().to_string());
    run.add(format!("{times:?} {turn_deg:?}"));
    if let Some(bytes) = stdin::bytes() {
        run.add_bytes(bytes);
    }
    for file in subject.files.all() {
        run.add_file(&file);
    }
    run
}
