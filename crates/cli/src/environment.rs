//! An environment in which graphics drivers keep quiet.
//!
//! Where `XDG_RUNTIME_DIR` is not set, as over ssh and in containers, Mesa's device selection layer asks libwayland for a
//! display, and libwayland prints `error: XDG_RUNTIME_DIR is invalid` on standard error, which reads as if the command had
//! failed. Its environment cannot be mended from within a process without `unsafe`, so the process replaces itself
//! once, with the variable set to the folder for temporary files. Cost: about a millisecond, on Linux only.

/// Makes sure that drivers have nothing to complain of; returns at once where they have not.
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
    // Only returns if it failed; then the command goes on, with the message.
    let _ = std::process::Command::new(program)
        .arg0(name)
        .args(args)
        .env(VARIABLE, std::env::temp_dir())
        .exec();
}

/// Makes sure that drivers have nothing to complain of: only Linux has such drivers.
#[cfg(not(target_os = "linux"))]
pub(super) fn calm_drivers() {}
