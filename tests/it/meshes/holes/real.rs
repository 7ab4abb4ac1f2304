//! Real meshes that are open, and their holes.

use cutaway_io::document::{Document, part};
use cutaway_io::load::Assets;

use super::*;

/// The boundary edges of a file before and after, and its holes that are closed, of all.
fn measure(file: &str) -> Option<(Topology, Topology)> {
    let path = data::data()?.join(file);
    let path = path.to_string_lossy().into_owned();
    let [before, after] = [false, true].map(|closes| {
        let mut document = Document::new();
        let draft = part(&path).with("close_holes", closes);
        document.add_part(draft).unwrap_or_else(|e| panic!("{e}"));
        let scene = document.resolve(0.0, &mut Assets::default());
        let scene = scene.unwrap_or_else(|e| panic!("{e}"));
        Topology::from_parts(&scene.parts)
    });
    Some((before, after))
}

#[test]
fn open_meshes_have_fewer_open_edges_and_no_worse_ones() {
    for file in [
        "organic/stanford_bunny.obj",
        "organic/angel_scan.ply",
        "messy/b9_shell.obj",
        "messy/antique_camera.glb",
        "messy/chair.obj",
        "messy/triangle_soup.stl",
        "animated/BoxAnimated.glb",
        "animated/CesiumMilkTruck.glb",
        "animated/Knight.glb",
    ] {
        let Some((before, after)) = measure(file) else {
            return;
        };
        assert!(after.boundary_edges <= before.boundary_edges, "{file}");
        assert!(
            after.non_manifold_edges <= before.non_manifold_edges,
            "{file}"
        );
        assert!(
            after.inconsistent_edges <= before.inconsistent_edges,
            "{file}"
        );
        assert!(after.coincident_faces <= before.coincident_faces, "{file}");
        assert_eq!(after.vertices, before.vertices, "{file}");
    }
    // Loose triangles stay what they are.
    let soup =
        measure("messy/triangle_soup.stl").map(|(before, after)| [before.faces, after.faces]);
    assert_eq!(soup, soup.map(|[before, _]| [before; 2]));
}
