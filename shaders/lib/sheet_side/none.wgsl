// Side of a sheet on which a point lies, where no sheet has a facing and so the side is not used.

#define_import_path cutaway::sheet_side

fn height_over_sheet(surface: u32, point: vec3<f32>) -> f32 {
    return 0.0;
}
