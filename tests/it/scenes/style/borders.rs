//! Borders are where layers differ, and nowhere else.

use super::*;
use common::real;
use cutaway::layers::{Layer, Layers};
use cutaway::scene::{Camera, Projection, Viewpoint};

const OUTLINE: u32 = 1;
const CUT: u32 = 2;
const PART: u32 = 3;
const FACE: u32 = 4;
const CONTOUR: u32 = 5;
const CREASE: u32 = 6;

/// Layers of a scene, and the word of each pixel's borders.
fn borders_of(scene: &Scene, size_px: [u32; 2]) -> (Layers, Vec<u32>) {
    let model = Model::new(scene);
    let view = model.prepared.view(size_px);
    let method = Method::from(Strategy::RAYCAST_MASK);
    let mut session = session();
    let drawn = session.draw(&model, &view, method).expect("a frame");
    assert_eq!(drawn.outcome, Outcome::Complete, "{}", scene.name);
    let layers = session.layers(method).expect("layers");
    let mut borders = session.words(method, "borders").expect("borders");
    // Those of tiles come after them.
    borders.truncate(layers.pixels.len());
    (layers, borders)
}

/// How often a class is among borders.
fn count(borders: &[u32], class: u32) -> usize {
    let both = borders.iter().flat_map(|b| [b & 15, (b >> 4) & 15]);
    both.filter(|c| *c == class).count()
}

fn likeness(l: &Layer) -> (Kind, u16, u8) {
    (l.kind, l.part, l.clip_surface)
}

/// Whether a sample is one wide between two that are alike.
fn is_sliver(layers: &Layers, [x, y]: [u32; 2]) -> bool {
    let [width, height] = layers.size_px;
    let own = likeness(layers.at(x, y));
    let between = |a: &Layer, b: &Layer| {
        likeness(a) == likeness(b) && a.kind != Kind::Background && likeness(a) != own
    };
    let along = x > 0 && x + 1 < width && between(layers.at(x - 1, y), layers.at(x + 1, y));
    let across = y > 0 && y + 1 < height && between(layers.at(x, y - 1), layers.at(x, y + 1));
    along || across
}

/// What the border between two samples must be, by kind and part alone; `None` where depth and normals say it.
fn expected(a: &Layer, b: &Layer) -> Option<u32> {
    let background = |l: &Layer| l.kind == Kind::Background;
    match (background(a), background(b)) {
        (true, true) => Some(0),
        (true, false) | (false, true) => Some(OUTLINE),
        (false, false) if a.kind != b.kind => Some(CUT),
        (false, false) if a.part != b.part && a.kind == Kind::Cap => Some(CUT),
        (false, false) if a.part != b.part => Some(PART),
        (false, false) if a.clip_surface != b.clip_surface => Some(FACE),
        (false, false) => None,
    }
}

#[test]
fn every_difference_of_kind_and_part_is_a_border_and_no_other_is() {
    let mut scene = scene_in(style("technical"));
    let [x, y] =
        ["-x=60%", "-z=55%"].map(|s| ClipSurface::parse(s, &scene.bounds()).expect("a section"));
    scene.cuts.push(Cut::new("corner", vec![x, y]));
    let (layers, borders) = borders_of(&scene, SIZE_PX);
    let judged = Judged::of(&layers, &borders, 0);
    assert_eq!(judged.faults, Vec::<String>::new());
    assert!(
        judged.met.iter().all(|m| *m > 10),
        "all classes are met: {:?}",
        judged.met
    );
    // The control: a row further the same words are wrong.
    let wrong = Judged::of(&layers, &borders, 1).faults.len();
    assert!(wrong > 50, "only {wrong} words of the next row are wrong");
}

/// The borders of a picture, held against what its layers ask for.
#[derive(Default)]
struct Judged {
    /// How often each class was there where it must be.
    met: [usize; 5],
    faults: Vec<String>,
}

impl Judged {
    /// With the words of so many rows further down.
    fn of(layers: &Layers, borders: &[u32], rows: u32) -> Self {
        let [width, height] = layers.size_px;
        let mut judged = Self::default();
        for (y, x) in (0..height - rows).flat_map(|y| (0..width).map(move |x| (y, x))) {
            let word = borders[((y + rows) * width + x) as usize];
            for (to, found) in [([x + 1, y], word & 15), ([x, y + 1], (word >> 4) & 15)] {
                let is_within = to[0] < width && to[1] < height;
                let must = match is_within {
                    false => Some(0),
                    true => required(layers, [x, y], to),
                };
                let is_right = match must {
                    Some(must) => found == must,
                    None => [0, CONTOUR, CREASE].contains(&found),
                };
                if !is_right {
                    let fault = format!("{found}, not {must:?}, between ({x}, {y}) and {to:?}");
                    judged.faults.push(fault);
                } else if let Some(must) = must.filter(|_| is_within) {
                    judged.met[must as usize] += 1;
                }
            }
        }
        judged
    }
}

