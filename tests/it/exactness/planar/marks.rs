//! Open meshes: what `planar` cannot know it marks, in the box of the part that is open and nowhere else.

use cutaway::gpu::{ClockSet, Program};
use cutaway::layers::{Kind, Layers};
use cutaway::plan::{Capacities, Plan, Work};
use cutaway::scene::{ClipSurface, Mesh, Part, Scene};
use cutaway::strategies::{self, DrawOptions, Method, Rasteriser, Strategy};
use cutaway_lab::compare::compare;
use glam::{DAffine3, DVec3};

use super::common::{Question, hardware_precision, meshes, scenes, session};

const SIZE: [u32; 2] = [128, 96];

/// A mesh without every so many-th triangle.
fn riddled(shape: &str, every: usize) -> Mesh {
    let mut mesh = meshes::shape(shape);
    let mut number = 0;
    mesh.triangles.retain(|_| {
        number += 1;
        number % every != every / 2
    });
    mesh
}

fn plane() -> ClipSurface {
    ClipSurface::plane(DVec3::Z * 0.05, DVec3::new(-0.2, -0.3, -1.0))
}

fn plan(question: &Question, rasteriser: Rasteriser) -> Plan {
    let options = DrawOptions::by(rasteriser);
    let capacities = Capacities::UNKNOWN;
    let (model, view) = (&question.model, &question.view);
    strategies::plan(
        model,
        view,
        Method::new(Strategy::PLANAR, options),
        &capacities,
    )
    .expect("a plan")
}

fn run(plan: Plan) -> Layers {
    let session = session();
    let mut program = Program::default();
    program
        .load(session.gpu(), plan)
        .expect("a plan that loads");
    program.run(session.gpu(), ClockSet::ALL).expect("a frame");
    program.layers(session.gpu(), SIZE).expect("layers")
}

fn marked(layers: &Layers) -> usize {
    layers.pixels.iter().filter(|p| p.unreliable).count()
}

/// Wrong and unmarked, by exact parity of the mesh as it is and by the whole mesh. Caps are drawn by the adapter, whichever rasteriser
/// draws the mesh.
fn unmarked(question: &Question, whole: &Question, layers: &Layers) -> [usize; 2] {
    let missed = (whole.exact.layers.pixels.iter().zip(&layers.pixels))
        .filter(|(truth, found)| truth.kind == Kind::Cap && found.kind != Kind::Cap)
        .filter(|(_, found)| !found.unreliable);
    let exact = question.exact.at(hardware_precision());
    let judged = compare(
        &exact,
        layers,
        &question.view,
        question.model.prepared.scale,
    );
    [judged.unmarked_wrong_px, missed.count()]
}

#[test]
fn whatever_is_wrong_about_riddled_meshes_is_marked() {
    let mut without_doubt = 0;
    for (shape, every) in [
        ("sphere?subdivisions=3", 20),
        ("sphere?subdivisions=3", 100),
        ("knot?segments=160&sides=12", 30),
        ("torus?segments=24&sides=12", 7),
    ] {
        let of = |mesh: Mesh| Question::new(&scenes::scene(shape, mesh, vec![plane()]), SIZE);
        let (open, whole) = (of(riddled(shape, every)), of(meshes::shape(shape)));
        for rasteriser in [Rasteriser::Hardware, Rasteriser::Compute] {
            let what = format!("{shape} less 1 in {every} by {rasteriser}");
            let layers = run(plan(&open, rasteriser));
            assert_eq!(unmarked(&open, &whole, &layers), [0, 0], "{what}");
            // The control: of each polygon of doubt only a triangle is drawn.
            let mut careless = plan(&open, rasteriser);
            let doubts = careless.passes.iter_mut().find(|p| p.name == "doubts");
            let Some(Work::Draw { draws, .. }) = doubts.map(|p| &mut p.work) else {
                panic!("{what}: nothing is doubted");
            };
            for draw in draws {
                draw.indices.end = draw.indices.start + 3;
            }
            let [_, missed] = unmarked(&open, &whole, &run(careless));
            without_doubt += missed;
        }
    }
    assert!(without_doubt > 1000, "{without_doubt} px would go unmarked");
}

#[test]
fn a_part_that_closes_is_not_doubted_for_its_neighbour() {
    let part = |name: &str, mesh: Mesh, x: f64| {
        let mut part = Part::new(name, mesh);
        part.world_from_part = DAffine3::from_translation(DVec3::X * x);
        part
    };
    let ball = "sphere?subdivisions=3";
    let parts = vec![
        part("open", riddled(ball, 20), -0.6),
        part("closed", meshes::shape(ball), 0.6),
    ];
    let scene = scenes::of_parts("a pair", parts, vec![plane()]);
    let question = Question::new(&scene, SIZE);
    let layers = run(plan(&question, Rasteriser::Hardware));
    let of_closed = layers
        .pixels
        .iter()
        .filter(|p| p.kind == Kind::Cap && p.part == 1);
    assert!(
        of_closed.clone().count() > 300,
        "the closed one has its cap"
    );
    assert_eq!(
        of_closed.filter(|p| p.unreliable).count(),
        0,
        "and does not mark it"
    );
    assert!(marked(&layers) > 300, "{} marked", marked(&layers));
}

#[test]
fn what_is_not_entered_through_the_plane_is_not_doubted() {
    let open = riddled("sphere?subdivisions=3", 100);
    let of = |plane: ClipSurface| -> Scene { scenes::scene("a half", open.clone(), vec![plane]) };
    let entered = of(plane());
    let mut left = of(plane().flipped());
    left.camera = entered.camera;
    let [entered, left] = [entered, left].map(|scene| {
        let question = Question::new(&scene, SIZE);
        marked(&run(plan(&question, Rasteriser::Hardware)))
    });
    assert!(
        10 * left < entered,
        "{left} marked from behind, {entered} from before"
    );
}

#[test]
fn who_closes_pays_nothing_for_doubt() {
    let of = |mesh: Mesh| {
        let scene = scenes::scene("a ball", mesh, vec![plane()]);
        plan(&Question::new(&scene, SIZE), Rasteriser::Hardware)
    };
    let ball = "sphere?subdivisions=3";
    let words = |plan: &Plan| {
        let mask = plan.resources.iter().find(|r| r.name == "mask");
        mask.map(|r| r.shape.bytes()).expect("a mask") / u64::from(SIZE[0] * SIZE[1] * 4)
    };
    let (closed, open) = (of(meshes::shape(ball)), of(riddled(ball, 20)));
    assert!(!closed.to_text().contains("doubts"), "{}", closed.to_text());
    assert!(open.to_text().contains("doubts"), "{}", open.to_text());
    assert_eq!([words(&closed), words(&open)], [1, 2], "words of a pixel");
}
