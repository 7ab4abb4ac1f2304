//! A plan on the device: its resources, pipelines and bind groups, kept as long as the plan's structure is unchanged.
//!
//! Loading a plan compares it with the previous one. Resources with the same name and shape are kept, equal contents are not uploaded
//! again, and only the passes whose inputs changed ([`Plan::due_after`]) run. A frame with an unchanged plan allocates nothing.

use std::collections::{BTreeMap, BTreeSet};

use crate::gpu::Gpu;
use crate::gpu::composite::{CompositeBuffers, Compositor};
use crate::gpu::device::is_shared;
use crate::gpu::draw::ReadyPass;
use crate::gpu::layer_words::{LAYER_BYTES, layers_from_words};
use crate::gpu::pick::{Arriving, Pick};
use crate::gpu::report::Report;
use crate::gpu::resource::{GpuResource, make};
use crate::gpu::target::Destination;
use crate::gpu::timing::{ClockSet, PassTime, RunTimes, TimestampQueries, timed};
use crate::layers::Layers;
use crate::plan::{Clock, Due, Pass, Plan, Recorded, Resource, ResourceId, Shape};
use crate::{Error, Result};

/// Passes that were encoded.
pub(crate) struct EncodedPasses {
    /// Number of passes.
    pub(crate) passes: usize,
    /// Capacities needed by the bounded buffers; known after the frame.
    pub(crate) report: Option<Report>,
}

/// A loaded plan.
#[derive(Default)]
pub struct Program {
    recorded: Recorded,
    resources: BTreeMap<String, (Shape, GpuResource)>,
    steps: Vec<ReadyPass>,
    stopwatch: Option<TimestampQueries>,
    generation: u64,
    /// Work that has not run successfully since its inputs changed.
    due: Due,
}

impl Program {
    /// Loads a plan; returns the work that must run to make the next frame correct.
    pub fn load(&mut self, gpu: &Gpu, recorded: impl Into<Recorded>) -> Result<&Due> {
        let Recorded { plan, on_cpu } = recorded.into();
        let mut rebind = self.steps.is_empty() || !same_structure(&plan, self.plan());
        if rebind {
            let check = || plan.check(gpu.limits());
            timed(&mut gpu.preparing().composing, check)?;
        }
        let mut remade: BTreeSet<&str> = BTreeSet::new();
        for resource in &plan.resources {
            let before = self
                .recorded
                .plan
                .resources
                .iter()
                .find(|r| r.name == resource.name);
            let uploaded = before.and_then(|b| b.contents.as_ref());
            let known = self.resources.get(&resource.name);
            let kept = known.is_some_and(|(shape, _)| *shape == resource.shape);
            let in_place = match (&resource.contents, uploaded, known) {
                _ if !kept => false,
                (None, None, _) => true,
                (Some(new), Some(old), _) if new == old => true,
                // Shared contents must not be overwritten: other programs read them.
                (Some(new), Some(old), Some((_, GpuResource::Buffer(buffer))))
                    if !is_shared(new) && !is_shared(old) && new.changes() == old.changes() =>
                {
                    for piece in new.not_in(old) {
                        gpu.queue.write_buffer(buffer, piece.offset, &piece.bytes);
                    }
                    true
                }
                _ => false,
            };
            if !in_place {
                self.resources
                    .insert(resource.name.clone(), (resource.shape, make(gpu, resource)));
                remade.insert(&resource.name);
                rebind = true;
            }
        }
        let due = plan.due_after(self.plan(), |r| remade.contains(r.name.as_str()));
        self.due.add(&due);
        self.due
            .passes
            .retain(|name| plan.passes.iter().any(|p| p.name == *name));
        self.resources
            .retain(|name, _| plan.resource_named(name).is_some());
        if rebind {
            // No plan counts as loaded until this one is built completely, or a failure halfway would later look like an unchanged plan.
            self.recorded = Recorded::default();
            self.steps.clear();
            self.generation += 1;
            let step = |pass| ReadyPass::new(gpu, &plan, pass, &self.resources);
            let steps = plan.passes.iter().map(step).collect::<Result<Vec<_>>>()?;
            let is_timed = gpu.has_timestamps();
            let stopwatch = || TimestampQueries::new(&gpu.device, plan.passes.len());
            self.stopwatch = is_timed.then(stopwatch).flatten();
            gpu.complaint()?;
            self.steps = steps;
        }
        self.recorded = Recorded { plan, on_cpu };
        Ok(&self.due)
    }

