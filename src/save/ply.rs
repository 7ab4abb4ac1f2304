//! Binary PLY, little-endian: vertices as `double`, faces with their colour, the number of their part, and whether they are a cap.

use super::{Solid, bytes_of};

pub(super) fn encoded(solids: &[Solid<'_>]) -> Vec<u8> {
    let total = |of: fn(&Solid<'_>) -> usize| solids.iter().map(of).sum::<usize>();
    let vertices = total(|s| s.mesh.positions.len());
    let faces = total(|s| s.mesh.triangles.len());
    let names = solids.iter().enumerate().map(|(i, solid)| {
        let name: String = solid.name.chars().filter(|c| !c.is_control()).collect();
        format!("comment part {i} {name}\n")
    });
    let header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment written by cutaway\n{}element vertex {vertices}\n\
         property double x\nproperty double y\nproperty double z\nelement face {faces}\n\
         property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
         property int part\nproperty uchar cap\nend_header\n",
        names.collect::<String>()
    );
    let mut bytes = Vec::with_capacity(header.len() + 24 * vertices + 21 * faces);
    bytes.extend_from_slice(header.as_bytes());
    let coordinates = solids.iter().flat_map(|s| &s.mesh.positions);
    for coordinate in coordinates.flat_map(|p| p.to_array()) {
        bytes.extend_from_slice(&coordinate.to_le_bytes());
    }
    let mut first = 0;
    for (part, solid) in (0_i32..).zip(solids) {
        let colors = [solid.color, solid.cap_color].map(bytes_of);
        for (index, triangle) in solid.mesh.triangles.iter().enumerate() {
            let is_cap = index >= solid.faces;
            bytes.push(3);
            for corner in triangle {
                bytes.extend_from_slice(&(first + corner).to_le_bytes());
            }
            let own = solid.face_colors.as_ref().and_then(|c| c.get(index));
            bytes.extend_from_slice(own.unwrap_or(&colors[usize::from(is_cap)]));
            bytes.extend_from_slice(&part.to_le_bytes());
            bytes.push(u8::from(is_cap));
        }
        first += solid.mesh.positions.len() as u32;
    }
    bytes
}
