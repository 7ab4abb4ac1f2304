// There are at most four planes.

#define_import_path cutaway::fours

fn has_second_four() -> bool {
    return false;
}
