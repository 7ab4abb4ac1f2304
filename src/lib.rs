//! Cuts solid triangle meshes with planes and 2.5D relief clip-surfaces, and draws the caps that make the cut look solid, by several
//! strategies.
//!
//! ```
//! use cutaway::scene::relief::{Placement, Procedure};
//! use cutaway::scene::ClipSurface;
//! use cutaway::{Cut, Gpu, GpuOptions, Model, Scene, Session, Strategy};
//!
//! let mut scene = Scene { parts: cutaway::generate::shapes::shape("crank")?, ..Scene::default() };
//! let bounds = scene.bounds();
//! let waves = Procedure::named("waves").ok_or("no such relief")?.map();
//! let surface = ClipSurface::parse("-z=50%", &bounds)?.with_relief(waves, &Placement::default(), &bounds)?;
//! scene.cuts.push(Cut::new("front half", vec![surface]));
//!
//! let model = Model::new(&scene);
//! let view = model.prepared.view([640, 480]);
//! let mut session = Session::new(Gpu::open(&GpuOptions::default())?);
//! let drawn = session.draw(&model, &view, Strategy::RAYCAST_MASK)?;
//! let rgba = session.picture(Strategy::RAYCAST_MASK)?;
//! # assert_eq!(drawn.outcome, cutaway::Outcome::Complete);
//! # assert_eq!(rgba.len(), 640 * 480 * 4);
//! # assert!(session.layers(Strategy::RAYCAST_MASK)?.count(cutaway::layers::Kind::Cap) > 10_000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # In order of need
//!
//! | module | what it is for |
//! |---|---|
//! | [`scene`] | what is cut: [`Scene`] of [`Part`]s, [`Cut`]s by [`ClipSurface`]s and cutters, camera; [`scene::relief`] for heights |
//! | [`generate`] | solids without files, and solids with defects |
//! | [`Model`] at the root | a scene packed for the device; [`Model::updated`] for the same at another time |
//! | [`strategies`] | how it is drawn: a [`Method`](strategies::Method) such as `raycast+mask@compute`, the table of all, and what each refuses |
//! | [`session`] | draws: a [`Session`] for pictures, or into the encoder and the attachments of a host ([`Session::encode`]) |
//! | [`gpu`] | the device: [`Gpu::open`], or that of a host by [`Gpu::from_device`] |
//! | [`layers`] | what each pixel shows: kind, part, clip-surface, depth, normal |
//! | [`slice`](mod@slice) | sections as polygons, and what cuts leave as closed meshes ([`slice::capped`]), without a device |
//! | [`plan`] | the passes of a frame as plain data: what runs, why, on which clock, in how many bytes |
//! | [`error`] | what went wrong, with what to do about it |
//!
//! # Features
//!
//! None for the above. `boolean` cuts meshes by reliefs and by other meshes; `serde` makes JSON of limits, topology and plans.
//!
//! # Sister crates
//!
//! `cutaway-io` loads meshes, images and scene files, and writes them; `cutaway-lab` adds the exact reference, comparisons, hard cases, experiments
//! and reports; `cutaway-cli` is the command. What they alone need of this crate is public, and not in its documentation: it may change
//! at any time.
//!
//! # Map
//!
//! ```text
//! data     scene -> plan -> passes -> layers -> image
//! imports  scene <- generate
//!          scene <- slice <- shader <- plan <- passes <- effects <- strategies <- gpu <- session
//! ```
//!
//! A module imports only from modules to its left, and all may import [`error`] and [`layers`]; only [`gpu`] names `wgpu`. A test holds this map against
//! the source.

// Derived code names the crate as others do.
extern crate self as cutaway;

mod effects;
pub mod error;
pub mod generate;
pub mod gpu;
pub mod layers;
#[doc(hidden)]
pub mod passes;
pub mod plan;
pub mod scene;
pub mod session;
#[doc(hidden)]
pub mod shader;
pub mod slice;
pub mod strategies;

pub use error::{Error, Result};
pub use gpu::{Gpu, GpuOptions};
pub use layers::Layers;
pub use passes::Model;
pub use scene::{ClipSurface, Cut, Part, Scene};
pub use session::{Outcome, Session};
pub use strategies::Strategy;
