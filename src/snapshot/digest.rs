//! All positions in one number.

use crate::math::Vec3;

/// Steps to which positions are rounded, per centimetre.
const STEPS: f64 = 1000.0;

/// The FNV-1a hash (64 bits; Fowler, Noll, Vo) of all positions, each coordinate rounded to
/// 0.001 cm and taken as a whole number of 8 bytes, the lowest first. −0 counts as 0.
#[must_use]
pub fn digest(positions: &[Vec3]) -> u64 {
    // The cast gives 0 for −0 and for what is not a number.
    let steps = |coordinate: &f64| (coordinate * STEPS).round() as i64;
    let coordinates = positions.iter().flat_map(|position| position.iter());
    let bytes = coordinates.flat_map(|coordinate| steps(coordinate).to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_published_hash() {
        assert_eq!(digest(&[]), 0xcbf2_9ce4_8422_2325);
        // By hand: 24 zero bytes multiply the start by the prime 24 times.
        let zeros = (0..24).fold(0xcbf2_9ce4_8422_2325_u64, |hash, _| {
            hash.wrapping_mul(0x0000_0100_0000_01b3)
        });
        assert_eq!(digest(&[Vec3::zeros()]), zeros);
    }

    #[test]
    fn it_sees_a_hundredth_of_a_millimetre_and_nothing_below() {
        let one = Vec3::new(1.0, -0.0, 2.0);
        assert_eq!(
            digest(&[one]),
            digest(&[Vec3::new(1.0004, -0.0004, 1.9996)])
        );
        assert_ne!(digest(&[one]), digest(&[Vec3::new(1.001, 0.0, 2.0)]));
        assert_ne!(digest(&[one]), digest(&[Vec3::new(0.0, 1.0, 2.0)]));
    }
}
