//! Small glTF documents, put together as text with their numbers in a data URI.

use base64::prelude::{BASE64_STANDARD, Engine as _};
use cutaway_io::load::{Loaded, load_mesh_file};
use serde_json::{Value, json};

use super::command::Scratch;

/// A document whose JSON may be changed at will before it is written.
#[derive(Clone)]
pub(crate) struct Document {
    pub(crate) json: Value,
    bytes: Vec<u8>,
}

impl Document {
    /// One scene with the node 0, which shows the mesh 0.
    pub(crate) fn new() -> Self {
        Self {
            json: json!({
                "asset": {"version": "2.0"},
                "scene": 0,
                "scenes": [{"nodes": [0]}],
                "nodes": [{"name": "one", "mesh": 0}],
                "meshes": [],
                "accessors": [],
                "bufferViews": [],
            }),
            bytes: Vec::new(),
        }
    }

    pub(crate) fn push(&mut self, list: &str, item: Value) -> usize {
        if self.json[list].is_null() {
            self.json[list] = json!([]);
        }
        let items = self.json[list].as_array_mut().unwrap();
        items.push(item);
        items.len() - 1
    }

    /// Bytes as a buffer view, aligned to 4.
    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view = json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()});
        self.bytes.extend(bytes);
        self.push("bufferViews", view)
    }

    pub(crate) fn accessor(
        &mut self,
        bytes: &[u8],
        number: u32,
        kind: &str,
        count: usize,
    ) -> usize {
        let view = self.view(bytes);
        let accessor =
            json!({"bufferView": view, "componentType": number, "type": kind, "count": count});
        self.push("accessors", accessor)
    }

    pub(crate) fn floats<const N: usize>(&mut self, items: &[[f32; N]]) -> usize {
        let kind = ["", "SCALAR", "VEC2", "VEC3", "VEC4"]
            .get(N)
            .unwrap_or(&"MAT4");
        let bytes: Vec<u8> = items
            .iter()
            .flatten()
            .flat_map(|c| c.to_le_bytes())
            .collect();
        let accessor = self.accessor(&bytes, 5126, kind, items.len());
        if N == 3 {
            // Positions must state theirs; wrong ones are read by nobody.
            self.json["accessors"][accessor]["min"] = json!([0, 0, 0]);
            self.json["accessors"][accessor]["max"] = json!([1, 1, 1]);
        }
        accessor
    }

    pub(crate) fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let corners = triangles.iter().flatten();
        let bytes: Vec<u8> = corners.clone().flat_map(|i| i.to_le_bytes()).collect();
        self.accessor(&bytes, 5125, "SCALAR", corners.count())
    }

    /// A clip with one channel; `values` is an accessor.
    pub(crate) fn clip(
        &mut self,
        node: usize,
        path: &str,
        way: &str,
        times: &[f32],
        values: usize,
    ) {
        let times: Vec<[f32; 1]> = times.iter().map(|t| [*t]).collect();
        let times = self.floats(&times);
        self.push(
            "animations",
            json!({
                "name": path,
                "channels": [{"sampler": 0, "target": {"node": node, "path": path}}],
                "samplers": [{"input": times, "output": values, "interpolation": way}],
            }),
        );
    }

    pub(crate) fn text(&self) -> String {
        let mut json = self.json.clone();
        let uri = format!(
            "data:application/octet-stream;base64,{}",
            BASE64_STANDARD.encode(&self.bytes)
        );
        json["buffers"] = json!([{"byteLength": self.bytes.len(), "uri": uri}]);
        json.to_string()
    }

    pub(crate) fn load(&self) -> Loaded {
        self.try_load().unwrap_or_else(|e| panic!("{e}"))
    }

    pub(crate) fn try_load(&self) -> cutaway::Result<Loaded> {
        let folder = Scratch::new("mesh");
        load_mesh_file(&folder.write("motion.gltf", self.text().as_bytes()))
    }
}

/// Corners of the unit cube and its triangles.
pub(crate) fn cube() -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    prism(&[0.0, 1.0], 1.0)
}

