// Codes of the triangles that claim pixels: counted from the end, so that a maximum finds the first of equals, and the side
// that shows in the lowest bit. 0 is nobody's.

#define_import_path cutaway::claims

fn code_of(triangle: u32, front: bool) -> u32 {
    return ((0x7fffffffu - triangle) << 1u) | select(0u, 1u, front);
}

fn triangle_of(code: u32) -> u32 {
    return 0x7fffffffu - (code >> 1u);
}

fn is_front(code: u32) -> bool {
    return (code & 1u) != 0u;
}
