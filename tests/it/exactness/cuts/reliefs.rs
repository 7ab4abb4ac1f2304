//! Heights of one and three dimensions, as scene files give them.

use std::sync::Arc;

use cutaway::scene::{OffsetMap, Scene, Wrap};

use super::{Scratch, at};

const PART: &str = "[[part]]\nname = \"solid\"\nshape = \"cube\"\n";

fn cut_by(relief: &str) -> String {
    format!(
        "{PART}[[cut]]\nname = \"front\"\nsurfaces = [{{ section = \"-z=50%\", relief = \"{relief}\" }}]\n"
    )
}

fn map(scene: &Scene) -> Arc<OffsetMap> {
    let relief = &scene.cuts[0].surfaces[0].relief;
    Arc::clone(relief.as_ref().expect("a relief"))
}

#[test]
fn a_profile_is_one_row_of_heights() {
    let folder = Scratch::new("profile");
    let text = "[relief.steps]\nkind = \"profile\"\nheights = [0, 0.25, 1, -2]\n".to_owned();
    let map = map(&folder.scene(&(text + &cut_by("steps"))));
    assert_eq!(map.size(), [4, 1]);
    assert_eq!(map.texels(), [0.0, 0.25, 1.0, -2.0]);
    // It is the same all along V.
    for x in [0.1, 0.4, 0.77] {
        let height = |y: f64| map.sample(Wrap::Repeat, glam::DVec2::new(x, y)).0;
        assert_eq!(height(0.2), height(0.9), "at {x}");
    }
    let [a, b] = [0.125, 0.375].map(|x| map.sample(Wrap::Repeat, glam::DVec2::new(x, 0.3)).0);
    assert_eq!([a, b], [0.0, 0.25], "texels are met at their centres");
}

#[test]
fn layers_are_met_at_whole_numbers_and_mixed_between() {
    let folder = Scratch::new("layers");
    let layer = |name: &str, value: f64| {
        format!(
            "[relief.{name}]\nkind = \"profile\"\nheights = [{value:?}, {:?}]\n",
            value * 3.0
        )
    };
    let text = |at: &str, wrap: &str| {
        let stack = format!(
            "[relief.stack]\nkind = \"layers\"\nof = [\"a\", \"b\", \"c\"]\n{at}\n{wrap}\n"
        );
        layer("a", 1.0) + &layer("b", 2.0) + &layer("c", 4.0) + &stack + &cut_by("stack")
    };
    for (at, wrap, height) in [
        ("", "", 1.0),
        ("at = 1", "", 2.0),
        ("at = 1.25", "", 2.5),
        ("at = 2.5", "", 2.5),
        ("at = 2.5", "wrap = \"clamp\"", 4.0),
        ("at = 3.25", "wrap = \"mirror\"", 3.5),
        ("at = -0.25", "wrap = \"repeat\"", 1.75),
    ] {
        let found = map(&folder.scene(&text(at, wrap)));
        assert_eq!(found.texels(), [height, height * 3.0], "{at} {wrap}");
    }
}

#[test]
fn layers_may_be_images() {
    let folder = Scratch::new("images");
    for (number, grey) in [(1, 0_u8), (2, 51), (3, 255)] {
        let name = folder.path(&format!("h_{number:03}.png"));
        let picture =
            image::GrayImage::from_raw(2, 2, vec![grey; 3].into_iter().chain([0]).collect());
        picture.expect("4 texels").save(name).expect("a picture");
    }
    let text = |line: &str| {
        format!(
            "[relief.stack]\nkind = \"layers\"\nimages = \"h_%03d.png\"\nat = 0.0\n{line}\n{}",
            cut_by("stack")
        )
    };
    let keys = "[[key]]\ntarget = \"relief.stack.at\"\ntimes_s = [0, 2]\nvalues = [0, 2]\n";
    let timeline = folder.timeline(&(text("") + keys));
    for (time_s, height) in [(0.0, 0.0), (0.5, 0.1), (1.0, 0.2), (1.5, 0.6), (2.0, 1.0)] {
        let found = map(&at(&timeline, time_s));
        let off = (f64::from(found.texels()[0]) - height).abs();
        assert!(off < 1e-7, "{} at {time_s} s", found.texels()[0]);
    }
    // The same time gives the same object, and whole layers are those that were read.
    let [a, b] = [1.0, 1.0].map(|t| map(&at(&timeline, t)));
    assert!(Arc::ptr_eq(&a, &b), "a layer was read again");
    let later = folder.scene(&text("first = 2"));
    assert_eq!(
        map(&later).texels()[0],
        0.2,
        "the first layer is that of the first number"
    );
    // Images are read when the file is, and never again.
    for number in 1..=3 {
        std::fs::remove_file(folder.path(&format!("h_{number:03}.png"))).expect("the picture");
    }
    assert_eq!(map(&at(&timeline, 1.0)).texels(), a.texels());
}

#[test]
fn what_does_not_move_stays_the_same_object() {
    let folder = Scratch::new("same");
    let text = "[relief.a]\nkind = \"fractal\"\nsize = 16\ngain = 0.5\n[relief.b]\nkind = \"waves\"\nsize = 16\n\
                [relief.stack]\nkind = \"layers\"\nof = [\"a\", \"b\"]\nat = 0.5\n";
    let still = "[[part]]\nname = \"solid\"\nshape = \"cube\"\n\
                 [[cut]]\nname = \"front\"\nsurfaces = [{ section = \"-z=50%\", relief = \"stack\" }, \
                 { section = \"-x=50%\", relief = \"b\" }]\n";
    let key = |target: &str, values: &str| {
        format!("[[key]]\ntarget = \"{target}\"\ntimes_s = [0, 1]\nvalues = {values}\n")
    };
    for (key, moves) in [
        (key("cut.front.surfaces.0.amplitude", "[0.1, 0.2]"), false),
        (key("relief.stack.at", "[0.25, 0.75]"), true),
        (key("relief.a.gain", "[0.25, 0.75]"), true),
    ] {
        let still = still.replace("relief = \"stack\"", "relief = \"stack\", amplitude = 0.1");
        let timeline = folder.timeline(&format!("{text}{still}{key}"));
        let [first, later] = [0.2, 0.8].map(|t| at(&timeline, t));
        let same = |i: usize| {
            let [a, b] = [&first, &later].map(|s| s.cuts[0].surfaces[i].relief.clone());
            Arc::ptr_eq(&a.expect("a relief"), &b.expect("a relief"))
        };
        assert_eq!(same(0), !moves, "{key}");
        assert!(same(1), "{key}: the layer that nobody moves");
    }
}
