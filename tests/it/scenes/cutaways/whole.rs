//! Parts that are whole: none is cut, and none stands in the air.

use cutaway::scene::ClipSurface;
use cutaway::strategies::Strategy;

use super::*;

/// A plate with a row of pins, of which a quarter cut removes some, cuts through others, and leaves the rest.
fn plate(role: Role) -> Scene {
    let mut parts = vec![placed(
        "plate",
        "cube?divisions=2",
        DVec3::new(4.0, 1.0, 1.0),
        DVec3::ZERO,
    )];
    for i in 0..7 {
        let at = DVec3::new(f64::from(i) * 0.5 - 1.5, 0.2, 0.1);
        let mut pin = placed(
            &format!("pin {i}"),
            "sphere?subdivisions=3",
            DVec3::splat(0.3),
            at,
        );
        pin.role = role;
        // Before the plate that they are in.
        pin.priority = Some(1);
        parts.push(pin);
    }
    let mut scene = scenes::of_parts("plate", parts, Vec::new());
    let surfaces =
        ["-x=48%", "-z=50%"].map(|s| ClipSurface::parse(s, &scene.bounds()).expect("a section"));
    scene.cuts = vec![
        Cut::new("left", surfaces[..1].to_vec()),
        Cut::new("front", surfaces[1..].to_vec()),
    ];
    scene
}

fn pins(layers: &Layers, kind: Kind) -> std::collections::BTreeSet<u16> {
    let shown = layers
        .pixels
        .iter()
        .filter(|l| l.kind == kind && l.part > 0);
    shown.map(|l| l.part).collect()
}

#[test]
fn what_is_whole_has_no_cap_and_is_hidden_where_all_of_it_is_removed() {
    let question = Question::new(&plate(Role::Whole), [320, 200]);
    let layers = &question.exact.layers;
    assert_eq!(pins(layers, Kind::Cap), [].into(), "none is cut");
    let shown = pins(layers, Kind::Surface);
    // Of those that both cuts leave something, all is seen; the others are gone.
    let bounds = plate(Role::Whole).bounds();
    let left = bounds.min.x + 0.48 * bounds.size().x;
    let kept = |i: &u16| f64::from(*i - 1) * 0.5 - 1.5 - 0.15 < left;
    assert_eq!(
        shown,
        (1..=7).filter(kept).collect(),
        "those that float are hidden"
    );
    assert!(shown.len() < 7 && shown.len() > 2, "{shown:?}");
    for strategy in [Strategy::RAYCAST_MASK, Strategy::RAYCAST_STENCIL] {
        let fault = question.answer(strategy).fault_of_exact();
        assert_eq!(fault, None, "{strategy}");
    }
    // The controls.
    let sliced = Question::new(&plate(Role::Exterior), [320, 200]);
    assert!(
        pins(&sliced.exact.layers, Kind::Cap).len() > 2,
        "pins that are cut"
    );
    let spared = Question::new(&plate(Role::Interior), [320, 200]);
    assert_eq!(
        pins(&spared.exact.layers, Kind::Surface).len(),
        7,
        "pins that float"
    );
}
