//! The work that is measured, here and in `benches`: a square of fabric C, 1 m a side.

use soen::{
    body::Bodies,
    forces::Laws,
    lattice::{Outline, Piece},
    math::Vec3,
    solver::{ForceModel, Placement, Problem},
};
use std::error::Error;

pub(crate) type Tried<T> = Result<T, Box<dyn Error>>;

/// The square, N × N nodes, above whatever it meets.
pub(crate) fn square(nodes: u32) -> Tried<Problem> {
    let fabric = soen::scene::fabric("c")?;
    Ok(Problem {
        piece: Piece {
            outline: Outline::rectangle(100.0, 100.0)?,
            grain: 0.0,
            pitch: 100.0 / f64::from(nodes - 1),
        },
        placement: Placement {
            centre: Vec3::new(0.0, 0.0, 26.0),
            x_axis: Vec3::x(),
            y_axis: Vec3::y(),
            curl: 0.0,
        },
        holds: vec![],
        bodies: Bodies::default(),
        friction: 0.3,
        thickness: fabric.thickness,
        laws: Laws::default(),
        forces: ForceModel::Lattice,
        seed: 1,
        fabric,
    })
}

/// So many threads to work on.
#[cfg(feature = "threads")]
pub(crate) struct Crew(rayon::ThreadPool);

#[cfg(feature = "threads")]
impl Crew {
    pub(crate) fn of(threads: usize) -> Tried<Self> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        Ok(Self(pool.build()?))
    }

    pub(crate) fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.0.install(work)
    }
}

/// The one thread that there is.
#[cfg(not(feature = "threads"))]
pub(crate) struct Crew;

#[cfg(not(feature = "threads"))]
impl Crew {
    pub(crate) fn of(_: usize) -> Tried<Self> {
        Ok(Self)
    }

    pub(crate) fn run<T>(&self, work: impl FnOnce() -> T) -> T {
        work()
    }
}
