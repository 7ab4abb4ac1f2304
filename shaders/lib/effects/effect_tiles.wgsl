// The tiles of the picture that effects draw: those that show something, or have such a tile within the reach of a stroke, and those of
// the frame before. All others are background already, without a stroke. Tiles are as large as touched ones.

#define_import_path cutaway::effect_tiles

// Inputs of the background: when they change, the whole picture is cleared.
struct Backdrop {
    size_px: vec2<u32>,
    band: vec2<u32>,
    // Bits of what is behind the first row and the last.
    top: vec4<u32>,
    bottom: vec4<u32>,
}

struct EffectTile {
    // The tile that is in this place of the list.
    listed: u32,
    is_shown: u32,
    // Whether the frame before has drawn it for what is shown.
    was_listed: u32,
}
