//! The drawing for CAD, read back pair by pair.

use std::fs;

use super::command::Scratch;
use super::{json_of, near, number, shoelace, uv};

/// The pairs of a file: a code on a line, a value on the next.
fn pairs(text: &str) -> Vec<(u16, &str)> {
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len() % 2, 0, "pairs of lines");
    lines
        .chunks_exact(2)
        .map(|p| (p[0].trim().parse().unwrap(), p[1]))
        .collect()
}

/// A polyline: its layer, whether it is closed, its points.
struct Polyline {
    layer: String,
    is_closed: bool,
    points: Vec<[f64; 2]>,
}

fn polylines(text: &str) -> Vec<Polyline> {
    let pairs = pairs(text);
    let entities = pairs.iter().position(|p| *p == (2, "ENTITIES")).unwrap();
    let mut found: Vec<Polyline> = Vec::new();
    for (code, value) in &pairs[entities + 1..] {
        match (code, found.last_mut()) {
            (0, _) if *value == "LWPOLYLINE" => found.push(Polyline {
                layer: String::new(),
                is_closed: false,
                points: Vec::new(),
            }),
            (0, _) if *value == "ENDSEC" => break,
            (8, Some(last)) => last.layer = (*value).to_owned(),
            (70, Some(last)) => last.is_closed = *value == "1",
            (90, Some(last)) => last.points.reserve(value.parse().unwrap()),
            (10, Some(last)) => last.points.push([value.parse().unwrap(), 0.0]),
            (20, Some(last)) => last.points.last_mut().unwrap()[1] = value.parse().unwrap(),
            _ => {}
        }
    }
    found
}

/// The value behind a variable of the header.
fn variable<'a>(text: &'a str, name: &str) -> &'a str {
    let pairs = pairs(text);
    let at = pairs.iter().position(|p| *p == (9, name)).unwrap();
    pairs[at + 1].1
}

#[test]
fn loops_are_closed_polylines_on_the_layers_of_their_parts() {
    let folder = Scratch::new("section-dxf");
    let line = "shape:gears --section z=50%";
    folder
        .run(&format!("section {line} -o cut.dxf --unit in"))
        .exits(0);
    let text = fs::read_to_string(folder.path("cut.dxf")).unwrap();
    assert!(
        text.is_ascii() && text.ends_with("EOF\n"),
        "ASCII, and whole"
    );
    assert_eq!(variable(&text, "$INSUNITS"), "1", "inches");
    assert_eq!(variable(&text, "$ACADVER"), "AC1018");
    let drawn = polylines(&text);
    let json = json_of(&folder, line);
    let parts = json["sections"][0]["parts"].as_array().unwrap();
    let expected: usize = parts
        .iter()
        .map(|p| p["loops"].as_array().unwrap().len())
        .sum();
    assert_eq!(drawn.len(), expected, "a polyline for each loop");
    for part in parts {
        let name = part["part"].as_str().unwrap();
        let own: Vec<&Polyline> = drawn.iter().filter(|p| p.layer == name).collect();
        let area: f64 = own.iter().map(|p| 0.5 * shoelace(&p.points)).sum();
        assert!(own.iter().all(|p| p.is_closed), "{name}");
        assert!(near(area, number(&part["area"])), "{name}: {area}");
        for (one, polyline) in part["loops"].as_array().unwrap().iter().zip(&own) {
            assert_eq!(uv(one), polyline.points, "{name}: to the last bit");
        }
    }
}

#[test]
fn no_two_parts_share_a_layer() {
    let folder = Scratch::new("section-dxf-names");
    let names = ["Bolt", "bolt", "a/b", "a:b", "0", "part"];
    folder.write_cubes("parts.toml", &names);
    folder.run("section parts.toml -o parts.dxf").exits(0);
    let text = fs::read_to_string(folder.path("parts.dxf")).unwrap();
    let mut layers: Vec<String> = polylines(&text)
        .iter()
        .map(|p| p.layer.to_lowercase())
        .collect();
    assert_eq!(layers.len(), names.len());
    layers.sort();
    layers.dedup();
    assert_eq!(
        layers.len(),
        names.len(),
        "in letters of any case: {layers:?}"
    );
    assert!(
        !layers.contains(&"0".to_owned()),
        "the layer of every drawing is none of a part"
    );
}

#[test]
fn planes_stand_beside_each_other_and_open_curves_on_their_own_layer() {
    let folder = Scratch::new("section-dxf-planes");
    folder
        .run("section shape:cube --section z=50% --section x=50% --whole -o two.dxf")
        .exits(0);
    let text = fs::read_to_string(folder.path("two.dxf")).unwrap();
    assert_eq!(variable(&text, "$INSUNITS"), "0", "no unit is said");
    let drawn = polylines(&text);
    let ends = |p: &Polyline, of: fn(f64, f64) -> f64, start| {
        p.points.iter().fold(start, |m, p| of(m, p[0]))
    };
    assert!(
        ends(&drawn[0], f64::max, f64::MIN) < ends(&drawn[1], f64::min, f64::MAX),
        "the second is to the right of the first"
    );
    folder
        .run("section shape:sphere --defect holes:amount=5% --section z=50% -o open.dxf")
        .exits(1);
    let text = fs::read_to_string(folder.path("open.dxf")).unwrap();
    let open: Vec<Polyline> = polylines(&text)
        .into_iter()
        .filter(|p| !p.is_closed)
        .collect();
    assert!(!open.is_empty(), "the control: it is open");
    assert!(
        open.iter().all(|p| p.layer == "sphere open"),
        "{}",
        open[0].layer
    );
}
