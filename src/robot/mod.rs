//! The robot of the paper (B): a person as a tailor measures one, as bones and as flesh.

mod bones;
mod levels;
mod measurements;

#[cfg(test)]
pub(crate) mod sample;

pub use bones::InvalidPerson;
pub use measurements::{Girth, Girths, InvalidMeasurement, Lengths, Measurements};
