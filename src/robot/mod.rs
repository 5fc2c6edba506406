//! The robot of the paper (B): a person as a tailor measures one, as bones and as flesh.

mod bones;
mod bulge;
mod extremities;
mod field;
mod figure;
mod levels;
mod limbs;
mod measurements;
mod muscles;
mod profile;
#[cfg(test)]
pub(crate) mod sample;
mod skin;
mod tape;
#[cfg(test)]
mod tests;
mod trunk;

pub use bones::InvalidPerson;
pub use figure::Robot;
pub use measurements::{Girth, Girths, InvalidMeasurement, Lengths, Measurements};
pub use muscles::{Ball, Muscle};
