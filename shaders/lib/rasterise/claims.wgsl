// Codes of the triangles that claim pixels: the side that shows in the highest bit, so that of triangles that coincide a maximum finds
// one that faces the eye; the rest is counted from the end, so that it finds the first of equals. 0 is no triangle's.

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
