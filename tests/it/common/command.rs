//! The command in a folder of its own: what it is run with, and what it leaves.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::atomic::{AtomicU32, Ordering};

use cutaway::scene::Scene;
use cutaway_io::document::{Document, Timeline};
use cutaway_io::load::Assets;
use serde_json::Value;

/// A folder that is removed with everything in it.
pub(crate) struct Scratch(PathBuf);

impl Scratch {
    pub(crate) fn new(name: &str) -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let name = format!("cutaway-{name}-{}-{number}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, bytes).unwrap();
        path
    }

    /// A scene file of cubes in a row, called by names as TOML writes them, that a plane halves.
    pub(crate) fn write_cubes(&self, file: &str, names: &[&str]) {
        let part = |(i, name): (usize, &&str)| {
            format!(
                "[[part]]\nname = \"{name}\"\nshape = \"cube\"\ntranslate = [{}, 0, 0]\n",
                3 * i
            )
        };
        let parts: String = names.iter().enumerate().map(part).collect();
        let cut = "[[cut]]\nsurfaces = [{ section = \"z=50%\" }]\n";
        self.write(file, format!("{parts}{cut}"));
    }

    /// A scene file of this text, opened.
    pub(crate) fn load(&self, text: &str) -> cutaway::Result<Timeline> {
        self.load_with(text, &mut Assets::default())
    }

    /// A scene file of this text, opened with what is there already.
    pub(crate) fn load_with(&self, text: &str, assets: &mut Assets) -> cutaway::Result<Timeline> {
        Document::read(&self.write("scene.toml", text))?.timeline(assets)
    }

    /// The scene of a sound text.
    pub(crate) fn scene(&self, text: &str) -> Scene {
        self.timeline(text).rest().clone()
    }

    /// The timeline of a sound text.
    pub(crate) fn timeline(&self, text: &str) -> Timeline {
        let timeline = self.load(text);
        timeline.unwrap_or_else(|e| panic!("{e}\n{text}"))
    }

    pub(crate) fn files(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(&self.0)
            .unwrap()
            .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// Runs the command in the folder; words are separated by spaces.
    pub(crate) fn run(&self, line: &str) -> Ran {
        let output = self.command(line).output().unwrap();
        Ran::of(line, output)
    }

    pub(crate) fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_cutaway-tested"));
        command.args(line.split_whitespace()).current_dir(&self.0);
        command
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A run that has ended.
pub(crate) struct Ran {
    pub(crate) line: String,
    pub(crate) code: Option<i32>,
    pub(crate) stdout: Vec<u8>,
    pub(crate) stderr: String,
}

impl Ran {
    pub(crate) fn of(line: &str, output: Output) -> Self {
        Self {
            line: line.to_owned(),
            code: output.status.code(),
            stdout: output.stdout,
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }

    #[track_caller]
    pub(crate) fn exits(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{}\n{}", self.line, self.stderr);
        self
    }

    /// What keeps this from being a refusal: exit code 2, an error that says all of this, nothing on standard output.
    pub(crate) fn faults_of_refusal(&self, said: &[&str]) -> Vec<String> {
        let mut faults = Vec::new();
        if self.code != Some(2) {
            faults.push(format!("exit code {:?}", self.code));
        }
        let unsaid = said.iter().chain(&["error:"]);
        let unsaid = unsaid.filter(|said| !self.stderr.contains(**said));
        faults.extend(unsaid.map(|said| format!("no `{said}`")));
        if !self.stdout.is_empty() {
            faults.push("something on standard output".to_owned());
        }
        faults
    }

    /// That it was refused.
    #[track_caller]
    pub(crate) fn must_refuse(self, said: &[&str]) {
        let faults = self.faults_of_refusal(said);
        assert!(
            faults.is_empty(),
            "{}: {faults:?}\n{}",
            self.line,
            self.stderr
        );
    }

    pub(crate) fn text(&self) -> &str {
        std::str::from_utf8(&self.stdout).unwrap()
    }

    pub(crate) fn json(&self) -> Value {
        serde_json::from_slice(&self.stdout)
            .unwrap_or_else(|e| panic!("{}: {e}\n{}", self.line, self.text()))
    }
}
