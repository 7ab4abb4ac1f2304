//! A host that draws surfaces itself, less what its shaders are told is removed, with our caps beside them.

use bytemuck::cast_slice;
use cutaway::Model;
use cutaway::gpu::{clip_wgsl, wgpu};
use cutaway::layers::{Kind, Layers};
use cutaway::scene::{ClipSurface, Cut, HostDepth, Scene};
use cutaway::session::{Encoded, Session};
use cutaway::strategies::Strategy;
use glam::dcamera::rh::proj::directx::perspective_infinite_reverse;
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DVec3};
use wgpu::util::DeviceExt;

use super::common::{meshes, scenes};
use super::host::{DEPTH, Host};

const SIZE_PX: [u32; 2] = [200, 150];
const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// What the host draws surfaces in.
const RED: [u8; 4] = [255, 0, 0, 255];

/// The part is the instance, as the host numbers its draws.
const HOST_WGSL: &str = "
@group(0) @binding(0) var<uniform> clip_from_world: mat4x4<f32>;
struct Corner {
    @builtin(position) at: vec4<f32>,
    @location(0) distance: f32,
    @location(1) @interpolate(flat) part: u32,
}
@vertex fn vertex(@location(0) p: vec3<f32>, @builtin(instance_index) part: u32) -> Corner {
    let at = clip_from_world * vec4<f32>(p, 1.0);
    return Corner(at, at.w, part);
}
@fragment fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    if IS_CLIPPED && !cutaway_is_kept(vec2<u32>(corner.at.xy), cutaway_depth(corner.distance), corner.part) {
        discard;
    }
    return vec4<f32>(1.0, 0.0, 0.0, 1.0);
}";

/// A crankshaft and a ball, of which one cut takes all.
fn scene() -> Scene {
    let mut scene = scenes::of_parts("crank", meshes::parts("crank"), Vec::new());
    let bounds = scene.bounds();
    let plane = ClipSurface::parse("-z=50%", &bounds).expect("a section");
    let rough = scenes::relief(&scene, "x=60%", "waves:amplitude=4%");
    let mut ball = meshes::parts("sphere?subdivisions=3").remove(0);
    ball.name = "ball".to_owned();
    ball.world_from_part = glam::DAffine3::from_scale_rotation_translation(
        DVec3::splat(0.2),
        glam::DQuat::IDENTITY,
        bounds.centre() + DVec3::Z * bounds.size().z,
    );
    scene.parts.push(ball);
    scene.cuts = vec![
        Cut::new("plane", vec![plane]),
        Cut::new("relief", vec![rough]),
    ];
    scene
}

struct Camera {
    world_from_view: DMat4,
    clip_from_view: DMat4,
}

fn camera() -> Camera {
    let view_from_world = look_at_mat4(DVec3::new(1.2, 1.6, 4.0), DVec3::ZERO, DVec3::Y);
    let aspect = f64::from(SIZE_PX[0]) / f64::from(SIZE_PX[1]);
    Camera {
        world_from_view: view_from_world.inverse(),
        clip_from_view: perspective_infinite_reverse(0.35, aspect, 0.1),
    }
}

/// Draws all parts by the host's own pipeline, clipped or not.
fn draw_surfaces(
    host: &Host,
    session: &mut Session,
    scene: &Scene,
    is_clipped: bool,
    encoder: &mut wgpu::CommandEncoder,
) {
    let device = &host.device;
    let Camera {
        world_from_view,
        clip_from_view,
    } = camera();
    let clip_from_world = (clip_from_view * world_from_view.inverse()).as_mat4();
    let kept = clip_wgsl(1).expect("text");
    let text = format!("const IS_CLIPPED = {is_clipped};\n{kept}\n{HOST_WGSL}");
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("host"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let matrix = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: cast_slice(&clip_from_world.to_cols_array()),
        usage: wgpu::BufferUsages::UNIFORM,
    });
    let own = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }],
    });
    let asked = session.gpu().clip_layout().expect("a layout");
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(&own), Some(&asked)],
        immediate_size: 0,
    });
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("host"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 12,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x3],
            })],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(COLOR.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &own,
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource: matrix.as_entire_binding(),
        }],
    });
    let clip = session.clip_group(Strategy::RAYCAST_MASK).expect("a group");
    let [color, depth] = &host.views();
    let load = wgpu::Operations {
        load: wgpu::LoadOp::Load,
        store: wgpu::StoreOp::Store,
    };
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("host"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: color,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Load,
                store: wgpu::StoreOp::Store,
            },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(load),
            stencil_ops: None,
        }),
        ..wgpu::RenderPassDescriptor::default()
    });
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.set_bind_group(1, &clip, &[]);
    for (number, part) in scene.parts.iter().enumerate() {
        let corners: Vec<[f32; 3]> = (part.mesh.triangles.iter().flatten())
            .map(|v| part.mesh.positions[*v as usize])
            .map(|p| part.world_from_part.transform_point3(p))
            .map(|p| p.as_vec3().to_array())
            .collect();
        let vertices = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: cast_slice(&corners),
            usage: wgpu::BufferUsages::VERTEX,
        });
        pass.set_vertex_buffer(0, vertices.slice(..));
        let number = number as u32;
        pass.draw(0..corners.len() as u32, number..number + 1);
    }
}

