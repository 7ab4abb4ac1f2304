//! `--save`: what a command line amounts to, as a file that draws the same picture.

use std::collections::BTreeSet;
use std::fs;

use cutaway_io::document::Document;

use crate::command::cli::command::Scratch;
use crate::common::shares::{Share, in_shares};
use crate::common::{root, some};

/// A cube.
const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n\
    f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

/// Options that say something of the scene, and whether a value follows them after a space.
const OF_SCENE: [(&str, bool); 31] = [
    ("--section", true),
    ("--relief", true),
    ("--flip", false),
    ("--ghost", false),
    ("--shadow", false),
    ("--cutout", false),
    ("--breakaway", false),
    ("--box", true),
    ("--wedge", true),
    ("--cut", true),
    ("--cutter", true),
    ("--exclude", true),
    ("--split", false),
    ("--defect", true),
    ("--fill", true),
    ("--interference", false),
    ("--camera-position", true),
    ("--camera-focal-point", true),
    ("--camera-view-up", true),
    ("--camera-azimuth-angle", true),
    ("--camera-elevation-angle", true),
    ("--camera-orthographic", false),
    ("--camera-zoom-factor", true),
    ("--up", true),
    ("--set", true),
    ("--time", true),
    ("--clip", true),
    ("--strategy", true),
    ("--rasteriser", true),
    ("--height-filter", true),
    ("--no-background", false),
];

/// Lines that the texts for users do not have.
const MORE: &[&str] = &[
    "shape:gears shape:cube shape:cube --section -x=50% --section z=30% --cut intersection",
    "shape:gears --section z=50% --flip --relief waves:amplitude=3%,size=32x16 --exclude gear*2 --camera-azimuth-angle 12.5",
    "shape:cube --box 50%,0,25%: --wedge -y:-30:200@0,50%,0 --cut intersection --up +Z",
    "shape:sphere --wedge z:0:270 --camera-orthographic --camera-zoom-factor 1.5",
    "shape:sphere?subdivisions=3 --cutter shape:cube --camera-position 3,2,1 --camera-view-up 0,0,1",
    "shape:crank?detail=16 --section z=40% --defect holes:amount=5%,seed=3 --defect flipped --fill nonzero",
    "shape:shells --section 1,1,0.5@50%,50%,50% --strategy planar --no-background",
    "bracket.stl shape:shells --split --section x=50%",
    "bracket.stl maps/../bracket.stl --section x=50% --relief maps/rock.png:wrap=mirror,amplitude=0.1",
    "shape:earth --breakaway=2% --roles interior=core",
    "shape:engine?detail=16 --cutout=axis=x,angle_deg=90 --breakaway=view=first --roles whole=bolt* --roles interior=crank",
    "walk_%d.obj --section x=50% --time 0.05",
    "shape:sphere --section z=0.1 --rasteriser compute --interference=#00ff00 --set part.0.material.color=#fa0",
    "scene.toml --section x=0.2 --relief fractal --set cut.front.enabled=false --exclude solid",
    "scene.toml --camera-azimuth-angle 20 --defect soup:amount=0.5%",
    "below/scene.toml --box :50%,50%,50%",
];

/// The words of a command line that say something of the scene, its first word being what the command is about.
fn of_scene(line: &str) -> Option<String> {
    let line = line.split(" #").next().unwrap_or(line);
    let line = line.split(" | ").next().unwrap_or(line);
    let mut words = line.split_whitespace().map(|w| w.trim_matches('\''));
    let mut kept: Vec<&str> = Vec::new();
    while let Some(word) = words.next() {
        let (option, value) = word.split_once('=').unwrap_or((word, ""));
        let known = OF_SCENE.iter().find(|(name, _)| *name == option);
        match known {
            Some((_, takes_value)) => {
                kept.push(word);
                kept.extend(
                    (value.is_empty() && *takes_value)
                        .then(|| words.next())
                        .flatten(),
                );
            }
            // Options of other things all have a value, or stand last.
            None if word.starts_with('-') => {
                if value.is_empty()
                    && !["--turntable", "--json", "--verbose", "--whole"].contains(&word)
                {
                    words.next();
                }
            }
            // A report's file stands after an option that need not have one.
            None if word.ends_with(".json") => {}
            None => kept.push(word),
        }
    }
    (!kept.is_empty()).then(|| kept.join(" "))
}

