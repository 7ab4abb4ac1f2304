//! Writes Wavefront OBJ. Each solid is an object with a group for its faces and one for its caps, whose materials are in a library. Each
//! image has a material, and its file is in the same folder.
//!
//! Numbers have as few digits as still read back exactly. Names are single words ([`word_of`]), unique among parts and materials.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use glam::{Vec2, Vec3};

use super::images::{Images, bits, file_name, upwards, word_of};
use super::painted::by_vertex;
use super::solid::{EncodedMesh, Solid, Unwritable, bytes_of};

pub(super) fn encoded(solids: &[Solid<'_>], stem: &str) -> Result<EncodedMesh, Unwritable> {
    let images = Images::of(solids);
    let names = Names::of(solids, images.count());
    let library = (
        library_name(stem),
        library(solids, &names, stem).into_bytes(),
    );
    let mut beside = vec![library];
    beside.extend(images.files(stem)?);
    Ok(EncodedMesh {
        file: text(solids, &images, &names, stem).into_bytes(),
        beside,
    })
}

/// File name of the material library.
pub(super) fn library_name(stem: &str) -> String {
    format!("{}.mtl", word_of(stem))
}

fn text(solids: &[Solid<'_>], images: &Images, names: &Names, stem: &str) -> String {
    let mut text = format!("# written by cutaway\nmtllib {}\n", library_name(stem));
    let mut places = Places::default();
    let mut first = 1;
    for (index, (solid, name)) in solids.iter().zip(&names.solids).enumerate() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "o {name}");
        let colored = solid.has_colors().then(|| by_vertex(solid));
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
        if solid.faces > 0 {
            let _ = writeln!(text, "g {name}");
        }
        for (image, faces) in images.faces(index, solid) {
            let _ = writeln!(text, "usemtl {}", image.map_or(name, |i| &names.images[i]));
            for t in faces {
                let [a, b, c] = triangles[t].map(|i| i + first);
                let uv = solid.face(t).filter(|_| image.is_some()).map(|f| f.uv);
                let _ = match uv.map(|uv| uv.map(|at| places.number(at, &mut text))) {
                    None => writeln!(text, "f {a} {b} {c}"),
                    Some([u, v, w]) => writeln!(text, "f {a}/{u} {b}/{v} {c}/{w}"),
                };
            }
        }
        if solid.faces < triangles.len() {
            let cap = cap_of(name);
            let _ = writeln!(text, "g {cap}\nusemtl {cap}");
            for [a, b, c] in &triangles[solid.faces..] {
                let [a, b, c] = [a, b, c].map(|i| i + first);
                let _ = writeln!(text, "f {a} {b} {c}");
            }
        }
        first += vertices as u32;
    }
    text
}

/// Texture coordinates. Each is written once, before the first face that uses it.
#[derive(Default)]
struct Places(BTreeMap<[u32; 2], usize>);

impl Places {
    fn number(&mut self, at: Vec2, text: &mut String) -> usize {
        let next = self.0.len() + 1;
        *self.0.entry(bits(at)).or_insert_with(|| {
            let [u, v] = upwards(at);
            let _ = writeln!(text, "vt {u} {v}");
            next
        })
    }
}

fn library(solids: &[Solid<'_>], names: &Names, stem: &str) -> String {
    let mut text = "# written by cutaway\n".to_owned();
    let mut put = |name: &str, color: Vec3, image: Option<String>| {
        let [r, g, b] = bytes_of(color).map(|c| format!("{:.4}", f64::from(c) / 255.0));
        let _ = writeln!(text, "newmtl {name}\nKd {r} {g} {b}\nd 1\nillum 1");
        if let Some(image) = image {
            let _ = writeln!(text, "map_Kd {image}");
        }
    };
    for (solid, name) in solids.iter().zip(&names.solids) {
        // Readers multiply vertex colours by material colours.
        let plain = |color| if solid.has_colors() { Vec3::ONE } else { color };
        put(name, plain(solid.color), None);
        put(&cap_of(name), plain(solid.cap_color), None);
    }
    for (image, name) in names.images.iter().enumerate() {
        put(name, Vec3::ONE, Some(file_name(stem, image)));
    }
    text
}

fn cap_of(name: &str) -> String {
    format!("{name}_cap")
}

/// Names without blanks. All differ from each other and from the names of caps.
struct Names {
    /// Names of the solids, which are also the names of their face materials.
    solids: Vec<String>,
    /// Names of the materials that have images.
    images: Vec<String>,
}

impl Names {
    fn of(solids: &[Solid<'_>], images: usize) -> Self {
        let mut taken = BTreeSet::new();
        let mut unique = |wanted: &str| {
            let wanted = word_of(wanted);
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
        Self {
            solids: solids.iter().map(|solid| unique(solid.name)).collect(),
            images: (0..images).map(|i| unique(&format!("image_{i}"))).collect(),
        }
    }
}
