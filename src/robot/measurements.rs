//! What a tailor writes down of a person, and the ranges outside of which it is a slip of the pen.

use core::{f64::consts::PI, fmt};

/// A person, measured upright and unclothed.
///
/// The paper's four (B-i), stature, sitting height, shoulder width and hip width, make the bones;
/// girths make the flesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurements {
    /// Who it is.
    pub name: String,
    /// Who measured, and where that is written.
    pub source: String,
    /// From the floor to the top of the head [cm].
    pub stature: f64,
    /// From the seat to the top of the head [cm].
    pub sitting_height: f64,
    /// From the tip of one shoulder blade to the other's, biacromial [cm].
    pub shoulder_width: f64,
    /// Breadth over the hips, standing [cm].
    pub hip_width: f64,
    /// Lengths that are known; the others follow from stature and sitting height.
    pub lengths: Lengths,
    /// What a tape reads.
    pub girths: Girths,
    /// Whether the body has neck and head.
    pub head: bool,
}

/// Lengths of segments [cm], each where it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lengths {
    /// From the chin to the top of the head.
    pub head: Option<f64>,
    /// From the top of the spine, between the collar bones, to the skull's joint.
    pub neck: Option<f64>,
    /// The spine's upper part, from the last rib to between the collar bones.
    pub thorax: Option<f64>,
    /// The spine's lower part, from the pelvis to the last rib.
    pub lumbar: Option<f64>,
    /// From the hip joints up to the spine.
    pub pelvis: Option<f64>,
    /// From the tip of the shoulder to the elbow.
    pub upper_arm: Option<f64>,
    /// From the elbow to the wrist.
    pub forearm: Option<f64>,
    /// From the wrist to the finger tips.
    pub hand: Option<f64>,
    /// From the hip joint to the knee.
    pub thigh: Option<f64>,
    /// From the knee to the ankle.
    pub shank: Option<f64>,
    /// From the heel to the toes.
    pub foot: Option<f64>,
}

/// What a tape reads around the body [cm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Girths {
    /// Half way up the neck.
    pub neck: f64,
    /// Over the bust, level.
    pub bust: f64,
    /// Below the bust, level.
    pub under_bust: f64,
    /// At the waist, level.
    pub waist: f64,
    /// Over the buttocks, level.
    pub hip: f64,
    /// Of one thigh, below the crotch.
    pub thigh: f64,
    /// Over the knee.
    pub knee: f64,
    /// Of the calf, where it is thickest.
    pub calf: f64,
    /// Above the ankle, where it is thinnest.
    pub ankle: f64,
    /// Of the upper arm, half way down, hanging.
    pub upper_arm: f64,
    /// Over the elbow, straight.
    pub elbow: f64,
    /// Of the wrist.
    pub wrist: f64,
}

/// A girth by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names are those of the fields of Girths")]
pub enum Girth {
    Neck,
    Bust,
    UnderBust,
    Waist,
    Hip,
    Thigh,
    Knee,
    Calf,
    Ankle,
    UpperArm,
    Elbow,
    Wrist,
}

/// A measurement outside its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "{quantity} is {value} cm; allowed: {low} to {high} cm{}",
    after(because)
)]
pub struct InvalidMeasurement {
    /// Which one: its field, `stature`, `girths.bust` or `lengths.thigh`.
    pub quantity: String,
    /// What it is [cm].
    pub value: f64,
    /// The least that is allowed [cm].
    pub low: f64,
    /// The greatest that is allowed [cm].
    pub high: f64,
    /// What the range hangs on; empty where it is fixed.
    pub because: &'static str,
}

/// Statures from a child that has just learned to stand to the tallest man known (272 cm).
const STATURES: [f64; 2] = [60.0, 280.0];

