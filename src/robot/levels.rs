//! How high everything is when a person stands, from stature and sitting height.
//!
//! Ratios are those of Japanese bodies: AIST body size database 1997–98, size-JPN 2004–06. Sitting
//! height is larger (0.54 of the stature) and shoulders are narrower (0.23) than in Drillis and
//! Contini's segments (1966), which are used where the Japanese tables say nothing.

use super::measurements::{InvalidMeasurement, Measurements, tenths, within};

/// Heights above the floor, and lengths, of a standing person [cm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Levels {
    pub(super) stature: f64,
    /// Where the legs part: stature less sitting height; size-JPN has 71.8 cm of 158.2 and 78.3 of
    /// 170.4, within 0.5 cm of that.
    pub(super) crotch: f64,
    pub(super) hip_joint: f64,
    pub(super) ankle: f64,
    /// Tip of the shoulder blade.
    pub(super) acromion: f64,
    /// Centre of the shoulder joint's ball.
    pub(super) shoulder: f64,
    /// Top of the spine, B of figure 4, where the collar bones begin.
    pub(super) collar: f64,
    /// The skull's joint.
    pub(super) skull: f64,
    pub(super) chin: f64,
    /// Chin to the top of the head.
    pub(super) head: f64,
    pub(super) pelvis: f64,
    pub(super) lumbar: f64,
    pub(super) thorax: f64,
    /// From the centre of the shoulder joint.
    pub(super) upper_arm: f64,
    pub(super) forearm: f64,
    pub(super) hand: f64,
    pub(super) thigh: f64,
    pub(super) shank: f64,
    pub(super) foot: f64,
}

/// Hip joints stand above the crotch by this share of the stature: at 0.530 where it is at 0.473.
const HIP_ABOVE_CROTCH: f64 = 0.057;
/// … or within this, where thigh and shank are both given.
const HIPS_ABOVE_CROTCH: [f64; 2] = [0.03, 0.085];
/// Drillis and Contini.
const ANKLE: f64 = 0.039;
/// The chin is this much of the stature above the tips of the shoulders: AIST has 137.1 cm of men
/// of 170 (chin at 146.1) and 124.9 of women of 155 (131.9).
const ACROMION_BELOW_CHIN: f64 = 0.05;
/// The shoulder's ball is this much of the stature below the tip of the shoulder (from memory of
/// anatomy: 3 cm of 158) …
const SHOULDER_BELOW_ACROMION: f64 = 0.02;
/// … and the collar bones begin this much above it.
const COLLAR_ABOVE_ACROMION: f64 = 0.014;
/// AIST, tip of shoulder to elbow: 0.181 men, 0.177 women.
const UPPER_ARM: f64 = 0.180;
/// AIST, elbow to wrist: 0.141.
const FOREARM: f64 = 0.141;
/// AIST: 0.106.
const HAND: f64 = 0.106;
/// AIST: 23.4 of 158.6 women, 25.3 of 170.5 men.
const FOOT: f64 = 0.148;
/// How pelvis, lumbar and thoracic spine share the way from the hip joints to the collar bones
/// (from memory of anatomy: 10, 17, 22 cm).
const TRUNK: [f64; 3] = [0.20, 0.35, 0.45];
/// Lengths given for the whole trunk may add up to this much more or less [cm].
const TRUNK_WITHIN: f64 = 0.5;

