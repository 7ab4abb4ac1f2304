//! Wavefront OBJ: an object for each solid, a group for its faces and one for its caps, and their materials in a library.
//!
//! Numbers are as short as they can be read back from. Names have no blanks in OBJ, nor what begins a comment or
//! goes on in the next line, and are made different.

use std::collections::BTreeSet;
use std::fmt::Write;

use glam::Vec3;

use super::painted::by_vertex;
use super::{Solid, bytes_of};

pub(super) fn encoded(solids: &[Solid<'_>], stem: &str) -> String {
    let mut text = format!("# written by cutaway\nmtllib {stem}.mtl\n");
    let mut first = 1;
    for (solid, name) in solids.iter().zip(names(solids)) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "o {name}");
        let colored = solid.coat.is_some().then(|| by_vertex(solid));
        let (vertices, triangles) = match &colored {
            None => (solid.mesh.positions.len(), &solid.mesh.triangles),
            Some((vertices, triangles)) => (vertices.len(), triangles),
        };
        match &colored {
            None => {
                for p in &solid.mesh.positions {
                    let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
                }
            }
            Some((vertices, _)) => {
                for vertex in vertices {
                    let p = solid.mesh.positions[vertex.at as usize];
                    let [r, g, b, _] = vertex.color.map(|c| f64::from(c) / 255.0);
                    let _ = writeln!(text, "v {} {} {} {r:.4} {g:.4} {b:.4}", p.x, p.y, p.z);
                }
            }
        }
        let (faces, caps) = triangles.split_at(solid.faces);
        for (group, triangles) in [(name.clone(), faces), (cap_of(&name), caps)] {
            if triangles.is_empty() {
                continue;
            }
            let _ = writeln!(text, "g {group}\nusemtl {group}");
            for [a, b, c] in triangles.iter().map(|t| t.map(|i| i + first)) {
                let _ = writeln!(text, "f {a} {b} {c}");
            }
        }
        first += vertices as u32;
    }
    text
}

pub(super) fn material_library(solids: &[Solid<'_>]) -> String {
    let mut text = "# written by cutaway\n".to_owned();
    for (solid, name) in solids.iter().zip(names(solids)) {
        // Colours of vertices are taken times those of materials.
        let is_coated = solid.coat.is_some();
        let plain = |color| if is_coated { Vec3::ONE } else { color };
        for (material, color) in [
            (name.clone(), plain(solid.color)),
            (cap_of(&name), plain(solid.cap_color)),
        ] {
            let [r, g, b] = bytes_of(color).map(|c| format!("{:.4}", f64::from(c) / 255.0));
            let _ = writeln!(text, "newmtl {material}\nKd {r} {g} {b}\nd 1\nillum 1");
        }
    }
    text
}

fn cap_of(name: &str) -> String {
    format!("{name}_cap")
}

/// Names without blanks, no two alike, nor like the cap of another.
fn names(solids: &[Solid<'_>]) -> Vec<String> {
    let mut taken = BTreeSet::new();
    let unique = |solid: &Solid<'_>| {
        let plain = |c: char| {
            if c.is_whitespace() || c.is_control() || c == '#' || c == '\\' {
                '_'
            } else {
                c
            }
        };
        let wanted: String = solid.name.chars().map(plain).collect();
        let wanted = if wanted.is_empty() {
            "part".to_owned()
        } else {
            wanted
        };
        let numbered = (2..).map(|i| format!("{wanted}_{i}"));
        let mut all = std::iter::once(wanted.clone()).chain(numbered);
        let is_free = |name: &String| !taken.contains(name) && !taken.contains(&cap_of(name));
        let name = all.find(is_free).unwrap_or(wanted);
        taken.extend([name.clone(), cap_of(&name)]);
        name
    };
    solids.iter().map(unique).collect()
}
