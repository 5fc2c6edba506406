//! How a bone may turn: a swing about two axes and a twist about a third, each within what anatomy
//! allows.

use crate::math::{Rotation, Vec3, turn, turned};
use core::f64::consts::PI;

/// A joint at the start of a bone.
///
/// Its angles f, a, t [rad] make the turn `exp(f·axes₀ + a·axes₁)·exp(t·axes₂)`: first the bone is
/// twisted about axis 2, then it swings along the shortest way. Axes are at right angles to each
/// other; axis 2 lies along the bone where it has a twist.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// What it is called, `right_knee`.
    pub name: String,
    /// What its angles are called, `flexion`, `abduction`, `rotation`; in files `flexion_deg`.
    pub angles: [&'static str; 3],
    /// What they turn about, of length 1, in the standing frame of the parent.
    pub axes: [Vec3; 3],
    /// The least and the greatest of each [rad]; both 0 where it does not turn.
    pub limits: [[f64; 2]; 3],
}

/// An angle beyond what anatomy allows.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{joint} {angle} is {value:.1}°; allowed: {low:.0}° to {high:.0}°")]
pub struct Exceeded {
    /// The joint.
    pub joint: String,
    /// Which of its angles.
    pub angle: &'static str,
    /// Its value [degrees].
    pub value: f64,
    /// The least that is allowed [degrees].
    pub low: f64,
    /// The greatest that is allowed [degrees].
    pub high: f64,
}

/// Angles so far beyond a limit are rounding [rad].
const ROUNDING: f64 = 1e-9;

impl Joint {
    /// The turn of its angles [rad].
    #[must_use]
    pub fn rotation(&self, [f, a, t]: [f64; 3]) -> Rotation {
        turn(&(self.axes[0] * f + self.axes[1] * a)) * turn(&(self.axes[2] * t))
    }

    /// The angles of a turn [rad]: the twist within ±π, the swing at most π.
    #[must_use]
    pub fn angles(&self, rotation: &Rotation) -> [f64; 3] {
        let axis = &self.axes[2];
        let along = rotation.imag().dot(axis);
        let mut twist = 2.0 * libm::atan2(along, rotation.w);
        if twist > PI {
            twist -= 2.0 * PI;
        } else if twist < -PI {
            twist += 2.0 * PI;
        }
        let swing = turned(&(rotation * turn(&(axis * -twist))));
        [swing.dot(&self.axes[0]), swing.dot(&self.axes[1]), twist]
    }

    /// The nearest angles that anatomy allows [rad].
    #[must_use]
    pub fn within(&self, angles: [f64; 3]) -> [f64; 3] {
        core::array::from_fn(|k| angles[k].clamp(self.limits[k][0], self.limits[k][1]))
    }

    /// Angles that anatomy does not allow.
    pub fn exceeded(&self, angles: [f64; 3]) -> impl Iterator<Item = Exceeded> + '_ {
        (0..3).filter_map(move |k| {
            let ([low, high], value) = (self.limits[k], angles[k]);
            let within = (low - ROUNDING..=high + ROUNDING).contains(&value);
            (!within).then(|| Exceeded {
                joint: self.name.clone(),
                angle: self.angles[k],
                value: value.to_degrees(),
                low: low.to_degrees(),
                high: high.to_degrees(),
            })
        })
    }

    /// Whether it turns at all.
    #[must_use]
    pub fn turns(&self) -> bool {
        self.limits.iter().any(|[low, high]| low < high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn shoulder() -> Joint {
        let limits = [[-60.0, 180.0], [-50.0, 180.0], [-90.0, 70.0]];
        Joint {
            name: "left_shoulder".into(),
            angles: ["flexion", "abduction", "rotation"],
            axes: [-Vec3::x(), -Vec3::y(), -Vec3::z()],
            limits: limits.map(|pair| pair.map(f64::to_radians)),
        }
    }

    proptest! {
        #[test]
        fn angles_are_read_back(f in -2.0..2.0, a in -2.0..2.0, t in -3.0..3.0) {
            let joint = shoulder();
            let back = joint.angles(&joint.rotation([f, a, t]));
            for (back, asked) in back.iter().zip([f, a, t]) {
                prop_assert!((back - asked).abs() < 1e-9, "{back} for {asked}");
            }
        }
    }

    #[test]
    fn flexion_lifts_a_hanging_arm_forward_and_abduction_to_its_side() {
        let hanging = -Vec3::z();
        let joint = shoulder();
        let lifted = |angles: [f64; 3]| joint.rotation(angles.map(f64::to_radians)) * hanging;
        assert!((lifted([90.0, 0.0, 0.0]) + Vec3::y()).norm() < 1e-12);
        assert!((lifted([0.0, 90.0, 0.0]) - Vec3::x()).norm() < 1e-12);
        assert!((lifted([0.0, 0.0, 40.0]) - hanging).norm() < 1e-12);
    }

    #[test]
    fn a_broken_limit_is_named() {
        let joint = shoulder();
        let broken: Vec<_> = joint.exceeded([3.5, 0.0, 0.0]).collect();
        let message = broken[0].to_string();
        assert_eq!(broken.len(), 1);
        assert_eq!(
            message,
            "left_shoulder flexion is 200.5°; allowed: -60° to 180°"
        );
        assert_eq!(joint.within([3.5, 0.0, 0.0])[0], PI);
    }
}
