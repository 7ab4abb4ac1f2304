// The picture tiles that effects draw: those that show something, those within stroke reach of such a tile, and those of the previous
// frame. All others already are background without strokes. Tiles have the size of touched tiles.

#define_import_path cutaway::effect_tiles

// Inputs of the background: when they change, the whole picture is cleared.
struct Backdrop {
    size_px: vec2<u32>,
    band: vec2<u32>,
    // Bits of the background colours of the first row and the last.
    top: vec4<u32>,
    bottom: vec4<u32>,
}

struct EffectTile {
    // The tile at this index of the list.
    listed: u32,
    is_shown: u32,
    // Whether the previous frame drew the tile because it showed something.
    was_listed: u32,
}
