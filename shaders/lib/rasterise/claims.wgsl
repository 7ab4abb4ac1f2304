// Codes of the triangles that claim pixels: the visible side in the highest bit, so that among coincident triangles a maximum finds one
// that faces the eye; the rest is counted from the end, so that a maximum finds the first of equals. 0 is not the code of any triangle.

#define_import_path cutaway::claims

fn code_of(triangle: u32, front: bool) -> u32 {
    return (0x7fffffffu - triangle) | select(0u, 0x80000000u, front);
}

fn triangle_of(code: u32) -> u32 {
    return 0x7fffffffu - (code & 0x7fffffffu);
}

fn is_front(code: u32) -> bool {
    return (code & 0x80000000u) != 0u;
}
