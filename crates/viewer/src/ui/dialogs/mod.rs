//! Menus, keys, notices and dialogs.

#[cfg(not(target_arch = "wasm32"))]
pub(super) mod closing;
pub(super) mod keys;
pub(super) mod menu;
pub(super) mod naming;
pub(super) mod opening;
pub(super) mod toasts;
