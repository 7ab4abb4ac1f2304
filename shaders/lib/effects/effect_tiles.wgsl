// The picture tiles that effects draw: tiles that are not background, tiles within stroke reach of these, and the tiles of the previous
// frame. All other tiles already are background without strokes. Tiles have the size of touched tiles.

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
    // Nonzero if the previous frame drew the tile because it was not background.
    was_listed: u32,
}
