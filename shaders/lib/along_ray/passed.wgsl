// The crossings in front of a depth along a ray.

#define_import_path cutaway::passed

struct Before {
    // Number of crossings in front.
    behind: u32,
    // Sides after these crossings.
    sides: u32,
}
