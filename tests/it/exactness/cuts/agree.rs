//! Every exact strategy on cuts of every form.

use cutaway::layers::Kind;
use cutaway::scene::Scene;
use cutaway::strategies::Strategy;

use super::Scratch;
use super::common::{Question, class_of, strategy};

const SIZE_PX: [u32; 2] = [160, 120];

/// Strategies that owe nothing to exact, whatever the cut.
const EXACT: [&str; 4] = [
    "raycast+mask",
    "raycast+abuffer",
    "raycast+kbuffer:32",
    "raycast+stencil",
];

/// Three reliefs, and a place for parts and cuts.
const RELIEFS: &str = r#"
[relief.rock]
kind = "fractal"
size = 64
[relief.broken]
kind = "cracks"
size = 64
[relief.stairs]
kind = "profile"
heights = [0, 0.1, 1, 0.9, 0.5]
[relief.stack]
kind = "layers"
of = ["rock", "broken"]
at = 0.3
"#;

const ONE: &str = "[[part]]\nname = \"solid\"\nshape = \"SHAPE\"\n";

/// What is cut how, and the least pixels of cap.
const CUTS: [(&str, &str, usize); 12] = [
    (
        "box",
        "[[cut]]\nbox = { min = [\"45%\", \"40%\", \"50%\"] }",
        300,
    ),
    (
        "rough box",
        "[[cut]]\nbox = { min = [\"45%\", \"40%\", \"50%\"], relief = \"rock\", amplitude = \"4%\" }",
        300,
    ),
    (
        "wedge",
        "[[cut]]\nwedge = { axis = [0.2, 1, 0.1], from_deg = -20, to_deg = 95 }",
        300,
    ),
    (
        "rough wedge",
        "[[cut]]\nwedge = { axis = \"y\", from_deg = -20, to_deg = 95, min = \"30%\", relief = \"stack\", amplitude = \"4%\" }",
        300,
    ),
    (
        "most of a pie",
        "[[cut]]\nwedge = { axis = \"y\", from_deg = -50, to_deg = 190, max = \"85%\" }",
        300,
    ),
    (
        "most of a rough pie",
        "[[cut]]\nwedge = { axis = \"y\", from_deg = -50, to_deg = 190, relief = \"rock\", faces = [\"to\"] }",
        100,
    ),
    (
        "half a pie",
        "[[cut]]\nwedge = { axis = \"y\", from_deg = -50, to_deg = 130 }",
        300,
    ),
    (
        "wedge in a box beyond a relief",
        "[[cut]]\nbox = { min = [\"10%\", \"10%\", \"10%\"] }\nwedge = { axis = \"y\", from_deg = -40, to_deg = 100 }\n\
         surfaces = [{ section = \"-y=75%\", relief = \"rock\", amplitude = \"5%\" }]",
        100,
    ),
    (
        "union of three reliefs",
        "[[cut]]\nsurfaces = [{ section = \"-z=80%\", relief = \"rock\" }]\n\
         [[cut]]\nsurfaces = [{ normal = [-1, 0.2, 0], origin = [0.2, 0, 0], relief = \"broken\", amplitude = \"4%\" }]\n\
         [[cut]]\nsurfaces = [{ normal = [0.1, -1, -0.2], origin = [0, 0.2, 0], relief = \"stairs\", amplitude = \"6%\" }]",
        300,
    ),
    (
        "reliefs and planes that intersect",
        "[[cut]]\nsurfaces = [{ section = \"-z=40%\", relief = \"rock\" }, { section = \"-x=30%\", relief = \"stairs\" }, \
         { normal = [0.2, -1, 0.3] }]",
        200,
    ),
    (
        "offset box",
        "[[cut]]\nbox = { min = [\"45%\", \"40%\", \"50%\"] }\noffset = { \"*\" = \"3%\" }",
        300,
    ),
    (
        "offset relief",
        "[[cut]]\nsurfaces = [{ section = \"-z=55%\", relief = \"rock\" }]\noffset = { \"*\" = \"-4%\" }",
        300,
    ),
];

fn holds(scene: &Scene, what: &str, least_cap_px: usize) -> Vec<String> {
    let question = Question::new(scene, SIZE_PX);
    let caps = question.exact.layers.count(Kind::Cap);
    assert!(caps >= least_cap_px, "{what}: only {caps} px of cap");
    let all = EXACT.into_iter().map(strategy);
    all.filter_map(|strategy| {
        let fault = question.answer(strategy).fault_of_exact()?;
        Some(format!("{what}: {strategy}: {fault}"))
    })
    .collect()
}

