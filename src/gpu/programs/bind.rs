//! Bind groups by name: each variable of the composed shader, found by reflection, is bound to the resource that the pass lists under the
//! variable's name.

use std::collections::BTreeMap;

use super::pipelines::Pipeline;
use crate::gpu::Gpu;
use crate::gpu::resource::GpuResource;
use crate::plan::{Pass, Plan, ResourceId, Shape};
use crate::shader::{BindingKind, ShaderBinding};
use crate::{Error, Result};

/// Resources on the device, by name.
pub(in crate::gpu) type GpuResources = BTreeMap<String, (Shape, GpuResource)>;

pub(in crate::gpu) fn bind_groups(
    gpu: &Gpu,
    plan: &Plan,
    pass: &Pass,
    pipeline: &Pipeline,
    wanted: &[ShaderBinding],
    resources: &GpuResources,
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
            let Some((_, resource)) = resources.get(&plan.resource(b.resource).name) else {
                return Err(Error::Plan(format!(
                    "{}: `{}` has no resource",
                    pass.name, w.name
                )));
            };
            bound.push((w, resource, b.layer.unwrap_or(0)));
        }
        made.push(bind_group(gpu, &pass.name, &layout, &bound));
    }
    Ok(made)
}

/// A bind group of resources, each with the texture layer to bind if the shader declares the texture without layers.
pub(in crate::gpu) fn bind_group(
    gpu: &Gpu,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    bound: &[(&ShaderBinding, &GpuResource, u32)],
) -> wgpu::BindGroup {
    // Views must outlive the entries that borrow them.
    let views: Vec<Option<wgpu::TextureView>> = (bound.iter())
        .map(|(w, resource, layer)| match (resource, w.kind) {
            (GpuResource::Texture(texture), BindingKind::TextureArray) => Some(array_view(texture)),
            (GpuResource::Texture(texture), kind) => Some(aspect_view(texture, kind, *layer)),
            _ => None,
        })
        .collect();
    let entries: Vec<wgpu::BindGroupEntry<'_>> = (bound.iter().zip(&views))
        .filter_map(|((w, resource, _), view)| {
            let resource = match (resource, view) {
                (GpuResource::Buffer(buffer), _) => buffer.as_entire_binding(),
                (GpuResource::Sampler(sampler), _) => wgpu::BindingResource::Sampler(sampler),
                (GpuResource::Texture(_), view) => {
                    wgpu::BindingResource::TextureView(view.as_ref()?)
                }
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
    resources: &'a GpuResources,
) -> Result<&'a wgpu::Texture> {
    match resources.get(&plan.resource(id).name) {
        Some((_, GpuResource::Texture(texture))) => Ok(texture),
        _ => Err(Error::Plan(format!(
            "{} is not a texture",
            plan.resource(id).name
        ))),
    }
}

pub(in crate::gpu) fn buffer<'a>(
    plan: &Plan,
    id: ResourceId,
    resources: &'a GpuResources,
) -> Result<&'a wgpu::Buffer> {
    match resources.get(&plan.resource(id).name) {
        Some((_, GpuResource::Buffer(buffer))) => Ok(buffer),
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

/// View of one layer; for a depth-stencil texture, a view of the aspect that the shader declares.
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
