//! What a cut does not ask for, a frame does not do.

use cutaway::Model;
use cutaway::plan::{Capacities, Plan};
use cutaway::scene::Scene;
use cutaway::strategies::{self, Strategy};

use super::Scratch;

const RELIEF: &str = "[relief.rough]\nkind = \"waves\"\nsize = 8\n";

/// Two cubes side by side, and cuts.
fn cubes(folder: &Scratch, cuts: &str) -> Scene {
    folder.scene(&format!(
        "{RELIEF}[[part]]\nname = \"left\"\nshape = \"cube\"\n[[part]]\nname = \"right\"\nshape = \"cube\"\n\
         translate = [3, 0, 0]\n{cuts}"
    ))
}

fn plan_of(scene: &Scene, strategy: &Strategy) -> Plan {
    let model = Model::new(scene);
    let view = model.prepared.view([320, 200]);
    strategies::plan(&model, &view, strategy, &Capacities::UNKNOWN)
        .unwrap_or_else(|e| panic!("{e}"))
}

fn names(plan: &Plan) -> (Vec<&str>, Vec<&str>) {
    let mut resources: Vec<&str> = plan.resources.iter().map(|r| r.name.as_str()).collect();
    resources.sort_unstable();
    let passes = plan.passes.iter().map(|p| p.name.as_str());
    (passes.collect(), resources)
}

/// All that draw reliefs.
fn strategies() -> impl Iterator<Item = Strategy> {
    let of_planes = [Strategy::STENCIL, Strategy::PLANAR];
    Strategy::all()
        .into_iter()
        .filter(move |s| !of_planes.contains(s))
}

#[test]
fn a_cut_that_is_off_is_as_good_as_none() {
    let folder = Scratch::new("off");
    let none = cubes(&folder, "");
    let ragged = "[[cut]]\nsurfaces = [{ section = \"-z=50%\", relief = \"rough\" }]\n";
    let off = cubes(
        &folder,
        &ragged.replace("surfaces", "enabled = false\nsurfaces"),
    );
    let empty = cubes(
        &folder,
        "[[cut]]\nwedge = { axis = \"z\", from_deg = 9, to_deg = 9, relief = \"rough\" }\n",
    );
    for strategy in strategies() {
        let plain = plan_of(&none, &strategy);
        assert_eq!(plan_of(&off, &strategy), plain, "{strategy}: off");
        assert_eq!(
            plan_of(&empty, &strategy),
            plain,
            "{strategy}: without an inside"
        );
        let on = plan_of(&cubes(&folder, ragged), &strategy);
        assert!(on != plain, "{strategy}: the control");
    }
}

#[test]
fn the_heights_of_a_cut_that_is_off_are_not_there() {
    let folder = Scratch::new("heights");
    let other = "[relief.other]\nkind = \"waves\"\nsize = 16\n";
    let cuts = |enabled: bool| {
        format!(
            "{other}[[cut]]\nsurfaces = [{{ section = \"-z=50%\", relief = \"rough\" }}]\n\
             [[cut]]\nenabled = {enabled}\nsurfaces = [{{ section = \"-x=50%\", relief = \"other\" }}]\n"
        )
    };
    let bytes = |enabled| Model::new(&cubes(&folder, &cuts(enabled))).heights.len();
    assert_eq!(bytes(false), 8 * 8 * 4);
    assert_eq!(bytes(true), (8 * 8 + 16 * 16) * 4, "the control");
}

#[test]
fn short_forms_of_planes_alone_are_not_marched() {
    let folder = Scratch::new("march");
    for (cut, is_marched) in [
        ("box = { min = [0, 0, 0] }", false),
        (
            "wedge = { axis = \"z\", from_deg = 0, to_deg = 250, max = 0.2 }",
            false,
        ),
        (
            "box = { min = [0, 0, 0], relief = \"rough\", faces = [\"-x\"] }",
            true,
        ),
        // A part at an offset has planes of its own.
        ("box = { min = [0, 0, 0] }\noffset = { left = 0.1 }", false),
    ] {
        let scene = cubes(&folder, &format!("[[cut]]\n{cut}\n"));
        let plan = plan_of(&scene, &Strategy::RAYCAST_MASK);
        let crossings = plan.passes.iter().find(|p| p.name == "crossings");
        let path = crossings.expect("the pass").shader.path;
        assert_eq!(path.ends_with("reliefs.wgsl"), is_marched, "{cut}: {path}");
    }
}

#[test]
fn a_box_that_misses_a_part_leaves_it_drawn_plainly() {
    let folder = Scratch::new("misses");
    let scene = cubes(
        &folder,
        "[[cut]]\nbox = { centre = [0, 0, 0.5], size = 0.5 }\n",
    );
    let plan = plan_of(&scene, &Strategy::RAYCAST_MASK);
    let one = cubes(
        &folder,
        "[[cut]]\napplies_to = [\"left\"]\nbox = { centre = [0, 0, 0.5], size = 0.5 }\n",
    );
    let filtered = plan_of(&one, &Strategy::RAYCAST_MASK);
    assert_eq!(
        names(&plan),
        names(&filtered),
        "the box or the filter spares the right one"
    );
    assert!(names(&plan).0.contains(&"surface"), "{:?}", names(&plan));
    // The control: a box that reaches both leaves nothing to be drawn plainly.
    let both = cubes(&folder, "[[cut]]\nbox = { min = [-1, -1, 0.3] }\n");
    let both = plan_of(&both, &Strategy::RAYCAST_MASK);
    assert!(!names(&both).0.contains(&"surface"), "{:?}", names(&both));
}

#[test]
fn filters_and_offsets_that_change_nothing_cost_nothing() {
    let folder = Scratch::new("filters");
    let plain = cubes(&folder, "[[cut]]\nbox = { min = [-1, 0, 0] }\n");
    for unused in [
        "applies_to = [\"*\"]",
        "except = [\"nothing*\"]",
        "offset = { left = 0, right = 0.0 }",
        "offset = { \"nothing*\" = 0.5 }",
        "enabled = true",
    ] {
        let scene = cubes(
            &folder,
            &format!("[[cut]]\n{unused}\nbox = {{ min = [-1, 0, 0] }}\n"),
        );
        for strategy in strategies() {
            let [a, b] = [&scene, &plain].map(|s| plan_of(s, &strategy));
            assert_eq!(a, b, "{strategy}: {unused}");
        }
    }
    // The control: an offset that is one.
    let scene = cubes(
        &folder,
        "[[cut]]\noffset = { left = 0.1 }\nbox = { min = [-1, 0, 0] }\n",
    );
    let [a, b] = [&scene, &plain].map(|s| plan_of(s, &Strategy::RAYCAST_MASK));
    assert!(a != b);
}
