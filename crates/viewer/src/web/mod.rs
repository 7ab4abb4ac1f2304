//! The viewer on a web page: a canvas, dropped or chosen files, a link that contains the scene, and the functions that the page can call.
//!
//! The same [`Viewer`] as on a desktop, on the browser's WebGPU. Nothing is sent anywhere: files stay in the page's memory.
//!
//! Cannot: make films (the command does that); watch files; keep files from one visit to the next; continue on another device if the
//! browser takes the device away.

pub mod files;

use std::cell::RefCell;
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

use cutaway::Result;
use cutaway_io::Document;
use cutaway_io::load::Assets;
use eframe::egui::{FontData, FontDefinitions, FontFamily, Ui};
use epaint_default_fonts::UBUNTU_LIGHT;
use js_sys::{Function, Promise, Uint8Array};
use wasm_bindgen::prelude::{Closure, wasm_bindgen};
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::future_to_promise;
use web_sys::{BeforeUnloadEvent, HtmlCanvasElement};

use crate::action::Action;
use crate::editing::link;
use crate::picture::device::{DeviceLoss, on_our_device};
use crate::picture::slot::{Painter, SlotSide};
use crate::state::State;
use crate::ui::Viewer;
use files::PageFiles;

/// The page's handle to the viewer.
#[wasm_bindgen]
pub struct Cutaway {
    viewer: Rc<RefCell<Viewer>>,
    ctx: eframe::egui::Context,
    on_lost: Rc<RefCell<Option<Function>>>,
}

/// Shows the viewer on a canvas. `fragment` is the fragment of the page's address, which may contain a scene.
///
/// # Errors
///
/// The browser does not offer WebGPU.
#[wasm_bindgen]
pub async fn start(canvas: HtmlCanvasElement, fragment: String) -> Result<Cutaway, JsValue> {
    let mut options = eframe::WebOptions {
        renderer: eframe::Renderer::Wgpu,
        ..eframe::WebOptions::default()
    };
    on_our_device(&mut options.wgpu_options);
    let made = Rc::new(RefCell::new(None));
    let given = made.clone();
    let runner = eframe::WebRunner::new();
    let run = runner.start(
        canvas,
        options,
        Box::new(move |creation| {
            let host = creation.wgpu_render_state.as_ref();
            let host = host.ok_or("egui draws without wgpu")?;
            creation.egui_ctx.set_fonts(fonts());
            let viewer = Rc::new(RefCell::new(Viewer::on(host, open(&fragment)?)?));
            let on_lost = Rc::default();
            *given.borrow_mut() = Some(Cutaway {
                viewer: viewer.clone(),
                ctx: creation.egui_ctx.clone(),
                on_lost: Rc::clone(&on_lost),
            });
            let woken = creation.egui_ctx.clone();
            let loss = DeviceLoss::watch(&host.device, move || woken.request_repaint());
            ask_before_leaving(viewer.clone(), loss.clone());
            Ok(Box::new(App {
                viewer,
                loss,
                on_lost,
            }))
        }),
    );
    run.await?;
    made.take().ok_or_else(|| "the viewer did not start".into())
}

/// Makes the browser ask before the user leaves a page with unsaved changes, except after a device loss, when the scene is kept elsewhere.
fn ask_before_leaving(viewer: Rc<RefCell<Viewer>>, loss: DeviceLoss) {
    let on_leaving = Closure::<dyn FnMut(_)>::new(move |event: BeforeUnloadEvent| {
        let is_changed = viewer.borrow().state().has_unsaved_changes();
        if is_changed && loss.reason().is_none() {
            event.prevent_default();
            // Some browsers need this line instead of the one above in order to ask; none of them shows the text.
            event.set_return_value("The scene was changed and is not saved.");
        }
    });
    if let Some(window) = web_sys::window() {
        window.set_onbeforeunload(Some(on_leaving.as_ref().unchecked_ref()));
    }
    // The handler lives as long as the page.
    on_leaving.forget();
}

/// The only one of egui's four fonts that the viewer uses.
fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    let name = "Ubuntu-Light".to_owned();
    let data = Arc::new(FontData::from_static(UBUNTU_LIGHT));
    fonts.font_data.insert(name.clone(), data);
    for family in [FontFamily::Proportional, FontFamily::Monospace] {
        fonts.families.insert(family, vec![name.clone()]);
    }
    fonts
}

/// Opens the scene in a fragment. If it cannot be opened, the state is empty and has a notice with the reason.
fn open(fragment: &str) -> Result<State> {
    let store = PageFiles::of_page();
    let open = |document| {
        let assets = Assets::from_files(store.clone());
        State::open_from(store.clone(), document, assets)
    };
    match link::document(fragment).and_then(|d| open(d.unwrap_or_else(Document::new))) {
        Ok(state) => Ok(state),
        Err(error) => {
            let mut empty = open(Document::new())?;
            empty.tell(error);
            Ok(empty)
        }
    }
}

/// Keeps a scene outside the page: in a link, whose fragment is returned, or, if no link can contain it, as a download.
fn keep(scene: Document) -> Result<Option<String>> {
    if let Ok(fragment) = link::fragment(&scene) {
        return Ok(Some(fragment));
    }
    files::download(Path::new("scene.toml"), scene.to_string().as_bytes())?;
    Ok(None)
}

