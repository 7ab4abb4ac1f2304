//! An environment in which graphics drivers print no spurious errors.
//!
//! Where `XDG_RUNTIME_DIR` is not set, as over ssh and in containers, Mesa's device selection layer asks libwayland for a
//! display, and libwayland prints `error: XDG_RUNTIME_DIR is invalid` on standard error, which reads as if the command had
//! failed. A process cannot change its own environment without `unsafe`, so the process replaces itself
//! once, with the variable set to the folder for temporary files. Cost: about a millisecond, on Linux only.

/// Restarts the process with `XDG_RUNTIME_DIR` set if it is not; otherwise returns at once.
#[cfg(target_os = "linux")]
pub(super) fn calm_drivers() {
    use std::os::unix::process::CommandExt;

    const VARIABLE: &str = "XDG_RUNTIME_DIR";
    if std::env::var_os(VARIABLE).is_some() {
        return;
    }
    let mut args = std::env::args_os();
    let (Some(name), Ok(program)) = (args.next(), std::env::current_exe()) else {
        return;
    };
    // `exec` returns only on failure; then the command goes on, and the driver's message appears.
    let _ = std::process::Command::new(program)
        .arg0(name)
        .args(args)
        .env(VARIABLE, std::env::temp_dir())
        .exec();
}

/// Does nothing: only Linux drivers print this message.
#[cfg(not(target_os = "linux"))]
pub(super) fn calm_drivers() {}
