// The tiles that effects draw, while they are found. Bound as @group(2) @binding(6).

#define_import_path cutaway::drawn_marks

#import cutaway::drawn_tiles::{DrawnTile, Kept}

// As in `drawn_list`.
struct Drawn {
    count: atomic<u32>,
    before: Kept,
    now: Kept,
    tiles: array<DrawnTile>,
}

@group(2) @binding(6) var<storage, read_write> drawn: Drawn;
