//! Which run a numbered frame is of: the scene that all options amount to, its times, the files that it reads, the program and the
//! device. A frame of the same run would be drawn to the same pixels, and need not be drawn again.

use cutaway::session::Session;
use cutaway_lab::experiment::Identity;

use super::times::Times;
use crate::input::stdin;
use crate::input::subject::Subject;

/// What tells this program from others: its length and when it was written. Reading all of it would take as long as a frame.
fn program() -> String {
    let file = std::env::current_exe().and_then(std::fs::metadata);
    let written = file.and_then(|m| Ok((m.len(), m.modified()?)));
    format!("{:?}", written.ok())
}

/// The identity of a run. Where results go, and which share of them is drawn, is not part of it.
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
