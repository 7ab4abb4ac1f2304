// Sky visibility from the search around a pixel. Bound as @group(2) @binding(0).

#define_import_path cutaway::sky_before

@group(2) @binding(0) var<storage, read> open_sky: array<f32>;

fn sky_before(pixel: u32) -> f32 {
    return open_sky[pixel];
}
