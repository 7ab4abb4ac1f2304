//! The animated models, at ten times of each clip, held against the oracle.

use std::path::PathBuf;

use cutaway::Part;
use cutaway::scene::{Bounds, Topology};
use cutaway_io::load::load_mesh_file;
use glam::DVec3;

use super::data::data;
use super::oracle::Oracle;

/// The models, and how many of their clips are looked at.
const MODELS: &[(&str, usize)] = &[
    ("RiggedSimple", 1),
    ("CesiumMan", 1),
    ("Fox", 3),
    ("AnimatedMorphCube", 1),
    ("MorphStressTest", 3),
    ("BoxAnimated", 1),
    ("CesiumMilkTruck", 1),
    ("Knight", 3),
];

/// Times per clip, from its beginning to its end.
const TIMES: usize = 10;

/// Share of the size that points may differ by: f64 leaves a few thousand times less.
const SAME: f64 = 1e-9;

pub(crate) fn model(name: &str) -> Option<PathBuf> {
    let path = data()?.join("animated").join(format!("{name}.glb"));
    assert!(path.is_file(), "no model at {}", path.display());
    Some(path)
}

/// All parts of a model at some times of some clips: name, clip, time, parts.
pub(crate) fn moments() -> Vec<(&'static str, usize, f64, Vec<Part>)> {
    let mut moments = Vec::new();
    for (name, clips) in MODELS {
        let Some(path) = model(name) else { continue };
        let parts = load_mesh_file(&path).unwrap().parts;
        let all = parts[0].clips().len();
        assert!(all >= *clips, "{name} has {all} clips");
        for k in 0..*clips {
            let clip = k * all / clips;
            for t in 0..TIMES {
                let time_s = parts[0].clips()[clip].duration_s * t as f64 / (TIMES - 1) as f64;
                let now = parts.iter().map(|p| p.at_time(clip, time_s)).collect();
                moments.push((*name, clip, time_s, now));
            }
        }
    }
    moments
}

fn points(parts: &[Part]) -> Vec<DVec3> {
    let placed = |part: &Part| -> Vec<DVec3> {
        let mesh = part.posed_mesh();
        let place = |p: &DVec3| part.world_from_part.transform_point3(*p);
        mesh.positions.iter().map(place).collect()
    };
    parts.iter().flat_map(placed).collect()
}

/// The first point of `some` that has none of `others` within a distance.
fn lonely(some: &[DVec3], others: &[DVec3], distance: f64) -> Option<DVec3> {
    let mut sorted = others.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x));
    some.iter().copied().find(|p| {
        let first = sorted.partition_point(|q| q.x < p.x - distance);
        let near = sorted[first..].iter().take_while(|q| q.x <= p.x + distance);
        !near.into_iter().any(|q| q.distance(*p) <= distance)
    })
}

/// How two sets of points differ, if they do.
fn difference(ours: &[DVec3], theirs: &[DVec3]) -> Option<String> {
    let size = Bounds::from_points(theirs.iter().copied()).size().length();
    if let Some(p) = lonely(ours, theirs, SAME * size) {
        return Some(format!("{p} is a vertex only here"));
    }
    let lost = lonely(theirs, ours, SAME * size);
    lost.map(|p| format!("{p} is a vertex only in the file"))
}

#[test]
fn models_stand_where_their_files_say() {
    let mut compared = 0;
    let mut oracle: Option<(&str, Oracle)> = None;
    for (name, clip, time_s, parts) in moments() {
        if oracle.as_ref().is_none_or(|(of, _)| *of != name) {
            let bytes = std::fs::read(model(name).unwrap()).unwrap();
            oracle = Some((name, Oracle::new(&bytes)));
        }
        let (_, oracle) = oracle.as_ref().unwrap();
        assert_eq!(oracle.clips(), parts[0].clips().len(), "{name}");
        let duration_s = parts[0].clips()[clip].duration_s;
        assert_eq!(oracle.duration_s(clip), duration_s, "{name}");
        let ours = points(&parts);
        if let Some(why) = difference(&ours, &oracle.points(clip, time_s)) {
            panic!("{name}, clip {clip}, {time_s} s: {why}");
        }
        compared += ours.len();
    }
    println!("{compared} vertices compared");
}

