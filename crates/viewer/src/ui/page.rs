//! Integration with the web page: dropped or chosen files, the link to the scene, and downloads of pictures.

use std::cell::{Cell, RefCell};
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use cutaway::{Error, Result};
use eframe::egui::{Context, DroppedFileHandle, Ui};
use image::{ImageFormat, RgbaImage};
use wasm_bindgen::prelude::Closure;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{File, HtmlInputElement};

use super::Viewer;
use crate::action::Action;
use crate::editing::link;
use crate::picture::slot::SlotSide;
use crate::state::State;
use crate::storage::files::{self, FileKind};
use crate::web::files::{PageFiles, download};
use cutaway::error::{Diagnostic, Severity};

/// Files and notices that asynchronous tasks deliver to the window.
#[derive(Clone, Default)]
pub(super) struct Outside {
    come: Rc<RefCell<Vec<Come>>>,
    under_way: Rc<Cell<usize>>,
}

/// A delivery to the window.
enum Come {
    /// Files that are now in the page's memory.
    Files(Vec<PathBuf>),
    /// A notice for the user.
    Told(Diagnostic),
}

impl Outside {
    pub(super) fn is_busy(&self) -> bool {
        self.under_way.get() > 0 || !self.come.borrow().is_empty()
    }

    /// Delivers the result of an asynchronous task when it is complete.
    fn await_it(&self, ctx: &Context, what: impl Future<Output = Come> + 'static) {
        let (own, ctx) = (self.clone(), ctx.clone());
        own.under_way.set(own.under_way.get() + 1);
        spawn_local(async move {
            let come = what.await;
            own.come.borrow_mut().push(come);
            own.under_way.set(own.under_way.get() - 1);
            ctx.request_repaint();
        });
    }
}

/// Reads dropped files into the page's memory.
async fn read(dropped: Vec<DroppedFileHandle>) -> Come {
    let mut paths = Vec::new();
    for file in dropped {
        let path = file.path().to_owned();
        match file.bytes_async().await {
            Ok(bytes) => PageFiles::of_page().insert(&path, bytes),
            Err(why) => return unreadable(&path, &why),
        }
        paths.push(path);
    }
    Come::Files(paths)
}

/// Reads chosen files into the page's memory.
async fn read_chosen(chosen: Vec<File>) -> Come {
    let mut paths = Vec::new();
    for file in chosen {
        let path = PathBuf::from(file.name());
        match JsFuture::from(file.array_buffer()).await {
            Ok(bytes) => {
                let bytes = js_sys::Uint8Array::new(&bytes).to_vec();
                PageFiles::of_page().insert(&path, bytes);
            }
            Err(why) => {
                return unreadable(&path, &String::from(js_sys::Object::from(why).to_string()));
            }
        }
        paths.push(path);
    }
    Come::Files(paths)
}

/// Asks in a browser dialog whether unsaved changes may be discarded.
fn is_agreed() -> bool {
    let question = "The scene was changed and is not saved. Open another in its place?";
    let asked = web_sys::window().and_then(|page| page.confirm_with_message(question).ok());
    asked.unwrap_or(true)
}

/// Actions for files that have arrived: files that the scene already uses are reloaded, and new files are opened.
fn actions_of(paths: Vec<PathBuf>, state: &State) -> Vec<Action> {
    let shown = state.shown();
    let known: Vec<&Path> = shown.map_or(Vec::new(), |s| s.timeline.files().collect());
    let (again, new): (Vec<PathBuf>, Vec<PathBuf>) = paths
        .into_iter()
        .partition(|path| known.contains(&path.as_path()));
    let reload = (!again.is_empty()).then_some(Action::Reload);
    let take = (!new.is_empty()).then(|| Action::Take(taken(new)));
    reload.into_iter().chain(take).collect()
}

/// Downloads a picture as a PNG file.
fn download_png(path: &Path, image: Result<RgbaImage>) -> Diagnostic {
    let written = image.and_then(|image| {
        let mut png = Cursor::new(Vec::new());
        let written = image.write_to(&mut png, ImageFormat::Png);
        written.map_err(|e| Error::file(path, e.to_string(), "make the window smaller"))?;
        download(path, png.get_ref())
    });
    let done = format!("exported {}", path.display());
    written.map_or_else(Diagnostic::from, |()| Diagnostic::note("exported", done))
}

