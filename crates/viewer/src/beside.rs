//! Background work, on a thread that leaves a core free for the window. A browser has no threads, so there the work runs immediately.
//!
//! Cost: a thread and a thread pool per task, about 0.1 ms.
//!
//! Cannot: cancel work that has begun.

/// Runs work in the background.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn beside(work: impl FnOnce() + Send + 'static) {
    std::thread::spawn(move || {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(cores.saturating_sub(1).max(1));
        match pool.build() {
            Ok(pool) => pool.install(work),
            Err(_) => work(),
        }
    });
}

/// Runs work immediately.
#[cfg(target_arch = "wasm32")]
pub(crate) fn beside(work: impl FnOnce() + Send + 'static) {
    work();
}
