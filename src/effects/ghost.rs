//! Ghosts: material removed by cuts, drawn over the picture as phantom lines or glass.
//!
//! The solids that cuts reach are drawn again without cuts; where they lie in front of the visible surface, material was removed. Costs a
//! pass over these solids, 28 bytes a pixel, and for lines a border search. Dashes jump where a line's dominant axis changes.
//!
//! Cannot: show removed material behind other removed material.

use super::borders::borders_of;
use super::pixels::{numbers, over_picture};
use super::style_numbers::half_px;
use crate::passes::{DrawPass, SceneBuffers, Surfaces, gather_into};
use crate::plan::{Binding, Draw, Plan, ResourceId, pack};
use crate::scene::style::Style;
use crate::scene::{linear_from_srgb, map_channels};
use crate::shader::Shader;

/// Radius in pixels in which borders determine the direction of a line; `SCATTER_PX` in `shaders/lib/phantom/lines.wgsl`.
const SCATTER_PX: u32 = 4;

/// Draws removed material over the picture.
pub(super) fn ghost(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    style_numbers: &Binding,
    (layers, picture): (ResourceId, ResourceId),
) {
    let input = scene.input;
    let style = &input.model.prepared.style;
    if !style.ghost.is_drawn() {
        return;
    }
    let draws = draws(scene);
    if draws.is_empty() {
        return;
    }
    let mut surfaces = Surfaces::named(plan, scene, ["ghost_words", "ghost_depth"]);
    let pass = DrawPass {
        name: "draw ghost".to_owned(),
        reason: "removed material is visible where the uncut solids lie in front of the kept parts"
            .to_owned(),
        shader: Shader::from("effects/ghost/surface.wgsl"),
        bindings: vec![scene.frame.clone()],
        constants: Vec::new(),
        vertices: scene.solid_mesh().0,
        indices: scene.solid_mesh().1,
        draws,
    };
    surfaces.draw(plan, pass);
    let uncut = gather_into(plan, scene, &surfaces, ["ghost_layers", "gather ghost"]);
    let mut bindings = vec![
        scene.frame.clone(),
        Binding::read("layers", layers),
        Binding::read("ghost_layers", uncut),
        Binding::update("picture", picture),
    ];
    let mut shader = Shader::from("effects/ghost/draw.wgsl");
    shader = if style.ghost.has_lines() {
        let names = ["ghost_borders", "find ghost borders"];
        let borders = borders_of(plan, scene, style_numbers, uncut, names);
        over_picture(
            plan,
            scene,
            (
                "keep ghost borders",
                "outlines are drawn where geometry was removed",
            ),
            "effects/ghost/keep.wgsl",
            vec![
                scene.frame.clone(),
                Binding::read("layers", layers),
                Binding::read("ghost_layers", uncut),
                Binding::update("ghost_borders", borders),
            ],
        );
        bindings.push(Binding::read("ghost_borders", borders));
        shader.with("lib/phantom/lines.wgsl")
    } else {
        shader.with("lib/phantom/none.wgsl")
    };
    bindings.push(numbers(plan, "ghost", ghost_numbers(scene, style)));
    let about = ("add ghost", "phantom lines and glass lie over the picture");
    over_picture(plan, scene, about, shader, bindings);
}

/// Number of rows on each side of a band that ghosts read, in a picture of `rows` rows.
pub(super) fn halo_rows(style: &Style, rows: u32) -> u32 {
    match style.ghost.has_lines() {
        // A border that determines a direction is found from samples up to two pixels beyond it; each of these reads its neighbours.
        true => half_px(style.ghost.width, rows).ceil() as u32 + 1 + SCATTER_PX + 4,
        false => 0,
    }
}

/// The solids that cuts reach, by part number in the scene.
fn draws(scene: &SceneBuffers<'_>) -> Vec<Draw> {
    let input = scene.input;
    let active_cuts = &input.active_cuts;
    let opened = (active_cuts.cut_parts().iter().copied()).filter(|r| active_cuts.cuts_of(*r) != 0);
    let ranks: Vec<usize> = opened.chain(active_cuts.removed_parts()).collect();
    let mut draws = input.draws_of(&ranks);
    for (draw, rank) in draws.iter_mut().zip(ranks) {
        draw.instance = input.model.prepared.parts[rank].part as u32;
    }
    draws
}

fn ghost_numbers(scene: &SceneBuffers<'_>, style: &Style) -> pack::Ghost {
    let input = scene.input;
    let ghost = &style.ghost;
    let unit = input.model.at_rest.picture_height() / 1000.0 * input.model.prepared.scale;
    let color = map_channels(ghost.color.unwrap_or(style.ink), linear_from_srgb);
    pack::Ghost {
        color: color.extend(1.0).to_array(),
        half_px: half_px(ghost.width, input.view.band[1]),
        alpha: ghost.alpha,
        glass: if ghost.has_glass() { ghost.glass } else { 0.0 },
        widths_per_unit: (1.0 / (f64::from(ghost.width).max(0.1) * unit)) as f32,
    }
}
