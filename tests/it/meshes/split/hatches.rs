//! Promise: no two parts in contact have the same hatch. Contacts are found apart from the scene's own grid: by distances of points of one
//! part to the triangles of another.

use std::collections::{BTreeMap, BTreeSet};

use cutaway::passes::ActiveCuts;
use cutaway::scene::{ClipSurface, Cut, Scene};
use cutaway::strategies::{Method, Strategy};
use cutaway::{Model, Outcome, Session};
use cutaway_io::document::named_style;

use super::*;
use crate::common::real;

/// Parts are in contact where they are nearer than this share of the scene's diagonal.
const CONTACT: f64 = 1e-5;

/// Cells of the grid that triangles are looked up in, along the diagonal.
const CELLS: f64 = 80.0;

/// The distance of a point to a triangle (Ericson 2005, 5.1.5).
fn distance(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return ap.length();
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return bp.length();
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return p.distance(a + ab * (d1 / (d1 - d3)));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return cp.length();
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return p.distance(a + ac * (d2 / (d2 - d6)));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return p.distance(b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
    }
    let sum = va + vb + vc;
    match sum == 0.0 {
        // Flat: the corners are near enough.
        true => ap.length().min(bp.length()).min(cp.length()),
        false => p.distance(a + ab * (vb / sum) + ac * (vc / sum)),
    }
}

fn corners_of(part: &Part) -> Vec<[DVec3; 3]> {
    let at = |p: DVec3| part.world_from_part.transform_point3(p);
    (0..part.mesh.triangles.len())
        .map(|t| part.mesh.corners(t).map(at))
        .collect()
}

/// The pairs of parts that are in contact.
fn touching(parts: &[Part], diagonal: f64) -> BTreeSet<(usize, usize)> {
    let cell = diagonal / CELLS;
    let near = CONTACT * diagonal;
    let index = |p: DVec3| (p / cell).floor().to_array().map(|c| c as i64);
    let triangles: Vec<_> = parts.iter().map(corners_of).collect();
    // Triangles in all cells that their boxes meet.
    let mut cells: BTreeMap<[i64; 3], Vec<(usize, usize)>> = BTreeMap::new();
    for (part, of_part) in triangles.iter().enumerate() {
        for (number, [a, b, c]) in of_part.iter().enumerate() {
            let [low, high] = [
                index(a.min(*b).min(*c) - near),
                index(a.max(*b).max(*c) + near),
            ];
            for x in low[0]..=high[0] {
                for y in low[1]..=high[1] {
                    for z in low[2]..=high[2] {
                        cells.entry([x, y, z]).or_default().push((part, number));
                    }
                }
            }
        }
    }
    cells.retain(|_, met| met.iter().any(|m| m.0 != met[0].0));
    let mut pairs = BTreeSet::new();
    for (part, of_part) in triangles.iter().enumerate() {
        for corners in of_part {
            // Points of the sides and of the middle; sides cross where no corner is near.
            let [a, b, c] = *corners;
            let middle = (a + b + c) / 3.0;
            let along = |from: DVec3, to: DVec3| {
                let steps = (from.distance(to) / cell * 4.0).ceil().clamp(1.0, 64.0);
                (0..steps as u32).map(move |i| from.lerp(to, f64::from(i) / steps))
            };
            let points = along(a, b).chain(along(b, c)).chain(along(c, a));
            for point in points.chain([middle]) {
                for (other, number) in cells.get(&index(point)).into_iter().flatten() {
                    let pair = (part.min(*other), part.max(*other));
                    if *other != part
                        && !pairs.contains(&pair)
                        && distance(point, triangles[*other][*number]) <= near
                    {
                        pairs.insert(pair);
                    }
                }
            }
        }
    }
    pairs
}

/// Lines of one direction whose distances differ by a smaller factor are alike.
const ALIKE: f64 = 1.1;

/// How lines look: direction in degrees, and distance in scene units; or none, where caps are filled.
type Look = Option<(f64, f64)>;