/// All command lines about a scene that a text shows to users.
fn lines(text: &str) -> Vec<String> {
    let commands = ["render", "compare", "animate", "plan", "section", "inspect"];
    let of_command = |line: &str| {
        let rest = line.trim_start().strip_prefix("cutaway ")?.trim_start();
        let (command, rest) = rest.split_once(' ')?;
        commands
            .contains(&command)
            .then(|| of_scene(rest))
            .flatten()
    };
    text.lines().filter_map(of_command).collect()
}

/// Files under all names that the lines have.
fn fill(folder: &Scratch) {
    let root = root();
    for name in ["bracket", "part", "scan", "engine", "walk_0", "walk_1"] {
        folder.write(&format!("{name}.obj"), CUBE);
    }
    // One body within another.
    let vertices = CUBE.lines().filter(|l| l.starts_with('v'));
    let smaller = vertices.map(|line| {
        let numbers = line
            .split(' ')
            .skip(1)
            .map(|x| x.parse::<f64>().unwrap() * 0.5 + 0.25);
        let numbers = numbers.map(|x| x.to_string()).collect::<Vec<_>>();
        format!("v {}\n", numbers.join(" "))
    });
    let faces = CUBE.lines().filter(|l| l.starts_with('f')).map(|line| {
        let numbers = line
            .split(' ')
            .skip(1)
            .map(|i| i.parse::<i64>().unwrap() + 8);
        let numbers = numbers.map(|i| i.to_string()).collect::<Vec<_>>();
        format!("f {}\n", numbers.join(" "))
    });
    let inner: String = smaller.chain(faces).collect();
    folder.write("gearbox.obj", format!("o housing\n{CUBE}o gear\n{inner}"));
    fs::create_dir_all(folder.path("maps")).unwrap();
    fs::create_dir_all(folder.path("below")).unwrap();
    let rock = image::GrayImage::from_fn(16, 16, |x, y| image::Luma([(x * y) as u8]));
    rock.save(folder.path("maps/rock.png")).unwrap();
    rock.save(folder.path("rock.png")).unwrap();
    let scene = "# Kept.\n[[part]]\nname = \"solid\"\nmesh = \"MESH\" # the solid\n\n[[part]]\nname = \"bar\"\nshape = \"cube\"\n\n[[cut]]\nname = \"front\"\nsurfaces = [{ section = \"-z=50%\" }]\n";
    for name in ["scene.toml", "bracket.toml"] {
        folder.write(name, scene.replace("MESH", "bracket.obj"));
    }
    folder.write("below/scene.toml", scene.replace("MESH", "../part.obj"));
    for name in ["experiments/scenes", "experiments/hard-cases"] {
        let scenes = folder.path(name);
        fs::create_dir_all(&scenes).unwrap();
        for entry in fs::read_dir(root.join(name)).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                fs::copy(&path, scenes.join(path.file_name().unwrap())).unwrap();
            }
        }
    }
}

/// The same line with files that are there; of an animated model what moves is left out.
fn with_files(line: &str) -> String {
    let words = line.split(' ').map(|word| {
        let stem = word.strip_suffix(".stl").or(word.strip_suffix(".ply"));
        match stem.or(word.strip_suffix(".glb")) {
            Some(stem) => format!("{}.obj", stem.replace("walk", "part")),
            None => word.to_owned(),
        }
    });
    let line = words.collect::<Vec<_>>().join(" ");
    line.replace(" --clip run", "")
}

in_shares!(what_is_saved_draws_the_same_picture_to_the_bit, 8);

