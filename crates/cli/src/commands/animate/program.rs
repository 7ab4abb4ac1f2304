//! The program ffmpeg: whether it is installed, and which codec it uses.

use std::io::ErrorKind;
use std::path::Path;
use std::process::{Command, Stdio};

use cutaway::{Error, Result};

/// The program, and its codec options.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct FfmpegProgram {
    pub(super) codec: &'static [&'static str],
}

/// Codecs that ffmpeg may have built in, the best first, each with its quality options.
const CODECS: &[(&str, &[&str])] = &[
    (
        "libx264",
        &["-c:v", "libx264", "-preset", "medium", "-crf", "16"],
    ),
    ("libopenh264", &["-c:v", "libopenh264", "-b:v", "12M"]),
    ("mpeg4", &["-c:v", "mpeg4", "-q:v", "2"]),
];

impl FfmpegProgram {
    /// Finds ffmpeg and the best of its codecs, before any frame is drawn.
    pub(super) fn find(output: &Path) -> Result<Self> {
        let culprit = || format!("--output {}", output.display());
        let asked = Command::new("ffmpeg")
            .args(["-hide_banner", "-encoders"])
            .stdin(Stdio::null())
            .output();
        let said = match asked {
            Ok(said) => String::from_utf8_lossy(&said.stdout).into_owned(),
            Err(e) => {
                let what = match e.kind() {
                    ErrorKind::NotFound => {
                        "ffmpeg, which makes MP4 files, is not installed".to_owned()
                    }
                    _ => format!("ffmpeg, which makes MP4 files, cannot be started: {e}"),
                };
                let help = "install the package ffmpeg (apt install ffmpeg, dnf install ffmpeg-free, pacman -S ffmpeg, \
                            brew install ffmpeg), or write a .gif or a .png";
                return Err(Error::input(culprit(), what, help));
            }
        };
        let has = |name: &str| said.split_whitespace().any(|word| word == name);
        let codec = CODECS.iter().find(|(name, _)| has(name));
        let (_, codec) = codec.ok_or_else(|| {
            let names: Vec<&str> = CODECS.iter().map(|(name, _)| *name).collect();
            let what = format!("ffmpeg has none of the encoders {}", names.join(", "));
            Error::input(
                culprit(),
                what,
                "install a complete ffmpeg, or write a .gif or a .png",
            )
        })?;
        Ok(Self { codec })
    }
}
