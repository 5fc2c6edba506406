//! From what a textile laboratory measures to the numbers of a [`Fabric`](crate::fabric::Fabric).
//!
//! [`power_law`] takes an S–S curve to A and B of (1), [`bending`] the overhangs of strips to M_BN
//! of (2), [`shear`] a record of force against angle to M_SH of (3) and (4); [`KesReadings`] and
//! [`FastReadings`] take the sheets of the two instrument sets in use. Each says how far a value may
//! be off ([`Estimate`]), what it rests on ([`Finding`]) and what is doubtful about it ([`Doubt`]),
//! and refuses what no cloth does ([`Unfit`]).
//!
//! A confidence says how far the readings leave a value open: it knows nothing of a strip cut
//! askew, or of another bolt of the same cloth.
//!
//! ```
//! use soen::fabric::fit::{Range, power_law};
//!
//! let curve: Vec<[f64; 2]> = (1..=50)
//!     .map(|k| f64::from(k) * 0.002)
//!     .map(|strain| [strain, 3.8e5 * strain.powf(2.8)])
//!     .collect();
//! let fit = power_law(&curve, &Range::default())?;
//! assert!((fit.b.value - 1.8).abs() < 1e-9);
//! # Ok::<(), soen::fabric::fit::Unfit>(())
//! ```

mod bending;
mod measured;
mod robust;
#[cfg(test)]
mod sample;
mod shear;
mod sheets;
mod tension;

pub use bending::{BendingFit, Overhangs, PAPER_ANGLE, Relation, bending, bending_length};
pub use measured::{Basis, Finding, Measured, MeasuredCurve, MeasuredDirection};
pub use shear::{ShearFit, ShearRecord, shear};
pub use sheets::{FastReadings, KesReadings};
pub use tension::{Fate, PowerFit, Range, power_law};

/// A value and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Half of its 95 % interval, in the unit of the value; absent where one reading alone says it.
    pub half_width: Option<f64>,
}

impl Estimate {
    fn new(value: f64, half_width: f64) -> Self {
        Self {
            value,
            half_width: half_width.is_finite().then_some(half_width),
        }
    }

    /// A value as a sheet gives it.
    fn given(value: f64) -> Self {
        Self {
            value,
            half_width: None,
        }
    }
}

/// Readings that give no value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unfit {
    /// A curve of a few points.
    #[error(
        "{found} points that pull, on the way up and within the range; allowed: {needed} or more"
    )]
    TooFewPoints {
        /// Points with a tension above 0.
        found: usize,
        /// How many it takes.
        needed: usize,
    },
    /// A curve that is bent the other way.
    #[error(
        "the curve flattens as it rises, B is {b:.3}; allowed: 0 to 10 (are strain and tension \
         exchanged, or is it one piece of the way up?)"
    )]
    Flattens {
        /// B [-].
        b: f64,
    },
    /// No overhang at all.
    #[error("no overhang; allowed: one or more, with the face up, the back up or both")]
    NoOverhang,
    /// The paper's relation away from its angle.
    #[error(
        "the paper's relation (2) holds at 41.5 degrees, not at {degrees:.1}; allowed there: \
         \"peirce\", \"exact\""
    )]
    NotItsAngle {
        /// The angle [degrees].
        degrees: f64,
    },
    /// A shear record of a few readings.
    #[error("{found} readings within the angles; allowed: {needed} or more")]
    TooFewAngles {
        /// Readings within the angles.
        found: usize,
        /// How many it takes.
        needed: usize,
    },
    /// A shear record that stands still.
    #[error("all readings within the angles are at one angle")]
    OneAngle,
    /// The way back of a shear record above its way out.
    #[error(
        "the hysteresis is {width:.3} gf/cm: the way back lies above the way out; allowed: 0 or \
         more (is the record in the order of its reading?)"
    )]
    NegativeHysteresis {
        /// 2HG [gf/cm].
        width: f64,
    },
    /// A shear force smaller than what the load alone makes.
    #[error(
        "the force rises by {shear:.3} gf/cm per radian less than the load's own part W·tan θ; \
         allowed: more (is load_gf too great, or width_cm wrong?)"
    )]
    LoadAlone {
        /// M_SH [gf/cm].
        shear: f64,
    },
    /// LT and WT of a KES-F sheet that disagree.
    #[error(
        "LT {lt} and WT {wt} contradict each other: with EMT {emt} %, WT is LT·500·EMT/200 = \
         {expected:.3} gf·cm/cm²"
    )]
    LinearityAndWork {
        /// LT [-].
        lt: f64,
        /// WT [gf·cm/cm²].
        wt: f64,
        /// EMT [%].
        emt: f64,
        /// WT of LT and EMT [gf·cm/cm²].
        expected: f64,
    },
    /// A linearity with no power law.
    #[error(
        "LT is {lt:.3}; allowed: 0.17 to 1 (above 1 the curve flattens as it rises, which (1) \
         cannot; give the S–S curve as a CSV, from the part that worn cloth bears)"
    )]
    Linearity {
        /// LT [-].
        lt: f64,
    },
    /// Extensions of a FAST sheet that do not grow.
    #[error(
        "E5 {e5} %, E20 {e20} % and E100 {e100} % contradict each other; allowed: E5 ≤ E20 < E100, \
         E20 above 0"
    )]
    Extensions {
        /// At 5 gf/cm [%].
        e5: f64,
        /// At 20 gf/cm [%].
        e20: f64,
        /// At 100 gf/cm [%].
        e100: f64,
    },
    /// Bending rigidity and bending length of a FAST sheet that disagree.
    #[error(
        "bending rigidity {rigidity} µN·m and bending length {length} mm contradict each other: \
         W·c³ is {expected:.3} µN·m"
    )]
    RigidityAndLength {
        /// As given [µN·m].
        rigidity: f64,
        /// As given [mm].
        length: f64,
        /// Of the length [µN·m].
        expected: f64,
    },
}