#[test]
fn exact_strategies_agree_on_every_form() {
    let folder = Scratch::new("agree");
    let mut faults = Vec::new();
    for shape in [
        "cube",
        "sphere?subdivisions=3",
        "knot?segments=120&sides=10",
    ] {
        for (what, cut, least) in CUTS {
            let text = format!("{RELIEFS}{}{cut}\n", ONE.replace("SHAPE", shape));
            // A knot is thin.
            let least = if shape.starts_with("knot") { 30 } else { least };
            faults.extend(holds(
                &folder.scene(&text),
                &format!("{shape}, {what}"),
                least,
            ));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn parts_at_their_own_distance_agree() {
    let folder = Scratch::new("distances");
    let mut faults = Vec::new();
    for (what, cut) in [
        (
            "an earth",
            "except = [\"core\"]\nwedge = { axis = \"y\", from_deg = -20, to_deg = 95 }\noffset = { mantle = 0.1 }",
        ),
        (
            "a rough earth",
            "wedge = { axis = \"y\", from_deg = -20, to_deg = 95, relief = \"rock\" }\n\
             offset = { mantle = \"2%\", core = 0.2, \"c*\" = -0.05 }",
        ),
        (
            "most of an earth",
            "wedge = { axis = \"y\", from_deg = -60, to_deg = 200 }\noffset = { mantle = 0.1, core = 0.2 }",
        ),
    ] {
        let text = format!(
            "{RELIEFS}[[part]]\nshape = \"earth?subdivisions=3&mantle=0.8\"\n[[cut]]\n{cut}\n"
        );
        faults.extend(holds(&folder.scene(&text), what, 300));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn case_38_two_that_cross_have_no_gap_along_their_edge() {
    let folder = Scratch::new("case-38");
    let a = "section = \"-0.3,-0.1,-1@50%,50%,45%\"";
    let b = "normal = [-1, 0.15, -0.2], origin = [-0.05, 0, 0]";
    for (shape, ruffle) in [
        ("cube", ""),
        ("sphere?subdivisions=4", ""),
        ("cube", ", relief = \"rock\", amplitude = \"5%\""),
        (
            "sphere?subdivisions=4",
            ", relief = \"broken\", amplitude = \"5%\"",
        ),
    ] {
        let part = ONE.replace("SHAPE", shape);
        let [a, b] = [a, b].map(|s| format!("{{ {s}{ruffle} }}"));
        let and = format!("{RELIEFS}{part}[[cut]]\nsurfaces = [{a}, {b}]\n");
        let or = format!("{RELIEFS}{part}[[cut]]\nsurfaces = [{a}]\n[[cut]]\nsurfaces = [{b}]\n");
        let [and, or] = [and, or].map(|text| Question::new(&folder.scene(&text), SIZE_PX));
        for (what, question) in [("AND", &and), ("OR", &or)] {
            let edge = edge_px(question);
            assert!(
                edge.len() > 20,
                "{shape} {what}: an edge of {} px",
                edge.len()
            );
            for name in EXACT {
                let judged = question.answer(strategy(name));
                assert_eq!(judged.fault_of_exact(), None, "{shape} {what} {name}");
                // Undecided pixels too: which of the two caps is seen may be open, but not that one is.
                for pixel in &edge {
                    let kind = judged.layers.pixels[*pixel].kind;
                    assert_eq!(kind, Kind::Cap, "{shape} {what} {name}: pixel {pixel}");
                }
            }
        }
        // The control: one is not the other.
        let drawn = and.answer(Strategy::RAYCAST_MASK).layers;
        assert!(or.compare(&drawn).decided_wrong_px > 300, "{shape}");
    }
}

/// Pixels of one clip-surface's cap with a neighbour of another's at nearly its depth: the edge where the two cross.
fn edge_px(question: &Question) -> Vec<usize> {
    let layers = &question.exact.layers;
    let width = layers.size_px[0] as usize;
    let is_edge = |i: usize, j: usize| {
        let (a, b) = (&layers.pixels[i], &layers.pixels[j]);
        a.kind == Kind::Cap
            && b.kind == Kind::Cap
            && class_of(a) != class_of(b)
            && (a.depth - b.depth).abs() < 4.0 * question.view.pixel_size(a.depth)
    };
    let all = 0..layers.pixels.len() - width - 1;
    all.filter(|i| is_edge(*i, i + 1) || is_edge(*i, i + width))
        .collect()
}
