//! Bind groups by name: the composed shader is reflected, and each of its variables takes the resource that the pass gives
//! under that name.

use std::collections::BTreeMap;

use super::pipelines::Pipeline;
use crate::gpu::Gpu;
use crate::gpu::real::Real;
use crate::plan::{Pass, Plan, ResourceId, Shape};
use crate::shader::{BindingKind, ShaderBinding};
use crate::{Error, Result};

/// Resources on the device, by name.
pub(in crate::gpu) type Reals = BTreeMap<String, (Shape, Real)>;

pub(in crate::gpu) fn bind_groups(
    gpu: &Gpu,
    plan: &Plan,
    pass: &Pass,
    pipeline: &Pipeline,
    wanted: &[ShaderBinding],
    real: &Reals,
) -> Result<Vec<wgpu::BindGroup>> {
    let groups = wanted.iter().map(|w| w.group + 1).max().unwrap_or(0);
    let mut made = Vec::with_capacity(groups as usize);
    for group in 0..groups {
        let layout = match pipeline {
            Pipeline::Compute(p) => p.get_bind_group_layout(group),
            Pipeline::Render(p) => p.get_bind_group_layout(group),
        };
        let mut bound = Vec::new();
        for w in wanted.iter().filter(|w| w.group == group) {
            let Some(b) = pass.bindings.iter().find(|b| b.name == w.name) else {
                return Err(Error::Plan(format!(
                    "{}: `{}` is bound to nothing",
                    pass.name, w.name
                )));
            };
            let Some((_, real)) = real.get(&plan.resource(b.resource).name) else {
                return Err(Error::Plan(format!(
                    "{}: `{}` has no resource",
                    pass.name, w.name
                )));
            };
            bound.push((w, real, b.layer.unwrap_or(0)));
        }
        made.push(bind_group(gpu, &pass.name, &layout, &bound));
    }
    Ok(made)
}

/// A group of resources, each with the layer that is bound of a texture without layers in the shader.
pub(in crate::gpu) fn bind_group(
    gpu: &Gpu,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    bound: &[(&ShaderBinding, &Real, u32)],
) -> wgpu::BindGroup {
    // Views must outlive the entries that borrow them.
    let views: Vec<Option<wgpu::TextureView>> = (bound.iter())
        .map(|(w, real, layer)| match (real, w.kind) {
            (Real::Texture(texture), BindingKind::TextureArray) => Some(array_view(texture)),
            (Real::Texture(texture), kind) => Some(aspect_view(texture, kind, *layer)),
            _ => None,
        })
        .collect();
    let entries: Vec<wgpu::BindGroupEntry<'_>> = (bound.iter().zip(&views))
        .filter_map(|((w, real, _), view)| {
            let resource = match (real, view) {
                (Real::Buffer(buffer), _) => buffer.as_entire_binding(),
                (Real::Sampler(sampler), _) => wgpu::BindingResource::Sampler(sampler),
                (Real::Texture(_), view) => wgpu::BindingResource::TextureView(view.as_ref()?),
            };
            Some(wgpu::BindGroupEntry {
                binding: w.binding,
                resource,
            })
        })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(label),
        layout,
        entries: &entries,
    })
}

pub(in crate::gpu) fn texture<'a>(
    plan: &Plan,
    id: ResourceId,
    real: &'a Reals,
) -> Result<&'a wgpu::Texture> {
    match real.get(&plan.resource(id).name) {
        Some((_, Real::Texture(texture))) => Ok(texture),
        _ => Err(Error::Plan(format!(
            "{} is not a texture",
            plan.resource(id).name
        ))),
    }
}

pub(in crate::gpu) fn buffer<'a>(
    plan: &Plan,
    id: ResourceId,
    real: &'a Reals,
) -> Result<&'a wgpu::Buffer> {
    match real.get(&plan.resource(id).name) {
        Some((_, Real::Buffer(buffer))) => Ok(buffer),
        _ => Err(Error::Plan(format!(
            "{} is not a buffer",
            plan.resource(id).name
        ))),
    }
}

pub(in crate::gpu) fn layer_view(texture: &wgpu::Texture, layer: u32) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2),
        base_array_layer: layer,
        array_layer_count: Some(1),
        ..wgpu::TextureViewDescriptor::default()
    })
}

fn array_view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..wgpu::TextureViewDescriptor::default()
    })
}

/// One layer as a shader reads it: of a texture of depth and stencil, what the shader declares.
fn aspect_view(texture: &wgpu::Texture, kind: BindingKind, layer: u32) -> wgpu::TextureView {
    let aspect = match (texture.format(), kind) {
        (wgpu::TextureFormat::Depth32FloatStencil8, BindingKind::DepthTexture) => {
            wgpu::TextureAspect::DepthOnly
        }
        (wgpu::TextureFormat::Depth32FloatStencil8, _) => wgpu::TextureAspect::StencilOnly,
        _ => wgpu::TextureAspect::All,
    };
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2),
        aspect,
        base_array_layer: layer,
        array_layer_count: Some(1),
        ..wgpu::TextureViewDescriptor::default()
    })
}
