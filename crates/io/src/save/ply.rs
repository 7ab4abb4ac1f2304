//! Writes binary PLY, little-endian. Vertices are `double`. Faces have a colour, the number of their part, and a flag for caps. If faces
//! show images, each face has `texcoord` and `texnumber`, and each image a comment `TextureFile`, as in MeshLab. A face without an image
//! has the `texnumber` -1. [`plain`] writes only positions and triangles.

use cutaway::scene::Mesh;
use glam::{DVec3, Vec2};

use super::images::{Images, file_name, upwards};
use super::painted::{ColoredVertex, by_vertex};
use super::solid::{EncodedMesh, Solid, Unwritable, bytes_of};

/// Properties that hold a colour.
const COLOR: &str = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

/// Properties of a face with an image.
const PLACE: &str = "property list uchar float texcoord\nproperty int texnumber\n";

pub(super) fn encoded(solids: &[Solid<'_>], stem: &str) -> Result<EncodedMesh, Unwritable> {
    let images = Images::of(solids);
    let has_images = images.count() > 0;
    let has_colors = solids.iter().any(Solid::has_colors);
    let meshes: Vec<(Vec<ColoredVertex>, Vec<[u32; 3]>)> = match has_colors {
        true => solids.iter().map(by_vertex).collect(),
        false => Vec::new(),
    };
    let vertices: usize = match has_colors {
        true => meshes.iter().map(|(vertices, _)| vertices.len()).sum(),
        false => solids.iter().map(|s| s.mesh.positions.len()).sum(),
    };
    let faces: usize = solids.iter().map(|s| s.mesh.triangles.len()).sum();
    let names = solids.iter().enumerate().map(|(i, solid)| {
        let name: String = solid.name.chars().filter(|c| !c.is_control()).collect();
        format!("comment part {i} {name}\n")
    });
    let files =
        (0..images.count()).map(|i| format!("comment TextureFile {}\n", file_name(stem, i)));
    let comments: String = names.chain(files).collect();
    let of_vertices = if has_colors { COLOR } else { "" };
    let (place, face_bytes) = if has_images { (PLACE, 50) } else { ("", 21) };
    let of_faces = format!("{COLOR}property int part\nproperty uchar cap\n{place}");
    let header = header(&comments, [vertices, faces], [of_vertices, &of_faces]);
    let mut bytes = Vec::with_capacity(header.len() + 27 * vertices + face_bytes * faces);
    bytes.extend_from_slice(header.as_bytes());
    match has_colors {
        false => put_vertices(&mut bytes, solids.iter().flat_map(|s| &s.mesh.positions)),
        true => {
            for (solid, (vertices, _)) in solids.iter().zip(&meshes) {
                for vertex in vertices {
                    let at = &solid.mesh.positions[vertex.at as usize];
                    put_vertices(&mut bytes, std::iter::once(at));
                    bytes.extend_from_slice(&vertex.color[..3]);
                }
            }
        }
    }
    let mut first = 0;
    for (part, solid) in (0_i32..).zip(solids) {
        let colors = [solid.color, solid.cap_color].map(bytes_of);
        let (vertices, triangles) = match meshes.get(part as usize) {
            Some((vertices, triangles)) => (vertices.len(), triangles),
            None => (solid.mesh.positions.len(), &solid.mesh.triangles),
        };
        for (index, triangle) in triangles.iter().enumerate() {
            let is_cap = index >= solid.faces;
            put_face(&mut bytes, triangle.map(|corner| first + corner));
            let own = solid.face(index);
            let color = own.map_or(colors[usize::from(is_cap)], |face| mean(face.colors));
            bytes.extend_from_slice(&color);
            bytes.extend_from_slice(&part.to_le_bytes());
            bytes.push(u8::from(is_cap));
            if has_images {
                let image = own.and_then(|face| images.number(part as usize, face));
                let uv = own.filter(|_| image.is_some()).map(|face| face.uv);
                put_place(&mut bytes, uv.unwrap_or_default(), image);
            }
        }
        first += vertices as u32;
    }
    let (file, beside) = (bytes, images.files(stem)?);
    Ok(EncodedMesh { file, beside })
}

/// Writes the texture coordinates of the corners of a face, and the number of its image.
fn put_place(bytes: &mut Vec<u8>, uv: [Vec2; 3], image: Option<usize>) {
    bytes.push(6);
    for place in uv.into_iter().flat_map(upwards) {
        bytes.extend_from_slice(&(place as f32).to_le_bytes());
    }
    let number = image.map_or(-1, |i| i as i32);
    bytes.extend_from_slice(&number.to_le_bytes());
}

fn mean(corners: [[u8; 4]; 3]) -> [u8; 3] {
    [0, 1, 2].map(|i| (corners.map(|c| u32::from(c[i])).iter().sum::<u32>() / 3) as u8)
}

/// Encodes a mesh without name and colours.
pub(super) fn plain(mesh: &Mesh) -> Vec<u8> {
    let (vertices, faces) = (mesh.positions.len(), mesh.triangles.len());
    let mut bytes = header("", [vertices, faces], ["", ""]).into_bytes();
    bytes.reserve(24 * vertices + 13 * faces);
    put_vertices(&mut bytes, mesh.positions.iter());
    (mesh.triangles.iter()).for_each(|corners| put_face(&mut bytes, *corners));
    bytes
}

fn header(
    comments: &str,
    [vertices, faces]: [usize; 2],
    [of_vertices, of_faces]: [&str; 2],
) -> String {
    format!(
        "ply\nformat binary_little_endian 1.0\ncomment written by cutaway\n{comments}element vertex {vertices}\n\
         property double x\nproperty double y\nproperty double z\n{of_vertices}element face {faces}\n\
         property list uchar int vertex_indices\n{of_faces}end_header\n"
    )
}

fn put_vertices<'a>(bytes: &mut Vec<u8>, positions: impl Iterator<Item = &'a DVec3>) {
    for coordinate in positions.flat_map(|p| p.to_array()) {
        bytes.extend_from_slice(&coordinate.to_le_bytes());
    }
}

fn put_face(bytes: &mut Vec<u8>, corners: [u32; 3]) {
    bytes.push(3);
    for corner in corners {
        bytes.extend_from_slice(&corner.to_le_bytes());
    }
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;
    use crate::load::{Memory, load_mesh_file_from};
    use cutaway::generate::shapes::shape;

    #[test]
    fn a_plain_mesh_is_read_back_to_the_last_bit() {
        let mut mesh = Mesh::clone(&shape("knot").expect("a shape")[0].mesh);
        mesh.positions.iter_mut().for_each(|p| *p *= 1.0 / 3.0);
        mesh.corner_normals = None;
        let mut store = Memory::default();
        store.insert("knot.ply", plain(&mesh));
        let path = PathBuf::from("knot.ply");
        let loaded = load_mesh_file_from(&path, &store).expect("a mesh");
        let read = &loaded.parts[0].mesh;
        assert_eq!(
            (&read.positions, &read.triangles),
            (&mesh.positions, &mesh.triangles)
        );
        assert!(read.vertex_paint.is_none(), "it has no colours");
        mesh.positions[0].x = mesh.positions[0].x.next_up();
        assert_ne!(read.positions, mesh.positions, "one bit is seen");
    }
}
