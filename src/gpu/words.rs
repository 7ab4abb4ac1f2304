//! Runs a small compute shader on given words and returns the words that it writes, so that a test can compare a WGSL library function with
//! its definition in f64.
//!
//! The shader is composed with the library, so it imports the same functions that draw frames. Before the run all output words are set to
//! [`POISON`], so that an unwritten word is not mistaken for a zero.

use super::Gpu;
use super::programs::bind::bind_group;
use super::resource::{GpuResource, make};
use crate::plan::Resource;
use crate::shader::{self, BindingKind};
use crate::{Error, Result};

/// Value of every output word before the run.
pub const POISON: u32 = 0xffff_ffff;

/// Name of the output variable, a `var<storage, read_write>` of the shader.
const OUTPUT: &str = "words";

/// Workgroup size that the dispatch assumes; a shader with larger workgroups gets more invocations than it needs.
const INVOCATIONS: usize = 64;

/// Runs the entry point `main` of a compute shader and returns the words of its variable `words`.
///
/// `inputs` are the other buffers that the shader uses, by variable name. There is at least one invocation of `@workgroup_size(64)` for
/// each output word; the shader must return early in invocations beyond the last case.
pub fn run_words(
    gpu: &Gpu,
    wgsl: &str,
    inputs: &[(&str, Vec<u32>)],
    output_words: usize,
) -> Result<Vec<u32>> {
    run_words_with(gpu, wgsl, &[], inputs, &[], output_words)
}

/// As [`run_words`], with files that fill open modules, and with further plan resources, such as textures, by variable name.
pub fn run_words_with(
    gpu: &Gpu,
    wgsl: &str,
    with: &[&str],
    inputs: &[(&str, Vec<u32>)],
    resources: &[(&str, &Resource)],
    output_words: usize,
) -> Result<Vec<u32>> {
    let composed = shader::compose_text_with("words", wgsl, with)?;
    let info = shader::validate(&composed).map_err(|what| Error::Shader {
        name: "words".to_owned(),
        what,
    })?;
    let wanted = shader::bindings(&composed, &info);
    let module = gpu.module("words", composed);
    let pipeline = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("words"),
            layout: None,
            module: &module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
    gpu.complaint()?;

    let poisoned = vec![POISON; output_words];
    let mut made = Vec::with_capacity(wanted.len());
    for w in &wanted {
        if let Some((_, resource)) = resources.iter().find(|(name, _)| *name == w.name) {
            made.push(make(gpu, resource));
            continue;
        }
        let words = match inputs.iter().find(|(name, _)| *name == w.name) {
            _ if w.name == OUTPUT => &poisoned,
            Some((_, words)) => words,
            None => return Err(Error::Plan(format!("`{}` is given no words", w.name))),
        };
        let usage = match w.kind {
            BindingKind::Uniform => gpu.uniform_usage(),
            BindingKind::StorageRead | BindingKind::StorageReadWrite => wgpu::BufferUsages::STORAGE,
            BindingKind::Texture
            | BindingKind::DepthTexture
            | BindingKind::TextureArray
            | BindingKind::Sampler => {
                return Err(Error::Plan(format!("`{}` is not a buffer", w.name)));
            }
        };
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(&w.name),
            size: words.len() as u64 * 4,
            usage: usage | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        gpu.queue
            .write_buffer(&buffer, 0, bytemuck::cast_slice(words));
        made.push(GpuResource::Buffer(buffer));
    }
    let Some(output) = wanted.iter().position(|w| w.name == OUTPUT) else {
        return Err(Error::Plan(format!(
            "the shader has no variable `{OUTPUT}`"
        )));
    };
    if let Some((name, _)) = inputs
        .iter()
        .find(|(name, _)| !wanted.iter().any(|w| w.name == *name))
    {
        return Err(Error::Plan(format!("the shader reads no `{name}`")));
    }

    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        let groups = wanted.iter().map(|w| w.group + 1).max().unwrap_or(0);
        for group in 0..groups {
            let layout = pipeline.get_bind_group_layout(group);
            let of_group = wanted.iter().zip(&made).filter(|(w, _)| w.group == group);
            let bound: Vec<_> = of_group.map(|(w, resource)| (w, resource, 0)).collect();
            let bound = bind_group(gpu, "words", &layout, &bound);
            pass.set_bind_group(group, &bound, &[]);
        }
        pass.dispatch_workgroups(output_words.div_ceil(INVOCATIONS) as u32, 1, 1);
    }
    gpu.queue.submit([encoder.finish()]);
    gpu.complaint()?;
    match &made[output] {
        GpuResource::Buffer(buffer) => gpu.read(buffer),
        _ => Err(Error::Plan(format!("`{OUTPUT}` is not a buffer"))),
    }
}
