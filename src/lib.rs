//! `soen` computes how cloth hangs: from measured fabric properties it finds the shape in which
//! every point of the cloth is in equilibrium, over any body, and proves it with a certificate.
//! The method grew from T. Soen, *Computer Simulation of Shape of Clothes*; numbers in round
//! brackets, (1) to (8), are that paper's equations, and its figures are scenes in `scenes/`.
//!
//! It promises a shape at rest: the certificate recomputes the forces from the positions alone,
//! without the solver. Cloth in motion may have inertia ([`solver::step`]); then it promises, frame by
//! frame, that forces balance with it. It does not promise the only shape at rest, for cloth has many (the scene's
//! seed picks one), nor that cloth keeps clear of itself.
//!
//! ```
//! use soen::{
//!     body::{Bodies, Part, Shape},
//!     forces::Laws,
//!     lattice::{Outline, Piece},
//!     math::{Pose, Vec3},
//!     solver::{ForceModel, Placement, Problem, Settings, settle},
//! };
//!
//! let fabric = soen::scene::fabric("c")?;
//! let ball = Part::new("ball".into(), &Shape::Ball { radius: 5.0 }, Pose::identity())?;
//! let centre = Vec3::new(0.0, 0.0, 6.0);
//! let problem = Problem {
//!     piece: Piece { outline: Outline::disc(8.0)?, grain: 0.0, pitch: 2.0 },
//!     placement: Placement { centre, x_axis: Vec3::x(), y_axis: Vec3::y(), curl: 0.0 },
//!     holds: vec![],
//!     bodies: Bodies::new(vec![ball]),
//!     friction: fabric.friction.body,
//!     thickness: fabric.thickness,
//!     laws: Laws::default(),
//!     forces: ForceModel::Lattice,
//!     seed: 1,
//!     fabric,
//! };
//! let drape = settle(&problem, &Settings { tolerance: 1e-3, frames: 0 }, &mut |_| true)?;
//! assert!(drape.converged);
//! println!("The hem hangs {:.2} cm below the top.", drape.shape.highest - drape.shape.lowest);
//! # assert!((3.0..8.0).contains(&(drape.shape.highest - drape.shape.lowest)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Units and frame
//! The textile laboratory's: cm, gram-force (gf), degrees in files, radians in code. Energy
//! [gf·cm]; contact pressure is shown in kPa too (1 gf/cm² = 0.0980665 kPa). Right-handed, z up,
//! gravity along −z. Every key of a file has its unit in its name, every quantity in its doc
//! comment. All is `f64`.
//!
//! # Code map
//! Below, in the order to read it in; a module names only modules above it, which a test keeps
//! true (`tests/suite/layers.rs`). [`scene::read`] gives a [`solver::Problem`], [`solver::settle`]
//! takes it to a [`solver::Settled`], and [`output`] makes files of that; [`scene::measured`] finds a
//! [`fabric::Fabric`] in what a laboratory measured; [`play::next`] goes on to the next frame of a
//! motion. The command line is `src/bin/soen`, the first user of this library.
//!
//! # What always holds
//! - A drape that did not converge is a value with its certificate, not an `Err`.
//! - The same problem gives the same bits, on any number of threads: no sum's order depends on
//!   them, no hash map is walked, and sines and powers are `libm`'s.
//! - `certificate` shares no sum, list or derivative with `solver`.
//!
//! And what is always absent:
//! - time, but in `motion` and `play`, which pose bodies by it, and where cloth has inertia:
//!   [`solver::step`] and its certificate. Masses are weights over standard gravity (`src/forces/momentum.rs`);
//! - a body inside `fabric` or `forces`, a material inside `lattice`, a scene inside `solver`;
//! - files outside `scene` and `output`, and clocks, arguments and printing outside the command
//!   line: the rest compiles to wasm32;
//! - a panic that input can reach, and unsafe code.

pub mod math;

// The cloth.
pub mod fabric;
pub mod lattice;

pub mod forces;

// What it meets.
pub mod body;
pub mod contact;

// Who wears it.
pub mod skeleton;

pub mod motion;
pub mod robot;

// Rest, and the proof of it.
pub mod certificate;
pub mod solver;

// Cloth that is worn while its wearer moves.
pub mod play;

// What a textile laboratory does with it.
pub mod lab;

// In and out.
pub mod scene;

pub mod output;
pub mod snapshot;

mod lanes;
mod threads;