/// Least and greatest share of the stature. Grown-ups have 0.52 to 0.55, 0.21 to 0.26 and 0.17 to
/// 0.24; children of one year have a sitting height of 0.62.
const SITTING_HEIGHTS: [f64; 2] = [0.45, 0.65];
const SHOULDER_WIDTHS: [f64; 2] = [0.17, 0.32];
const HIP_WIDTHS: [f64; 2] = [0.13, 0.40];

impl Girth {
    /// All of them, from above.
    pub const ALL: [Self; 12] = [
        Self::Neck,
        Self::Bust,
        Self::UnderBust,
        Self::Waist,
        Self::Hip,
        Self::Thigh,
        Self::Knee,
        Self::Calf,
        Self::Ankle,
        Self::UpperArm,
        Self::Elbow,
        Self::Wrist,
    ];

    /// Its field of [`Girths`].
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Neck => "neck",
            Self::Bust => "bust",
            Self::UnderBust => "under_bust",
            Self::Waist => "waist",
            Self::Hip => "hip",
            Self::Thigh => "thigh",
            Self::Knee => "knee",
            Self::Calf => "calf",
            Self::Ankle => "ankle",
            Self::UpperArm => "upper_arm",
            Self::Elbow => "elbow",
            Self::Wrist => "wrist",
        }
    }

    /// Least and greatest share of the stature: half of what the thinnest and twice of what the
    /// stoutest of the surveys had.
    fn shares(self) -> [f64; 2] {
        match self {
            Self::Bust | Self::UnderBust | Self::Waist | Self::Hip => [0.22, 1.2],
            Self::Thigh => [0.15, 0.6],
            Self::Neck => [0.13, 0.4],
            Self::Knee | Self::Calf => [0.12, 0.4],
            Self::UpperArm => [0.09, 0.4],
            Self::Elbow | Self::Ankle => [0.08, 0.3],
            Self::Wrist => [0.06, 0.2],
        }
    }
}

impl fmt::Display for Girth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Girths {
    /// One of them [cm].
    #[must_use]
    pub fn of(&self, girth: Girth) -> f64 {
        match girth {
            Girth::Neck => self.neck,
            Girth::Bust => self.bust,
            Girth::UnderBust => self.under_bust,
            Girth::Waist => self.waist,
            Girth::Hip => self.hip,
            Girth::Thigh => self.thigh,
            Girth::Knee => self.knee,
            Girth::Calf => self.calf,
            Girth::Ankle => self.ankle,
            Girth::UpperArm => self.upper_arm,
            Girth::Elbow => self.elbow,
            Girth::Wrist => self.wrist,
        }
    }
}

impl Lengths {
    /// Name, value and least and greatest share of the stature of each: half to one and a half of
    /// a grown-up's, and more for a child's head.
    fn all(&self) -> [(&'static str, Option<f64>, [f64; 2]); 11] {
        [
            ("head", self.head, [0.08, 0.27]),
            ("neck", self.neck, [0.02, 0.12]),
            ("thorax", self.thorax, [0.06, 0.24]),
            ("lumbar", self.lumbar, [0.05, 0.18]),
            ("pelvis", self.pelvis, [0.02, 0.12]),
            ("upper_arm", self.upper_arm, [0.1, 0.27]),
            ("forearm", self.forearm, [0.07, 0.21]),
            ("hand", self.hand, [0.05, 0.16]),
            ("thigh", self.thigh, [0.12, 0.36]),
            ("shank", self.shank, [0.12, 0.36]),
            ("foot", self.foot, [0.08, 0.22]),
        ]
    }
}

impl Measurements {
    /// The measurements themselves, when each is inside its range.
    ///
    /// # Errors
    /// [`InvalidMeasurement`] names the first that is not, NaN and infinities among them.
    pub fn checked(self) -> Result<Self, InvalidMeasurement> {
        let stature = self.stature;
        within("stature", stature, STATURES, "")?;
        let share = |quantity: &str, value: f64, share: [f64; 2]| {
            within(
                quantity,
                value,
                share.map(|x| tenths(x * stature)),
                OF_STATURE,
            )
        };
        share("sitting_height", self.sitting_height, SITTING_HEIGHTS)?;
        share("shoulder_width", self.shoulder_width, SHOULDER_WIDTHS)?;
        share("hip_width", self.hip_width, HIP_WIDTHS)?;
        for girth in Girth::ALL {
            let quantity = format!("girths.{girth}");
            share(&quantity, self.girths.of(girth), girth.shares())?;
        }
        for (name, length, shares) in self.lengths.all() {
            if let Some(length) = length {
                share(&format!("lengths.{name}"), length, shares)?;
            }
        }
        // Between a round and a flat section, depth over breadth 1 and 0.45.
        let hip = self.girths.hip;
        let breadths = [PI, 2.0 + 0.45 * (PI - 2.0)].map(|girth| tenths(hip / girth));
        within("hip_width", self.hip_width, breadths, "for that hip girth")?;
        Ok(self)
    }
}

const OF_STATURE: &str = "for that stature";

pub(super) fn within(
    quantity: &str,
    value: f64,
    [low, high]: [f64; 2],
    because: &'static str,
) -> Result<(), InvalidMeasurement> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(InvalidMeasurement {
        quantity: quantity.into(),
        value,
        low,
        high,
        because,
    })
}

