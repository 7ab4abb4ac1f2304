//! The sections of cut parts by planes, as uploads: sliced and triangulated on the CPU, drawn for any camera.
//!
//! Sections by an unchanged plane are reused; the others are sliced on all cores. Slicing time counts for the clock of the cut;
//! making the slicers, once per mesh and pose, counts for the clock of the solid.
//! Buffers are larger than their contents, so that they still fit when a plane moves a little.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;
use web_time::Instant;

use super::input::{Input, counted};
use crate::passes::pack::sliced::{PackedSection, Sliced};
use crate::plan::pack::MAX_SURFACES;
use crate::plan::{
    BufferRole, Clock, Contents, CpuStep, CpuWork, Draw, Piece, Plan, Resource, ResourceId,
};
use crate::scene::PreparedPart;
use crate::slice::SlicePlane;

/// The sections of a frame that have an interior, or may have one.
pub(crate) struct Sections {
    /// In the format of [`Vertices::Mesh`](crate::plan::Vertices::Mesh).
    pub vertices: ResourceId,
    /// Three per triangle.
    pub indices: ResourceId,
    /// One draw per section; the instance is the part's position in the table times [`MAX_SURFACES`], plus the clip-surface's position.
    pub draws: Vec<Draw>,
    /// One draw per incomplete section, with instances as in `draws`: covers everything in which the plane can meet the part.
    pub doubts: Vec<Draw>,
}

/// A part to slice, and the plane.
struct SliceTask {
    part: PreparedPart,
    sliced: Arc<Sliced>,
    plane: SlicePlane,
    instance: u32,
}

impl SliceTask {
    fn sliced(&self) -> PackedSection {
        self.sliced.slice(&self.part, &self.plane)
    }
}

/// One wanted section for each part.
fn of_each_part<'a>(wanted: impl IntoIterator<Item = &'a SliceTask>) -> Vec<&'a SliceTask> {
    let mut of_each: Vec<&SliceTask> = wanted.into_iter().collect();
    of_each.dedup_by(|a, b| Arc::ptr_eq(&a.sliced, &b.sliced));
    of_each
}

impl Sections {
    /// The sections of the cut parts by the planes that cut them, or none if all planes miss; and the work done for the plan's CPU steps.
    /// All clip-surfaces must be planes.
    pub(crate) fn slice(plan: &mut Plan, input: &Input<'_>) -> (Option<Self>, Vec<CpuWork>) {
        let wanted = wanted(input);
        let known: Vec<_> = (wanted
            .iter()
            .map(|w| w.sliced.sections.get(&(w.plane, w.part.fill))))
        .collect();
        let slicers_ms = make_slicers(&wanted, &known);
        let started = now();
        let all: Vec<Arc<PackedSection>> = (wanted.par_iter().zip(&known))
            .map(|(w, known)| known.clone().unwrap_or_else(|| Arc::new(w.sliced())))
            .collect();
        let took_ms =
            (known.iter().any(Option::is_none)).then(|| started.elapsed().as_secs_f64() * 1e3);
        for ((w, known), section) in wanted.iter().zip(&known).zip(&all) {
            if known.is_none() {
                w.sliced
                    .sections
                    .insert((w.plane, w.part.fill), section.clone());
            }
        }
        let met: Vec<_> = (wanted.iter().zip(&all))
            .filter(|(_, s)| s.index_count + s.doubt_count > 0)
            .collect();
        let found = met.iter().filter(|(_, s)| s.index_count > 0).count();
        let sections = (!met.is_empty()).then(|| {
            let [vertices, indices] = upload(plan, &met);
            let (draws, doubts) = draws(&met);
            Self {
                vertices,
                indices,
                draws,
                doubts,
            }
        });
        if wanted.is_empty() {
            return (None, Vec::new());
        }
        let parts = of_each_part(wanted.iter()).len();
        plan.on_cpu.push(CpuStep {
            name: "slicers".to_owned(),
            clock: Clock::Solid,
            reason: format!(
                "{} prepared for slicing by any plane",
                counted(parts, "part")
            ),
            makes: Vec::new(),
        });
        plan.on_cpu.push(CpuStep {
            name: "slice".to_owned(),
            clock: Clock::Cut,
            reason: format!(
                "{}, triangulated: the region of a plane inside a part",
                counted(found, "section")
            ),
            makes: (sections.iter().flat_map(|s| [s.vertices, s.indices])).collect(),
        });
        let work = work(wanted, slicers_ms, took_ms);
        (sections, work.into())
    }
}