/// What is doubtful about a value that was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Doubt {
    /// The power law is not the curve's.
    #[error("A·S^(B+1) misses the curve by {:.1} % on average: a narrower range may hold", 100.0 * residual)]
    LawDoesNotHold {
        /// Relative error, root mean square [-].
        residual: f64,
    },
    /// The start of the curve looks like slack of the machine.
    #[error(
        "the first {:.2} % look like slack of the machine: without them the law misses by {:.1} % \
         in place of {:.1} %; slack_percent takes them off",
        100.0 * strain, 100.0 * residual, 100.0 * without
    )]
    Slack {
        /// Where the curve seems to begin [-].
        strain: f64,
        /// Relative error when it begins there [-].
        residual: f64,
        /// Relative error when it begins at 0 [-].
        without: f64,
    },
    /// The law is used below what was measured.
    #[error(
        "the least tension used is {least:.3} gf/cm, but 1 m of this cloth bears {worn:.3} gf/cm \
         of its own weight: below, the law is extrapolated"
    )]
    Extrapolated {
        /// [gf/cm].
        least: f64,
        /// [gf/cm].
        worn: f64,
    },
    /// Face and back bend differently.
    #[error(
        "face and back differ by more than 20 %: {face:.4} and {back:.4} gf·cm; the fabric has \
         their mean"
    )]
    FaceAndBack {
        /// [gf·cm].
        face: f64,
        /// [gf·cm].
        back: f64,
    },
    /// One side alone was measured.
    #[error("no overhang with the {absent} up: cloth curls, and one side alone hides it")]
    OneSide {
        /// "face" or "back".
        absent: &'static str,
    },
    /// Beyond what strips on a cantilever tester show.
    #[error("an overhang of {length} cm is outside of what the tester reads well, 1.5 to 20 cm")]
    OverhangRange {
        /// [cm].
        length: f64,
    },
    /// One strip unlike the others.
    #[error("an overhang of {length} cm is more than 15 % off the others' {middle:.2} cm")]
    OverhangApart {
        /// [cm].
        length: f64,
        /// Their median [cm].
        middle: f64,
    },
    /// The load outweighs the cloth in a shear record.
    #[error(
        "{:.0} % of the force is the load's own part W·tan θ: the paper asks for a tenth of the \
         usual 200 gf, or less",
        100.0 * share
    )]
    LoadRules {
        /// [-].
        share: f64,
    },
    /// A shear that cannot be told from 0.
    #[error("the shear, {shear:.4} gf/cm, is below 0 by less than it may be off: the fabric has 0")]
    ShearIsZero {
        /// [gf/cm].
        shear: f64,
    },
    /// Friction between threads cannot be told from their stiffness.
    #[error("the record has no way back: its hysteresis is unknown")]
    NoWayBack,
    /// Hysteresis so great that the value says little.
    #[error(
        "the hysteresis {what} is greater than {times} times the stiffness: rest is not one shape"
    )]
    Hysteresis {
        /// "2HG" or "2HB".
        what: &'static str,
        /// How many times.
        times: f64,
    },
    /// 2HG5 below 2HG.
    #[error("2HG5 is below 2HG: hysteresis usually grows with the angle")]
    HysteresisFalls,
    /// LT and WT of a sheet do not quite agree.
    #[error("LT and WT are {:.1} % apart: LT is used", 100.0 * apart)]
    LinearityAndWork {
        /// [-].
        apart: f64,
    },
    /// A friction against steel.
    #[error("MIU {miu} is against steel, not skin: it is kept here alone")]
    Miu {
        /// [-].
        miu: f64,
    },
    /// Weight and thickness of no cloth.
    #[error(
        "weight and thickness make {density:.3} g/cm³, outside of what cloth has, 0.05 to 1.6: one \
         of them may be in another unit"
    )]
    Density {
        /// [g/cm³].
        density: f64,
    },
    /// A value that nobody measured.
    #[error("friction is not measured: 0.35 against a body and 0.4 against cloth are assumed")]
    FrictionAssumed,
}