#[test]
fn the_oracle_can_disagree() {
    let Some(path) = model("CesiumMan") else {
        return;
    };
    let oracle = Oracle::new(&std::fs::read(&path).unwrap());
    let part = &load_mesh_file(&path).unwrap().parts[0];
    let theirs = oracle.points(0, 0.7);
    let now = part.at_time(0, 0.7);
    let ours = |part: &Part| points(std::slice::from_ref(part));
    assert_eq!(difference(&ours(&now), &theirs), None, "nothing is planted");

    let late = part.at_time(0, 0.7 + 1e-6);
    assert!(difference(&ours(&late), &theirs).is_some(), "another time");
    let mut turned = now.clone();
    turned.pose.joints.swap(3, 4);
    assert!(
        difference(&ours(&turned), &theirs).is_some(),
        "swapped joints"
    );
    let mut bound = now.clone();
    bound.pose.joints.clear();
    assert!(difference(&ours(&bound), &theirs).is_some(), "no joints");
    let mut lost = ours(&now);
    lost.remove(100);
    let why = difference(&lost, &theirs);
    assert!(
        why.is_some_and(|w| w.contains("only in the file")),
        "a lost vertex"
    );
}

#[test]
fn closed_models_stay_closed() {
    for (name, clip, time_s, parts) in moments() {
        let rest = load_mesh_file(&model(name).unwrap()).unwrap().parts;
        let is_first = clip == 0 && time_s <= 0.0;
        for (part, rest) in parts.iter().zip(&rest) {
            let closed = Topology::new(&rest.mesh).closed;
            if is_first {
                let word = if closed { "closed" } else { "open" };
                println!("{name}: {} is {word}", part.name);
            }
            let posed = part.posed_mesh();
            assert_eq!(
                posed.triangles, rest.mesh.triangles,
                "{name}, {}",
                part.name
            );
            assert_eq!(posed.defect(), None, "{name}, {}", part.name);
            // Parts that touch nothing but themselves have a volume that hardly changes: a tear or a flip would show.
            if closed && ["RiggedSimple", "CesiumMan", "Fox"].contains(&name) {
                let share = posed.volume() / rest.mesh.volume();
                assert!((0.5..2.0).contains(&share), "{name} at {time_s} s: {share}");
            }
        }
    }
}

#[test]
fn what_does_not_bend_is_not_posed() {
    let Some(path) = model("Knight") else { return };
    let parts = load_mesh_file(&path).unwrap().parts;
    for part in &parts {
        let now = part.at_time(0, 0.3);
        let is_rigid = now.pose.is_rest();
        assert_eq!(is_rigid, now.motion.is_none(), "{}", part.name);
        // Weapons hang on a node, arms and body on several joints.
        let is_weapon = part.name.contains("Sword") || part.name.contains("Shield");
        assert!(is_rigid || !is_weapon, "{}", part.name);
    }
    let Some(path) = model("CesiumMilkTruck") else {
        return;
    };
    let parts = load_mesh_file(&path).unwrap().parts;
    let now: Vec<Part> = parts.iter().map(|p| p.at_time(0, 0.4)).collect();
    assert!(
        std::sync::Arc::ptr_eq(&now[1].mesh, &now[2].mesh),
        "the wheels share a mesh"
    );
    assert!(now.iter().all(|p| p.pose.is_rest()));
    assert_eq!(
        now[0].world_from_part, parts[0].world_from_part,
        "the body stays"
    );
    assert_ne!(
        now[1].world_from_part, parts[1].world_from_part,
        "the wheels turn"
    );
}