#[wasm_bindgen]
impl Cutaway {
    /// Opens a file as if it had been dropped: a scene replaces the present one, a model becomes a further part, an image the relief of the
    /// selected cut.
    pub fn take(&self, name: &str, bytes: &[u8]) {
        PageFiles::of_page().insert(name, bytes);
        self.apply(Action::Take(vec![name.into()]));
    }

    /// The text of the scene file.
    pub fn scene(&self) -> Result<String, JsValue> {
        let scene = self.viewer.borrow().state().as_seen();
        Ok(scene.map_err(text)?.to_string())
    }

    /// The command that draws the picture in slot A.
    pub fn command(&self) -> Result<String, JsValue> {
        let viewer = self.viewer.borrow();
        viewer.state().command(viewer.size_px()).map_err(text)
    }

    /// The fragment for the page's address with which the page opens this scene.
    pub fn fragment(&self) -> Result<String, JsValue> {
        let scene = self.viewer.borrow().state().as_seen();
        scene.and_then(|scene| link::fragment(&scene)).map_err(text)
    }

    /// Sets a function to call once when the browser takes the device away, after which nothing is drawn. Its arguments are the reason and
    /// the fragment for an address that opens the scene: null if the scene was downloaded instead, undefined if it was not kept.
    pub fn on_lost(&self, call: Function) {
        *self.on_lost.borrow_mut() = Some(call);
    }

    /// Chooses the renderer of slot A or B: a strategy such as `raycast+mask@compute`, `auto` or `exact`.
    pub fn choose(&self, is_b: bool, name: &str) -> Result<(), JsValue> {
        let painter: Painter = name.parse().map_err(text)?;
        self.apply(Action::Choose(side(is_b), painter));
        Ok(())
    }

    /// Turns the smoothing of edges at rest on or off.
    pub fn smooth(&self, is_smooth: bool) {
        self.viewer.borrow_mut().smooth(is_smooth);
        self.ctx.request_repaint();
    }

    /// Turns the comparison of the slots with the exact reference on or off.
    pub fn show_errors(&self, shows: bool) {
        self.apply(Action::ShowErrors(shows));
    }

    /// Errors of slot A or B at full resolution, as JSON; undefined until they are known.
    pub fn errors(&self, is_b: bool) -> Option<String> {
        let viewer = self.viewer.borrow();
        let (errors, _) = viewer.errors(side(is_b)).filter(|(_, at)| *at == 1)?;
        serde_json::to_string(errors).ok()
    }

    /// All crossings of the magnified pixel's ray, as JSON; undefined until known. A click while errors are shown magnifies a pixel.
    pub fn crossings(&self) -> Option<String> {
        let viewer = self.viewer.borrow();
        serde_json::to_string(&viewer.magnified()?.depths).ok()
    }

    /// The reason why slot A or B shows nothing; undefined if it shows a picture.
    pub fn refusal(&self, is_b: bool) -> Option<String> {
        let viewer = self.viewer.borrow();
        viewer.screen().refusal(side(is_b)).map(str::to_owned)
    }

    /// Returns true while something is pending: a frame, an answer from the judge, a requested pixel.
    pub fn is_busy(&self) -> bool {
        self.viewer.borrow().is_busy()
    }

    /// Width and height of a slot's picture, in pixels.
    pub fn size_px(&self) -> Vec<u32> {
        self.viewer.borrow().size_px().to_vec()
    }

    /// The pixels of slot A or B: RGBA8, rows from the top.
    pub fn picture(&self, is_b: bool) -> Promise {
        let read = self.viewer.borrow().screen().read(side(is_b));
        future_to_promise(async move {
            let read = read.ok_or("the slot has no picture")?;
            let image = read.await.map_err(text)?;
            Ok(Uint8Array::from(image.as_raw().as_slice()).into())
        })
    }

    fn apply(&self, action: Action) {
        self.viewer.borrow_mut().apply(action);
        self.ctx.request_repaint();
    }
}

fn side(is_b: bool) -> SlotSide {
    if is_b { SlotSide::B } else { SlotSide::A }
}

fn text(error: cutaway::Error) -> JsValue {
    error.to_string().into()
}

struct App {
    viewer: Rc<RefCell<Viewer>>,
    loss: DeviceLoss,
    on_lost: Rc<RefCell<Option<Function>>>,
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        let Some(why) = self.loss.reason() else {
            self.viewer.borrow_mut().show(ui);
            return;
        };
        // Taken out before the call, because the function may set another one.
        let call = self.on_lost.borrow_mut().take();
        if let Some(call) = call {
            let kept = self.viewer.borrow().state().as_seen().and_then(keep);
            // Undefined if the scene could not be kept.
            let kept = kept.map_or(JsValue::UNDEFINED, |link| {
                link.map_or(JsValue::NULL, JsValue::from)
            });
            // An exception in the page's callback is ignored.
            let _ = call.call2(&JsValue::NULL, &why.into(), &kept);
        }
    }
}