/// The hatch of each part of a cut scene that has one.
fn looks(session: &mut Session, scene: &Scene) -> BTreeMap<usize, Look> {
    let model = Model::new(scene);
    let view = model.prepared.view([96, 72]);
    let method = Method::from(Strategy::RAYCAST_MASK);
    let drawn = session.draw(&model, &view, method).expect("a frame");
    assert_eq!(drawn.outcome, Outcome::Complete, "{}", scene.name);
    let active_cuts = ActiveCuts::new(&model.prepared, &view).expect("few enough parts");
    let rows = session.words(method, "part_hatches").expect("hatches");
    let lines = session.words(method, "hatch_lines").expect("lines");
    let rows = rows.chunks_exact(20);
    assert_eq!(rows.len(), active_cuts.order.len(), "a row for each part");
    (active_cuts.order[..active_cuts.lanes].iter().zip(rows))
        .map(|(rank, row)| {
            let [first, count] = [row[4], row[5]].map(|n| n as usize);
            let is_filled = count == 0;
            let line = &lines[16 * first.min(lines.len() / 16 - 1)..];
            let [x, y] = [line[0], line[1]].map(|word| f64::from(f32::from_bits(word)));
            let look = (y.atan2(x).to_degrees().rem_euclid(180.0), 1.0 / x.hypot(y));
            (
                model.prepared.parts[*rank].part,
                (!is_filled).then_some(look),
            )
        })
        .collect()
}

fn are_alike(a: (f64, f64), b: (f64, f64)) -> bool {
    let turned = (a.0 - b.0).abs();
    let turned = turned.min(180.0 - turned);
    turned < 8.0 && (a.1 / b.1).max(b.1 / a.1) < ALIKE
}

/// A scene cut through its middle, whichever side stays.
fn cut(scene: &Scene, side: &str) -> Scene {
    let plane = ClipSurface::parse(&format!("{side}0.3,0.25,1@50%,50%,50%"), &scene.bounds());
    let mut scene = scene.clone();
    scene.style = named_style("technical").expect("a style");
    scene.cuts = vec![Cut::new("middle", vec![plane.expect("a section")])];
    scene
}

/// What is in contact and looks alike, and how many contacts there are.
fn alike(
    looks: &BTreeMap<usize, Look>,
    contacts: &BTreeSet<(usize, usize)>,
) -> (usize, Vec<(usize, usize)>) {
    let both = contacts.iter().filter_map(|(a, b)| {
        let (first, second) = (looks.get(a).copied()??, looks.get(b).copied()??);
        Some(((*a, *b), are_alike(first, second)))
    });
    let both: Vec<_> = both.collect();
    let wrong = both
        .iter()
        .filter(|(_, alike)| *alike)
        .map(|(pair, _)| *pair);
    (both.len(), wrong.collect())
}

#[test]
fn no_two_parts_in_contact_have_the_same_hatch() {
    let Some(folder) = data::data() else { return };
    let mut files = real::files(&["assembly"]);
    let others = ["messy/offset1.obj", "dense/garden_fence_panels.stl"];
    files.extend(others.map(|f| folder.join(f)));
    let mut session = session();
    let (mut all, mut control) = (0, 0);
    for file in files {
        let scene = super::real::split(&file);
        let contacts = touching(&scene.parts, scene.bounds().size().length());
        for side in ["", "-"] {
            let scene = cut(&scene, side);
            let mut looks = looks(&mut session, &scene);
            let (count, wrong) = alike(&looks, &contacts);
            let name = file.display();
            assert!(
                wrong.is_empty(),
                "{name}: {wrong:?} touch and are alike: {looks:?}"
            );
            all += count;
            // The control: one hatch for all.
            looks.values_mut().for_each(|l| *l = Some((45.0, 1.0)));
            control += alike(&looks, &contacts).1.len();
        }
    }
    assert!(all > 100, "only {all} contacts were looked at");
    assert!(
        control >= all,
        "{control} of {all} contacts of one hatch are found"
    );
}

#[test]
fn contacts_are_found_where_corners_meet_and_where_only_sides_do() {
    let at = |name: &str, to: [f64; 3]| Part::new(name, cube(to.into(), 1.0, false));
    let parts = [
        at("a", [0.0, 0.0, 0.0]),
        at("a face", [1.0, 0.0, 0.0]),
        at("a corner", [2.0, 1.0, 1.0]),
        at("nothing", [0.0, 0.0, 1.001]),
    ];
    let expected = BTreeSet::from([(0, 1), (1, 2)]);
    assert_eq!(touching(&parts, 4.0), expected);
    // Long bars that cross in the middle of their sides.
    let mut bars = [at("x", [0.0; 3]), at("y", [0.0, 0.0, 1.0])];
    for (bar, along) in bars.iter_mut().zip([DVec3::X, DVec3::Y]) {
        let mut mesh = (*bar.mesh).clone();
        for p in &mut mesh.positions {
            *p += 20.0 * *p * along;
        }
        bar.mesh = mesh.into();
    }
    assert_eq!(touching(&bars, 30.0).len(), 1);
}
