//! What an instrument shows.

use super::Rest;
use crate::{
    lattice::{CutError, OutlineError},
    solver::Unsolvable,
};

/// One number of a reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// What it is, with its unit, as a key: `tip_drop_cm`.
    pub key: &'static str,
    /// The number.
    pub value: f64,
}

/// The curve that an instrument draws.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// What is along x, with its unit.
    pub x: &'static str,
    /// What is along y, with its unit.
    pub y: &'static str,
    /// What each line is, and its points (x, y).
    pub lines: Vec<(&'static str, Vec<[f64; 2]>)>,
}

/// All that an instrument shows.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The instrument, as the command line names it.
    pub instrument: &'static str,
    /// What was counted, and how often: the folds of several layings. Empty for what counts nothing.
    pub histogram: Vec<[usize; 2]>,
    /// Its numbers, in the order to print them in.
    pub figures: Vec<Figure>,
    /// Its curve.
    pub trace: Option<Trace>,
    /// The cloth to take a picture of.
    pub rest: Option<Rest>,
    /// Whether every shape that was measured is certified.
    pub certified: bool,
}

impl Reading {
    /// A number by its key.
    #[must_use]
    pub fn figure(&self, key: &str) -> Option<f64> {
        let mut figures = self.figures.iter();
        figures
            .find(|figure| figure.key == key)
            .map(|figure| figure.value)
    }
}

/// Figures from keys and values.
pub(super) fn figures<const N: usize>(figures: [(&'static str, f64); N]) -> Vec<Figure> {
    figures.map(|(key, value)| Figure { key, value }).into()
}

/// A test that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LabError {
    /// A setting outside its range.
    #[error("{what} is {value}; allowed: {allowed}")]
    NotAllowed {
        /// The setting.
        what: &'static str,
        /// What it is.
        value: f64,
        /// What is allowed.
        allowed: String,
    },
    /// The watcher ended it.
    #[error("stopped before it was measured")]
    Stopped,
    /// The specimen has no such outline.
    #[error(transparent)]
    Outline(#[from] OutlineError),
    /// The specimen cannot be cut.
    #[error(transparent)]
    Cut(#[from] CutError),
    /// The specimen cannot be placed.
    #[error(transparent)]
    Unsolvable(#[from] Unsolvable),
    /// A support has a size that no body can have.
    #[error(transparent)]
    Part(#[from] crate::body::PartError),
    /// What is looked for is not within the instrument's range.
    #[error("{what} is not found between {low} and {high}")]
    NotFound {
        /// What is looked for.
        what: &'static str,
        /// Where the search began.
        low: f64,
        /// Where it ended.
        high: f64,
    },
}

/// Lets only settings inside a range pass.
pub(super) fn within(what: &'static str, value: f64, low: f64, high: f64) -> Result<f64, LabError> {
    if (low..=high).contains(&value) {
        Ok(value)
    } else {
        let allowed = format!("{low} to {high}");
        Err(LabError::NotAllowed {
            what,
            value,
            allowed,
        })
    }
}
