//! Numbered pictures come one by one, are kept by the same command and drawn anew by any other, and Ctrl-C leaves whole files alone.

use std::fs;

use super::CUT_CUBE;
use super::command::Scratch;

fn kept(folder: &Scratch, line: &str) -> Vec<bool> {
    let json = folder.run(&format!("{line} --json -")).exits(0).json();
    let frames = json["frames"].as_array().unwrap();
    frames
        .iter()
        .map(|f| f["kept"].as_bool().unwrap())
        .collect()
}

#[test]
fn the_same_command_goes_on_where_it_stopped() {
    let folder = Scratch::new("animate-kept");
    folder.write(
        "a.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n",
    );
    let line =
        "animate a.obj --section z=50% --resolution 32,32 --turntable --frames 3 -o out/%d.png";
    assert_eq!(kept(&folder, line), [false; 3]);
    let first = fs::read(folder.path("out/2.png")).unwrap();
    assert_eq!(kept(&folder, line), [true; 3]);
    let ran = folder.run(line).exits(0);
    assert!(ran.stderr.contains("3 already existed"), "{}", ran.stderr);
    // One that is gone, one that is cut off, one of something else.
    fs::remove_file(folder.path("out/2.png")).unwrap();
    assert_eq!(kept(&folder, line), [true, false, true]);
    assert_eq!(fs::read(folder.path("out/2.png")).unwrap(), first);
    fs::write(folder.path("out/1.png"), &first[..first.len() / 2]).unwrap();
    fs::copy(folder.path("out/2.png"), folder.path("out/3.png")).unwrap();
    assert_eq!(kept(&folder, line), [false, true, false]);
    // Where results go says nothing of the frames; all else does.
    fs::rename(folder.path("out"), folder.path("moved")).unwrap();
    assert_eq!(kept(&folder, &line.replace("out/", "moved/")), [true; 3]);
    let other = line.replace("out/", "moved/").replace("50%", "40%");
    assert_eq!(kept(&folder, &other), [false; 3]);
    let text = fs::read_to_string(folder.path("a.obj")).unwrap();
    folder.write("a.obj", text.replace("v 1 0 0", "v 2 0 0"));
    assert_eq!(kept(&folder, &other), [false; 3], "another mesh");
}

#[cfg(unix)]
#[test]
fn an_interrupt_and_sigterm_leave_whole_files_alone() {
    use std::process::{Command, Stdio};
    use std::time::Duration;

    let folder = Scratch::new("animate-interrupt");
    for (output, signal) in [
        ("out/%04d.png", "-INT"),
        ("out/film.gif", "-INT"),
        ("out/film.gif", "-TERM"),
    ] {
        fs::create_dir_all(folder.path("out")).unwrap();
        let names = || {
            let entries = fs::read_dir(folder.path("out")).unwrap();
            let names = entries.map(|e| e.unwrap().file_name().to_string_lossy().into_owned());
            names.collect::<Vec<String>>()
        };
        let line = format!("animate {CUT_CUBE} --turntable --frames 80000 -o {output}");
        let mut child = folder.command(&line).stderr(Stdio::null()).spawn().unwrap();
        let mut waits = 0;
        // A film is one file, not in its place until it is whole; a folder that is read while a frame takes its place may show both
        // its names, so only whole frames are counted.
        let has_begun = || match output.contains('%') {
            true => names().iter().filter(|n| !n.starts_with('.')).count() >= 2,
            false => !names().is_empty(),
        };
        while !has_begun() {
            assert_eq!(child.try_wait().unwrap(), None, "{output}");
            waits += 1;
            assert!(waits < 6000, "no frame comes");
            std::thread::sleep(Duration::from_millis(20));
        }
        let pid = child.id().to_string();
        assert!(
            Command::new("kill")
                .args([signal, &pid])
                .status()
                .unwrap()
                .success()
        );
        let ended = child.wait().unwrap();
        assert_eq!(ended.code(), Some(130), "{output} {signal}: {ended}");
        let left = names();
        if output.contains('%') {
            assert!((2..80_000).contains(&left.len()), "{} frames", left.len());
            for name in &left {
                assert!(!name.starts_with('.'), "{name} stays behind");
                super::reading::still(&folder.path("out").join(name));
            }
        } else {
            assert!(left.is_empty(), "{left:?}");
        }
        fs::remove_dir_all(folder.path("out")).unwrap();
    }
}
