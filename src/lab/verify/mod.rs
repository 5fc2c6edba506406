//! The simulated cloth beside theory and what was published, in one table.
//!
//! Every reference is somebody else's: a closed form, an ordinary differential equation that knows
//! no lattice, a standard's relation, a published measurement or regression. Where theory and the
//! lattice differ, the table says by how much; nothing is tuned to it. A comparison without an
//! allowance is shown because it is instructive: the reference is no more certain than we are.

mod drape;
mod friction;
mod round_trip;
mod strips;
mod twist;

use super::{LabError, Watch};
use crate::{fabric::Fabric, solver::Progress};

/// How far a figure may be from its reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Allowed {
    /// Part of the reference [%].
    Percent(f64),
    /// In the figure's unit.
    Off(f64),
    /// Anything from the reference up to this.
    UpTo(f64),
    /// More than the reference.
    More,
    /// Shown, not judged.
    Shown,
}

/// A figure beside its reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The test, with its fabric and direction.
    pub test: String,
    /// What is compared, with its unit.
    pub quantity: &'static str,
    /// Ours.
    pub figure: f64,
    /// Theirs.
    pub reference: f64,
    /// How far apart they may be.
    pub allowed: Allowed,
    /// Whose the reference is.
    pub source: &'static str,
}

impl Comparison {
    /// Whether the figure is as near as allowed; `None` where it is shown only.
    #[must_use]
    pub fn passes(&self) -> Option<bool> {
        let off = (self.figure - self.reference).abs();
        match self.allowed {
            Allowed::Percent(most) => Some(off <= 0.01 * most * self.reference.abs()),
            Allowed::Off(most) => Some(off <= most),
            Allowed::UpTo(most) => Some((self.reference..=most).contains(&self.figure)),
            Allowed::More => Some(self.figure > self.reference),
            Allowed::Shown => None,
        }
    }

    /// By how much the figure differs from its reference [%].
    #[must_use]
    pub fn difference(&self) -> f64 {
        100.0 * (self.figure / self.reference - 1.0)
    }

    /// The reference and what is allowed about it, in words.
    #[must_use]
    pub fn allowance(&self) -> String {
        match self.allowed {
            Allowed::Percent(most) => format!("± {most} %"),
            Allowed::Off(most) => format!("± {most}"),
            Allowed::UpTo(most) => format!("to {most}"),
            Allowed::More => "more".into(),
            Allowed::Shown => "shown".into(),
        }
    }
}

/// What takes part: a fabric and what it is called.
pub type Named = (String, Fabric);

/// Runs every comparison; `tell` hears of each as soon as it is made. With `quick`, what takes
/// minutes is left out.
///
/// # Errors
/// [`LabError`] where a fabric allows no such test.
pub fn verify(
    fabrics: &[Named],
    quick: bool,
    watch: Watch<'_>,
    tell: &mut dyn FnMut(&Comparison),
) -> Result<Vec<Comparison>, LabError> {
    let mut all = Vec::new();
    let mut stopped = false;
    let mut watch = |progress: &Progress| {
        stopped = stopped || !watch(progress);
        !stopped
    };
    let each: [Compare; 4] = [
        strips::compare,
        round_trip::compare,
        twist::compare,
        friction::compare,
    ];
    let each = each.into_iter().take(if quick { 3 } else { 4 });
    let each = each.flat_map(|compare| fabrics.iter().map(move |one| (compare, one)));
    for (compare, fabric) in each {
        add(&mut all, compare(fabric, &mut watch)?, tell);
    }
    if !quick {
        drape::compare(fabrics, &mut watch, &mut |rows| add(&mut all, rows, tell))?;
    }
    if stopped {
        Err(LabError::Stopped)
    } else {
        Ok(all)
    }
}

/// A group of comparisons of one fabric.
type Compare = fn(&Named, Watch<'_>) -> Result<Vec<Comparison>, LabError>;

fn add(all: &mut Vec<Comparison>, found: Vec<Comparison>, tell: &mut dyn FnMut(&Comparison)) {
    found.iter().for_each(tell);
    all.extend(found);
}

/// How a test is called.
fn name(test: &str, fabric: &Named, of: impl core::fmt::Display) -> String {
    format!("{test}, {} {of}", fabric.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_allowance_is_kept_to() {
        let row = |figure, allowed| {
            let comparison = Comparison {
                test: String::new(),
                quantity: "",
                figure,
                reference: 10.0,
                allowed,
                source: "",
            };
            comparison.passes()
        };
        assert_eq!(row(10.2, Allowed::Percent(2.1)), Some(true));
        assert_eq!(row(10.3, Allowed::Percent(2.1)), Some(false));
        assert_eq!(row(9.5, Allowed::Off(0.4)), Some(false));
        assert_eq!(row(12.0, Allowed::UpTo(12.0)), Some(true));
        assert_eq!(row(9.9, Allowed::UpTo(12.0)), Some(false));
        assert_eq!(row(10.0, Allowed::More), Some(false));
        assert_eq!(row(f64::NAN, Allowed::Off(1.0)), Some(false));
        assert_eq!(row(10.0, Allowed::Shown), None);
    }
}
