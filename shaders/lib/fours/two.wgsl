// There are more than four planes. Where there are not, the shader contains no code for the others: devices may run untaken branches.

#define_import_path cutaway::fours

fn has_second_four() -> bool {
    return true;
}
