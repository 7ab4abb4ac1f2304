//! A frame of a scene that stands still allocates nothing of ours.
//!
//! wgpu allocates for every pass that is recorded and every scope that is opened. What is ours is the difference to the same pass recorded
//! by hand.

use allocation_counter::measure;
use cutaway::Model;
use cutaway::gpu::wgpu;
use cutaway::session::Encoded;
use cutaway::strategies::Strategy;

use super::common::scenes;
use super::host::Host;

const SIZE_PX: [u32; 2] = [160, 120];
const PLAIN: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

const BY_HAND: &str = "
@group(0) @binding(0) var<uniform> a: vec4<f32>;
@group(0) @binding(1) var<storage, read> b: array<u32>;
@group(0) @binding(2) var<storage, read> c: array<u32>;
@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(f32(i), 0.0, 0.0, 1.0);
}
@fragment fn fragment() -> @location(0) vec4<f32> { return a * f32(b[0] + c[0]); }";

/// One pass by hand, with as many bindings as the one that composites.
struct ByHand {
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
}

impl ByHand {
    fn new(host: &Host) -> Self {
        let module = (host.device).create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(BY_HAND.into()),
        });
        let pipeline = (host.device).create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: None,
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: None,
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(PLAIN.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let buffers = [
            wgpu::BufferUsages::UNIFORM,
            wgpu::BufferUsages::STORAGE,
            wgpu::BufferUsages::STORAGE,
        ]
        .map(|usage| {
            host.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: 64,
                usage,
                mapped_at_creation: false,
            })
        });
        let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
            .zip(&buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let group = host.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        Self { pipeline, group }
    }

    fn encode(&self, host: &Host, encoder: &mut wgpu::CommandEncoder, color: &wgpu::TextureView) {
        let filters = [
            wgpu::ErrorFilter::OutOfMemory,
            wgpu::ErrorFilter::Validation,
        ];
        let scopes = filters.map(|filter| host.device.push_error_scope(filter));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("composite"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: color,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Load,
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.set_viewport(0.0, 0.0, 160.0, 120.0, 0.0, 1.0);
        pass.set_scissor_rect(0, 0, 160, 120);
        pass.draw(0..3, 0..1);
        drop(pass);
        for scope in scopes.into_iter().rev() {
            drop(scope.pop());
        }
    }
}

#[test]
fn a_still_frame_allocates_what_its_one_pass_takes() {
    let host = Host::new(SIZE_PX, PLAIN);
    let model = Model::new(&scenes::sectioned("cube", &["-z=50%"]));
    let view = model.prepared.view(SIZE_PX);
    let views = host.views();
    let mut session = host.session();
    let by_hand = ByHand::new(&host);
    let (mut ours, mut of_wgpu) = (Vec::new(), Vec::new());
    for _ in 0..6 {
        let mut encoder = host.encoder();
        let target = host.target(&views, None);
        let counted = measure(|| {
            let method = Strategy::RAYCAST_MASK;
            let encoded = session.encode(&mut encoder, &model, &view, method, &target);
            assert!(matches!(encoded, Ok(Encoded::Drawn { .. })), "{encoded:?}");
        });
        ours.push(counted.count_total);
        host.submit(encoder);
        host.wait();
        let polled = measure(|| {
            let overflows = session.poll().expect("a device");
            assert_eq!(overflows, [], "a plane needs no more");
        });
        assert!(
            polled.count_total < 1000,
            "polling allocates {}",
            polled.count_total
        );

        let mut encoder = host.encoder();
        let counted = measure(|| by_hand.encode(&host, &mut encoder, &views[0]));
        of_wgpu.push(counted.count_total);
        host.submit(encoder);
    }
    assert!(ours[0] > 10 * of_wgpu[0], "the first frame: {ours:?}");
    assert_eq!(ours[2..], of_wgpu[2..], "after the second frame");
}