/// The host's picture, and the layers that it should show.
fn composed(is_clipped: bool) -> (Vec<u8>, Layers, Vec<u8>) {
    let host = Host::new(SIZE_PX, COLOR);
    let scene = scene();
    let model = Model::new(&scene);
    let Camera {
        world_from_view,
        clip_from_view,
    } = camera();
    let view = (model.prepared)
        .view_from(&world_from_view, &clip_from_view, SIZE_PX)
        .expect("a camera");
    let method = Strategy::RAYCAST_MASK;
    let mut session = host.session();
    // Lists first find the room that they need.
    for _ in 0..3 {
        let mut encoder = host.encoder();
        let encoded = session.encode_passes(&mut encoder, &model, &view, method);
        assert!(matches!(encoded, Ok(Encoded::Drawn { .. })), "{encoded:?}");
        host.submit(encoder);
        host.wait();
        let _ = session.poll().expect("a device");
    }
    let views = host.views();
    let mut encoder = host.encoder();
    host.clear(&mut encoder, [0.0, 1.0, 0.0], 0.0);
    let encoded = session.encode_passes(&mut encoder, &model, &view, method);
    assert_eq!(encoded.ok(), Some(Encoded::Drawn { passes: 0 }), "still");
    draw_surfaces(&host, &mut session, &scene, is_clipped, &mut encoder);
    let mut target = host.target(&views, Some(HostDepth::from_projection(&clip_from_view)));
    (target.background, target.caps_only) = (false, true);
    let encoded = session.encode(&mut encoder, &model, &view, method, &target);
    assert_eq!(encoded.ok(), Some(Encoded::Drawn { passes: 0 }), "caps");
    host.submit(encoder);
    let layers = session.layers(method).expect("layers");
    let picture = session.picture(method).expect("a picture");
    (host.read().0, layers, picture)
}

/// Pixels that are not what their layer says: red where a surface is seen, our colour where a cap is, green elsewhere.
fn wrong_px(colors: &[u8], layers: &Layers, picture: &[u8]) -> usize {
    let pixels = colors.chunks_exact(4).zip(picture.chunks_exact(4));
    let pixels = pixels.zip(&layers.pixels);
    pixels
        .filter(|((seen, ours), layer)| match layer.kind {
            Kind::Surface => *seen != RED,
            Kind::Cap => seen != ours,
            Kind::Background => **seen != [0, 255, 0, 255],
        })
        .count()
}

#[test]
fn surfaces_of_a_host_end_where_caps_begin() {
    let (colors, layers, picture) = composed(true);
    let [surfaces, caps] = [Kind::Surface, Kind::Cap].map(|kind| layers.count(kind));
    assert!(surfaces > 1000 && caps > 1000, "{surfaces} and {caps} px");
    let wrong = wrong_px(&colors, &layers, &picture);
    // The host rounds its vertices and its distances by itself, so a pixel on a silhouette or at a rim may fall to the other side.
    assert!(wrong <= 20, "{wrong} px");
    // The control: a host that does not ask covers the caps with what is removed.
    let (colors, layers, picture) = composed(false);
    let unasked = wrong_px(&colors, &layers, &picture);
    assert!(unasked > 2000, "{unasked} px");
}

#[test]
fn a_method_without_lists_has_nothing_to_clip_by() {
    let host = Host::new(SIZE_PX, COLOR);
    let scene = scenes::sectioned("cube", &["-z=50%"]);
    let model = Model::new(&scene);
    let view = model.prepared.view(SIZE_PX);
    let mut session = host.session();
    let method: cutaway::strategies::Method = "stencil".parse().expect("a method");
    let early = session.clip_group(method).expect_err("no frame");
    assert!(early.to_string().contains("stencil"), "{early}");
    let mut encoder = host.encoder();
    let encoded = session.encode_passes(&mut encoder, &model, &view, method);
    assert!(matches!(encoded, Ok(Encoded::Drawn { .. })), "{encoded:?}");
    host.submit(encoder);
    let error = session.clip_group(method).expect_err("no lists");
    assert!(error.to_string().contains("list of crossings"), "{error}");
    // Nor is there anything of a frame that was drawn and not encoded since.
    let method = Strategy::RAYCAST_MASK;
    let mut encoder = host.encoder();
    let encoded = session.encode_passes(&mut encoder, &model, &view, method);
    assert!(matches!(encoded, Ok(Encoded::Drawn { .. })), "{encoded:?}");
    host.submit(encoder);
    assert!(session.clip_group(method).is_ok(), "an encoded frame");
    let _ = session.draw(&model, &view, method).expect("a frame");
    assert!(
        session.clip_group(method).is_err(),
        "a frame that was drawn"
    );
}
