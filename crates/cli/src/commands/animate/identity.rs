//! Identity of the run of a numbered frame: the scene that results from all options, its times, its input files, the program and the
//! device. A frame of the same run would be drawn to the same pixels, and need not be drawn again.

use cutaway::session::Session;
use cutaway_lab::experiment::Identity;

use super::times::Times;
use crate::input::stdin;
use crate::input::subject::Subject;

/// Identity of this program: its length and modification time. Reading the whole file would take as long as a frame.
fn program() -> String {
    let file = std::env::current_exe().and_then(std::fs::metadata);
    let written = file.and_then(|m| Ok((m.len(), m.modified()?)));
    format!("{:?}", written.ok())
}

/// The identity of a run, without the output paths and the share of frames that is drawn.
pub(super) fn of(
    subject: &Subject,
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
