// No deformers.

#define_import_path cutaway::deform

#import cutaway::pose::Standing

fn outward_at(vertex: u32) -> vec3<f32> {
    return vec3<f32>(0.0);
}

fn deformed(at: Standing) -> Standing {
    return at;
}
