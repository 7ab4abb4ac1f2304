//! Helpers that run a viewer in a test harness.

use std::path::PathBuf;
use std::time::Duration;

use cutaway_io::Document;
use cutaway_io::document::part;
use cutaway_io::load::Assets;
use cutaway_viewer::action::Selection;
use cutaway_viewer::device::on_our_device;
use cutaway_viewer::gizmo::Gizmo;
use cutaway_viewer::slot::SlotSide;
use cutaway_viewer::ui::Viewer;
use cutaway_viewer::world_view::WorldView;
use cutaway_viewer::{Action, State};
use eframe::egui::{Pos2, Rect, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use egui_wgpu::{RenderState, RendererOptions, WgpuConfiguration, WgpuSetup, wgpu};
use image::RgbaImage;

/// A model with few faces, so that the reference is computed quickly.
pub(crate) const TORUS: &str = "shape:torus?segments=48&sides=24";

/// A temporary folder, removed when this is dropped.
pub(crate) struct Scratch(tempfile::TempDir);

impl Scratch {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }
}

/// A device created in the same way as the window's.
pub(crate) fn host() -> RenderState {
    let mut config = WgpuConfiguration {
        wgpu_setup: WgpuSetup::without_display_handle(),
        ..WgpuConfiguration::default()
    };
    on_our_device(&mut config);
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let made = RenderState::create(&config, &instance, None, RendererOptions::default());
    pollster::block_on(made).unwrap()
}

/// A state that shows a model.
pub(crate) fn state(model: &str) -> State {
    let mut document = Document::new();
    document.add_part(part(model)).unwrap();
    State::open(document, Assets::default()).unwrap()
}

/// A viewer that has drawn a state.
pub(crate) fn viewer(state: State) -> Harness<'static, Viewer> {
    shown(Viewer::on(&host(), state).unwrap())
}

/// Runs an existing viewer in a harness.
pub(crate) fn shown(mut viewer: Viewer) -> Harness<'static, Viewer> {
    // One sample per pixel, unless a test requests more.
    viewer.smooth(false);
    let show = |ui: &mut eframe::egui::Ui, viewer: &mut Viewer| viewer.show(ui);
    let builder = Harness::builder().with_size(Vec2::new(1100.0, 640.0));
    let mut harness = builder.build_ui_state(show, viewer);
    classify(&mut harness);
    harness
}

/// Runs frames until nothing is pending, and checks that all controls are labelled.
pub(crate) fn classify(harness: &mut Harness<'_, Viewer>) {
    let mut waits = 0;
    for _ in 0..3 {
        harness.step();
    }
    while harness.state().is_busy() {
        waits += 1;
        assert!(waits < 24_000, "it never ends");
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
    harness.step();
    harness.check_accessibility();
}

/// The pixels of a slot.
pub(crate) fn pixels(harness: &Harness<'_, Viewer>, side: SlotSide) -> RgbaImage {
    pollster::block_on(harness.state().screen().read(side).unwrap()).unwrap()
}

/// Carries out an action, and waits until its effect is drawn.
pub(crate) fn act(harness: &mut Harness<'_, Viewer>, action: Action) {
    harness.state_mut().apply(action);
    classify(harness);
}

/// Rectangle of the picture, in points.
pub(crate) fn picture(harness: &Harness<'_, Viewer>) -> Rect {
    harness.get_by_label("Picture").rect()
}

/// The selected cut's gizmo, in points of the picture.
pub(crate) fn gizmo(harness: &Harness<'_, Viewer>) -> Gizmo {
    let rect = picture(harness);
    let state = harness.state().state();
    let Selection::Cut(index) = state.selection() else {
        return Gizmo::default();
    };
    let shown = state.shown().unwrap();
    let size = [rect.width(), rect.height()].map(|s| s.round() as u32);
    let up = shown.scene.camera.up;
    let view = WorldView::of(shown, size);
    Gizmo::of(state.posed(), index, (&state.bounds(), up), &view)
}

/// Drags the pointer from a point of the window.
pub(crate) fn drag(harness: &mut Harness<'_, Viewer>, from: Pos2, by: Vec2) {
    harness.drag_at(from);
    harness.step();
    harness.hover_at(from + by * 0.5);
    harness.step();
    harness.hover_at(from + by);
    harness.step();
    harness.drop_at(from + by);
    classify(harness);
}
