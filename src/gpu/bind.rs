//! Bind groups by name: the composed shader is reflected, and each of its variables takes the resource that the pass gives
//! under that name.

use std::collections::BTreeMap;

use super::Gpu;
use super::pipelines::Pipeline;
use super::program::Real;
use crate::plan::{Pass, Plan, ResourceId, Shape};
use crate::shader::{BindingKind, ShaderBinding};
use crate::{Error, Result};

/// Resources on the device, by name.
pub(super) type Reals = BTreeMap<String, (Shape, Real)>;

pub(super) fn bind_groups(
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
        // Views must outlive the entries that borrow them.
        let mut views: Vec<(u32, wgpu::TextureView)> = Vec::new();
        let mut buffers: Vec<(u32, &wgpu::Buffer)> = Vec::new();
        for w in wanted.iter().filter(|w| w.group == group) {
            let Some(b) = pass.bindings.iter().find(|b| b.name == w.name) else {
                return Err(Error::Plan(format!(
                    "{}: `{}` is bound to nothing",
                    pass.name, w.name
                )));
            };
            match real.get(&plan.resource(b.resource).name) {
                Some((_, Real::Buffer(buffer))) => buffers.push((w.binding, buffer)),
                Some((_, Real::Texture(texture))) => {
                    let view = match w.kind {
                        BindingKind::TextureArray => array_view(texture),
                        kind => aspect_view(texture, kind, b.layer.unwrap_or(0)),
                    };
                    views.push((w.binding, view));
                }
                _ => {
                    return Err(Error::Plan(format!(
                        "{}: `{}` has no resource",
                        pass.name, w.name
                    )));
                }
            }
        }
        let textures = views.iter().map(|(binding, view)| wgpu::BindGroupEntry {
            binding: *binding,
            resource: wgpu::BindingResource::TextureView(view),
        });
        let entries: Vec<wgpu::BindGroupEntry<'_>> = buffers
            .iter()
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: buffer.as_entire_binding(),
            })
            .chain(textures)
            .collect();
        made.push(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&pass.name),
            layout: &layout,
            entries: &entries,
        }));
    }
    Ok(made)
}

pub(super) fn texture<'a>(
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

pub(super) fn buffer<'a>(plan: &Plan, id: ResourceId, real: &'a Reals) -> Result<&'a wgpu::Buffer> {
    match real.get(&plan.resource(id).name) {
        Some((_, Real::Buffer(buffer))) => Ok(buffer),
        _ => Err(Error::Plan(format!(
            "{} is not a buffer",
            plan.resource(id).name
        ))),
    }
}

pub(super) fn layer_view(texture: &wgpu::Texture, layer: u32) -> wgpu::TextureView {
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