impl Levels {
    /// # Errors
    /// [`InvalidMeasurement`] where the lengths given leave no room for those that are not.
    pub(super) fn of(person: &Measurements) -> Result<Self, InvalidMeasurement> {
        let (stature, lengths) = (person.stature, &person.lengths);
        let of_stature = |given: Option<f64>, share: f64| given.unwrap_or(share * stature);
        let head = lengths.head.unwrap_or_else(|| head_of(stature));
        let chin = stature - head;
        let skull = chin + 0.2 * head;
        let usual = chin - (ACROMION_BELOW_CHIN - COLLAR_ABOVE_ACROMION) * stature;
        let collar = lengths.neck.map_or(usual, |neck| skull - neck);
        let acromion = collar - COLLAR_ABOVE_ACROMION * stature;
        let drop = SHOULDER_BELOW_ACROMION * stature;
        let crotch = stature - person.sitting_height;
        let ankle = ANKLE * stature;
        let [thigh, shank] = leg(person, crotch, ankle)?;
        let hip_joint = ankle + thigh + shank;
        let [pelvis, lumbar, thorax] = trunk(person, collar - hip_joint)?;
        Ok(Self {
            stature,
            crotch,
            hip_joint,
            ankle,
            acromion,
            shoulder: acromion - drop,
            collar: hip_joint + pelvis + lumbar + thorax,
            skull,
            chin,
            head,
            pelvis,
            lumbar,
            thorax,
            upper_arm: of_stature(lengths.upper_arm, UPPER_ARM) - drop,
            forearm: of_stature(lengths.forearm, FOREARM),
            hand: of_stature(lengths.hand, HAND),
            thigh,
            shank,
            foot: of_stature(lengths.foot, FOOT),
        })
    }
}

/// A straight line through AIST's heads, 23.1 cm of women of 158 and 23.9 of men of 170; a child of
/// 120 cm then has 20.6, which is a sixth of it, as children have.
fn head_of(stature: f64) -> f64 {
    12.7 + 0.066 * stature
}

/// Thigh and shank are of one length (Drillis and Contini: 0.245 and 0.246), unless given.
fn leg(person: &Measurements, crotch: f64, ankle: f64) -> Result<[f64; 2], InvalidMeasurement> {
    let stature = person.stature;
    let both = crotch + HIP_ABOVE_CROTCH * stature - ankle;
    let [low, high] = HIPS_ABOVE_CROTCH.map(|share| crotch + share * stature - ankle);
    let reason = "for that stature and sitting height";
    let rest = |name: &str, given: f64| {
        let range = [tenths(0.3 * both), tenths(0.7 * both)];
        within(name, given, range, reason).map(|()| both - given)
    };
    match (person.lengths.thigh, person.lengths.shank) {
        (None, None) => Ok([0.5 * both; 2]),
        (Some(thigh), None) => Ok([thigh, rest("lengths.thigh", thigh)?]),
        (None, Some(shank)) => Ok([rest("lengths.shank", shank)?, shank]),
        (Some(thigh), Some(shank)) => {
            let range = [tenths(low - thigh), tenths(high - thigh)];
            within("lengths.shank", shank, range, "beside that thigh")?;
            Ok([thigh, shank])
        }
    }
}

/// Pelvis, lumbar and thorax: those given, and the rest shared among the others.
fn trunk(person: &Measurements, whole: f64) -> Result<[f64; 3], InvalidMeasurement> {
    let lengths = &person.lengths;
    let given = [lengths.pelvis, lengths.lumbar, lengths.thorax];
    let names = ["lengths.pelvis", "lengths.lumbar", "lengths.thorax"];
    let known: f64 = given.iter().flatten().sum();
    let open = || given.iter().zip(TRUNK).filter(|(given, _)| given.is_none());
    let shares: f64 = open().map(|(_, share)| share).sum();
    let left = whole - known;
    let (least, most) = if shares > 0.0 {
        // Half of its usual share is the least that one which is not given can have.
        (0.5 * shares * whole, f64::INFINITY)
    } else {
        (-TRUNK_WITHIN, TRUNK_WITHIN)
    };
    if !(least..=most).contains(&left) {
        let (name, value) = names
            .iter()
            .zip(given)
            .filter_map(|(name, given)| Some((*name, given?)))
            .next_back()
            .unwrap_or(("sitting_height", person.sitting_height));
        let range = [(value + left - most).max(0.0), value + left - least];
        within(name, value, range.map(tenths), "beside the other lengths")?;
    }
    let part = |index: usize| {
        let share = TRUNK.get(index).copied().unwrap_or_default();
        let given = given.get(index).copied().flatten();
        given.unwrap_or(left * share / shares.max(share))
    };
    Ok([part(0), part(1), part(2)])
}
