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
//! # Modules, in the order that a user needs them
//!
//! | module | purpose |
//! |---|---|
//! | [`scene`] | the [`Scene`]: [`Part`]s, [`Cut`]s by [`ClipSurface`]s and cutters, and a camera; [`scene::relief`] for heights |
//! | [`generate`] | solids that need no file, and solids with defects |
//! | [`Model`] at the root | a scene packed for the device; [`Model::updated`] for the same scene at another time |
//! | [`strategies`] | drawing methods: a [`Method`](strategies::Method) such as `raycast+mask@compute`, the table of all, limits |
//! | [`session`] | drawing: a [`Session`] makes pictures, or draws into a host's encoder and attachments ([`Session::encode`]) |
//! | [`gpu`] | the device: opened by [`Gpu::open`], or a host's by [`Gpu::from_device`] |
//! | [`layers`] | the visible element of each pixel: kind, part, clip-surface, depth, normal |
//! | [`slice`](mod@slice) | sections as polygons, and the kept parts as closed meshes ([`slice::capped`]), without a device |
//! | [`plan`] | the passes of a frame as plain data: each pass with its reason, its clock and its bytes |
//! | [`error`] | errors: the cause, and what to do about it |
//!
//! # Features
//!
//! None is needed for the above. `boolean` cuts meshes by reliefs and other meshes; `serde` converts limits, topology and plans to JSON.
//!
//! # Sister crates
//!
//! `cutaway-io` loads and writes meshes, images and scene files; `cutaway-lab` adds the exact reference, comparisons, hard cases,
//! experiments and reports; `cutaway-cli` is the command. Items that only these crates need are public but undocumented, and may
//! change at any time.
//!
//! # Map
//!
//! ```text
//! data     scene -> plan -> passes -> layers -> image
//! imports  scene <- generate
//!          scene <- slice <- shader <- plan <- passes <- effects <- strategies <- gpu <- session
//! ```
//!
//! A module imports only from modules to its left; all may import [`error`] and [`layers`]. Only [`gpu`] names `wgpu`. A test compares
//! this map with the source.

// Derived code refers to this crate by name, as in other crates.
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
