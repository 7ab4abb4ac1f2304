//! A host with a device, an encoder, a camera and attachments of its own, which a cut solid is composed into by depth.
//!
//! The host draws a chequered floor that passes through a crankshaft; cutaway adds the crankshaft, cut open, in the same frame. Nothing
//! is read back and nothing waited for until the host wants a file: `cargo run --example embed -- out.png`.

use cutaway::gpu::{Gpu, Target, TargetDepth, wgpu};
use cutaway::passes::Model;
use cutaway::scene::{ClipSurface, Cut, HostDepth, Scene};
use cutaway::session::{Encoded, Session};
use cutaway::strategies::Strategy;
use glam::dcamera::rh::proj::directx::perspective_infinite_reverse;
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DVec3};

const SIZE_PX: [u32; 2] = [640, 480];
const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
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

/// The host's camera: where it stands, and how it projects.
fn camera() -> [DMat4; 2] {
    let view_from_world = look_at_mat4(DVec3::new(-1.2, 1.6, 3.0), DVec3::ZERO, DVec3::Y);
    let aspect = f64::from(SIZE_PX[0]) / f64::from(SIZE_PX[1]);
    let clip_from_view = perspective_infinite_reverse(0.8, aspect, 0.1);
    [view_from_world.inverse(), clip_from_view]
}

/// What is cut: a crankshaft, by a plane through its middle.
fn scene() -> cutaway::Result<Scene> {
    let mut scene = Scene {
        parts: cutaway::generate::shapes::shape("crank")?,
        ..Scene::default()
    };
    let plane = ClipSurface::parse("-z=50%", &scene.bounds())?;
    scene.cuts.push(Cut::of("front half", vec![plane]));
    Ok(scene)
}

/// The host's own things.
struct Host {
    device: wgpu::Device,
    queue: wgpu::Queue,
    color: wgpu::Texture,
    depth: wgpu::TextureView,
    floor: wgpu::RenderPipeline,
    floor_group: wgpu::BindGroup,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or("embed.png".to_owned());
    let rgba = draw()?;
    let [width, height] = SIZE_PX;
    image::save_buffer(&path, &rgba, width, height, image::ColorType::Rgba8)?;
    println!("{path}");
    Ok(())
}

/// Draws three frames of the host, and reads the last one back.
pub(crate) fn draw() -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let instance =
        wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let wanted = wgpu::RequestAdapterOptions::default();
    let adapter = pollster::block_on(instance.request_adapter(&wanted))?;
    // The device as cutaway likes it; a host adds what it wants itself.
    let (device, queue) = pollster::block_on(adapter.request_device(&Gpu::descriptor(&adapter)))?;
    let gpu = Gpu::from_device(&adapter.get_info(), device.clone(), queue.clone())?;
    let [world_from_view, clip_from_view] = camera();
    let host = Host::new(device, queue, clip_from_view * world_from_view.inverse());

    let model = Model::of(&scene()?);
    let view = (model.prepared).view_from(&world_from_view, &clip_from_view, SIZE_PX)?;
    let mut session = Session::new(gpu);
    let color_view = host
        .color
        .create_view(&wgpu::TextureViewDescriptor::default());
    let target = Target {
        color: &color_view,
        color_format: COLOR,
        depth: Some(TargetDepth {
            view: &host.depth,
            format: DEPTH,
            convention: HostDepth::of(&clip_from_view),
        }),
        sample_count: 1,
        origin_px: [0, 0],
        background: false,
        caps_only: false,
    };
    for _ in 0..3 {
        let mut encoder = (host.device).create_command_encoder(&Default::default());
        host.draw_floor(&mut encoder, &color_view);
        let encoded =
            session.encode(&mut encoder, &model, &view, Strategy::RAYCAST_MASK, &target)?;
        if let Encoded::Refused(refusal) = encoded {
            return Err(refusal.into());
        }
        host.queue.submit([encoder.finish()]);
        for (method, overflow) in session.poll()? {
            println!("{method}: {}", overflow.what);
        }
    }
    host.read_back()
}

impl Host {
    fn new(device: wgpu::Device, queue: wgpu::Queue, clip_from_world: DMat4) -> Self {
        let target = |format| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d {
                    width: SIZE_PX[0],
                    height: SIZE_PX[1],
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            })
        };
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("floor"),
            source: wgpu::ShaderSource::Wgsl(FLOOR_WGSL.into()),
        });
        let floor = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
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
                targets: &[Some(COLOR.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("clip_from_world"),
            size: 64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        queue.write_buffer(&uniform, 0, bytemuck::bytes_of(&clip_from_world.as_mat4()));
        let floor_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("floor"),
            layout: &floor.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: uniform.as_entire_binding(),
            }],
        });
        Self {
            color: target(COLOR),
            depth: target(DEPTH).create_view(&Default::default()),
            floor,
            floor_group,
            device,
            queue,
        }
    }

    /// The host's own pass.
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

    /// The picture, for a file.
    fn read_back(&self) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
        let [width, height] = SIZE_PX;
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture"),
            size: u64::from(width * height * 4),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            self.color.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &staging,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(width * 4),
                    rows_per_image: None,
                },
            },
            self.color.size(),
        );
        self.queue.submit([encoder.finish()]);
        staging.map_async(wgpu::MapMode::Read, .., |_| {});
        self.device.poll(wgpu::PollType::wait_indefinitely())?;
        let rgba = staging.get_mapped_range(..)?.to_vec();
        Ok(rgba)
    }
}