    /// The loaded plan.
    pub fn plan(&self) -> &Plan {
        &self.recorded.plan
    }

    /// Bytes of the buffers and textures that were created for resources on a clock, either only those of the scene or only the others.
    /// Contents that several programs share count for each program.
    pub fn allocated_on(&self, clock: Clock, is_scene: bool) -> u64 {
        let wanted = |r: &&Resource| r.clock == clock && r.is_scene == is_scene;
        let resources = self.recorded.plan.resources.iter().filter(wanted);
        resources
            .filter_map(|r| self.resources.get(&r.name))
            .map(|(_, resource)| resource.bytes())
            .sum()
    }

    /// Runs the due passes and the passes in `besides`: all at once, or pass by pass for their times, which blocks on each.
    pub fn run_due(&mut self, gpu: &Gpu, besides: &Due, is_timed: bool) -> Result<RunTimes> {
        let due = &self.due.passes;
        let runs = |pass: &Pass| due.contains(&pass.name) || besides.passes.contains(&pass.name);
        let mut times = match is_timed {
            true => self.run_passes(gpu, runs)?,
            false => self.run_at_once(gpu, runs)?,
        };
        times.add_before(PassTime::of_cpu(&self.recorded, |_, work| work.took_ms));
        self.due = Due::default();
        Ok(times)
    }

    /// Runs the passes on the given clocks and waits for them; CPU work on these clocks is repeated to measure its time.
    pub fn run(&self, gpu: &Gpu, clocks: ClockSet) -> Result<RunTimes> {
        let works = PassTime::of_cpu(&self.recorded, |step, work| {
            let is_asked = clocks.contains(step.clock);
            is_asked.then(|| TimestampQueries::ms_of(&*work.again))
        });
        let mut times = self.run_passes(gpu, |pass| clocks.contains(pass.clock))?;
        times.add_before(works);
        Ok(times)
    }

    fn run_passes(&self, gpu: &Gpu, runs: impl Fn(&Pass) -> bool) -> Result<RunTimes> {
        match &self.stopwatch {
            Some(stopwatch) => self.run_stamped(gpu, runs, stopwatch),
            None => self.run_by_the_wall(gpu, runs),
        }
    }

    /// Submits all passes together, without waiting.
    fn run_at_once(&self, gpu: &Gpu, runs: impl Fn(&Pass) -> bool) -> Result<RunTimes> {
        let mut encoder = new_encoder(gpu);
        let mut passes = Vec::with_capacity(self.steps.len());
        for (index, pass, step) in self.steps_that(runs) {
            step.encode(&mut encoder, None, index);
            passes.push(PassTime {
                name: pass.name.clone(),
                clock: pass.clock,
                time_ms: None,
            });
        }
        gpu.scoped(|| {
            gpu.queue.submit([encoder.finish()]);
            Ok(())
        })?;
        Ok(RunTimes::sum(passes))
    }

    fn run_stamped(
        &self,
        gpu: &Gpu,
        runs: impl Fn(&Pass) -> bool,
        stopwatch: &TimestampQueries,
    ) -> Result<RunTimes> {
        let mut encoder = new_encoder(gpu);
        let mut ran = Vec::with_capacity(self.steps.len());
        for (index, pass, step) in self.steps_that(runs) {
            step.encode(&mut encoder, Some(stopwatch), index);
            ran.push((index, pass.name.as_str(), pass.clock));
        }
        stopwatch.finish(&mut encoder);
        gpu.queue.submit([encoder.finish()]);
        let ticks = gpu.map::<u64>(&stopwatch.copied)?;
        let ns_per_tick = gpu.queue.get_timestamp_period();
        Ok(TimestampQueries::times(ns_per_tick, &ticks, &ran))
    }