fn what_is_saved_draws_the_same_picture_to_the_bit(share: Share) {
    let folder = Scratch::new("saved");
    fill(&folder);
    let root = root();
    let mut all: Vec<String> = MORE.iter().map(|l| (*l).to_owned()).collect();
    for file in [
        "README.md",
        "experiments/README.md",
        "docs/scenes.md",
        "docs/sections.md",
        "docs/styles.md",
        "docs/cutaways.md",
        "docs/animation.md",
    ] {
        all.extend(lines(&fs::read_to_string(root.join(file)).unwrap()));
    }
    for scene in ["bitten-crank", "earth-shells", "twisting-knot"] {
        let name = format!("experiments/scenes/{scene}.toml");
        let text = fs::read_to_string(root.join(&name)).unwrap();
        all.extend(lines(&text.replace("#   ", "")));
    }
    for command in ["render", "compare", "animate", "section", "plan"] {
        all.extend(lines(
            folder.run(&format!("{command} --help")).exits(0).text(),
        ));
    }
    let of_texts = all.split_off(MORE.len());
    let of_texts: BTreeSet<String> = of_texts.into_iter().collect();
    assert!(of_texts.len() > 35, "{of_texts:#?}");
    for line in share.part(all.into_iter().chain(some(of_texts.into_iter(), 3))) {
        let line = with_files(&line);
        let small = "--resolution 48,36 --supersample 1 --quiet";
        let saving = format!("render {line} {small} -o first.png --save saved/scene.toml --force");
        folder.run(&saving).exits(0);
        folder
            .run("render saved/scene.toml --quiet -o again.png")
            .exits(0);
        let [first, again] = ["first.png", "again.png"].map(|f| fs::read(folder.path(f)).unwrap());
        let saved = fs::read_to_string(folder.path("saved/scene.toml")).unwrap();
        assert!(first == again, "{line} is not drawn again by\n{saved}");
    }
}

#[test]
fn a_scene_keeps_its_comments_and_takes_options_on_top() {
    let folder = Scratch::new("on-top");
    fill(&folder);
    let line = "inspect scene.toml --set part.bar.scale=2 --save other.toml";
    folder.run(line).exits(0);
    let before = fs::read_to_string(folder.path("scene.toml")).unwrap();
    let after = fs::read_to_string(folder.path("other.toml")).unwrap();
    assert_eq!(after, before.replace("\"cube\"\n", "\"cube\"\nscale = 2\n"));
    let line = "render scene.toml --section x=50% --relief fractal:seed=3 --camera-azimuth-angle 5 -o a.png --save b.toml";
    folder.run(line).exits(0);
    let saved = fs::read_to_string(folder.path("b.toml")).unwrap();
    assert!(saved.starts_with(before.trim_end()), "{saved}");
    let document = Document::parse("b.toml", &saved).unwrap();
    for (path, value) in [
        ("cut.front.surfaces.0.section", "\"-z=50%\""),
        ("cut.x=50%.surfaces.0.relief", "\"fractal\""),
        ("relief.fractal.seed", "3"),
        ("camera.azimuth_deg", "5"),
        ("camera.elevation_deg", "\"auto\""),
    ] {
        let found = &document.get(path).unwrap().value;
        assert_eq!(*found, cutaway_io::document::Value::read(value), "{path}");
    }
}

#[test]
fn a_scene_that_is_read_is_replaced_by_force_alone() {
    let folder = Scratch::new("force");
    fill(&folder);
    let before = fs::read_to_string(folder.path("scene.toml")).unwrap();
    for place in ["scene.toml", "./below/../scene.toml"] {
        let line = format!("inspect scene.toml --set part.bar.scale=2 --save {place}");
        let ran = folder.run(&line).exits(2);
        assert!(ran.stderr.contains("--force"), "{}", ran.stderr);
        assert_eq!(
            fs::read_to_string(folder.path("scene.toml")).unwrap(),
            before
        );
    }
    for (line, phrase) in [
        ("render scene.toml -o a.png --save bracket.obj", ".toml"),
        ("render scene.toml -o a.png --save -", "saved to a file"),
        ("render scene.toml -o a.png --save a.png", ".toml"),
        ("render scene.toml -o a.png --force", "--save"),
        (
            "render scene.toml -o a.png --set part.bar.scale=no --save b.toml",
            "part.bar.scale",
        ),
        (
            "render scene.toml -o a.png --json b.toml --save b.toml",
            "the file of",
        ),
        (
            "render below/scene.toml -o a.png --save nowhere/at/all/b.toml --set cut.x.y=1",
            "cut `x`",
        ),
    ] {
        let ran = folder.run(line).exits(2);
        assert!(ran.stderr.contains(phrase), "{line}: {}", ran.stderr);
        assert!(
            ran.stderr.contains("help:") || phrase == "--save",
            "{}",
            ran.stderr
        );
        for file in ["a.png", "b.toml"] {
            assert!(!folder.path(file).exists(), "{line} leaves {file}");
        }
    }
    let line = "inspect scene.toml --set part.bar.scale=2 --save scene.toml --force";
    folder.run(line).exits(0);
    let after = fs::read_to_string(folder.path("scene.toml")).unwrap();
    assert_ne!(after, before);
    assert!(after.contains("# the solid"), "{after}");
}
