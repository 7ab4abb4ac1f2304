// On which side of a sheet a point lies, where no sheet has a facing and so nobody asks.

#define_import_path cutaway::sheet_side

fn height_over_sheet(surface: u32, point: vec3<f32>) -> f32 {
    return 0.0;
}
