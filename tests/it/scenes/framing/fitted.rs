//! One picture, by the reference, of shapes and cuts of every kind.

use cutaway::scene::{Camera, Fit, Prepared, Projection, Scene, Viewpoint};
use cutaway_io::document::Document;
use cutaway_io::load::Assets;
use cutaway_lab::exact::evaluate;

use super::{margins_of, misfit};

const SIZES: [[u32; 2]; 3] = [[240, 180], [320, 120], [120, 260]];

/// Two thirds of the height that the reliefs here have in the pictures: by less it may be that they rise nowhere where it would show.
const ROUGH_PX: f64 = 8.0;

fn scene(text: &str) -> Scene {
    let document = Document::parse("scene.toml", text).expect(text);
    let mut assets = Assets::default();
    document.resolve(0.0, &mut assets).expect(text)
}

/// Margins of the scene through a camera.
fn seen(prepared: &Prepared, camera: &Camera, size_px: [u32; 2]) -> [f64; 4] {
    let view = prepared.view_of(camera, size_px);
    margins_of(&evaluate(prepared, &view).layers).expect("something is kept")
}

fn orbits() -> Vec<Camera> {
    let directions = [(35.0, 25.0), (-120.0, -40.0), (0.0, 90.0)];
    let projections = [
        Projection::Perspective { fov_y_deg: 30.0 },
        Projection::Perspective { fov_y_deg: 45.0 },
        Projection::Orthographic { height: None },
    ];
    let all = directions
        .into_iter()
        .flat_map(|d| projections.map(|p| (d, p)));
    all.map(|((azimuth_deg, elevation_deg), projection)| Camera {
        viewpoint: Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        },
        projection,
        fit: Fit::Kept,
        ..Camera::default()
    })
    .collect()
}

/// Every camera and size shows it fitted, and that of all does not.
#[track_caller]
fn fits(text: &str, within_px: f64) {
    let mut scene = scene(text);
    scene.camera.fit = Fit::Kept;
    let prepared = Prepared::new(&scene);
    let mut misfits_of_all = 0;
    for (i, camera) in orbits().into_iter().enumerate() {
        let size_px = SIZES[i % SIZES.len()];
        let wrong = misfit(seen(&prepared, &camera, size_px), size_px, within_px);
        assert_eq!(wrong, None, "{text}: {camera:?}, {size_px:?}");
        let of_all = Camera {
            fit: Fit::All,
            ..camera
        };
        let wrong = misfit(seen(&prepared, &of_all, size_px), size_px, within_px);
        misfits_of_all += usize::from(wrong.is_some());
    }
    assert!(
        misfits_of_all > 5,
        "{text}: the control fits too: {misfits_of_all}"
    );
}

fn shaped(shape: &str, cut: &str) -> String {
    format!("[[part]]\nname = \"solid\"\nshape = \"{shape}\"\n{cut}")
}

/// Each section a cut of its own.
fn cuts(sections: &[&str]) -> String {
    let cut = |s: &&str| format!("[[cut]]\nname = \"{s}\"\nsurfaces = [{{ section = \"{s}\" }}]\n");
    sections.iter().map(cut).collect()
}

#[test]
fn what_planes_keep_is_fitted_to_the_pixel() {
    for (shape, sections) in [
        ("crank", &["-z=50%"][..]),
        ("gears", &["x=70%"]),
        ("torus", &["1,2,-1@50%,50%,50%"]),
        ("sphere", &["x=20%", "-z=40%"]),
        // All corners of what is kept lie within faces and within the solid.
        ("cube", &["x=60%", "y=70%", "z=30%"]),
        (
            "cube",
            &[
                "1,1,1@60%,60%,60%",
                "1,-1,0@50%,50%,50%",
                "0,1,-1@50%,50%,40%",
            ],
        ),
        ("knot", &["y=50%", "-y=60%"]),
    ] {
        fits(&shaped(shape, &cuts(sections)), 1.0);
    }
}

#[test]
fn what_boxes_wedges_and_spared_parts_keep_is_fitted_to_the_pixel() {
    for cut in [
        "[[cut]]\nsurfaces = [{ section = \"x=30%\" }, { section = \"y=40%\" }]\n[[cut]]\nsurfaces = [{ section = \"z=57%\" }]\n",
        "[[cut]]\nwedge = { axis = \"z\", from_deg = 0, to_deg = 200 }\n",
        "[[cut]]\nbox = { min = [\"20%\", \"-10%\", \"-10%\"] }\n",
    ] {
        fits(&shaped("crank", cut), 1.0);
    }
    let spared = "[[part]]\nname = \"solid\"\nshape = \"cube\"\n[[part]]\nname = \"core\"\nshape = \"sphere\"\ntranslate = [0.4, 0, 0]\n\
                  role = \"interior\"\n[[cut]]\nsurfaces = [{ section = \"-x=10%\" }]\n";
    fits(spared, 1.0);
    let offset = "[[part]]\nname = \"solid\"\nshape = \"cube\"\n[[cut]]\nsurfaces = [{ section = \"-x=20%\" }]\noffset = { solid = \"5%\" }\n";
    fits(offset, 1.0);
}

