// What is known about all crossings along a ray, and about those in front of a depth.

#define_import_path cutaway::passed

struct Head {
    // Number of crossings.
    count: u32,
    // The sides where the ray starts.
    sides: u32,
    // Clip-surfaces of computed crossings, in order, four bits each; unused where crossings are listed.
    order: u32,
}

struct Before {
    // Number of crossings in front.
    behind: u32,
    // Sides after these crossings.
    sides: u32,
}
