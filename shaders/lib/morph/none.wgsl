// No morph targets: vertices stay in the rest pose.

#define_import_path cutaway::morph

fn morphed(point: vec3<f32>, vertex: u32) -> vec3<f32> {
    return point;
}
