//! The drawing, read back by a small reader of our own.

use std::fs;

use serde_json::Value;

use super::command::Scratch;
use super::{near, number, shoelace};

/// The values of an attribute, in order.
fn attributes<'a>(text: &'a str, name: &str) -> Vec<&'a str> {
    let begin = format!(" {name}=\"");
    let pieces = text.split(begin.as_str()).skip(1);
    pieces.map(|p| p.split('"').next().unwrap()).collect()
}

/// The closed curves of the data of a path: `M`, `L`, `Z`, absolute.
fn curves(data: &str) -> Vec<Vec<[f64; 2]>> {
    let point = |p: &str| {
        let (u, v) = p.split_once(' ').unwrap();
        [u, v].map(|c| c.parse::<f64>().unwrap())
    };
    data.trim_end_matches('Z')
        .split('Z')
        .map(|curve| {
            let curve = curve.strip_prefix('M').unwrap();
            curve.split('L').map(point).collect()
        })
        .collect()
}

/// Area that the paths of a drawing fill, one by one. Outlines and holes run opposite ways.
fn areas(drawing: &str) -> Vec<f64> {
    let paths = attributes(drawing, "d").into_iter();
    let area = |d: &str| curves(d).iter().map(|c| shoelace(c)).sum::<f64>() * 0.5;
    paths.map(area).collect()
}

fn drawn(folder: &Scratch, line: &str) -> (String, Value) {
    let ran = folder
        .run(&format!("section {line} -o cut.svg --json -"))
        .exits(0);
    let drawing = fs::read_to_string(folder.path("cut.svg")).unwrap();
    (drawing, ran.json())
}

#[test]
fn a_drawing_has_the_areas_that_are_told() {
    let folder = Scratch::new("section-svg");
    for line in [
        "shape:cube --section z=50%",
        "shape:gears --section -z=50%",
        "shape:crank --section z=50% --section x=30% --section 1,2,3@50%,50%,50%",
        "shape:shells --section y=40%",
    ] {
        let (drawing, json) = drawn(&folder, line);
        let expected: Vec<f64> = (json["sections"].as_array().unwrap().iter())
            .flat_map(|s| s["parts"].as_array().unwrap())
            .map(|p| number(&p["area"]))
            .collect();
        let found = areas(&drawing);
        assert_eq!(found.len(), expected.len(), "one path per part: {line}");
        for (found, expected) in found.iter().zip(&expected) {
            assert!(
                (found - expected).abs() < 1e-7 * expected,
                "{line}: {found} for {expected}"
            );
        }
        // The control: a point elsewhere is another area.
        let moved = drawing.replacen("\"M", "\"M9 7L", 1);
        assert!(
            (areas(&moved)[0] - expected[0]).abs() > 1e-3 * expected[0],
            "{line}"
        );
        let rules = attributes(&drawing, "fill-rule");
        assert!(rules.iter().all(|r| *r == "evenodd"), "{rules:?}");
        let groups = json["sections"].as_array().unwrap().len();
        assert_eq!(
            drawing.matches("<g id=\"section-").count(),
            groups,
            "{line}"
        );
    }
    let (drawing, _) = drawn(&folder, "shape:cube --section z=50% --fill nonzero");
    assert_eq!(attributes(&drawing, "fill-rule"), ["nonzero"]);
}

#[test]
fn everything_is_in_the_picture_and_nothing_covers_another_plane() {
    let folder = Scratch::new("section-frame");
    let (drawing, _) = drawn(
        &folder,
        "shape:crank --section z=50% --section x=30% --section y=50%",
    );
    let frame: Vec<f64> = attributes(&drawing, "viewBox")[0]
        .split(' ')
        .map(|n| n.parse().unwrap())
        .collect();
    let mut spans: Vec<[f64; 2]> = Vec::new();
    for group in drawing.split("<g id=").skip(1) {
        let transform = attributes(group, "transform")[0];
        let by = match transform.strip_prefix("translate(") {
            Some(rest) => {
                let numbers = rest.split(')').next().unwrap().split(' ');
                numbers.map(|n| n.parse::<f64>().unwrap()).collect()
            }
            None => vec![0.0; 2],
        };
        assert!(transform.ends_with("scale(1 -1)"), "{transform}");
        let mut span = [f64::INFINITY, f64::NEG_INFINITY];
        for [u, v] in attributes(group, "d")
            .into_iter()
            .flat_map(curves)
            .flatten()
        {
            let (x, y) = (by[0] + u, by[1] - v);
            assert!(x > frame[0] && x < frame[0] + frame[2], "{x} of {frame:?}");
            assert!(y > frame[1] && y < frame[1] + frame[3], "{y} of {frame:?}");
            span = [span[0].min(x), span[1].max(x)];
        }
        spans.push(span);
    }
    assert_eq!(spans.len(), 3, "planes");
    for pair in spans.windows(2) {
        assert!(pair[0][1] < pair[1][0], "{spans:?}");
    }
}

#[test]
fn a_unit_gives_the_drawing_the_size_of_the_model() {
    let folder = Scratch::new("section-unit");
    let mut widths = Vec::new();
    for (unit, mm) in [("mm", 1.0), ("cm", 10.0), ("m", 1000.0), ("in", 25.4)] {
        let (drawing, _) = drawn(
            &folder,
            &format!("shape:cube --section z=50% --unit {unit}"),
        );
        let frame: Vec<f64> = attributes(&drawing, "viewBox")[0]
            .split(' ')
            .map(|n| n.parse().unwrap())
            .collect();
        let width = attributes(&drawing, "width")[0];
        let width: f64 = width.strip_suffix("mm").unwrap().parse().unwrap();
        assert!(near(width, frame[2] * mm), "{unit}: {width} for {frame:?}");
        assert!(
            drawing.contains(&format!("drawn as 1 {unit}")),
            "{unit} is told"
        );
        widths.push(width);
    }
    let (fitted, _) = drawn(&folder, "shape:cube --section z=50%");
    assert_eq!(attributes(&fitted, "width"), ["1000"], "fitted");
    assert!(fitted.contains("no physical size"), "and told");
}

#[test]
fn names_are_text_and_not_markup() {
    let folder = Scratch::new("section-names");
    folder.write(
        "scene.toml",
        "[[part]]\nname = \"a<b> & \\\"c\\\" \\u0007\"\nshape = \"cube\"\n[[cut]]\nname = \"</g>\"\nsurfaces = [{ section = \"z=50%\" }]\n",
    );
    let (drawing, _) = drawn(&folder, "scene.toml");
    assert!(
        drawing.contains("a&lt;b&gt; &amp; &quot;c&quot;"),
        "{drawing}"
    );
    assert!(drawing.contains("&lt;/g&gt;"), "{drawing}");
    assert!(!drawing.contains('\u{7}'), "a control character is no XML");
    // Every tag that opens closes: the reader keeps a stack.
    let mut open: Vec<&str> = Vec::new();
    for tag in drawing.split('<').skip(1) {
        let tag = tag.split('>').next().unwrap();
        if tag.starts_with('?') || tag.ends_with('/') {
            continue;
        }
        let name = tag.split(' ').next().unwrap();
        match name.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name), "{drawing}"),
            None => open.push(name),
        }
    }
    assert!(open.is_empty(), "{open:?}");
}
