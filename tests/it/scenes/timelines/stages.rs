//! The stage: one box for all times.

use cutaway::scene::Bounds;
use cutaway_io::document::Timeline;
use cutaway_io::load::load_mesh_file;
use glam::DVec3;

use super::common::data::data;
use super::common::scenes::turning_gears;
use super::{Scratch, at, part};

const SCENE: &str = r#"
[[part]]
name = "bar"
shape = "cube?divisions=6"
scale = [1, 3, 1]
rotate_deg = [0, 0, 0]
deform = [
  { kind = "twist", axis = "y", turn_deg = 0 },
  { kind = "bend", axis = "y", turn_deg = 0 },
  { kind = "inflate", by = 0.1 },
]
[[cut]]
name = "middle"
surfaces = [{ section = "z=50%" }, { section = "x=0%" }]
[[key]]
target = "part.bar.rotate_deg"
times_s = [0, 2]
values = [[0, 0, 0], [0, 0, 90]]
[[key]]
target = "part.bar.deform.0.turn_deg"
times_s = [0, 2]
values = [0, 360]
[[key]]
target = "part.bar.deform.1.turn_deg"
times_s = [0, 1.03, 2]
values = [0, 120, 0]
"#;

fn holds(stage: Bounds, point: DVec3, slack: f64) -> bool {
    let slack = DVec3::splat(slack);
    point.cmpge(stage.min - slack).all() && point.cmple(stage.max + slack).all()
}

/// Vertices outside of the stage by more than a slack, at one of some times.
fn outside(timeline: &Timeline, stage: Bounds, slack: f64, times: u32) -> usize {
    let duration_s = timeline.duration_s().expect("something moves");
    let mut count = 0;
    for i in 0..=times {
        let scene = at(timeline, duration_s * f64::from(i) / f64::from(times));
        for part in &scene.parts {
            let mesh = part.posed_mesh();
            let placed = mesh.positions.iter();
            let placed = placed.map(|p| part.world_from_part.transform_point3(*p));
            count += placed.filter(|p| !holds(stage, *p, slack)).count();
        }
    }
    count
}

#[test]
fn the_stage_holds_all_vertices_at_all_times() {
    let folder = Scratch::new("stage");
    let timeline = folder.timeline(SCENE);
    let stage = timeline.stage().expect("sound").expect("it moves");
    assert_eq!(outside(&timeline, stage, 1e-12, 64), 0, "at sampled times");
    // Between the samples a vertex may leave it by what its path is curved.
    assert_eq!(outside(&timeline, stage, 0.01, 611), 0, "at other times");
    let less = Bounds {
        max: stage.max - DVec3::X * 0.02,
        ..stage
    };
    assert!(outside(&timeline, less, 0.01, 64) > 0, "a planted fault");
}

#[test]
fn relative_sections_stay_where_they_are() {
    let folder = Scratch::new("sections");
    let timeline = folder.timeline(SCENE);
    let stage = timeline.stage().expect("sound").expect("it moves");
    for time_s in [0.0, 0.7, 2.0] {
        let scene = at(&timeline, time_s);
        assert_eq!(scene.bounds(), stage, "the stage is the scene's box");
        let [middle, side] = &scene.cuts[0].surfaces[..] else {
            panic!("two sections");
        };
        assert_eq!(middle.origin.z, stage.centre().z, "50% at {time_s} s");
        assert_eq!(side.origin.x, stage.min.x, "0% at {time_s} s");
    }
    // The negative control: the part's own box is another one at each of these times.
    let [a, b] = [0.0, 2.0].map(|t| at(&timeline, t).bounds_of_parts());
    assert!(a != b, "nothing moved");
}

#[test]
fn inflated_parts_keep_their_directions() {
    let folder = Scratch::new("directions");
    let timeline = folder.timeline(SCENE);
    let [a, b] = [0.3, 1.3].map(|t| at(&timeline, t).parts[0].motion.clone());
    let [a, b] = [a, b].map(|m| m.expect("directions"));
    assert!(
        std::sync::Arc::ptr_eq(&a, &b),
        "the directions were found anew"
    );
}

/// Gears of an assembly, two of them turned against each other; nothing to check where the meshes are not.
#[test]
fn gears_of_an_assembly_turn_by_keys() {
    let Some(data) = data() else { return };
    let file = data.join("assembly/cube_gears.glb");
    let folder = Scratch::new("gears");
    let text = turning_gears(&file, "z=50%", 360.0);
    let timeline = folder.timeline(&text);
    let whole = load_mesh_file(&file).expect("a mesh that loads").parts;
    let [start, quarter] = [0.0, 1.0].map(|t| at(&timeline, t));
    assert_eq!(start.parts.len(), whole.len(), "every solid is there once");
    let turned = part(&quarter, "left");
    let rest = part(&start, "left");
    assert_eq!(
        whole
            .iter()
            .find(|p| p.name == "gear 2")
            .map(|p| p.bounds_in_world()),
        Some(rest.bounds_in_world()),
        "at first it is where the file has it"
    );
    let centre = rest.bounds_in_world().centre();
    for p in rest.mesh.positions.iter().step_by(97) {
        let from = rest.world_from_part.transform_point3(*p) - centre;
        let to = turned.world_from_part.transform_point3(*p) - centre;
        let expected = DVec3::new(-from.y, from.x, from.z);
        assert!((to - expected).length() < 1e-9, "{from} went to {to}");
    }
    let other = part(&quarter, "right").world_from_part;
    assert!(
        (other.matrix3.x_axis - turned.world_from_part.matrix3.x_axis).length() > 0.1,
        "they turn against each other"
    );
}
