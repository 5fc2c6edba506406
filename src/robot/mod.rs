//! The robot of the paper (B): a person as a tailor measures one, as bones and as flesh.
//!
//! [`Measurements`] give a [`Skeleton`](crate::skeleton::Skeleton); balls strung on its bones, as
//! dumplings on a skewer, are the muscles. A tape around them reads the girths that were asked for,
//! they go where the bones go, and bulge where a limb bends. Cloth meets the balls
//! ([`Robot::parts`]) or the smooth skin over them ([`Robot::skin`]).
//!
//! What no one measured is made in proportion, and plainly: left and right are alike, hands are
//! mittens, faces have no features.
//!
//! ```
//! use soen::{robot::{Girth, Robot}, skeleton::Posture};
//!
//! let woman = soen::scene::person("woman-158".as_ref())?;
//! let robot = Robot::new(&woman)?;
//! assert!((robot.girth(Girth::Waist) - 64.0).abs() < 0.1);
//! let standing = Posture::standing(robot.skeleton());
//! let skin = robot.skin(&standing, &[])?;
//! assert!(skin.inspection().closed);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bones;
mod bulge;
mod extremities;
mod field;
mod figure;
mod found;
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

/// Name and file text of each person that ships.
pub const PEOPLE: [(&str, &str); 3] = [
    ("woman-158", include_str!("../../bodies/woman-158.toml")),
    ("man-170", include_str!("../../bodies/man-170.toml")),
    ("child-120", include_str!("../../bodies/child-120.toml")),
];
