//! The host in a window: the model turns, and the floor passes through it.

use std::error::Error;
use std::sync::Arc;

use cutaway::gpu::wgpu::{self, CurrentSurfaceTexture};
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::window::{Window, WindowId};

use super::host::Host;

/// Degrees that the camera goes around the model in a frame.
const STEP_DEG: f64 = 0.5;

/// Runs until the window is closed.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    let events = EventLoop::new()
        .map_err(|e| format!("{e}\n  help: without a display, name a file: embed out.png"))?;
    let display = Box::new(events.owned_display_handle());
    let descriptor = wgpu::InstanceDescriptor::new_with_display_handle_from_env(display);
    let mut app = App {
        instance: wgpu::Instance::new(descriptor),
        open: None,
        failure: None,
    };
    events.run_app(&mut app)?;
    app.failure.map_or(Ok(()), Err)
}

struct App {
    instance: wgpu::Instance,
    open: Option<Open>,
    failure: Option<Box<dyn Error>>,
}

/// An open window, with what draws into it.
struct Open {
    window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    configuration: wgpu::SurfaceConfiguration,
    host: Host,
    degrees: f64,
}

impl Open {
    fn new(instance: &wgpu::Instance, events: &ActiveEventLoop) -> Result<Self, Box<dyn Error>> {
        let attributes = Window::default_attributes()
            .with_title("a cut crankshaft in the frame of its host")
            .with_inner_size(PhysicalSize::new(960, 720));
        let window = Arc::new(events.create_window(attributes)?);
        let surface = instance.create_surface(window.clone())?;
        let wanted = wgpu::RequestAdapterOptions {
            compatible_surface: Some(&surface),
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&wanted))?;
        let size = window.inner_size();
        let size = PhysicalSize::new(size.width.max(1), size.height.max(1));
        let configuration = surface
            .get_default_config(&adapter, size.width, size.height)
            .ok_or("the adapter cannot draw into the window")?;
        let size_px = [size.width, size.height];
        let host = Host::new(&adapter, size_px, configuration.format)?;
        surface.configure(&host.device, &configuration);
        Ok(Self {
            window,
            surface,
            configuration,
            host,
            degrees: 0.0,
        })
    }

    fn resize(&mut self, size: PhysicalSize<u32>) {
        // A window that is folded away has no pixels.
        if size.width > 0 && size.height > 0 {
            (self.configuration.width, self.configuration.height) = (size.width, size.height);
            self.host.resize([size.width, size.height]);
            self.configure();
        }
    }

    fn configure(&self) {
        self.surface
            .configure(&self.host.device, &self.configuration);
    }

    fn draw(&mut self) -> cutaway::Result<()> {
        match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(frame) | CurrentSurfaceTexture::Suboptimal(frame) => {
                let view = frame.texture.create_view(&Default::default());
                self.host.draw(&view, self.degrees)?;
                self.host.queue.present(frame);
                self.degrees += STEP_DEG;
            }
            CurrentSurfaceTexture::Outdated | CurrentSurfaceTexture::Lost => self.configure(),
            // Asked for again when there is something to see.
            CurrentSurfaceTexture::Occluded => return Ok(()),
            // The next frame may do.
            CurrentSurfaceTexture::Timeout | CurrentSurfaceTexture::Validation => {}
        }
        self.window.request_redraw();
        Ok(())
    }
}

impl ApplicationHandler for App {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.open.is_none() {
            match Open::new(&self.instance, events) {
                Ok(open) => {
                    open.window.request_redraw();
                    self.open = Some(open);
                }
                Err(failure) => self.fail(events, failure),
            }
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(open) = &mut self.open else {
            return;
        };
        match event {
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::Resized(size) => open.resize(size),
            WindowEvent::Occluded(false) => open.window.request_redraw(),
            WindowEvent::RedrawRequested => {
                if let Err(failure) = open.draw() {
                    self.fail(events, failure.into());
                }
            }
            _ => {}
        }
    }
}

impl App {
    fn fail(&mut self, events: &ActiveEventLoop, failure: Box<dyn Error>) {
        self.failure = Some(failure);
        events.exit();
    }
}
