//! The laboratory: the tests that measured a fabric, run on the simulated cloth.
//!
//! Each instrument takes a [`Fabric`](crate::fabric::Fabric), cuts its specimen, brings it to rest
//! and reads off the same numbers that the laboratory's instrument shows, in the same units: so
//! that parameters can be checked by the measurements they came from, and the lattice by theory.
//! A [`Reading`] also has the instrument's curve, and the drape to make a picture of.
//!
//! Nothing here is fitted to what comes out. [`elastica`] knows what the continuum does.
//!
//! ```
//! use soen::{fabric::Yarn, lab};
//!
//! let fabric = soen::scene::fabric("c")?;
//! let test = lab::Cantilever { yarn: Yarn::Warp, overhang: 4.0, pitch: 0.5 };
//! let bent = test.run(&fabric, &mut |_| true)?;
//! assert!((bent.tip_drop - 3.84).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bias_bend;
mod buckling;
mod cantilever;
mod capstan;
mod drapemeter;
pub mod elastica;
mod heart_loop;
mod reading;
mod resolution;
mod shadow;
mod shear;
mod slope;
mod specimen;
mod stick_slip;
mod strip;
mod verify;

pub use bias_bend::{BiasBend, BiasBent};
pub use buckling::{Buckling, CRITICAL, Stood};
pub use cantilever::{Bent, Cantilever, Overhang, SLOPE};
pub use capstan::{Capstan, Held};
pub use drapemeter::{Drapemeter, Drapes, Laying};
pub use heart_loop::{Heart, HeartLoop};
pub use reading::{Figure, LabError, Reading, Trace};
pub use resolution::{Order, Resolution, Resolved};
pub use shadow::{Folds, Shadow};
pub use shear::{Frame, ShearFrame, Sheared};
pub use slope::{Slid, Slope};
pub use specimen::{Cut, Rest};
pub use stick_slip::{Slipped, StickSlip};
pub use strip::{Hung, HungStrip, Pull, Pulled};
pub use verify::{Allowed, Comparison, Named, verify};

use crate::solver::Progress;

/// Asked between sweeps whether to go on.
pub type Watch<'w> = &'w mut (dyn FnMut(&Progress) -> bool + Send);
