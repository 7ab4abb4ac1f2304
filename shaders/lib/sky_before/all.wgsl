// Nothing hides the sky that the relief does not hide.

#define_import_path cutaway::sky_before

fn sky_before(pixel: u32) -> f32 {
    return 1.0;
}
