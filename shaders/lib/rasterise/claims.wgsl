// Codes of the triangles that claim pixels. The highest bit is the visible side, so that among coincident triangles the maximum faces the
// eye. The other bits count triangles from the last, so that among equals the maximum is the first. No triangle has the code 0.

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
