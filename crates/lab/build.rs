//! Builds the crate again when a hard case comes or goes: its files are part of the program.

fn main() {
    println!("cargo:rerun-if-changed=hard-cases");
}
