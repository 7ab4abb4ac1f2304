// Less light where less of the sky is seen. Bound as @group(2) @binding(4).

#define_import_path cutaway::occlusion

#import cutaway::style::style

// 1 where nothing is hidden.
@group(2) @binding(4) var<storage, read> visibility: array<f32>;

fn occluded(color: vec3<f32>, pixel: u32, is_cap: bool) -> vec3<f32> {
    let amount = select(style.occlusion_surface, style.occlusion_cap, is_cap);
    return color * (1.0 - amount * (1.0 - visibility[pixel]));
}
