//! The paper's rule (Trapp & Döllner 2013): chi at every fragment of the mesh, and a separately drawn cap.
//!
//! The mesh is clipped by chi and the tessellated clip-surface is drawn into the same depth buffer, each fragment tested against its part's
//! depth sprite or layered depth image. Two approximations of one surface meet at the rim: between vertices the cap is flat where the clip
//! test bends, and the *gap* shows what lies behind. No finite tessellation closes it where a solid meets the clip-surface at a grazing
//! angle; it is counted (`crack_px`), not hidden.
//!
//! Per frame: the mesh once, the triangles for each part and clip-surface, d loads per cap fragment. Where the near plane meets a part,
//! each pixel samples the image once more: the paper has no cap there. Cannot: draw by the compute rasteriser.

use std::ops::Range;

use super::tessellation::{Tessellation, instance};
use crate::effects::{FrameOutput, finish};
use crate::passes::{
    DrawPass, Input, Lanes, Refusal, SceneBuffers, Surfaces, Volume, counted, gather,
};
use crate::plan::{Draw, Plan, Vertices};
use crate::shader::Shader;

/// Records the frame: the triangles that `tessellate` makes, and the volume images that `images` makes, each with the part-table indices
/// that it covers.
pub(crate) fn record(
    plan: &mut Plan,
    input: &Input<'_>,
    tessellate: impl FnOnce(&mut Plan, &SceneBuffers<'_>) -> Result<Tessellation, Refusal>,
    images: impl FnOnce(&mut Plan, &SceneBuffers<'_>) -> Result<Vec<(Range<usize>, Volume)>, Refusal>,
) -> Result<FrameOutput, Refusal> {
    let scene = SceneBuffers::upload(plan, input, Lanes::none())?;
    let ranks = input.active_cuts.cut_parts();
    let images: Vec<(&[usize], Volume)> = (images(plan, &scene)?.into_iter())
        .map(|(places, volume)| (&ranks[places], volume))
        .collect();

    let (vertices, indices) = scene.mesh();
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        scene.parts.clone(),
    ];
    bindings.extend(scene.filtered_heights.iter().cloned());
    let clip = DrawPass {
        name: "clip".to_owned(),
        reason: format!(
            "{}: chi decides at every fragment",
            counted(ranks.len(), "cut part")
        ),
        shader: Shader::from("strategies/surface/paper/clip.wgsl").with(input.height_filter_file()),
        bindings,
        constants: Vec::new(),
        vertices,
        indices,
        draws: input.draws_of(ranks),
    };
    let mut surfaces = Surfaces::new(plan, &scene);
    surfaces.draw(plan, clip);
    surfaces.draw_plain_parts(plan, &scene, false);

    // Parts that only the near plane opens have no clip-surface to draw as triangles.
    if !input.active_cuts.surfaces.is_empty() {
        let tessellation = tessellate(plan, &scene)?;
        for (ranks, volume) in &images {
            for pass in caps(&scene, &tessellation, ranks, volume) {
                surfaces.draw(plan, pass);
            }
        }
    }
    for (ranks, volume) in &images {
        if let Some(pass) = near_caps(&scene, ranks, volume) {
            surfaces.draw(plan, pass);
        }
    }
    let layered = gather(plan, &scene, &surfaces);
    Ok(finish(plan, &scene, layered))
}

/// The near-plane caps of the parts that a volume image covers; `ranks` are the ranks of these parts.
fn near_caps(scene: &SceneBuffers<'_>, ranks: &[usize], volume: &Volume) -> Option<DrawPass> {
    let input = scene.input;
    let view = input.view;
    let parts = &input.model.prepared.parts;
    let is_met = |rank: &&usize| view.near_cap && view.near_plane_meets(&parts[**rank].bounds);
    let places: Vec<u32> = (ranks.iter().filter(is_met))
        .map(|rank| input.active_cuts.place_of(*rank) as u32)
        .collect();
    let first = places.first()?;
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        scene.parts.clone(),
    ];
    bindings.extend(scene.filtered_heights.iter().cloned());
    bindings.extend(volume.bindings.iter().cloned());
    Some(DrawPass {
        name: format!("near cap {first}"),
        reason: format!(
            "{} met by the near plane: the volume image shows where the near plane is inside",
            counted(places.len(), "part")
        ),
        shader: Shader::from("strategies/surface/paper/near.wgsl")
            .with(volume.file)
            .with(input.height_filter_file()),
        bindings,
        constants: Vec::new(),
        vertices: Vertices::None,
        indices: scene.screen_indices,
        draws: places.iter().map(|p| Draw::full_screen(*p)).collect(),
    })
}

/// The caps of the parts that a volume image covers.
fn caps(
    scene: &SceneBuffers<'_>,
    tessellation: &Tessellation,
    ranks: &[usize],
    volume: &Volume,
) -> Vec<DrawPass> {
    let input = scene.input;
    let instances: Vec<u32> = (ranks.iter())
        .flat_map(|rank| instances_of(input, *rank))
        .collect();
    let names: Vec<String> = (ranks.iter())
        .map(|rank| format!("`{}`", input.model.prepared.parts[*rank].name))
        .collect();
    let first = ranks.first().map_or(0, |r| input.active_cuts.place_of(*r));
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        scene.parts.clone(),
        // For the normals.
        scene.heights.clone(),
    ];
    let filtered = scene.filtered_heights.iter();
    bindings.extend(filtered.filter(|b| b.name != "heights").cloned());
    bindings.extend(tessellation.bindings.iter().cloned());
    bindings.extend(volume.bindings.iter().cloned());
    let batches = tessellation.batches(&instances).into_iter().enumerate();
    batches
        .map(|(i, batch)| DrawPass {
            name: match i {
                0 => format!("cap {first}"),
                i => format!("cap {first}.{i}"),
            },
            reason: format!(
                "the displaced triangles of {}, cut to the solid by its image",
                names.join(", ")
            ),
            shader: Shader::from("strategies/surface/paper/cap.wgsl")
                .with(volume.file)
                .with(input.height_filter_file())
                .with_all(&tessellation.files),
            bindings: bindings.clone(),
            constants: batch.constants,
            vertices: Vertices::None,
            indices: batch.indices,
            draws: batch.draws,
        })
        .collect()
}

/// The instances of a part: one for each clip-surface that cuts it.
fn instances_of(input: &Input<'_>, rank: usize) -> Vec<u32> {
    let place = input.active_cuts.place_of(rank) as u32;
    let surfaces = input.active_cuts.surfaces_of(rank);
    surfaces.map(|s| instance(place, s as u32)).collect()
}
