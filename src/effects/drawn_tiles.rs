//! The tiles of the picture that effects go over: those in which something is shown, or beside which, as far as strokes reach, and those
//! of the frame before, which have to become background again. All others have been background all along.
//!
//! One pass over the layers, one over the tiles, and one over the picture where its background changes; 12 bytes a tile of 16 x 16 pixels.
//! The list outlives its frame, and says what the background hangs on. Whoever rasterised the mesh: layers are all that is asked.
//!
//! Cannot: help effects that draw on the background, as the shadow on the ground and ghosts do. There all of the picture is gone over.

use super::borders::Strokes;
use super::illustrate::{backdrop, reach_px};
use crate::passes::{SceneBuffers, TILE_PX, share_tiles};
use crate::plan::{Binding, Clock, Contents, Pass, Plan, Resource, ResourceId, Role, Work};
use crate::scene::style::Paper;
use crate::shader::Shader;

/// Bytes before the tiles, and of a tile: `shaders/lib/drawn_list.wgsl`.
const BYTES_OF_HEAD: u64 = 80;
const BYTES_OF_TILE: u64 = 12;

/// Tiles that a workgroup of the pass over tiles owns.
const TILES_LISTED_AT_ONCE: u32 = 64;

/// The tiles that effects of a frame go over.
#[derive(Clone, Copy, Debug)]
pub(super) struct DrawnTiles {
    list: ResourceId,
    tile_count: u32,
}

impl DrawnTiles {
    /// Finds them from the layers of the frame, and makes what is in none of them background, without strokes; none where effects draw on
    /// the background.
    pub(super) fn find(
        plan: &mut Plan,
        scene: &SceneBuffers<'_>,
        style_numbers: &Binding,
        layers: ResourceId,
        (picture, strokes): (ResourceId, Option<Strokes>),
    ) -> Option<Self> {
        let model = scene.input.model;
        let style = &model.prepared.style;
        if style.ghost.is_drawn() || model.ground.is_some() {
            return None;
        }
        let size_px = scene.input.view.size_px;
        let [columns, rows] = size_px.map(|px| px.div_ceil(TILE_PX));
        let tile_count = columns * rows;
        let bytes = BYTES_OF_HEAD + u64::from(tile_count) * BYTES_OF_TILE;
        let room = Contents::in_pieces(bytes, Vec::new(), true);
        let list = Resource::upload("drawn tiles", Role::Storage, room, Clock::Frame);
        let list = plan.add_resource(list);
        let drawn = Binding::update("drawn", list);
        let show = Pass::new(
            "find tiles",
            "in which tiles of the picture something is shown: effects look at no other",
            "effects/tiles/show.wgsl",
            vec![
                scene.frame.clone(),
                style_numbers.clone(),
                Binding::read("layers", layers),
                drawn.clone(),
            ],
            Work::over(size_px),
        );
        let kind = match style.paper {
            Paper::Gradient => 1,
            Paper::Color(_) => 2,
            Paper::None => 3,
        };
        plan.add_pass(show.with_constants(vec![("kind", f64::from(kind))]));
        let tiles = Self { list, tile_count };
        let mut bindings = vec![
            scene.frame.clone(),
            tiles.listed(),
            Binding::write("picture", picture),
        ];
        if style.paper != Paper::Gradient {
            bindings.push(style_numbers.clone());
        }
        let shader = Shader::from("effects/tiles/clear.wgsl").with(backdrop(style.paper));
        let shader = match strokes {
            Some(Strokes { borders, strokes }) => {
                bindings.push(Binding::write("borders", borders));
                bindings.push(Binding::write("strokes", strokes));
                shader.with("lib/blank_strokes/drawn.wgsl")
            }
            None => shader.with("lib/blank_strokes/none.wgsl"),
        };
        plan.add_pass(Pass::new(
            "clear picture",
            "all of it is background where the frame before had another one, or there was none",
            shader,
            bindings,
            tiles.shared(),
        ));
        let reach_px = match strokes {
            // A border is between two samples of which one may be background.
            Some(_) => reach_px(style, scene.input.view.band[1]) as u32 + 1,
            None => 0,
        };
        let list_tiles = Pass::new(
            "list tiles",
            "these tiles, those beside them as far as strokes reach, and those of the frame before",
            "effects/tiles/list.wgsl",
            vec![scene.frame.clone(), drawn],
            Work::Compute {
                groups: [tile_count.div_ceil(TILES_LISTED_AT_ONCE), 1, 1],
            },
        );
        let reach = f64::from(reach_px.div_ceil(TILE_PX));
        plan.add_pass(list_tiles.with_constants(vec![("reach", reach)]));
        Some(tiles)
    }

    /// For who goes over them.
    pub(super) fn listed(self) -> Binding {
        Binding::read("drawn", self.list)
    }

    /// A dispatch whose workgroups share them.
    pub(super) fn shared(self) -> Work {
        share_tiles(self.tile_count)
    }
}
