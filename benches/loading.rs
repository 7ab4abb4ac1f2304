//! How long it takes to open a mesh: read the file, parse it, weld it, check it.
//!
//! Files of 10 thousand and 200 thousand triangles in each format lie in a folder for temporary files, so that reading is reading
//! from the cache of the system. Formats differ in what there is to do: OBJ is text, corners of STL must be welded.

#[path = "common/files.rs"]
mod files;
#[path = "common/meshes.rs"]
mod meshes;

use std::hint::black_box;
use std::path::PathBuf;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use cutaway::scene::Mesh;
use cutaway_io::load::load_mesh_file;

/// A folder that is gone with this value.
struct Folder(PathBuf);

impl Folder {
    fn make() -> Self {
        let path = std::env::temp_dir().join(format!("cutaway-loading-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder for files");
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // Nothing can be done about what cannot be removed.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

type Format = (&'static str, fn(&Mesh) -> Vec<u8>);

const FORMATS: [Format; 4] = [
    ("obj", files::obj),
    ("ply", files::ply),
    ("stl", files::stl),
    ("glb", files::glb),
];

fn loading(criterion: &mut Criterion) {
    let folder = Folder::make();
    for (extension, bytes) in FORMATS {
        let mut group = criterion.benchmark_group(format!("loading/{extension}"));
        for (name, around, along) in [("10k", 100, 50), ("200k", 500, 200)] {
            let mesh = meshes::ribbed_torus(around, along);
            let path = folder.0.join(format!("{name}.{extension}"));
            let bytes = bytes(&mesh);
            std::fs::write(&path, &bytes).expect("a file is written");
            let loaded = load_mesh_file(&path).expect("what was just written loads");
            let [part] = loaded.parts.as_slice() else {
                panic!("{} parts in {path:?}", loaded.parts.len());
            };
            assert_eq!(part.mesh.triangles.len(), mesh.triangles.len(), "{path:?}");
            assert_eq!(part.mesh.positions.len(), mesh.positions.len(), "{path:?}");
            group.throughput(Throughput::Bytes(bytes.len() as u64));
            group.bench_function(BenchmarkId::from_parameter(name), |b| {
                b.iter(|| load_mesh_file(black_box(&path)).expect("it has loaded before"));
            });
        }
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = loading
}
criterion_main!(benches);
