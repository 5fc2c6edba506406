//! The numbers everything else is written in: `f64`, nalgebra's names, and nothing tuned.

/// A point or direction in space [cm], right-handed, z up.
pub type Vec3 = nalgebra::Vector3<f64>;
/// A 3×3 matrix, for stiffness [gf/cm].
pub type Mat3 = nalgebra::Matrix3<f64>;
/// A point on the flat cloth [cm].
pub type Vec2 = nalgebra::Vector2<f64>;
/// A position and a turn in space.
pub type Pose = nalgebra::Isometry3<f64>;
/// A turn in space.
pub type Rotation = nalgebra::UnitQuaternion<f64>;

/// The turn about an axis by its length [rad], with `libm`'s sines: the same bits on every machine.
#[must_use]
pub fn turn(about: &Vec3) -> Rotation {
    let angle = about.norm();
    let (sine, cosine) = libm::sincos(0.5 * angle);
    // sin(x/2)/x → 1/2
    let part = if angle > 1e-12 { sine / angle } else { 0.5 };
    let vector = about * part;
    let quaternion = nalgebra::Quaternion::new(cosine, vector.x, vector.y, vector.z);
    Rotation::new_normalize(quaternion)
}

/// Turns about the axes of space, x, then y, then z [rad].
#[must_use]
pub fn turn_in_order([x, y, z]: [f64; 3]) -> Rotation {
    turn(&(Vec3::z() * z)) * turn(&(Vec3::y() * y)) * turn(&(Vec3::x() * x))
}

/// The axis and angle of a turn: its direction is the axis, its length the angle [rad], at most π.
#[must_use]
pub fn turned(rotation: &Rotation) -> Vec3 {
    let vector = rotation.imag();
    let (sine, cosine) = (vector.norm(), rotation.w);
    let (vector, cosine) = if cosine < 0.0 {
        (-vector, -cosine)
    } else {
        (vector, cosine)
    };
    // atan2(s, c)·2/s → 2/c
    let part = if sine > 1e-12 {
        2.0 * libm::atan2(sine, cosine) / sine
    } else {
        2.0 / cosine
    };
    vector * part
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_turn_is_nalgebras_and_is_read_back(x in -2.0..2.0, y in -2.0..2.0, z in -1.0..1.0) {
            let about = Vec3::new(x, y, z);
            let ours = turn(&about);
            prop_assert!(ours.angle_to(&Rotation::new(about)) < 1e-7);
            prop_assert!((turned(&ours) - about).norm() < 1e-9);
        }
    }

    #[test]
    fn no_turn_is_read_back_as_none() {
        assert_eq!(turn(&Vec3::zeros()), Rotation::identity());
        assert_eq!(turned(&Rotation::identity()), Vec3::zeros());
    }
}
