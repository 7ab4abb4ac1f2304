//! The host: a floor of its own, and a crankshaft cut open that cutaway composes into the same attachments.

use cutaway::gpu::{Gpu, Target, TargetDepth, wgpu};
use cutaway::scene::{ClipSurface, Cut, HostDepth, Scene};
use cutaway::session::{Encoded, Session};
use cutaway::strategies::Strategy;
use cutaway::{Model, Result};
use glam::dcamera::rh::proj::directx::perspective_infinite_reverse;
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DQuat, DVec3};

const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

const FLOOR_WGSL: &str = "
@group(0) @binding(0) var<uniform> clip_from_world: mat4x4<f32>;
struct Corner { @builtin(position) at: vec4<f32>, @location(0) on_floor: vec2<f32> }
@vertex fn vertex(@builtin(vertex_index) i: u32) -> Corner {
    let p = vec2<f32>(f32(i & 1u), f32(i >> 1u)) * 6.0 - 3.0;
    return Corner(clip_from_world * vec4<f32>(p.x, -0.1, p.y, 1.0), p);
}
@fragment fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    let square = vec2<i32>(floor(corner.on_floor * 4.0));
    let light = 0.15 + 0.2 * f32((square.x + square.y) & 1);
    return vec4<f32>(light, 0.3, 0.25, 1.0);
}";

/// The host's camera: where it stands, so many degrees around the model, and how it projects.
fn camera([width, height]: [u32; 2], degrees: f64) -> [DMat4; 2] {
    let eye = DQuat::from_rotation_y(degrees.to_radians()) * DVec3::new(-1.2, 1.6, 3.0);
    let view_from_world = look_at_mat4(eye, DVec3::ZERO, DVec3::Y);
    let aspect = f64::from(width) / f64::from(height);
    let clip_from_view = perspective_infinite_reverse(0.8, aspect, 0.1);
    [view_from_world.inverse(), clip_from_view]
}

/// What is cut: a crankshaft, by a plane through its middle.
fn scene() -> Result<Scene> {
    let mut scene = Scene {
        parts: cutaway::generate::shapes::shape("crank")?,
        ..Scene::default()
    };
    let plane = ClipSurface::parse("-z=50%", &scene.bounds())?;
    scene.cuts.push(Cut::new("front half", vec![plane]));
    Ok(scene)
}

/// The host, with what it embeds.
pub(crate) struct Host {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    size_px: [u32; 2],
    format: wgpu::TextureFormat,
    depth: wgpu::TextureView,
    floor: wgpu::RenderPipeline,
    floor_group: wgpu::BindGroup,
    clip_from_world: wgpu::Buffer,
    session: Session,
    model: Model,
}

impl Host {
    /// A host on an adapter that draws frames of a size and a format.
    pub(crate) fn new(
        adapter: &wgpu::Adapter,
        size_px: [u32; 2],
        format: wgpu::TextureFormat,
    ) -> std::result::Result<Self, Box<dyn std::error::Error>> {
        // The device as cutaway likes it; a host adds what it wants itself.
        let asked = adapter.request_device(&Gpu::descriptor(adapter));
        let (device, queue) = pollster::block_on(asked)?;
        let gpu = Gpu::from_device(&adapter.get_info(), device.clone(), queue.clone())?;
        let floor = floor_pipeline(&device, format);
        let clip_from_world = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("clip_from_world"),
            size: 64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let floor_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("floor"),
            layout: &floor.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: clip_from_world.as_entire_binding(),
            }],
        });
        Ok(Self {
            depth: texture(&device, size_px, DEPTH).create_view(&Default::default()),
            session: Session::new(gpu),
            model: Model::new(&scene()?),
            device,
            queue,
            size_px,
            format,
            floor,
            floor_group,
            clip_from_world,
        })
    }

    /// Goes on with attachments of another size.
    pub(crate) fn resize(&mut self, size_px: [u32; 2]) {
        self.size_px = size_px;
        self.depth = texture(&self.device, size_px, DEPTH).create_view(&Default::default());
    }

    /// Draws a frame from so many degrees around the model: the host's own pass, then the cut solid by the same depth.
    pub(crate) fn draw(&mut self, color: &wgpu::TextureView, degrees: f64) -> Result<()> {
        let [world_from_view, clip_from_view] = camera(self.size_px, degrees);
        let clip_from_world = (clip_from_view * world_from_view.inverse()).as_mat4();
        let bytes = bytemuck::bytes_of(&clip_from_world);
        self.queue.write_buffer(&self.clip_from_world, 0, bytes);
        let mut encoder = self.device.create_command_encoder(&Default::default());
        self.draw_floor(&mut encoder, color);
        let prepared = &self.model.prepared;
        let view = prepared.view_from(&world_from_view, &clip_from_view, self.size_px)?;
        let target = Target {
            color,
            color_format: self.format,
            depth: Some(TargetDepth {
                view: &self.depth,
                format: DEPTH,
                convention: HostDepth::from_projection(&clip_from_view),
            }),
            sample_count: 1,
            origin_px: [0, 0],
            background: false,
            caps_only: false,
        };
        let (session, method) = (&mut self.session, Strategy::RAYCAST_MASK);
        match session.encode(&mut encoder, &self.model, &view, method, &target)? {
            Encoded::Drawn { .. } => self.queue.submit([encoder.finish()]),
            Encoded::Refused(refusal) => return Err(cutaway::Error::Plan(refusal.reason)),
        };
        for (method, overflow) in session.poll()? {
            println!("{method}: {}", overflow.what);
        }
        Ok(())
    }

    fn draw_floor(&self, encoder: &mut wgpu::CommandEncoder, color: &wgpu::TextureView) {
        let sky = wgpu::Color {
            r: 0.02,
            g: 0.03,
            b: 0.05,
            a: 1.0,
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("floor"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: color,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(sky),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.floor);
        pass.set_bind_group(0, &self.floor_group, &[]);
        pass.draw(0..4, 0..1);
    }
}

/// An attachment that can be read.
pub(crate) fn texture(
    device: &wgpu::Device,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

fn floor_pipeline(device: &wgpu::Device, format: wgpu::TextureFormat) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("floor"),
        source: wgpu::ShaderSource::Wgsl(FLOOR_WGSL.into()),
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("floor"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState {
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
