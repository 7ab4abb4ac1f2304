//! Finds the picture tiles that effects process: tiles that are not background, tiles within stroke reach of these, and the tiles of the
//! previous frame, which must become background again. All other tiles already are background.
//!
//! One pass over the layers, one over the tiles, one over the picture where its background changes; 12 bytes per tile of 16 x 16 pixels.
//! The list persists between frames, with the inputs of its background. It is built from layers alone, whichever rasteriser drew them.
//!
//! Cannot: speed up unsharp occlusion, which has a wide reach, or effects that draw on the background, such as the ground shadow and
//! ghosts: these process the whole picture.

use super::ambient::horizon;
use super::backdrop::backdrop;
use super::borders::StrokeBuffers;
use super::effect_tiles::EffectTiles;
use super::halo;
use super::style_numbers::reach_px;
use crate::passes::{SceneBuffers, TILE_PX, tiles_in};
use crate::plan::{Binding, BufferRole, Clock, Contents, Pass, Plan, Resource, ResourceId, Work};
use crate::scene::View;
use crate::scene::style::{Paper, Style};
use crate::shader::Shader;

/// Bytes before the first tile, and bytes per tile, in the layout of `shaders/lib/effects/effect_tile_list.wgsl`.
const BYTES_OF_HEAD: u64 = 112;
const BYTES_OF_TILE: u64 = 12;

/// Tiles per workgroup in the pass over tiles.
const TILES_LISTED_AT_ONCE: u32 = 64;

/// Number of rows around a band in which effects compute values for the band. A horizon search reaches farther, but reads only layers.
fn computed_halo_rows(style: &Style, view: &View) -> u32 {
    halo::halo_rows(style, view.band[1]).max(horizon::SMOOTH_PX + 1)
}

impl EffectTiles {
    /// Finds these tiles from the layers of the frame, and resets all others to background without strokes. Returns none if an effect
    /// draws on the background.
    pub(super) fn find(
        plan: &mut Plan,
        scene: &SceneBuffers<'_>,
        style_numbers: &Binding,
        layers: ResourceId,
        (picture, strokes): (ResourceId, Option<StrokeBuffers>),
    ) -> Option<Self> {
        let model = scene.input.model;
        let style = &model.prepared.style;
        if style.ghost.is_drawn() || model.ground.is_some() {
            return None;
        }
        let size_px = scene.input.view.size_px;
        let tile_count = tiles_in(size_px);
        // The size of a WGSL struct is a multiple of its alignment, even if the list has a single tile.
        let bytes = (BYTES_OF_HEAD + u64::from(tile_count) * BYTES_OF_TILE).next_multiple_of(16);
        let room = Contents::in_pieces(bytes, Vec::new(), true);
        let list = Resource::upload("effect tiles", BufferRole::Storage, room, Clock::Frame);
        let list = plan.add_resource(list);
        let drawn = Binding::update("effect_tiles", list);
        let tiles = Self { list, tile_count };
        // The gradient uses no style numbers.
        let numbers = (style.paper != Paper::Gradient).then(|| style_numbers.clone());
        let mut bindings = vec![
            scene.frame.clone(),
            Binding::read("layers", layers),
            drawn.clone(),
        ];
        bindings.extend(numbers.clone());
        plan.add_pass(Pass::new(
            "find tiles",
            "marks the tiles that are not background: effects skip all others",
            Shader::from("effects/tiles/show.wgsl").with(backdrop(style.paper)),
            bindings,
            Work::over(size_px),
        ));
        let mut bindings = vec![
            scene.frame.clone(),
            tiles.listed(),
            Binding::write("picture", picture),
        ];
        bindings.extend(numbers);
        let shader = Shader::from("effects/tiles/clear.wgsl").with(backdrop(style.paper));
        let shader = match strokes {
            Some(StrokeBuffers { borders, strokes }) => {
                bindings.push(Binding::write("borders", borders));
                bindings.push(Binding::write("strokes", strokes));
                shader.with("lib/blank_strokes/drawn.wgsl")
            }
            None => shader.with("lib/blank_strokes/none.wgsl"),
        };
        plan.add_pass(Pass::new(
            "clear picture",
            "the whole picture becomes background if the previous frame had another background, or on the first frame",
            shader,
            bindings,
            tiles.shared(),
        ));
        let reach_px = match strokes {
            // A border lies between two samples, one of which may be in a background tile.
            Some(_) => reach_px(style, scene.input.view.band[1]) as u32 + 1,
            None => 0,
        };
        let list_tiles = Pass::new(
            "list tiles",
            "tiles that are not background, tiles within stroke reach of these, and the tiles of the previous frame",
            "effects/tiles/list.wgsl",
            vec![scene.frame.clone(), drawn],
            Work::Compute {
                groups: [tile_count.div_ceil(TILES_LISTED_AT_ONCE), 1, 1],
            },
        );
        // Rows outside the kept part of the picture are skipped, except for the computed rows that kept rows read.
        let [above, below] = scene.input.view.halo_rows;
        let asked = computed_halo_rows(style, scene.input.view);
        let end_row = size_px[1] - below.saturating_sub(asked);
        plan.add_pass(list_tiles.with_constants(vec![
            ("reach", f64::from(reach_px.div_ceil(TILE_PX))),
            ("first_row", f64::from(above.saturating_sub(asked))),
            ("end_row", f64::from(end_row)),
        ]));
        Some(tiles)
    }
}
