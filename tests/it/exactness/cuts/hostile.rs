//! What is said of cuts and reliefs beside the slips of `tests/it/scenes/hostile_scenes.rs`: gaps between images, offsets of nothing.

use super::Scratch;

const LAYERS: &str = r#"
[[part]]
name = "solid"
shape = "cube"
[[part]]
shape = "earth?subdivisions=1"
[relief.stack]
kind = "layers"
images = "a%d.png"
[[cut]]
name = "block"
offset = { solid = 0.1 }
surfaces = [{ section = "z=50%", relief = "stack" }]
"#;

#[test]
fn a_gap_between_images_is_told() {
    let folder = Scratch::new("gap");
    for number in [0, 1, 3] {
        let picture = image::GrayImage::new(2, 2);
        let path = folder.path(&format!("a{number}.png"));
        picture.save(path).expect("a picture");
    }
    let message = folder.load(LAYERS).expect_err("a gap").to_string();
    assert!(message.contains("frame 2, which is missing"), "{message}");
    // The control: without the gap it loads, and layers of two sizes do not.
    let path = folder.path("a2.png");
    image::GrayImage::new(2, 2).save(&path).expect("a picture");
    folder.scene(LAYERS);
    image::GrayImage::new(3, 2).save(&path).expect("a picture");
    let message = folder.load(LAYERS).expect_err("two sizes").to_string();
    assert!(message.contains("layer 2 has 3 x 2"), "{message}");
    // Images that are layers are no names to choose from.
    image::GrayImage::new(2, 2).save(&path).expect("a picture");
    let text = format!("{LAYERS}[relief.odd]\nkind = \"layers\"\nof = [\"qqqqq\"]\n");
    let message = folder.load(&text).expect_err("no such relief").to_string();
    assert!(message.contains("relief `qqqqq`"), "{message}");
    assert!(
        !message.contains(['\u{7f}']) && !message.contains(".png"),
        "{message}"
    );
}

#[test]
fn an_offset_of_no_part_of_the_cut_is_noted() {
    let folder = Scratch::new("offset-of-none");
    let notes = |offset: &str, rest: &str| {
        let text = LAYERS
            .replacen("solid = 0.1", offset, 1)
            .replace(", relief = \"stack\"", "");
        let text = text.replacen("[[cut]]\n", &format!("[[cut]]\n{rest}"), 1);
        let text = text.replace(
            "kind = \"layers\"\nimages = \"a%d.png\"",
            "kind = \"waves\"",
        );
        folder.timeline(&text).notes().to_vec()
    };
    for (offset, rest, noted) in [
        ("solid = 0.1, \"c*\" = 1", "", 0),
        ("solid = 0.1, \"q*\" = 1", "", 1),
        ("solid = 0.1, \"c*\" = 1", "except = [\"solid\"]\n", 1),
    ] {
        let notes = notes(offset, rest);
        let found = notes
            .iter()
            .filter(|n| n.to_string().contains("no part of the cut"))
            .count();
        assert_eq!(found, noted, "{offset}: {notes:?}");
    }
}
