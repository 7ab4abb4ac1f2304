//! MP4: what ffmpeg is told and given, and what happens without it.

use std::process::Output;

use super::command::{Ran, Scratch};
use super::{CUT_CUBE, fs};

/// Prints the boxes of an MP4 file without frames.
#[cfg(unix)]
const WHOLE: &str = "printf '\\0\\0\\0\\010ftyp\\0\\0\\0\\010mdat\\0\\0\\0\\010moov'";

/// Runs the command with nothing but the folder's `bin` to find programs in.
fn run(folder: &Scratch, line: &str) -> Ran {
    let output: Output = folder
        .command(line)
        .env("PATH", folder.path("bin"))
        .output()
        .unwrap();
    Ran::of(line, output)
}

/// Puts a program called ffmpeg there that knows an encoder, and otherwise does what the script says.
#[cfg(unix)]
fn stand_in(folder: &Scratch, encoders: &str, script: &str) {
    use std::os::unix::fs::PermissionsExt;

    fs::create_dir_all(folder.path("bin")).unwrap();
    let text = format!(
        "#!/bin/sh\ncase \"$*\" in *-encoders*) echo ' V....D {encoders} an encoder'; exit 0;; esac\n\
         for last in \"$@\"; do :; done\nfile=\"${{last#file:}}\"\n{script}\n"
    );
    folder.write("bin/ffmpeg", &text);
    fs::set_permissions(folder.path("bin/ffmpeg"), fs::Permissions::from_mode(0o755)).unwrap();
}

#[test]
fn without_ffmpeg_the_package_is_named_and_nothing_is_drawn() {
    let folder = Scratch::new("animate-no-ffmpeg");
    let ran = run(
        &folder,
        &format!("animate {CUT_CUBE} --turntable -o out.mp4"),
    )
    .exits(2);
    for said in [
        "--output out.mp4",
        "not installed",
        "apt install ffmpeg",
        "help:",
        ".gif",
    ] {
        assert!(ran.stderr.contains(said), "no `{said}` in\n{}", ran.stderr);
    }
    assert!(folder.files().is_empty(), "{:?}", folder.files());
}

#[cfg(unix)]
#[test]
fn ffmpeg_is_given_every_pixel_of_every_frame() {
    let folder = Scratch::new("animate-ffmpeg");
    stand_in(
        &folder,
        "libx264",
        &format!("echo \"$@\" > told.txt; /bin/cat > raw.bin; {WHOLE} > \"$file\""),
    );
    let odd = CUT_CUBE.replace("64,48", "63,47");
    let ran = run(
        &folder,
        &format!("animate {odd} --turntable --frames 3 --fps 12.5 -o out.mp4"),
    )
    .exits(0);
    assert!(
        ran.stderr.contains("64 x 48"),
        "odd sizes are told of: {}",
        ran.stderr
    );
    let arguments = fs::read_to_string(folder.path("told.txt")).unwrap();
    for word in [
        "-video_size 64x48",
        "-framerate 12.5",
        "rgb24",
        "libx264",
        "yuv420p",
        "-f mp4",
    ] {
        assert!(arguments.contains(word), "no `{word}` in {arguments}");
    }
    assert_eq!(
        folder.files(),
        ["bin", "out.mp4", "raw.bin", "told.txt"],
        "in its place, and nothing beside it"
    );
    let raw = fs::read(folder.path("raw.bin")).unwrap();
    assert_eq!(raw.len(), 64 * 48 * 3 * 3);
    folder.run(&format!("render {odd} -o one.png")).exits(0);
    let one = super::reading::still(&folder.path("one.png"));
    for (x, y, pixel) in one.enumerate_pixels() {
        let at = (y * 64 + x) as usize * 3;
        assert_eq!(raw[at..at + 3], pixel.0[..3], "{x},{y} of the first frame");
    }
    let last_of = |x: usize| &raw[(10 * 64 + x) * 3..][..3];
    assert_eq!(last_of(63), last_of(62), "the border is continued");
}

#[cfg(unix)]
#[test]
fn an_ffmpeg_that_fails_is_quoted_and_leaves_what_was_there() {
    let folder = Scratch::new("animate-bad-ffmpeg");
    fs::create_dir_all(folder.path("bin")).unwrap();
    for (script, said) in [
        (
            "/bin/cat > /dev/null; echo half > \"$file\"; echo no such colour >&2; exit 3",
            "no such colour",
        ),
        ("echo I will not >&2; exit 1", "I will not"),
        ("/bin/cat > /dev/null", "it is empty"),
        (
            "/bin/cat > /dev/null; printf '\\0\\0\\0\\010ftyp\\0\\0\\0\\011mdat' > \"$file\"",
            "cannot be played",
        ),
    ] {
        stand_in(&folder, "mpeg4", script);
        folder.write("out.mp4", "old");
        let ran = run(
            &folder,
            &format!("animate {CUT_CUBE} --turntable --frames 30 --supersample 1 -o out.mp4"),
        )
        .exits(2);
        assert!(
            ran.stderr.contains(said) && ran.stderr.contains("help:"),
            "{script}: {}",
            ran.stderr
        );
        assert_eq!(folder.files(), ["bin", "out.mp4"], "{script}");
        assert_eq!(
            fs::read_to_string(folder.path("out.mp4")).unwrap(),
            "old",
            "{script}"
        );
    }
    stand_in(&folder, "flv", "exit 0");
    let ran = run(
        &folder,
        &format!("animate {CUT_CUBE} --turntable -o out.mp4"),
    )
    .exits(2);
    assert!(ran.stderr.contains("libx264"), "{}", ran.stderr);
}
