// The tiles that effects draw, for the effects. Bound as @group(2) @binding(6).

#define_import_path cutaway::drawn_list

#import cutaway::drawn_tiles::{DrawnTile, Kept}

struct Drawn {
    count: u32,
    before: Kept,
    now: Kept,
    tiles: array<DrawnTile>,
}

@group(2) @binding(6) var<storage, read> drawn: Drawn;