#[test]
fn what_reliefs_and_cutters_keep_is_fitted_nearly() {
    let relief = "[relief.rock]\nkind = \"fractal\"\nseed = 3\n";
    for sections in [&["-z=50%"][..], &["x=40%", "-z=40%"]] {
        let cut = |s: &&str| {
            format!(
                "[[cut]]\nsurfaces = [{{ section = \"{s}\", relief = \"rock\", amplitude = \"4%\" }}]\n"
            )
        };
        let cuts: String = sections.iter().map(cut).collect();
        fits(&shaped("crank", &format!("{relief}{cuts}")), ROUGH_PX);
        fits(&shaped("sphere", &format!("{relief}{cuts}")), ROUGH_PX);
    }
    // Within its cutter alone it is kept: that counts as its box.
    let inside = "[[cut]]\nvolume = \"shape:cube\"\nflip = true\nscale = 0.5\n";
    fits(&shaped("sphere", inside), 2.0);
}

/// A part that a relief passes by had points that were no numbers in what the camera was fitted to, and the picture was empty.
#[test]
fn regression_0011_a_part_beside_a_relief_is_fitted_too() {
    let relief = "[relief.rock]\nkind = \"waves\"\n";
    let cut =
        "[[cut]]\nsurfaces = [{ section = \"x=0\", relief = \"rock\", amplitude = \"2%\" }]\n";
    for x in [2.0, -2.0] {
        let beside = format!(
            "[[part]]\nname = \"beside\"\nshape = \"cube?size=0.5\"\ntranslate = [{x}, 0, 0]\n"
        );
        fits(&shaped("cube", &format!("{beside}{relief}{cut}")), ROUGH_PX);
    }
}

#[test]
fn where_nothing_is_kept_all_is_shown() {
    let gone = cuts(&["z=10000", "x=50%"]);
    let mut scene = scene(&shaped("crank", &gone));
    let of_all = Prepared::new(&scene).view([64, 48]);
    scene.camera.fit = Fit::Kept;
    assert_eq!(Prepared::new(&scene).view([64, 48]), of_all);
    scene.cuts.pop();
    scene.cuts.clear();
    assert!(
        Prepared::new(&scene).view([64, 48]) != of_all,
        "the control"
    );
}

#[test]
fn a_camera_with_a_place_is_there() {
    let mut scene = scene(&shaped("crank", &cuts(&["-z=50%"])));
    scene.camera.viewpoint = Viewpoint::Explicit {
        position: glam::DVec3::new(3.0, 2.0, 4.0),
        focal_point: glam::DVec3::ZERO,
        view_up: None,
    };
    let views = [Fit::All, Fit::Kept].map(|fit| {
        scene.camera.fit = fit;
        Prepared::new(&scene).view([64, 48])
    });
    assert_eq!(views[0], views[1]);
}

#[test]
fn zoom_enlarges_about_the_middle() {
    let mut scene = scene(&shaped("crank", &cuts(&["-z=50%"])));
    scene.camera.fit = Fit::Kept;
    scene.camera.zoom = 0.5;
    let prepared = Prepared::new(&scene);
    let [left, right, above, below] = seen(&prepared, &scene.camera, [240, 180]);
    assert!((left - right).abs() <= 1.0 && (above - below).abs() <= 1.0);
    let wide = 240.0 - left - right;
    let wanted = (240.0 - 2.0 * 0.06 * 180.0) / 2.0;
    assert!((wide - wanted).abs() <= 1.5, "{wide} instead of {wanted}");
}

#[test]
fn a_wide_view_keeps_out_of_what_it_shows() {
    // From the tip of what is kept of it a wide view could hold all of it.
    let cuts = cuts(&[
        "1,1,1@60%,60%,60%",
        "1,-1,0@50%,50%,50%",
        "0,1,-1@50%,50%,40%",
    ]);
    let mut scene = scene(&shaped("cube", &cuts));
    scene.camera.fit = Fit::Kept;
    scene.camera.projection = Projection::Perspective { fov_y_deg: 75.0 };
    let [left, right, above, below] = seen(&Prepared::new(&scene), &scene.camera, [240, 180]);
    assert!((left - right).abs() <= 1.0 && (above - below).abs() <= 1.0);
    assert!(left.min(above) > 10.0, "it is no larger than fitted");
}