/// To a tenth of a centimetre, as it is shown.
pub(super) fn tenths(length: f64) -> f64 {
    (10.0 * length).round() / 10.0
}

fn after(reason: &str) -> String {
    match reason {
        "" => String::new(),
        reason => format!(" {reason}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::sample::{everyone, woman};

    #[test]
    fn the_message_names_quantity_value_and_range() {
        let said = |change: fn(&mut Measurements)| {
            let mut person = woman();
            change(&mut person);
            person.checked().unwrap_err().to_string()
        };
        assert_eq!(
            said(|p| p.stature = 1.58),
            "stature is 1.58 cm; allowed: 60 to 280 cm"
        );
        assert_eq!(
            said(|p| p.sitting_height = 158.0),
            "sitting_height is 158 cm; allowed: 71.1 to 102.7 cm for that stature"
        );
        assert_eq!(
            said(|p| p.girths.calf = 3.4),
            "girths.calf is 3.4 cm; allowed: 19 to 63.2 cm for that stature"
        );
        assert_eq!(
            said(|p| p.lengths.foot = Some(234.0)),
            "lengths.foot is 234 cm; allowed: 12.6 to 34.8 cm for that stature"
        );
        // 91 cm is π times 29, and 2.51 times 36.2.
        assert_eq!(
            said(|p| p.hip_width = 40.0),
            "hip_width is 40 cm; allowed: 29 to 36.2 cm for that hip girth"
        );
    }

    #[test]
    fn every_value_is_checked_against_nan_and_infinity() {
        type Slot = fn(&mut Measurements) -> &mut f64;
        let slots: [Slot; 16] = [
            |p| &mut p.stature,
            |p| &mut p.sitting_height,
            |p| &mut p.shoulder_width,
            |p| &mut p.hip_width,
            |p| &mut p.girths.neck,
            |p| &mut p.girths.bust,
            |p| &mut p.girths.under_bust,
            |p| &mut p.girths.waist,
            |p| &mut p.girths.hip,
            |p| &mut p.girths.thigh,
            |p| &mut p.girths.knee,
            |p| &mut p.girths.calf,
            |p| &mut p.girths.ankle,
            |p| &mut p.girths.upper_arm,
            |p| &mut p.girths.elbow,
            |p| &mut p.girths.wrist,
        ];
        for person in everyone() {
            assert_eq!(person.clone().checked(), Ok(person.clone()));
            for (which, slot) in slots.iter().enumerate() {
                for value in [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e9] {
                    let mut broken = person.clone();
                    *slot(&mut broken) = value;
                    assert!(broken.checked().is_err(), "value {which} let {value} pass");
                }
            }
        }
    }
}
