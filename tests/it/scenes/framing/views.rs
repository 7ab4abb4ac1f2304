//! Directions by their names, straight views of sections, and pictures that are moved.

use cutaway::scene::{Prepared, View};
use cutaway_io::document::Document;
use cutaway_io::load::Assets;
use glam::{DVec2, DVec3};

const SIZE: [u32; 2] = [240, 180];

fn resolved(text: &str) -> cutaway::Result<View> {
    let document = Document::parse("scene.toml", text)?;
    let scene = document.resolve(0.0, &mut Assets::default())?;
    Ok(Prepared::new(&scene).view(SIZE))
}

fn view(camera: &str, cuts: &str) -> View {
    let text = format!("[camera]\n{camera}\n[[part]]\nname = \"solid\"\nshape = \"crank\"\n{cuts}");
    resolved(&text).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn named_views_look_along_the_axes() {
    for (name, up, forward, right) in [
        ("front", "+Y", DVec3::NEG_Z, DVec3::X),
        ("back", "+Y", DVec3::Z, DVec3::NEG_X),
        ("left", "+Y", DVec3::X, DVec3::Z),
        ("right", "+Y", DVec3::NEG_X, DVec3::NEG_Z),
        ("top", "+Y", DVec3::NEG_Y, DVec3::X),
        ("bottom", "+Y", DVec3::Y, DVec3::X),
        ("front", "+Z", DVec3::Y, DVec3::X),
        ("back", "+Z", DVec3::NEG_Y, DVec3::NEG_X),
        ("left", "+Z", DVec3::X, DVec3::NEG_Y),
        ("right", "+Z", DVec3::NEG_X, DVec3::Y),
        ("top", "+Z", DVec3::NEG_Z, DVec3::X),
        ("bottom", "+Z", DVec3::Z, DVec3::X),
    ] {
        let view = view(&format!("view = \"{name}\"\nup = \"{up}\""), "");
        let off = (view.forward - forward).length() + (view.right - right).length();
        assert!(
            off < 1e-9,
            "{name}, {up}: {} and {}",
            view.forward,
            view.right
        );
    }
    for up in ["+Y", "+Z"] {
        let iso = view(&format!("view = \"iso\"\nup = \"{up}\""), "");
        let spread = iso.forward.abs() - iso.forward.abs().element_sum() / 3.0;
        assert!(spread.abs().max_element() < 1e-9, "{up}: {}", iso.forward);
    }
}

#[test]
fn cut_looks_straight_at_the_first_section() {
    for section in [
        "z=50%",
        "-x=20%",
        "y=40%",
        "1,2,3@50%,50%,50%",
        "-3,1,0.5,0.1",
    ] {
        let cuts = format!(
            "[[cut]]\nsurfaces = [{{ section = \"{section}\" }}]\n[[cut]]\nsurfaces = [{{ section = \"x=1%\" }}]"
        );
        for projection in ["perspective", "orthographic"] {
            for up in ["+Y", "+Z"] {
                let camera =
                    format!("view = \"cut\"\nprojection = \"{projection}\"\nup = \"{up}\"");
                let text = format!("[camera]\n{camera}\n[[part]]\nshape = \"crank\"\n{cuts}");
                let document = Document::parse("scene.toml", &text).expect("a scene");
                let scene = document
                    .resolve(0.0, &mut Assets::default())
                    .expect("a scene");
                let normal = scene.cuts[0].surfaces[0].frame().normal;
                let view = Prepared::new(&scene).view(SIZE);
                assert!(
                    (view.forward - normal).length() < 1e-9,
                    "{section}: {}",
                    view.forward
                );
                let axis = if up == "+Y" { DVec3::Y } else { DVec3::Z };
                let is_level = normal.dot(axis).abs() > 0.84;
                assert!(
                    is_level || view.up.dot(axis) > 0.5,
                    "{section}, {up}: {}",
                    view.up
                );
            }
        }
    }
}

#[test]
fn views_that_make_no_sense_are_refused() {
    for (camera, said) in [
        ("view = \"frnt\"", &["camera.view", "`front`"][..]),
        (
            "view = \"front\"\nazimuth_deg = 3",
            &["azimuth_deg", "given by `view`"],
        ),
        (
            "view = \"top\"\nposition = [0, 0, 5]",
            &["position", "given by `view`"],
        ),
        ("view = \"cut\"", &["camera.view", "no plane to look at"]),
        ("pan = [11, 0]", &["camera.pan", "from -10 to 10"]),
        ("pan = 3", &["camera.pan"]),
    ] {
        let text = format!("[camera]\n{camera}\n[[part]]\nshape = \"cube\"\n");
        let error = resolved(&text).expect_err(camera).to_string();
        for said in said {
            assert!(error.contains(said), "{camera}: no `{said}` in\n{error}");
        }
        assert!(error.contains("help:"), "{camera}: {error}");
    }
}

#[test]
fn a_pan_moves_the_picture_and_nothing_in_it() {
    for place in [
        "azimuth_deg = 35\nelevation_deg = 25",
        "position = [3, 2, 4]",
        "view = \"iso\"\nfit = \"kept\"",
    ] {
        for projection in ["perspective", "orthographic"] {
            let camera = format!("{place}\nprojection = \"{projection}\"\n");
            let still = view(&camera, "");
            let moved = view(&format!("{camera}pan = [0.25, -0.1]"), "");
            assert_eq!((still.eye, still.forward), (moved.eye, moved.forward));
            for point in [DVec3::ZERO, DVec3::new(0.3, -0.2, 0.4)] {
                let [(a, depth), (b, as_deep)] = [still, moved].map(|v| v.project(point));
                assert!(
                    (b - a - DVec2::new(45.0, 18.0)).length() < 1e-9,
                    "{a} to {b}"
                );
                assert_eq!(depth, as_deep, "what hides what stays");
            }
        }
    }
}

#[test]
fn a_pan_moves_by_keys() {
    let text = "[camera]\nazimuth_deg = 10\npan = [0, 0]\n[[part]]\nshape = \"cube\"\n[[key]]\ntarget = \"camera.pan\"\n\
                times_s = [0, 1]\nvalues = [[0, 0], [0.5, 0]]\n";
    let document = Document::parse("scene.toml", text).expect("a scene");
    let at = |time_s: f64| {
        let scene = document
            .resolve(time_s, &mut Assets::default())
            .expect("a scene");
        Prepared::new(&scene).view(SIZE).centre_px
    };
    assert_eq!([0.0, 0.5, 1.0].map(|t| at(t).x), [120.0, 165.0, 210.0]);
}
