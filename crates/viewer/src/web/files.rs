//! In-memory file storage of a page, for files that were dropped or chosen. Files that are written are also kept there, and are downloaded.

use std::borrow::Cow;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, PoisonError};

use cutaway::{Error, Result};
use cutaway_io::load::Files;
use js_sys::{Array, Uint8Array};
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{Blob, HtmlAnchorElement, Url};

use crate::storage::files::FileStorage;

type PageFile = (PathBuf, Arc<[u8]>);

/// Files in memory, in order of arrival. If two have the same name, only the newer one keeps its bytes.
#[derive(Debug, Default)]
pub struct PageFiles(Mutex<Vec<PageFile>>);

impl PageFiles {
    /// The files of this page.
    pub fn of_page() -> Arc<Self> {
        static OF_PAGE: LazyLock<Arc<PageFiles>> = LazyLock::new(Arc::default);
        OF_PAGE.clone()
    }

    /// Adds a file.
    pub fn insert(&self, path: impl Into<PathBuf>, bytes: impl Into<Arc<[u8]>>) {
        let path = path.into();
        let mut files = self.lock();
        files
            .iter_mut()
            .filter(|(name, _)| *name == path)
            .for_each(|(_, old)| *old = Arc::default());
        files.push((path, bytes.into()));
    }

    /// The files that were added after the first `count` files.
    pub fn since(&self, count: usize) -> Vec<PageFile> {
        self.lock().get(count..).unwrap_or_default().to_vec()
    }

    fn find(&self, path: &Path) -> Option<Arc<[u8]>> {
        let files = self.lock();
        let found = files.iter().rev().find(|(name, _)| name == path);
        found.map(|(_, bytes)| bytes.clone())
    }

    fn lock(&self) -> MutexGuard<'_, Vec<PageFile>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Files for PageFiles {
    fn read(&self, path: &Path) -> io::Result<Cow<'_, [u8]>> {
        let bytes = self.find(path).ok_or_else(|| {
            let what = "it was not dropped into this page";
            io::Error::new(ErrorKind::NotFound, what)
        })?;
        Ok(Cow::Owned(bytes.to_vec()))
    }

    fn is_file(&self, path: &Path) -> bool {
        self.find(path).is_some()
    }
}

impl FileStorage for PageFiles {
    fn write(&self, path: &Path, bytes: &[u8]) -> Result<()> {
        self.insert(path, bytes);
        download(path, bytes)
    }
}

/// Lets the browser download a file.
///
/// # Errors
///
/// The browser does not download the file.
pub fn download(path: &Path, bytes: &[u8]) -> Result<()> {
    try_download(path, bytes).map_err(|e| {
        let what = format!("the browser does not download it: {e:?}");
        Error::file(path, what, "allow downloads for this page")
    })
}

fn try_download(path: &Path, bytes: &[u8]) -> Result<(), JsValue> {
    let document = web_sys::window().and_then(|window| window.document());
    let document = document.ok_or("there is no page")?;
    let blob = Blob::new_with_u8_array_sequence(&Array::of1(&Uint8Array::from(bytes)))?;
    let address = Url::create_object_url_with_blob(&blob)?;
    let link: HtmlAnchorElement = document.create_element("a")?.unchecked_into();
    link.set_href(&address);
    link.set_download(&path.file_name().unwrap_or_default().to_string_lossy());
    link.click();
    Url::revoke_object_url(&address)
}
