// What lies before a depth of a ray.

#define_import_path cutaway::passed

struct Before {
    // How many crossings are in front.
    behind: u32,
    // Sides after these crossings.
    sides: u32,
}