/// The work of making slicers and the work of slicing, each with the time it took; no time if all results were cached.
fn work(wanted: Vec<SliceTask>, slicers_ms: Option<f64>, took_ms: Option<f64>) -> [CpuWork; 2] {
    let wanted = Arc::new(wanted);
    let of_slicers = wanted.clone();
    let slicers = CpuWork {
        took_ms: slicers_ms,
        again: Arc::new(move || {
            let made = of_each_part(of_slicers.iter()).into_par_iter();
            made.for_each(|w| drop(w.sliced.new_slicer(&w.part)));
        }),
    };
    let slices = CpuWork {
        took_ms,
        again: Arc::new(move || {
            wanted.par_iter().for_each(|w| drop(w.sliced()));
        }),
    };
    [slicers, slices]
}

fn wanted(input: &Input<'_>) -> Vec<SliceTask> {
    let prepared = &input.model.prepared;
    let mut wanted = Vec::new();
    for (place, rank) in input.active_cuts.cut_parts().iter().enumerate() {
        for slot in input.active_cuts.surfaces_of(*rank) {
            let surface = &prepared.surfaces[input.active_cuts.surfaces[slot]];
            let lift = surface.flat_height().unwrap_or(0.0);
            wanted.push(SliceTask {
                part: prepared.parts[*rank].clone(),
                sliced: input.model.sliced(*rank),
                // All parts are near the centre of scene space; the origin of the plane may be anywhere.
                plane: (SlicePlane::from(surface).keeping(lift)).seen_from(DVec3::ZERO),
                instance: (place * MAX_SURFACES + slot) as u32,
            });
        }
    }
    wanted
}

fn upload(plan: &mut Plan, met: &[(&SliceTask, &Arc<PackedSection>)]) -> [ResourceId; 2] {
    let mut ends = [0_u64; 2];
    let mut pieces = [Vec::new(), Vec::new()];
    for (_, section) in met {
        for (i, bytes) in [&section.vertices, &section.indices]
            .into_iter()
            .enumerate()
        {
            pieces[i].push(Piece {
                offset: ends[i],
                bytes: bytes.clone(),
            });
            ends[i] += bytes.len() as u64;
        }
    }
    let of = [
        ("section vertices", BufferRole::Vertex),
        ("section indices", BufferRole::Index),
    ];
    let mut pieces = pieces.into_iter();
    [0, 1].map(|i| {
        let contents = Contents::in_pieces(room(ends[i]), pieces.next().unwrap_or_default(), true);
        plan.add_resource(Resource::own_upload(of[i].0, of[i].1, contents, Clock::Cut))
    })
}

/// Makes the slicers that the unknown sections need; returns the time taken, or `None` if no slicer was missing.
fn make_slicers(wanted: &[SliceTask], known: &[Option<Arc<PackedSection>>]) -> Option<f64> {
    let started = now();
    let missing = (wanted.iter().zip(known))
        .filter(|(w, known)| known.is_none() && !w.sliced.has_slicer())
        .map(|(w, _)| w);
    // Each slicer only once: a thread that makes one and waits for others must not pick up a task for the same slicer.
    let missing = of_each_part(missing);
    missing.par_iter().for_each(|w| w.sliced.prepare(&w.part));
    (!missing.is_empty()).then(|| started.elapsed().as_secs_f64() * 1e3)
}

/// Draws of the sections that have an interior, and of the incomplete ones.
fn draws(met: &[(&SliceTask, &Arc<PackedSection>)]) -> (Vec<Draw>, Vec<Draw>) {
    let (mut draws, mut doubts) = (Vec::new(), Vec::new());
    let (mut first_vertex, mut first_index) = (0_u32, 0_u32);
    for (wanted, section) in met {
        for (all, count) in [
            (&mut draws, section.index_count),
            (&mut doubts, section.doubt_count),
        ] {
            if count > 0 {
                all.push(Draw {
                    indices: first_index..first_index + count,
                    base_vertex: first_vertex.cast_signed(),
                    vertex_count: section.vertex_count,
                    instance: wanted.instance,
                    arguments: None,
                });
            }
            first_index += count;
        }
        first_vertex += section.vertex_count;
    }
    (draws, doubts)
}

#[allow(
    clippy::disallowed_methods,
    reason = "no pass does this work, so that nobody else can time it"
)]
fn now() -> Instant {
    Instant::now()
}

/// Buffer size for a number of bytes: the next power of two.
fn room(bytes: u64) -> u64 {
    bytes.next_power_of_two()
}
