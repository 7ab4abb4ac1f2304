//! The dialog that asks for the name of a file to open, save or export. An existing file is replaced only after confirmation.

use std::path::{Path, PathBuf};

use eframe::egui::{self, Context, TextEdit, Window};

use crate::action::Action;
use crate::storage::files::{self, FileKind};
use crate::ui::Viewer;

/// What the named file is for.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    target_arch = "wasm32",
    allow(dead_code, reason = "a page has files chosen by the browser")
)]
enum For {
    Open,
    Save,
    Export,
}

/// State of the dialog: the purpose of the file name, and the text typed so far.
pub(in crate::ui) struct Asks {
    what_for: For,
    typed: String,
    /// Existing file that would be replaced.
    replaces: Option<PathBuf>,
}

impl Asks {
    fn new(what_for: For, typed: impl Into<String>) -> Self {
        Self {
            what_for,
            typed: typed.into(),
            replaces: None,
        }
    }

    #[cfg(not(target_arch = "wasm32"))]
    pub(in crate::ui) fn open() -> Self {
        Self::new(For::Open, "")
    }

    fn title(&self) -> &'static str {
        match self.what_for {
            For::Open => "Open a mesh, a scene or an image",
            For::Save => "Save the scene",
            For::Export => "Export a picture (.png), a film (.gif, .mp4) or a drawing (.svg)",
        }
    }

    fn verb(&self) -> &'static str {
        match self.what_for {
            _ if self.replaces.is_some() => "Replace",
            For::Open => "Open",
            For::Save => "Save",
            For::Export => "Export",
        }
    }

    /// Path of the named file; a scene always gets the extension `.toml`.
    fn path(&self) -> PathBuf {
        let path = PathBuf::from(self.typed.trim());
        let is_scene = files::kind(&path).is_ok_and(|kind| kind == FileKind::Scene);
        match self.what_for {
            For::Save if !is_scene => path.with_added_extension("toml"),
            _ => path,
        }
    }
}

impl Viewer {
    pub(in crate::ui) fn ask_for_save(&mut self) {
        let typed = self.state.usual_file().display().to_string();
        self.asks = Some(Asks::new(For::Save, typed));
    }

    pub(in crate::ui) fn ask_for_export(&mut self) {
        self.asks = Some(Asks::new(For::Export, "cut.png"));
    }

    /// Shows the dialog while it asks for a name.
    pub(in crate::ui) fn file_dialog(&mut self, ctx: &Context) {
        let Some(asks) = &mut self.asks else {
            return;
        };
        let mut answer = None;
        Window::new(asks.title())
            .collapsible(false)
            .show(ctx, |ui| {
                let field = ui.add(TextEdit::singleline(&mut asks.typed).desired_width(360.0));
                let field = field.accessible_name("File name");
                if field.changed() {
                    asks.replaces = None;
                }
                let has_entered =
                    field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
                if let Some(there) = &asks.replaces {
                    ui.label(format!("{} is there already", there.display()));
                }
                ui.horizontal(|ui| {
                    if ui.button(asks.verb()).clicked() || has_entered {
                        answer = Some(true);
                    }
                    if ui.button("Cancel").clicked() {
                        answer = Some(false);
                    }
                });
            });
        match (answer, self.asks.take()) {
            (Some(true), Some(asks)) => self.take_name(ctx, asks),
            (None, asks) => self.asks = asks,
            _ => {}
        }
    }

    /// Uses the name that was typed, or keeps the dialog open to confirm that a file may be replaced.
    fn take_name(&mut self, ctx: &Context, mut asks: Asks) {
        let path = asks.path();
        let agreed = asks.replaces.as_deref() == Some(&*path);
        if !agreed && asks.what_for != For::Open && self.is_in_the_way(&path) {
            asks.replaces = Some(path);
            self.asks = Some(asks);
            return;
        }
        match asks.what_for {
            #[cfg(not(target_arch = "wasm32"))]
            For::Open => self.apply_or_ask(Action::Take(vec![path])),
            #[cfg(target_arch = "wasm32")]
            For::Open => self.apply(Action::Take(vec![path])),
            For::Save if agreed => self.state.apply(Action::SaveOver(path)),
            For::Save => self.state.apply(Action::Save(path)),
            For::Export => self.begin_export(ctx, &path),
        }
    }

    /// Returns true if a file exists and may be replaced after confirmation.
    fn is_in_the_way(&self, path: &Path) -> bool {
        self.state.replaces(path) && self.state.must_not_be_read(path).is_ok()
    }
}
