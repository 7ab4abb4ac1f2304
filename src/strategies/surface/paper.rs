//! The paper's rule (Trapp & Döllner 2013): chi at every fragment of the mesh, and the cap drawn by itself.
//!
//! The mesh is clipped by chi and the tessellated clip-surface is drawn into the same depth buffer, each fragment tested against the
//! depth sprite of its part, or its layered depth image. Two approximations of one surface meet at the rim: between vertices the cap
//! runs straight where the clip test bends, and the *gap* shows what lies behind. No finite tessellation closes it where a solid
//! meets the clip-surface at a grazing angle; it is counted (`crack_px`), not hidden.
//!
//! Per frame: the mesh once, the triangles for each part and clip-surface, d loads for each cap fragment. Where the near
//! plane meets a part, the image is asked once more at each pixel: the paper has no cap there. Cannot: draw by the compute rasteriser.

use std::ops::Range;

use super::tessellation::{Tessellation, instance};
use crate::passes::Refusal;
use crate::passes::{DrawPass, Recorder, Volume, counted};
use crate::plan::Vertices;
use crate::shader::Shader;
use crate::strategies::inside::stencil::full_screen;

/// Records the frame: the triangles that `tessellate` makes, and each image of volumes that `images` makes with the places of the parts
/// that it answers for.
pub fn record(
    recorder: &mut Recorder<'_>,
    tessellate: impl FnOnce(&mut Recorder<'_>) -> Result<Tessellation, Refusal>,
    images: impl FnOnce(&mut Recorder<'_>) -> Result<Vec<(Range<usize>, Volume)>, Refusal>,
) -> Result<(), Refusal> {
    let ranks: Vec<usize> = recorder.relevance.cut_parts().to_vec();
    let images: Vec<(&[usize], Volume)> = (images(recorder)?.into_iter())
        .map(|(places, volume)| (&ranks[places], volume))
        .collect();

    let (vertices, indices) = recorder.mesh();
    let mut bindings = vec![recorder.frame(), recorder.cut_table(), recorder.parts()];
    bindings.extend(recorder.filtered_heights());
    let filter = recorder.height_filter_file();
    recorder.draw(DrawPass {
        name: "clip".to_owned(),
        reason: format!(
            "{}: chi decides at every fragment",
            counted(ranks.len(), "cut part")
        ),
        shader: Shader::from("strategies/surface/paper/clip.wgsl").with(filter),
        bindings,
        constants: Vec::new(),
        vertices,
        indices,
        draws: recorder.draws_of(&ranks),
    });
    recorder.draw_plain_parts(false);

    // Parts that only the near plane opens have no clip-surface to draw triangles of.
    if !recorder.relevance.surfaces.is_empty() {
        let tessellation = tessellate(recorder)?;
        for (ranks, volume) in &images {
            caps(recorder, &tessellation, ranks, volume);
        }
    }
    for (ranks, volume) in &images {
        near_caps(recorder, ranks, volume);
    }
    recorder.gather();
    Ok(())
}

/// Draws the caps that the near plane makes in the parts that an image of volumes answers for, by rank.
fn near_caps(recorder: &mut Recorder<'_>, ranks: &[usize], volume: &Volume) {
    let view = recorder.view;
    let parts = &recorder.model.prepared.parts;
    let is_met = |rank: &&usize| view.near_cap && view.near_plane_meets(&parts[**rank].bounds);
    let places: Vec<u32> = (ranks.iter().filter(is_met))
        .map(|rank| recorder.relevance.place_of(*rank) as u32)
        .collect();
    let Some(first) = places.first() else {
        return;
    };
    let mut bindings = vec![recorder.frame(), recorder.cut_table(), recorder.parts()];
    bindings.extend(recorder.filtered_heights());
    bindings.extend(volume.bindings.iter().cloned());
    let (indices, draws): (Vec<_>, Vec<_>) = places
        .iter()
        .map(|place| full_screen(recorder, *place))
        .unzip();
    recorder.draw(DrawPass {
        name: format!("near cap {first}"),
        reason: format!(
            "{}: the near plane meets it, and its image says where it is inside",
            counted(places.len(), "part")
        ),
        shader: Shader::from("strategies/surface/paper/near.wgsl")
            .with(volume.file)
            .with(recorder.height_filter_file()),
        bindings,
        constants: Vec::new(),
        vertices: Vertices::None,
        indices: indices[0],
        draws: draws.concat(),
    });
}

/// Draws the caps of the parts that an image of volumes answers for.
fn caps(
    recorder: &mut Recorder<'_>,
    tessellation: &Tessellation,
    ranks: &[usize],
    volume: &Volume,
) {
    let instances: Vec<u32> = (ranks.iter())
        .flat_map(|rank| instances_of(recorder, *rank))
        .collect();
    let names: Vec<String> = (ranks.iter())
        .map(|rank| format!("`{}`", recorder.model.prepared.parts[*rank].name))
        .collect();
    let first = ranks.first().map_or(0, |r| recorder.relevance.place_of(*r));
    for (i, batch) in tessellation.batches(&instances).into_iter().enumerate() {
        let mut bindings = vec![
            recorder.frame(),
            recorder.cut_table(),
            recorder.parts(),
            // For the normals.
            recorder.heights(),
        ];
        let filtered = recorder.filtered_heights().into_iter();
        bindings.extend(filtered.filter(|b| b.name != "heights"));
        bindings.extend(tessellation.bindings.iter().cloned());
        bindings.extend(volume.bindings.iter().cloned());
        let name = match i {
            0 => format!("cap {first}"),
            i => format!("cap {first}.{i}"),
        };
        recorder.draw(DrawPass {
            name,
            reason: format!(
                "the displaced triangles of {}, cut to the solid by its image",
                names.join(", ")
            ),
            shader: Shader::from("strategies/surface/paper/cap.wgsl")
                .with(volume.file)
                .with(recorder.height_filter_file())
                .with_all(&tessellation.files),
            bindings,
            constants: batch.constants,
            vertices: Vertices::None,
            indices: batch.indices,
            draws: batch.draws,
        });
    }
}

/// The instances of a part: one for each clip-surface that cuts it.
fn instances_of(recorder: &Recorder<'_>, rank: usize) -> Vec<u32> {
    let relevance = &recorder.relevance;
    let place = relevance.place_of(rank) as u32;
    let bits = (0..relevance.cuts.len())
        .filter(|c| relevance.cuts_of(rank) >> c & 1 == 1)
        .fold(0, |b, c| b | relevance.cuts[c]);
    (0..relevance.surfaces.len() as u32)
        .filter(|s| bits >> s & 1 == 1)
        .map(|s| instance(place, s))
        .collect()
}
