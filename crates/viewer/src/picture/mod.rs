//! The window's picture: the camera, the slots and their textures, and the gizmo and marks painted over them.

pub mod camera;
pub mod chart;
pub mod device;
pub mod full_screen;
pub mod gizmo;
pub mod pace;
pub mod pick;
pub mod readback;
pub mod screen;
pub mod shown;
pub mod slot;
pub mod world_view;
