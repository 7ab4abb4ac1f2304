// Only the relief occludes the sky.

#define_import_path cutaway::sky_before

fn sky_before(pixel: u32) -> f32 {
    return 1.0;
}