/// A closed square prism along x with a ring of four vertices at each station.
pub(crate) fn prism(stations: &[f32], size: f32) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let ring = [[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]];
    let at = |x: &f32| ring.map(|[y, z]| [*x, y, z]);
    let positions = stations.iter().flat_map(at).collect();
    let mut triangles = vec![[0, 2, 1], [0, 3, 2]];
    for s in 0..stations.len() as u32 - 1 {
        for k in 0..4 {
            let (a, b) = (4 * s + k, 4 * s + (k + 1) % 4);
            triangles.extend([[a, b, b + 4], [a, b + 4, a + 4]]);
        }
    }
    let last = 4 * (stations.len() as u32 - 1);
    triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|i| i + last)));
    (positions, triangles)
}

/// A document that shows a cube without motion.
pub(crate) fn cube_document() -> Document {
    let mut document = Document::new();
    let (positions, triangles) = cube();
    let (positions, indices) = (document.floats(&positions), document.indices(&triangles));
    document.push(
        "meshes",
        json!({"primitives": [{"attributes": {"POSITION": positions}, "indices": indices}]}),
    );
    document
}

/// A bar from x = 0 to 2 on two joints: node 1 at the origin, node 2 below it at x = 1. The ring in the middle belongs to
/// both by halves. Node 0 shows it and stands elsewhere, which must not matter.
pub(crate) fn bar_document() -> Document {
    let mut document = Document::new();
    let (positions, triangles) = prism(&[0.0, 1.0, 2.0], 0.5);
    let (positions, indices) = (document.floats(&positions), document.indices(&triangles));
    let joints: Vec<u8> = [[0_u8, 0, 0, 0], [0, 1, 0, 0], [1, 0, 0, 0]]
        .iter()
        .flat_map(|j| std::iter::repeat_n(*j, 4))
        .flatten()
        .collect();
    let joints = document.accessor(&joints, 5121, "VEC4", 12);
    let weights: Vec<[f32; 4]> = [
        [1.0, 0.0, 0.0, 0.0],
        [0.5, 0.5, 0.0, 0.0],
        [1.0, 0.0, 0.0, 0.0],
    ]
    .iter()
    .flat_map(|w| std::iter::repeat_n(*w, 4))
    .collect();
    let weights = document.floats(&weights);
    let mut inverse = [[0.0_f32; 16]; 2];
    for matrix in &mut inverse {
        (0..4).for_each(|k| matrix[5 * k] = 1.0);
    }
    inverse[1][12] = -1.0;
    let inverse = document.floats(&inverse);
    document.push(
        "meshes",
        json!({"primitives": [{
            "attributes": {"POSITION": positions, "JOINTS_0": joints, "WEIGHTS_0": weights},
            "indices": indices,
        }]}),
    );
    document.json["nodes"] = json!([
        {"name": "bar", "mesh": 0, "skin": 0, "translation": [7, 8, 9]},
        {"name": "root", "children": [2]},
        {"name": "tip", "translation": [1, 0, 0]},
    ]);
    document.json["scenes"] = json!([{"nodes": [0, 1]}]);
    document.push(
        "skins",
        json!({"joints": [1, 2], "inverseBindMatrices": inverse}),
    );
    document
}

/// A rotation about z as glTF has it.
pub(crate) fn about_z(degrees: f32) -> [f32; 4] {
    let half = degrees.to_radians() / 2.0;
    [0.0, 0.0, half.sin(), half.cos()]
}

/// A bar that bends by a quarter turn in a second.
pub(crate) fn bending_bar() -> Document {
    let mut document = bar_document();
    let turns = document.floats(&[about_z(0.0), about_z(90.0)]);
    document.clip(2, "rotation", "LINEAR", &[0.0, 1.0], turns);
    document
}

/// A cube with two morph targets: the first lifts the top by 1 in y, the second moves everything by 1 in z.
pub(crate) fn morphing_cube() -> Document {
    let mut document = cube_document();
    let (positions, _) = cube();
    let lift: Vec<[f32; 3]> = positions.iter().map(|[_, y, _]| [0.0, *y, 0.0]).collect();
    let lift = document.floats(&lift);
    let shift = document.floats(&[[0.0, 0.0, 1.0]; 8]);
    document.json["meshes"][0]["primitives"][0]["targets"] =
        json!([{"POSITION": lift}, {"POSITION": shift}]);
    let weights = document.floats(&[[0.0], [0.0], [1.0], [0.5]]);
    document.clip(0, "weights", "LINEAR", &[0.0, 1.0], weights);
    document
}
