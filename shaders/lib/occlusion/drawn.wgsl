// Light is reduced where less of the sky is visible. Bound as @group(2) @binding(4).

#define_import_path cutaway::occlusion

#import cutaway::style::style

// 1 where nothing is occluded.
@group(2) @binding(4) var<storage, read> visibility: array<f32>;

fn occluded_share(pixel: u32, is_cap: bool) -> f32 {
    return (1.0 - visibility[pixel]) * select(style.occlusion_surface, style.occlusion_cap, is_cap);
}

fn occluded(color: vec3<f32>, pixel: u32, is_cap: bool) -> vec3<f32> {
    return color * (1.0 - occluded_share(pixel, is_cap));
}
