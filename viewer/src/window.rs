//! The window on a desktop.

use std::sync::Arc;

use cutaway::cmd::Opened;
use cutaway::{Error, Result};
use eframe::egui::{Ui, ViewportBuilder};
use egui_wgpu::{WgpuConfiguration, WgpuSetup, wgpu};

use crate::device::on_our_device;
use crate::recent::Recent;
use crate::state::State;
use crate::ui::Viewer;

/// Opens a window on a document, and stays until it is closed.
///
/// # Errors
///
/// A document that cannot be opened, a display or an adapter that there is not.
pub fn open(opened: Opened) -> Result<()> {
    let state = State::open(opened.document, opened.assets)?;
    let mut options = eframe::NativeOptions {
        viewport: ViewportBuilder::default().with_inner_size([1280.0, 800.0]),
        renderer: eframe::Renderer::Wgpu,
        ..eframe::NativeOptions::default()
    };
    on_our_device(&mut options.wgpu_options);
    if let Some(wanted) = opened.adapter {
        on_adapter(&mut options.wgpu_options, wanted);
    }
    let run = eframe::run_native(
        "cutaway",
        options,
        Box::new(move |made| {
            let host = made.wgpu_render_state.as_ref();
            let host = host.ok_or("egui draws without wgpu")?;
            let mut viewer = Viewer::on(host, state)?;
            if opened.profile {
                viewer.begin_profile();
            }
            if let Some(file) = Recent::usual_file() {
                viewer.remember_in(Recent::read(file));
            }
            // Scripts wait for it.
            println!("ready: {}", viewer.screen().gpu().report().name);
            Ok(Box::new(App(viewer)))
        }),
    );
    run.map_err(|e| {
        Error::input(
            "view",
            format!("no window can be opened: {e}"),
            "it needs a display ($DISPLAY or $WAYLAND_DISPLAY) and a graphics adapter, for which a software driver will do (the package \
             mesa-vulkan-drivers of Debian, Ubuntu and Fedora); `cutaway render` needs no display",
        )
    })
}

/// Lets egui take the adapter with some words in its name.
fn on_adapter(options: &mut WgpuConfiguration, wanted: String) {
    let WgpuSetup::CreateNew(setup) = &mut options.wgpu_setup else {
        return;
    };
    let select = move |adapters: &[wgpu::Adapter], _: Option<&wgpu::Surface<'_>>| {
        let name = |a: &wgpu::Adapter| a.get_info().name;
        let is_wanted =
            |a: &&wgpu::Adapter| name(a).to_lowercase().contains(&wanted.to_lowercase());
        adapters.iter().find(is_wanted).cloned().ok_or_else(|| {
            let names: Vec<String> = adapters.iter().map(name).collect();
            format!(
                "no adapter has `{wanted}` in its name; use part of one of: {}",
                names.join(", ")
            )
        })
    };
    setup.native_adapter_selector = Some(Arc::new(select));
}

struct App(Viewer);

impl eframe::App for App {
    fn on_exit(&mut self) {
        if let Some(profile) = self.0.profile() {
            print!("{profile}");
        }
    }

    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        self.0.show(ui);
    }
}
