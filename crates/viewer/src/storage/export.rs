//! Pictures, films and drawings of the scene as files, made by the command in a process of its own: what is exported is what the command
//! would make, the window goes on meanwhile, and an end leaves no half of a file.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use cutaway::{Error, Result};
use cutaway_cli::write_file;
use cutaway_io::Document;

use crate::notice::Notice;

/// Supersampling factor of exported pictures, relative to the window.
const SUPERSAMPLE: &str = "2";

/// A file that is being made.
#[derive(Debug)]
pub struct Export {
    child: Child,
    path: PathBuf,
    made: PathBuf,
    /// Holds the scene that the command reads.
    _folder: tempfile::TempDir,
}

impl Export {
    /// Begins a file: a picture (.png), a film (.gif, .apng, .mp4) or the outlines of its sections (.svg), by the ending of its name.
    ///
    /// # Errors
    ///
    /// Another ending, or a process that cannot be started.
    pub fn begin(
        program: &Path,
        document: &Document,
        size_px: [u32; 2],
        moves: bool,
        path: &Path,
    ) -> Result<Self> {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        let [width, height] = size_px;
        let size = format!("{width},{height}");
        let words: Vec<&str> = match &*ending.to_lowercase() {
            "png" => vec![
                "render",
                "--resolution",
                &size,
                "--supersample",
                SUPERSAMPLE,
            ],
            "gif" | "apng" | "mp4" if moves => vec!["animate", "--resolution", &size],
            "gif" | "apng" | "mp4" => vec!["animate", "--turntable", "--resolution", &size],
            "svg" => vec!["section"],
            _ => {
                return Err(Error::file(
                    path,
                    "it is no kind of file that is exported",
                    "name a picture (.png), a film (.gif, .apng, .mp4) or a drawing (.svg)",
                ));
            }
        };
        let fault = |e: std::io::Error| {
            Error::file(
                path,
                format!("its making cannot be started: {e}"),
                "try again",
            )
        };
        let folder = tempfile::tempdir().map_err(fault)?;
        let scene = folder.path().join("scene.toml");
        // Made here, and put into its place when it is whole.
        let made = folder.path().join(format!("made.{ending}"));
        write_file(&scene, document.moved_to(&scene)?.to_string().as_bytes())?;
        let (subcommand, options) = (words[0], &words[1..]);
        let child = Command::new(program)
            .arg(subcommand)
            .arg(&scene)
            .args(options)
            .args(["--quiet".as_ref(), "--output".as_ref(), made.as_os_str()])
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(fault)?;
        Ok(Self {
            child,
            path: path.to_owned(),
            made,
            _folder: folder,
        })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Result of the export, once it has ended.
    pub fn ended(&mut self) -> Option<Notice> {
        let status = self.child.try_wait().ok().flatten()?;
        if status.success() {
            let read = std::fs::read(&self.made);
            let read = read.map_err(|e| Error::file(&self.made, e.to_string(), "export it again"));
            let placed = read.and_then(|bytes| write_file(&self.path, &bytes));
            let done = format!("exported {}", self.path.display());
            return Some(placed.map_or_else(Notice::from, |()| Notice::done(done)));
        }
        let mut text = String::new();
        if let Some(stderr) = &mut self.child.stderr {
            // What it said is all there is to tell; without it the status must do.
            let _ = stderr.read_to_string(&mut text);
        }
        let text = text.trim().trim_start_matches("error: ").to_owned();
        Some(Notice {
            text: match text.is_empty() {
                true => format!("{} was not exported: {status}", self.path.display()),
                false => text,
            },
            is_error: true,
        })
    }

    /// Ends it before it is done.
    pub fn cancel(&mut self) {
        // One that has ended by itself needs no end.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Drop for Export {
    fn drop(&mut self) {
        self.cancel();
    }
}
