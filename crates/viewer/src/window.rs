//! The desktop window, which is reopened when its device is lost.
//!
//! egui cannot change its device, so a window ends when its device is lost. Another window with another device continues with the same
//! [`Viewer`]: document, history, eye and slots are unchanged. Two losses within ten seconds end the program, because the cause of
//! the loss is expected to persist. Unsaved changes are then written to a file that the error names.
//!
//! Cannot: keep the widths of panels; or keep the window's position on systems that do not report it (Wayland).
//!
//! For tests: `$CUTAWAY_LOSE_DEVICE` names a file. Whenever that file exists, it is removed and the device is destroyed.

use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::Arc;
use std::{env, fs};

use cutaway::{Error, Result};
use cutaway_cli::Opened;
use cutaway_lab::experiment::Stopwatch;
use eframe::CreationContext;
use eframe::egui::{
    Context, FullOutput, Plugin, Ui, ViewportBuilder, ViewportCommand, ViewportInfo,
};
use egui_wgpu::{WgpuConfiguration, WgpuError, WgpuSetup, wgpu};

use crate::picture::device::{DeviceLoss, on_our_device};
use crate::picture::screen::Screen;
use crate::state::State;
use crate::storage::recent::Recent;
use crate::storage::recovery;
use crate::ui::Viewer;

/// If a device is lost within this time in seconds after reopening, the program ends.
const TOO_SOON_S: f64 = 10.0;

/// Variable with the name of the file whose existence destroys the device.
const LOSE_DEVICE: &str = "CUTAWAY_LOSE_DEVICE";

/// Help for errors without a usable adapter.
const INSTALL: &str = "install a Vulkan driver (a software driver is enough): the package mesa-vulkan-drivers (Debian, Ubuntu, Fedora) or \
                       vulkan-swrast (Arch)";

/// Opens a window for a document, and returns when the window is closed.
///
/// # Errors
///
/// The document cannot be opened, there is no display or no adapter, or the device is lost repeatedly.
pub fn open(opened: Opened) -> Result<()> {
    let mut window = WindowState {
        state: Some(State::open(opened.document, opened.assets)?),
        viewer: None,
        adapter: opened.adapter,
        is_profiled: opened.profile,
        placement: ViewportBuilder::default().with_inner_size([1280.0, 800.0]),
        lost: None,
        reopened: None,
        loses_by: env::var_os(LOSE_DEVICE),
    };
    loop {
        let run = window.run();
        let lost = window.lost.take();
        match (run, lost) {
            (Err(error), _) if window.viewer.is_none() => return Err(not_opened(&error)),
            (Err(error), _) => {
                let what = format!("the graphics device was lost and there is no other: {error}");
                return Err(window.given_up(what));
            }
            (Ok(()), Some(why)) if is_too_soon(window.reopened.as_ref().map(Stopwatch::ms)) => {
                let what =
                    format!("the graphics device was lost twice in {TOO_SOON_S:.0} s: {why}");
                return Err(window.given_up(what));
            }
            (Ok(()), Some(why)) => {
                eprintln!("the graphics device was lost ({why}); reopening the window");
                window.reopened = Some(Stopwatch::start());
            }
            (Ok(()), None) => {
                if let Some(profile) = window.viewer.as_ref().and_then(Viewer::profile) {
                    print!("{profile}");
                }
                return Ok(());
            }
        }
    }
}

/// Returns true if a device was lost too soon after its window was reopened; never for the first window.
fn is_too_soon(open_ms: Option<f64>) -> bool {
    open_ms.is_some_and(|open_ms| open_ms < TOO_SOON_S * 1000.0)
}

/// The error, with help, for a window that cannot be opened.
fn not_opened(error: &eframe::Error) -> Error {
    match error {
        eframe::Error::Winit(_) | eframe::Error::WinitEventLoop(_) => Error::input(
            "view",
            format!("there is no display to open a window on: {error}"),
            "set $DISPLAY or $WAYLAND_DISPLAY; `cutaway render` needs no display",
        ),
        eframe::Error::Wgpu(WgpuError::CustomNativeAdapterSelectionError(why)) => {
            let help = "name another adapter, or leave the option out";
            Error::input("--adapter", why, help)
        }
        eframe::Error::Wgpu(_) => Error::Adapter {
            what: format!("no graphics adapter can draw into a window: {error}"),
            help: INSTALL.to_owned(),
        },
        error => Error::Adapter {
            what: format!("no window can be opened: {error}"),
            help: INSTALL.to_owned(),
        },
    }
}

/// State that survives a change of the device.
struct WindowState {
    /// State of the first window.
    state: Option<State>,
    viewer: Option<Viewer>,
    /// Part of the requested adapter's name.
    adapter: Option<String>,
    is_profiled: bool,
    placement: ViewportBuilder,
    /// Reason why the last window's device was lost; `None` if it was not.
    lost: Option<String>,
    /// Time since the present window was reopened; `None` for the first window.
    reopened: Option<Stopwatch>,
    loses_by: Option<OsString>,
}

impl WindowState {
    /// Opens a window, and returns when it is closed or its device is lost.
    fn run(&mut self) -> eframe::Result {
        let mut options = eframe::NativeOptions {
            viewport: self.placement.clone(),
            renderer: eframe::Renderer::Wgpu,
            ..eframe::NativeOptions::default()
        };
        on_our_device(&mut options.wgpu_options);
        if let Some(wanted) = self.adapter.clone() {
            on_adapter(&mut options.wgpu_options, wanted);
        }
        eframe::run_native(
            "cutaway",
            options,
            Box::new(move |made| Ok(Box::new(self.begin(made)?))),
        )
    }