fn unreadable(path: &Path, why: &str) -> Come {
    let help = "choose it again, or a smaller one";
    Come::Told(Error::file(path, format!("the browser cannot read it: {why}"), help).into())
}

/// The files to open: only the scenes if there is one, else only the meshes if there is one, else all files.
fn taken(paths: Vec<PathBuf>) -> Vec<PathBuf> {
    let of = |kind| move |path: &&PathBuf| files::kind(path).is_ok_and(|k| k == kind);
    for kind in [FileKind::Scene, FileKind::Model] {
        let taken: Vec<PathBuf> = paths.iter().filter(of(kind)).cloned().collect();
        if !taken.is_empty() {
            return taken;
        }
    }
    paths
}

impl Viewer {
    /// Handles dropped files and deliveries.
    pub(super) fn look_outside(&mut self, ctx: &Context, actions: &mut Vec<Action>) {
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        if !dropped.is_empty() {
            self.outside.await_it(ctx, read(dropped));
        }
        for come in self.outside.come.take() {
            match come {
                Come::Files(paths) => {
                    let is_scene = |path: &PathBuf| {
                        files::kind(path).is_ok_and(|kind| kind == FileKind::Scene)
                    };
                    let leaves = paths.iter().any(is_scene);
                    if !(leaves && self.state.has_unsaved_changes()) || is_agreed() {
                        actions.extend(actions_of(paths, &self.state));
                    }
                }
                Come::Told(notice) => self.toasts.add(ctx, notice),
            }
        }
    }

    /// Lets the user choose files to open, in the browser's dialog.
    pub(super) fn ask_for_files(&mut self, ctx: &Context) {
        if let Err(why) = self.choose_files(ctx) {
            let text = format!("the browser does not allow files to be chosen: {why:?}");
            self.toasts
                .add(ctx, Diagnostic::new(Severity::Error, "browser", text));
        }
    }

    /// Downloads the picture of slot A, as displayed.
    pub(super) fn begin_export(&mut self, ctx: &Context, path: &Path) {
        if path.extension().is_none_or(|ending| ending != "png") {
            let what = "a page exports only pictures (.png)";
            let help = "save the scene, and use the command for films and drawings";
            self.toasts.add(ctx, Error::file(path, what, help).into());
            return;
        }
        if let Some(image) = self.screen.read(SlotSide::A) {
            let path = path.to_owned();
            let told = async move { Come::Told(download_png(&path, image.await)) };
            self.outside.await_it(ctx, told);
        }
    }

    /// Shows a spinner while a delivery is pending.
    pub(super) fn exporting(&mut self, ui: &mut Ui) {
        if self.outside.is_busy() {
            ui.spinner();
        }
    }

    /// Copies to the clipboard a link that opens this page with this scene.
    pub(super) fn copy_link(&mut self, ctx: &Context) {
        let fragment = self.state.as_seen().and_then(|d| link::fragment(&d));
        match fragment {
            Ok(fragment) => {
                let page = web_sys::window().and_then(|window| window.location().href().ok());
                let page = page.unwrap_or_default();
                let page = page.split('#').next().unwrap_or_default();
                ctx.copy_text(format!("{page}#{fragment}"));
                let told = Diagnostic::note("copied", "the link is in the clipboard");
                self.toasts.add(ctx, told);
            }
            Err(error) => self.toasts.add(ctx, error.into()),
        }
    }

    /// Opens the browser's dialog for choosing files.
    fn choose_files(&self, ctx: &Context) -> Result<(), JsValue> {
        let document = web_sys::window().and_then(|window| window.document());
        let document = document.ok_or("there is no page")?;
        let input: HtmlInputElement = document.create_element("input")?.unchecked_into();
        input.set_type("file");
        input.set_multiple(true);
        let (outside, ctx, chosen) = (self.outside.clone(), ctx.clone(), input.clone());
        let on_change = Closure::once_into_js(move || {
            let list = chosen.files();
            let files = list
                .iter()
                .flat_map(|l| (0..l.length()).filter_map(|i| l.get(i)));
            outside.await_it(&ctx, read_chosen(files.collect()));
        });
        input.set_onchange(Some(on_change.unchecked_ref()));
        input.click();
        Ok(())
    }
}