    /// Submits passes one by one and waits for each, which is how passes are timed on a device without timestamps.
    fn run_by_the_wall(&self, gpu: &Gpu, runs: impl Fn(&Pass) -> bool) -> Result<RunTimes> {
        gpu.wait()?;
        let mut passes = Vec::with_capacity(self.steps.len());
        for (index, pass, step) in self.steps_that(runs) {
            let started = TimestampQueries::now();
            let mut encoder = new_encoder(gpu);
            step.encode(&mut encoder, None, index);
            gpu.queue.submit([encoder.finish()]);
            gpu.wait()?;
            passes.push(PassTime {
                name: pass.name.clone(),
                clock: pass.clock,
                time_ms: Some(started.elapsed().as_secs_f64() * 1e3),
            });
        }
        Ok(RunTimes::sum(passes))
    }

    fn steps_that(
        &self,
        runs: impl Fn(&Pass) -> bool,
    ) -> impl Iterator<Item = (usize, &Pass, &ReadyPass)> {
        let all = self
            .recorded
            .plan
            .passes
            .iter()
            .zip(&self.steps)
            .enumerate();
        all.filter(move |(_, (pass, _))| runs(pass))
            .map(|(index, (pass, step))| (index, pass, step))
    }

    /// Encodes the due work, for an encoder that the caller submits; returns the number of passes. The needed capacities of bounded
    /// buffers, if any, are copied after the passes.
    pub(crate) fn encode_due(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<EncodedPasses> {
        let due = &self.due.passes;
        let mut passes = 0;
        for (index, _, step) in self.steps_that(|pass| due.contains(&pass.name)) {
            step.encode(encoder, None, index);
            passes += 1;
        }
        self.due = Due::default();
        let report = match self.recorded.plan.need {
            Some(id) if passes > 0 => {
                let needs = self.buffer(id)?;
                let staging = gpu.staging(needs.size());
                encoder.copy_buffer_to_buffer(needs, 0, &staging, 0, needs.size());
                let bounded = self.recorded.plan.bounded.clone();
                Some(Report::new(encoder, staging, bounded))
            }
            _ => None,
        };
        Ok(EncodedPasses { passes, report })
    }

    /// Copies the layers of one pixel after the encoded commands; pixels are numbered row by row from the upper left corner.
    pub(crate) fn pick(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        pixel: u64,
    ) -> Result<Pick> {
        let layers = self.layers_buffer()?;
        let staging = gpu.staging(LAYER_BYTES);
        encoder.copy_buffer_to_buffer(layers, pixel * LAYER_BYTES, &staging, 0, LAYER_BYTES);
        Ok(Pick::new(encoder, staging))
    }

    /// Copies the layers of all pixels after the encoded commands.
    pub(crate) fn send_layers(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<Arriving> {
        Ok(Arriving::new(gpu, encoder, self.layers_buffer()?))
    }

    /// Copies the picture after the encoded commands.
    pub(crate) fn send_picture(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<Arriving> {
        Ok(Arriving::new(gpu, encoder, self.picture_buffer()?))
    }

    /// A compositor that draws the picture into a host's attachments.
    pub(crate) fn compositor(&self, gpu: &Gpu, target: &Destination<'_>) -> Result<Compositor> {
        let table = |name: &str| {
            let fault = || Error::Plan(format!("the plan has no {name}"));
            self.buffer_named(name).ok_or_else(fault)
        };
        let frame = CompositeBuffers {
            picture: self.picture_buffer()?,
            layers: self.layers_buffer()?,
            parts: table("parts")?,
        };
        Compositor::new(gpu, target, &frame)
    }

    /// The buffer of the resource with this name, if the plan has one.
    pub(in crate::gpu) fn buffer_named(&self, name: &str) -> Option<&wgpu::Buffer> {
        match &self.resources.get(name)?.1 {
            GpuResource::Buffer(buffer) => Some(buffer),
            GpuResource::Texture(_) | GpuResource::Sampler(_) => None,
        }
    }

    /// Number of times that resources were created or bound: if it changes, all objects that refer to them must be rebuilt.
    pub(crate) fn generation(&self) -> u64 {
        self.generation
    }

    /// The largest capacity that each bounded buffer needed, in order of [`Plan::bounded`].
    pub fn needs(&self, gpu: &Gpu) -> Result<Vec<u32>> {
        let Some(id) = self.recorded.plan.need else {
            return Ok(Vec::new());
        };
        let words = gpu.read::<u32>(self.buffer(id)?)?;
        Ok(self
            .plan()
            .bounded
            .iter()
            .map(|b| words.get(b.slot as usize).copied().unwrap_or(0))
            .collect())
    }

    /// Zeroes the words in which the frame's bounded buffers report needed capacities; a pass of the solid resets those of the solid.
    pub fn clear_needs_of_frame(&self, gpu: &Gpu) -> Result<()> {
        let Some(id) = self.recorded.plan.need else {
            return Ok(());
        };
        let buffer = self.buffer(id)?;
        for bounded in self.recorded.plan.bounded.iter().filter(|b| !b.exact) {
            gpu.queue
                .write_buffer(buffer, u64::from(bounded.slot) * 4, &[0; 4]);
        }
        Ok(())
    }

    /// The layers of the last frame.
    pub fn layers(&self, gpu: &Gpu, size_px: [u32; 2]) -> Result<Layers> {
        let words = gpu.read::<u32>(self.layers_buffer()?)?;
        Ok(Layers {
            size_px,
            pixels: layers_from_words(&words),
        })
    }

    /// The picture of the last frame: RGBA8, rows from the top.
    pub fn picture(&self, gpu: &Gpu) -> Result<Vec<u8>> {
        gpu.read::<u8>(self.picture_buffer()?)
    }

    /// The words of the buffer with a given name, for tests.
    pub fn words(&self, gpu: &Gpu, name: &str) -> Result<Vec<u32>> {
        let id = self
            .plan()
            .resource_named(name)
            .ok_or_else(|| Error::Plan(format!("there is no resource `{name}`")))?;
        gpu.read::<u32>(self.buffer(id)?)
    }

    fn picture_buffer(&self) -> Result<&wgpu::Buffer> {
        let none = || Error::Plan("the plan makes no picture".to_owned());
        self.buffer(self.plan().picture.ok_or_else(none)?)
    }

    fn layers_buffer(&self) -> Result<&wgpu::Buffer> {
        let none = || Error::Plan("the plan makes no layers".to_owned());
        self.buffer(self.plan().layers.ok_or_else(none)?)
    }

    fn buffer(&self, id: ResourceId) -> Result<&wgpu::Buffer> {
        let name = &self.recorded.plan.resource(id).name;
        match self.resources.get(name) {
            Some((_, GpuResource::Buffer(buffer))) => Ok(buffer),
            _ => Err(Error::Plan(format!("{name} is not a buffer"))),
        }
    }
}

fn new_encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    let descriptor = wgpu::CommandEncoderDescriptor {
        label: Some("frame"),
    };
    gpu.device.create_command_encoder(&descriptor)
}

/// Returns true if two plans differ only in the contents of their uploads.
fn same_structure(a: &Plan, b: &Plan) -> bool {
    let same = |(a, b): (&Resource, &Resource)| a.name == b.name && a.shape == b.shape;
    a.passes == b.passes
        && a.resources.len() == b.resources.len()
        && a.resources.iter().zip(&b.resources).all(same)
}
