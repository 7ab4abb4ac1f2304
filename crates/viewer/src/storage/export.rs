//! Exports pictures, films and drawings by running the command in a separate process: the result is what the command
//! would write, the window remains usable, and cancelling leaves no partial file.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use cutaway::{Error, Result};
use cutaway_cli::write_file;
use cutaway_io::Document;

use cutaway::error::{Diagnostic, Severity};

/// Value of `--supersample` for exported pictures.
const SUPERSAMPLE: &str = "2";

/// An export in progress.
#[derive(Debug)]
pub struct Export {
    child: Child,
    path: PathBuf,
    made: PathBuf,
    /// Temporary folder with the scene that the command reads.
    _folder: tempfile::TempDir,
}

impl Export {
    /// Begins an export. The extension decides what is exported: a picture (.png), a film (.gif, .apng, .mp4) or section outlines (.svg).
    ///
    /// # Errors
    ///
    /// The file has another extension, or the process cannot be started.
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
                    "this kind of file cannot be exported",
                    "name a picture (.png), a film (.gif, .apng, .mp4) or a drawing (.svg)",
                ));
            }
        };
        let fault = |e: std::io::Error| {
            Error::file(
                path,
                format!("the export cannot be started: {e}"),
                "try again",
            )
        };
        let folder = tempfile::tempdir().map_err(fault)?;
        let scene = folder.path().join("scene.toml");
        // The command writes to this path; the file is moved to its destination when complete.
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

    /// The file to which the export is written.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The notice of success or failure, once the export has ended.
    pub fn ended(&mut self) -> Option<Diagnostic> {
        let status = self.child.try_wait().ok().flatten()?;
        if status.success() {
            let read = std::fs::read(&self.made);
            let read = read.map_err(|e| Error::file(&self.made, e.to_string(), "export it again"));
            let placed = read.and_then(|bytes| write_file(&self.path, &bytes));
            let done = format!("exported {}", self.path.display());
            return Some(
                placed.map_or_else(Diagnostic::from, |()| Diagnostic::note("exported", done)),
            );
        }
        let mut text = String::new();
        if let Some(stderr) = &mut self.child.stderr {
            // Report the process's messages or, if there are none, its exit status.
            let _ = stderr.read_to_string(&mut text);
        }
        let text = text.trim().trim_start_matches("error: ").to_owned();
        let text = match text.is_empty() {
            true => format!("{} was not exported: {status}", self.path.display()),
            false => text,
        };
        Some(Diagnostic::new(Severity::Error, "export", text))
    }

    /// Cancels the export.
    pub fn cancel(&mut self) {
        // This fails, without harm, if the process has already ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Drop for Export {
    fn drop(&mut self) {
        self.cancel();
    }
}
