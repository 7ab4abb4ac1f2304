//! What shells and the manual are given.

use std::process::Command;

use crate::command::cli::command::Scratch;

#[test]
fn a_shell_completes_commands_and_options() {
    let folder = Scratch::new("completions");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let ran = folder.run(&format!("completions {shell}")).exits(0);
        let script = ran.text();
        let has = |word: &str| script.contains(word);
        assert!(
            has("render") && has("section") && has("supersample"),
            "{shell}"
        );
        assert!(!has("no-such-option"), "{shell}");
    }
    // Bash itself, where it is there: what a user gets who types so far and presses Tab.
    let ran = folder.run("completions bash").exits(0);
    folder.write("cutaway.bash", ran.text());
    let ask = "source cutaway.bash; COMP_WORDS=(cutaway render --supers); COMP_CWORD=2; _cutaway cutaway --supers render; echo \"${COMPREPLY[@]}\"";
    let asked = Command::new("bash")
        .arg("-c")
        .arg(ask)
        .current_dir(folder.path(""))
        .output();
    if let Ok(asked) = asked {
        assert_eq!(
            String::from_utf8_lossy(&asked.stdout).trim(),
            "--supersample"
        );
    }
    let refused = folder.run("completions tcsh").exits(2).stderr;
    assert!(refused.contains("bash"), "{refused}");
}

#[test]
fn each_command_has_a_page_of_the_manual() {
    let folder = Scratch::new("man");
    folder.run("man man1").exits(0);
    for (page, word) in [
        ("cutaway", "cutaway\\-section"),
        ("cutaway-render", "supersample"),
        ("cutaway-measure", "EXPERIMENT"),
    ] {
        let text = std::fs::read_to_string(folder.path(&format!("man1/{page}.1"))).unwrap();
        assert!(text.contains(".TH ") && text.contains(word), "{page}");
    }
    folder.write("file", "");
    let refused = folder.run("man file/man1").exits(2).stderr;
    assert!(
        refused.contains("file/man1") && refused.contains("help:"),
        "{refused}"
    );
}
