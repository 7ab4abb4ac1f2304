//! `-` as an input: a model from standard input, whose format is recognised from its content.
//!
//! Standard input is read completely, before anything else is opened. From then on the model is a file in memory, `-/stdin.stl`, visible
//! only to this process. A process has one standard input, so it keeps one copy of the bytes, which documents opened later
//! read again.

use std::borrow::Cow;
use std::io::{self, ErrorKind, IsTerminal, Read};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use clap::Args;
use cutaway::{Error, Result};
use cutaway_io::load::{Assets, Disk, Files, MESH_FORMATS, MOST_BYTES, input_file, mesh_format};

/// The argument for standard input.
pub(crate) const WORD: &str = "-";

static PIPED: OnceLock<Arc<Piped>> = OnceLock::new();

/// Options for standard input.
#[derive(Args, Clone, Copy)]
pub(crate) struct StdinArgs {
    /// Format of the model from standard input, if it cannot be recognised from the content
    #[arg(long, value_name = "FORMAT", value_parser = parse_format)]
    input_format: Option<&'static str>,
}

impl StdinArgs {
    /// Reads the model from standard input if one of the inputs is `-`, and replaces that input by the name of the file in memory.
    pub(crate) fn classify(self, inputs: &[String]) -> Result<Vec<String>> {
        let count = inputs.iter().filter(|input| *input == WORD).count();
        match (count, self.input_format) {
            (0, None) => return Ok(inputs.to_vec()),
            (0, Some(format)) => {
                let what = "no model comes from standard input";
                let help = "give `-` as the model; a file's format is known from its name";
                return Err(Error::input(format!("--input-format {format}"), what, help));
            }
            (1, _) => {}
            _ => {
                let what = "standard input can be read once";
                return Err(Error::input(WORD, what, "give `-` once"));
            }
        }
        let piped = Piped::read(self.input_format)?;
        let place = piped.place.to_string_lossy().into_owned();
        // If a second command runs in the same process, it uses the bytes that the first command read.
        PIPED.get_or_init(|| Arc::new(piped));
        let named = |input: &String| match input.as_str() {
            WORD => place.clone(),
            other => other.to_owned(),
        };
        Ok(inputs.iter().map(named).collect())
    }
}

/// Assets from disk, and from standard input if it was read.
pub(crate) fn assets() -> Assets {
    match PIPED.get() {
        Some(piped) => Assets::from_files(Arc::<Piped>::clone(piped)),
        None => Assets::default(),
    }
}

/// Unpacked bytes of standard input; `None` if it was not read.
pub(crate) fn bytes() -> Option<&'static [u8]> {
    PIPED.get().map(|piped| piped.bytes.as_slice())
}

/// Returns true if an input is the file in memory that holds standard input.
pub(crate) fn is_it(input: &str) -> bool {
    PIPED
        .get()
        .is_some_and(|piped| piped.place == Path::new(input))
}

/// Rejects a document that would refer to standard input, which cannot be read a second time.
pub(crate) fn must_not_be_kept(culprit: &str) -> Result<()> {
    match PIPED.get() {
        Some(_) => {
            let what = "the model comes from standard input, which cannot be read a second time";
            let help = "save the model to a file first, and give the file's name";
            Err(Error::input(culprit, what, help))
        }
        None => Ok(()),
    }
}

fn parse_format(text: &str) -> Result<&'static str, String> {
    let lower = text.to_lowercase();
    let found = MESH_FORMATS.into_iter().find(|format| *format == lower);
    found.ok_or_else(|| {
        let known = MESH_FORMATS.join(", ");
        format!("there is no such format\n  help: say one of {known}")
    })
}

/// A model in memory, and the files on disk.
#[derive(Debug)]
struct Piped {
    place: PathBuf,
    bytes: Vec<u8>,
}

impl Piped {
    fn read(format: Option<&str>) -> Result<Self> {
        let wrong = |what: String, help: &str| Error::input(WORD, what, help);
        let stdin = io::stdin();
        if stdin.is_terminal() {
            let what = "standard input is a terminal".to_owned();
            let help = "pipe a model into it, as in `cutaway inspect - < bracket.stl`";
            return Err(wrong(what, help));
        }
        let mut packed = Vec::new();
        let read = stdin.lock().take(MOST_BYTES + 1).read_to_end(&mut packed);
        read.map_err(|e| wrong(format!("cannot be read: {e}"), "give the name of a file"))?;
        if packed.len() as u64 > MOST_BYTES {
            let what = format!("it has more than {MOST_BYTES} bytes");
            return Err(wrong(what, "split it into several files"));
        }
        if packed.is_empty() {
            let what = "nothing came from standard input".to_owned();
            return Err(wrong(
                what,
                "check whether the program before the pipe has failed",
            ));
        }
        let bytes = input_file::unpack(Path::new(WORD), packed)?;
        let format = format.or_else(|| mesh_format(&bytes)).ok_or_else(|| {
            let what = "the format of standard input cannot be recognised from its content";
            wrong(
                what.to_owned(),
                "name the format, for example by --input-format stl",
            )
        })?;
        Ok(Self {
            place: Path::new(WORD).join(format!("stdin.{format}")),
            bytes,
        })
    }
}

impl Files for Piped {
    fn read(&self, path: &Path) -> io::Result<Cow<'_, [u8]>> {
        if path == self.place {
            return Ok(Cow::Borrowed(&self.bytes));
        }
        if path.starts_with(WORD) {
            let what =
                "a model from standard input has no files beside it; pack it into one, as a .glb";
            return Err(io::Error::new(ErrorKind::NotFound, what));
        }
        Disk.read(path)
    }

    fn is_file(&self, path: &Path) -> bool {
        path == self.place || (!path.starts_with(WORD) && Disk.is_file(path))
    }

    fn leads_out(&self, path: &Path, from: &Path) -> bool {
        from != self.place && Disk.leads_out(path, from)
    }
}
