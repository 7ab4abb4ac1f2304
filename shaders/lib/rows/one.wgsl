// There is one part.

#define_import_path cutaway::rows

fn row_of_triangle(triangle: u32) -> u32 {
    return 0u;
}
