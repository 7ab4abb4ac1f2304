//! Makes a WebAssembly module and its JavaScript, as a browser loads them, of a program that `rustc` compiled: `cutaway-bindgen WASM FOLDER`.
//!
//! It does what `wasm-bindgen --target web --remove-name-section` does, by the same library. Of the command, which also runs tests in browsers,
//! most is a server and a client of HTTP, which take some minutes to compile. The version of the library has to be that of `wasm-bindgen` in
//! the module; `Cargo.lock` has both.

use std::env;

use anyhow::{Context, bail};
use wasm_bindgen_cli_support::Bindgen;

fn main() -> anyhow::Result<()> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [module, folder] = arguments.as_slice() else {
        bail!("usage: cutaway-bindgen WASM FOLDER");
    };
    Bindgen::new()
        .input_path(module)
        .web(true)?
        .typescript(true)
        // The page names no module: the JavaScript is to load the one beside it.
        .omit_default_module_path(false)
        .remove_name_section(true)
        .generate(folder)
        .with_context(|| format!("{module} to {folder}"))
}