/// What the border between two neighbouring samples must be; `None` where depth and normals say it.
fn required(layers: &Layers, from: [u32; 2], to: [u32; 2]) -> Option<u32> {
    let [a, b] = [from, to].map(|[x, y]| layers.at(x, y));
    let is_doubted = a.unreliable && b.unreliable;
    match is_doubted || is_sliver(layers, from) || is_sliver(layers, to) {
        true => Some(0),
        false => expected(a, b),
    }
}

/// Three cuts of a scene: across the longest axis, aslant, and a corner.
fn three_cuts(scene: &Scene) -> Vec<Vec<Cut>> {
    let bounds = scene.bounds();
    let cut = |sections: &[&str]| {
        let planes = sections.iter().map(|s| ClipSurface::parse(s, &bounds));
        vec![Cut::new(
            "cut",
            planes.map(|p| p.expect("a section")).collect(),
        )]
    };
    let lengths = bounds.size().to_array();
    let longest = (0..3).max_by(|a, b| lengths[*a].total_cmp(&lengths[*b]));
    let across = ["-x=52%", "-y=52%", "-z=52%"][longest.unwrap_or(0)];
    vec![
        cut(&[across]),
        cut(&["-0.31,-0.27,-0.91@48%,51%,49%"]),
        cut(&["-x=55%", "-y=47%"]),
    ]
}

#[test]
fn borders_are_where_layers_differ_on_every_closed_mesh() {
    let mut met = [0; 5];
    let mut meshes = 0;
    let folders = ["cad", "organic", "assembly", "dense"];
    for (_, mut scene) in real::closed(real::files(&folders), None) {
        meshes += 1;
        scene.style = style("technical");
        for cuts in three_cuts(&scene) {
            scene.cuts = cuts;
            let (layers, borders) = borders_of(&scene, [400, 300]);
            let judged = Judged::of(&layers, &borders, 0);
            let faults = judged.faults.len();
            assert_eq!(faults, 0, "{}: {:?}", scene.name, judged.faults.first());
            for (sum, met) in met.iter_mut().zip(judged.met) {
                *sum += met;
            }
        }
    }
    println!("{meshes} meshes; pairs by class from none to face: {met:?}");
    assert!(meshes == 0 || met[1..].iter().all(|m| *m > 20), "{met:?}");
}

/// A shape by itself, from an elevation, and a cut that misses it.
fn alone(shape: &str, elevation_deg: f64, projection: Projection) -> Scene {
    let mut scene = scenes::of_parts(
        shape,
        vec![Part::new("it", meshes::shape(shape))],
        Vec::new(),
    );
    scene.camera = Camera {
        viewpoint: Viewpoint::Orbit {
            azimuth_deg: 31.0,
            elevation_deg,
        },
        projection,
        ..scene.camera
    };
    scene.style = style("technical");
    scene
}

#[test]
fn smooth_and_flat_have_no_contour_within() {
    let projections = [
        Projection::Perspective { fov_y_deg: 30.0 },
        Projection::Orthographic { height: None },
    ];
    for projection in projections {
        for elevation_deg in [0.0, 0.5, 2.0, 5.0, 20.0, 60.0, 89.5] {
            for shape in ["sphere?subdivisions=5", "cube"] {
                let scene = alone(shape, elevation_deg, projection);
                let (_, borders) = borders_of(&scene, [300, 300]);
                let contours = count(&borders, CONTOUR);
                assert_eq!(contours, 0, "{shape} from {elevation_deg}");
                assert!(count(&borders, OUTLINE) > 300, "{shape}: an outline");
                let is_folded = count(&borders, CREASE) > 50;
                let edges = shape == "cube" && (2.0..80.0).contains(&elevation_deg);
                assert!(!edges || is_folded, "{shape} from {elevation_deg}: creases");
                assert!(
                    shape == "cube" || !is_folded,
                    "{shape} from {elevation_deg}: no creases"
                );
            }
        }
    }
    // The control: a ring hides itself.
    let ring = alone("torus", 15.0, projections[0]);
    let (_, borders) = borders_of(&ring, [300, 300]);
    assert!(
        count(&borders, CONTOUR) > 50,
        "{} on a ring",
        count(&borders, CONTOUR)
    );
}
