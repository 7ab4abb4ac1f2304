//! Styles as data: by name, by file, in scenes, with changes on top.

use cutaway_io::load::Assets;

use super::*;
use crate::common::command::Scratch;

const PART: &str = "[[part]]\nname = \"c\"\nshape = \"cube\"\n";

#[test]
fn a_scene_takes_a_style_and_changes_on_it() {
    let folder = Scratch::new("styles");
    folder.write(
        "mine.toml",
        "base = \"drafting\"\nink = \"#ff0000\"\n[strokes]\nface = 0\n",
    );
    let of = |text: &str| folder.scene(&format!("{text}\n{PART}")).style;
    assert_eq!(of(""), Style::default(), "lit is what the library draws");
    assert_eq!(of("style = \"toon\""), style("toon"));
    let changed = of("[style]\nbase = \"toon\"\n[style.strokes]\noutline = 9");
    assert_eq!(changed.strokes.outline, 9.0);
    assert_eq!(
        changed.strokes.cut,
        style("toon").strokes.cut,
        "the rest stays"
    );
    for text in ["style = \"mine.toml\"", "[style]\nbase = \"mine.toml\""] {
        let mine = of(text);
        assert_eq!(mine.ink.to_array(), [1.0, 0.0, 0.0], "{text}");
        assert_eq!(mine.strokes.face, 0.0, "{text}");
        assert_eq!(mine.paper, style("drafting").paper, "{text}");
    }
    let clear = of("style = \"toon\"\nbackground = \"transparent\"");
    assert_eq!(clear.paper, Paper::None);
}

#[test]
fn numbers_of_a_style_move() {
    let folder = Scratch::new("moving_styles");
    let text = format!(
        "{PART}[style]\nbase = \"toon\"\n[style.strokes]\noutline = 2\n\
         [[key]]\ntarget = \"style.strokes.outline\"\ntimes_s = [0, 1]\nvalues = [2, 4]\n"
    );
    let timeline = folder.timeline(&text);
    let at = |time_s| timeline.at(time_s).expect("a scene").style.strokes.outline;
    assert_eq!([at(0.0), at(0.5), at(1.0)], [2.0, 3.0, 4.0]);
}

#[test]
fn a_document_names_the_file_of_its_style_from_wherever_it_is() {
    let folder = Scratch::new("style_files");
    folder.write("mine.toml", "shading = \"clay\"\n");
    let path = folder.write("scene.toml", format!("style = \"mine.toml\"\n{PART}"));
    let document = cutaway_io::Document::read(&path).expect("a document");
    let moved = document
        .moved_to(&folder.path("below/scene.toml"))
        .expect("a document");
    assert!(
        moved.to_string().contains("style = \"../mine.toml\""),
        "{moved}"
    );
    let mut assets = Assets::default();
    let timeline = document.timeline(&mut assets).expect("a timeline");
    let named = timeline.files().any(|file| file.ends_with("mine.toml"));
    assert!(named, "the file is among those that were read");
}

#[test]
fn nonsense_names_its_place_and_what_helps() {
    let folder = Scratch::new("style_slips");
    folder.write("wrong.toml", "[strokes]\noutlien = 3\n");
    folder.write("bad.toml", "[strokes]\noutline = -3\n");
    for (text, said) in [
        (
            "style = \"tecnical\"",
            &["scene.toml:1", "`tecnical`", "technical"][..],
        ),
        (
            "style = \"wrong.toml\"",
            &["wrong.toml:2", "outlien", "outline"],
        ),
        ("style = \"bad.toml\"", &["bad.toml:2", "from 0 to 20"]),
        ("style = \"none.toml\"", &["none.toml", "cannot be read"]),
        ("[style]\nshading = \"calmer\"", &["scene.toml:2", "calm"]),
        (
            "[style.surface]\ncolor = \"#fff\"\nchroma = 0.1",
            &["one colour"],
        ),
        ("[style]\nstroke = 1", &["did you mean `strokes`"]),
        ("background = \"papers\"", &["papers"]),
    ] {
        let error = folder
            .load(&format!("{text}\n{PART}"))
            .expect_err(text)
            .to_string();
        for said in said {
            assert!(error.contains(said), "{text}: no `{said}` in\n{error}");
        }
        assert!(error.contains("help:"), "{text}: {error}");
    }
}

#[test]
fn patterns_are_named_or_come_from_files() {
    let folder = Scratch::new("patterns");
    folder.write(
        "mine.pat",
        "*OAK, mine\n0, 0,0, 1,2, 3,-1\n*PINE\n45, 0,0, 0,1\n",
    );
    folder.write("one.pat", "*ONE\n45, 0,0, 0,1\n");
    folder.write("bad.pat", "*ONE\n45, 0,0, 0\n");
    let scene = |hatch: &str| {
        format!(
            "style = \"drafting\"\n[[part]]\nshape = \"cube\"\nmaterial = {{ hatch = \"{hatch}\" }}\n\
             [[cut]]\nsurfaces = [{{ section = \"-z=50%\" }}]\n"
        )
    };
    let mut session = session();
    let mut pictures = Vec::new();
    for hatch in [
        "general",
        "none",
        "solid",
        "steel",
        "mine.pat#oak",
        "one.pat",
    ] {
        let scene = folder.scene(&scene(hatch));
        let method = Method::from(Strategy::RAYCAST_MASK);
        pictures.push((hatch, picture_of(&mut session, &scene, method)));
    }
    for (i, (hatch, picture)) in pictures.iter().enumerate() {
        for (other, theirs) in &pictures[..i] {
            // Lines at 45 degrees are what is general.
            let alike = (*hatch, *other) == ("one.pat", "general");
            assert_eq!(picture == theirs, alike, "{hatch} and {other}");
        }
    }
    for (hatch, said) in [
        ("steal", &["\"steal\" is not a hatch", "steel"][..]),
        ("mine.pat#OKA", &["no pattern `OKA`", "OAK"]),
        ("mine.pat", &["2 patterns", "mine.pat#OAK"]),
        ("bad.pat", &["bad.pat", "line 2"]),
        ("none.pat", &["none.pat"]),
    ] {
        let error = folder.load(&scene(hatch)).expect_err(hatch).to_string();
        for said in said {
            assert!(error.contains(said), "{hatch}: no `{said}` in\n{error}");
        }
        assert!(error.contains("help:"), "{hatch}: {error}");
    }
}

#[test]
fn the_command_draws_technically_unless_it_is_told_otherwise() {
    let folder = Scratch::new("style_command");
    let base = "render shape:cube --section z=50% --resolution 96,72";
    let drawn = |name: &str, options: &str| {
        folder
            .run(&format!("{base} {options} -o {name}.png"))
            .exits(0);
        let image = image::open(folder.path(&format!("{name}.png"))).expect("a picture");
        image.to_rgba8().into_raw()
    };
    let usual = drawn("usual", "");
    assert!(
        usual == drawn("technical", "--style technical"),
        "the usual style"
    );
    assert!(usual != drawn("lit", "--style lit"), "lit is another");
    assert_eq!(usual[..4], [255; 4], "the paper of technical");
    let clear = drawn("clear", "--background none");
    assert!(
        clear == drawn("clearer", "--no-background"),
        "two names of one thing"
    );
    assert_eq!(clear[3], 0, "nothing in the corner");
    assert_eq!(drawn("red", "--background=#ff0000")[..4], [255, 0, 0, 255]);
    folder
        .run(&format!("{base} --style tehcnical -o x.png"))
        .must_refuse(&["technical"]);
    folder
        .run(&format!("{base} --background reddish -o x.png"))
        .must_refuse(&["#rrggbb"]);
}