    fn begin(&mut self, made: &CreationContext<'_>) -> Result<App<'_>, String> {
        let host = made.wgpu_render_state.as_ref();
        let host = host.ok_or("egui draws without wgpu")?;
        let screen = Screen::on(host).map_err(|e| e.to_string())?;
        let viewer = match (self.viewer.take(), self.state.take()) {
            (Some(viewer), _) => viewer.reopened_on(screen),
            (None, Some(state)) => self.first(screen, state),
            (None, None) => return Err("there is nothing to show".to_owned()),
        };
        // Scripts wait for this line.
        println!("ready: {}", viewer.screen().gpu().name());
        self.viewer = Some(viewer);
        let woken = made.egui_ctx.clone();
        let loss = DeviceLoss::watch(&host.device, move || woken.request_repaint());
        made.egui_ctx.add_plugin(PaintsNothing(loss.clone()));
        Ok(App {
            window: self,
            device: host.device.clone(),
            loss,
        })
    }

    fn first(&self, screen: Screen, state: State) -> Viewer {
        let mut viewer = Viewer::with(screen, state);
        if self.is_profiled {
            viewer.begin_profile();
        }
        if let Some(file) = Recent::usual_file() {
            viewer.remember_in(Recent::read(file));
        }
        viewer
    }

    /// The error with which the program ends if devices keep being lost. Unsaved changes are written to a file.
    fn given_up(&self, mut what: String) -> Error {
        match self.viewer.as_ref().map(|v| recovery::keep(v.state())) {
            Some(Ok(Some(path))) => {
                what += &format!("; the changed scene is in {}", path.display());
            }
            Some(Err(error)) => what += &format!("; the changed scene is lost: {error}"),
            Some(Ok(None)) | None => {}
        }
        let help = format!(
            "update the graphics driver, end other programs that use it, or use a smaller window; if the device is still lost, {INSTALL}"
        );
        Error::Adapter { what, help }
    }
}

/// Selects egui's adapter by part of its name.
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

/// The position and size of a window, with which the next window is opened.
fn placed_as(info: &ViewportInfo) -> ViewportBuilder {
    let mut next = ViewportBuilder::default()
        .with_inner_size(info.inner_rect.map_or([1280.0, 800.0].into(), |r| r.size()))
        .with_maximized(info.maximized.unwrap_or(false))
        .with_fullscreen(info.fullscreen.unwrap_or(false));
    if let Some(outer) = info.outer_rect {
        next = next.with_position(outer.min);
    }
    next
}

/// A window on one device.
struct App<'a> {
    window: &'a mut WindowState,
    device: wgpu::Device,
    loss: DeviceLoss,
}

impl eframe::App for App<'_> {
    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        if let Some(file) = self.window.loses_by.as_ref().map(PathBuf::from)
            && fs::remove_file(file).is_ok()
        {
            self.device.destroy();
        }
        if self.loss.reason().is_none()
            && let Some(viewer) = &mut self.window.viewer
        {
            viewer.show(ui);
        }
        if let Some(why) = self.loss.reason() {
            self.window.lost = Some(why.to_owned());
            self.window.placement = ui.ctx().input(|input| placed_as(input.viewport()));
            ui.ctx().send_viewport_cmd(ViewportCommand::Close);
        }
    }
}

/// Keeps egui from painting on a lost device; it would panic there, because no buffer can be mapped.
struct PaintsNothing(DeviceLoss);

impl Plugin for PaintsNothing {
    fn debug_name(&self) -> &'static str {
        "nothing is painted on a lost device"
    }

    fn output_hook(&mut self, _: &Context, output: &mut FullOutput) {
        if self.0.reason().is_some() {
            output.shapes.clear();
            output.textures_delta.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::Rect;

    #[test]
    fn only_a_second_loss_can_be_too_soon() {
        for (open_ms, expected) in [(None, false), (Some(500.0), true), (Some(60_000.0), false)] {
            assert_eq!(is_too_soon(open_ms), expected, "{open_ms:?}");
        }
    }

    #[test]
    fn what_helps_is_told_of_what_is_missing() {
        let unnamed = WgpuError::CustomNativeAdapterSelectionError("no adapter".to_owned());
        for (error, phrase) in [
            (unnamed, "name another adapter"),
            (WgpuError::NoSurfaceFormatsAvailable, "vulkan-swrast (Arch)"),
        ] {
            let told = not_opened(&eframe::Error::Wgpu(error)).to_string();
            assert!(told.contains(phrase), "{told}");
        }
    }

    #[test]
    fn the_next_window_is_where_the_last_one_was() {
        let rect = |min: [f32; 2], max: [f32; 2]| Rect::from_min_max(min.into(), max.into());
        let next = placed_as(&ViewportInfo {
            inner_rect: Some(rect([10.0, 40.0], [650.0, 520.0])),
            outer_rect: Some(rect([8.0, 20.0], [652.0, 522.0])),
            ..ViewportInfo::default()
        });
        assert_eq!(next.inner_size, Some([640.0, 480.0].into()));
        assert_eq!(next.position, Some([8.0, 20.0].into()));
        let untold = placed_as(&ViewportInfo::default());
        assert_eq!((untold.position, untold.fullscreen), (None, Some(false)));
    }
}
