//! Tension per width against strain: the power law (1), the linear modulus of table 1, and a
//! measured S–S curve.
//!
//! The paper leaves shortening (S < 0) open. Here a law continues oddly, T(−S) = −T(S), but never
//! below minus the *floor*: the Euler load of a rod of the lattice's pitch, above which real cloth
//! buckles within one pitch. On that plateau the tension stays, so the tangent is 0 and the energy
//! grows linearly.

use crate::{
    fabric::Curve,
    lanes::{Lanes, Simd, WIDEST},
};

/// Tension per width T(S) [gf/cm] against strain S = (L − b)/b [-].
#[derive(Clone, Debug, PartialEq)]
pub enum Tension {
    /// T = A·S^(B+1), from the modulus M_T = A·S^B of (1), table 2.
    Power {
        /// Factor A [gf/cm].
        a: f64,
        /// Exponent B [-].
        b: f64,
    },
    /// T = M_T·S, table 1.
    Linear {
        /// Modulus M_T [gf/cm].
        modulus: f64,
    },
    /// Through measured points.
    Points(Curve),
}

/// What a direction of cloth answers to one strain, per width.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Answer {
    /// ∫T dS from 0, per area of cloth [gf/cm].
    pub energy: f64,
    /// T [gf/cm].
    pub tension: f64,
    /// dT/dS [gf/cm].
    pub tangent: f64,
}

impl Tension {
    /// Energy, tension and tangent at a strain [-], with one evaluation of the law.
    ///
    /// `floor` is the greatest compression that the cloth bears [gf/cm], 0 or more; it may be
    /// infinite.
    pub fn answer(&self, strain: f64, floor: f64) -> Answer {
        let size = strain.abs();
        let odd = self.stretched(size);
        if strain >= 0.0 {
            return odd;
        }
        if odd.tension < floor {
            return Answer {
                tension: -odd.tension,
                ..odd
            };
        }
        let buckling = self.strain_at(floor).min(size);
        Answer {
            energy: self.stretched(buckling).energy + floor * (size - buckling),
            tension: -floor,
            tangent: 0.0,
        }
    }

    /// Energy per area of cloth [gf/cm] at a strain, as in [`answer`](Self::answer).
    pub fn energy(&self, strain: f64, floor: f64) -> f64 {
        self.answer(strain, floor).energy
    }

    /// Tension per width [gf/cm] at a strain, as in [`answer`](Self::answer).
    pub fn tension(&self, strain: f64, floor: f64) -> f64 {
        self.answer(strain, floor).tension
    }

    /// Tangent modulus per width [gf/cm] at a strain, as in [`answer`](Self::answer).
    pub fn tangent(&self, strain: f64, floor: f64) -> f64 {
        self.answer(strain, floor).tangent
    }

    /// Tension and tangent [gf/cm] of rods side by side, each by its own law, at their strains and with
    /// their floors, as in [`answer`](Self::answer).
    #[inline(always)]
    pub(crate) fn answers<S: Simd, const N: usize>(
        laws: [&Self; N],
        strains: [Lanes<S>; N],
        floors: [Lanes<S>; N],
    ) -> [(Lanes<S>, Lanes<S>); N] {
        let (mut exponents, mut powers) = ([0.0; N], strains);
        for k in 0..N {
            powers[k] = strains[k].abs();
            if let Self::Power { b, .. } = laws[k] {
                exponents[k] = *b;
            }
        }
        if laws.iter().any(|law| matches!(law, Self::Power { .. })) {
            powers = Lanes::powers(powers, exponents);
        }
        let mut answers = [(strains[0], strains[0]); N];
        for k in 0..N {
            let simd = strains[k].kind();
            let (modulus, growth) = match laws[k] {
                Self::Power { a, b } => (powers[k] * *a, b + 1.0),
                Self::Linear { modulus } => (Lanes::of(simd, *modulus), 1.0),
                Self::Points(_) => {
                    answers[k] = laws[k].answers_one_by_one(strains[k], floors[k]);
                    continue;
                }
            };
            answers[k] = odd(modulus, growth, strains[k], floors[k]);
        }
        answers
    }

    #[inline(never)]
    fn answers_one_by_one<S: Simd>(
        &self,
        strain: Lanes<S>,
        floor: Lanes<S>,
    ) -> (Lanes<S>, Lanes<S>) {
        let (mut strains, mut floors) = ([0.0; WIDEST], [0.0; WIDEST]);
        strain.write(&mut strains);
        floor.write(&mut floors);
        let answers = core::array::from_fn::<_, WIDEST, _>(|k| self.answer(strains[k], floors[k]));
        (
            Lanes::read(strain.kind(), &answers.map(|answer| answer.tension)),
            Lanes::read(strain.kind(), &answers.map(|answer| answer.tangent)),
        )
    }

    /// The law itself, for S ≥ 0.
    fn stretched(&self, strain: f64) -> Answer {
        match self {
            Self::Power { a, b } => {
                let modulus = a * libm::pow(strain, *b);
                Answer {
                    energy: modulus * strain * strain / (b + 2.0),
                    tension: modulus * strain,
                    tangent: modulus * (b + 1.0),
                }
            }
            Self::Linear { modulus } => Answer {
                energy: modulus * strain * strain / 2.0,
                tension: modulus * strain,
                tangent: *modulus,
            },
            Self::Points(curve) => curve.at(strain),
        }
    }

    /// The least strain S ≥ 0 with T(S) = `tension` [gf/cm]; infinite where the law never gets
    /// there.
    pub fn strain_at(&self, tension: f64) -> f64 {
        match self {
            Self::Power { a, b } => libm::pow(tension / a, 1.0 / (b + 1.0)),
            Self::Linear { modulus } => tension / modulus,
            Self::Points(curve) => curve.strain_at(tension),
        }
    }
}

/// Tension and tangent [gf/cm] by a secant modulus [gf/cm] that grows with a power of strain one less
/// than `growth`: odd in the strain, and never below the floor.
#[inline(always)]
fn odd<S: Simd>(
    modulus: Lanes<S>,
    growth: f64,
    strain: Lanes<S>,
    floor: Lanes<S>,
) -> (Lanes<S>, Lanes<S>) {
    let (tension, tangent) = (modulus * strain.abs(), modulus * growth);
    let zero = Lanes::of(strain.kind(), 0.0);
    let borne = tension.less_than(floor).choose(tangent, zero);
    let shortened = strain.less_than(zero);
    (
        shortened.choose(-tension.min(floor), tension),
        shortened.choose(borne, tangent),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const A_WARP: Tension = Tension::Power { a: 4.0e4, b: 1.7 };

    #[test]
    fn cloth_a_warp_is_a_hundred_times_stiffer_at_15_percent_than_at_1() {
        // physics.md §0: 43 gf/cm and 4300 gf/cm, from table 2.
        assert!((A_WARP.tangent(0.01, 0.0) - 43.0).abs() < 0.05);
        assert!((A_WARP.tangent(0.15, 0.0) - 4293.0).abs() < 1.0);
    }

    #[test]
    fn a_slack_rod_has_no_stiffness() {
        assert_eq!(A_WARP.answer(0.0, 1.0), Answer::default());
    }

    #[test]
    fn the_linear_law_is_table_1() {
        let law = Tension::Linear { modulus: 420.0 };
        assert_eq!(law.tension(0.01, 0.0), 4.2);
        assert_eq!(law.tangent(0.3, 0.0), 420.0);
        assert_eq!(law.energy(0.02, 0.0), 0.084);
    }

    #[test]
    fn compression_stops_at_the_euler_load() {
        let floor = 0.24;
        for law in laws() {
            assert_eq!(law.tension(-0.5, floor), -floor);
            assert_eq!(law.tangent(-0.5, floor), 0.0);
            let slope = law.energy(-0.6, floor) - law.energy(-0.5, floor);
            assert!((slope - 0.1 * floor).abs() < 1e-12);
        }
    }

    #[test]
    fn without_a_floor_compression_costs_nothing() {
        for law in laws() {
            assert_eq!(law.answer(-0.2, 0.0).energy, 0.0);
            assert_eq!(law.answer(-0.2, 0.0).tension, 0.0);
        }
    }

    fn laws() -> [Tension; 3] {
        let points = [[0.01, 0.4], [0.02, 2.1], [0.05, 2.1], [0.08, 30.0]];
        [
            A_WARP,
            Tension::Linear { modulus: 420.0 },
            Tension::Points(Curve::new(&points).unwrap()),
        ]
    }

    proptest! {
        #[test]
        fn tension_is_the_slope_of_energy_and_tangent_that_of_tension(
            strain in -0.12..0.12f64, floor in 0.0..3.0f64,
        ) {
            let step = 1e-6;
            for law in laws() {
                let (before, here, after) = (
                    law.answer(strain - step, floor),
                    law.answer(strain, floor),
                    law.answer(strain + step, floor),
                );
                let slope = (after.energy - before.energy) / (2.0 * step);
                prop_assert!((slope - here.tension).abs() < 1e-3 * (1.0 + here.tangent));
                // The tangent jumps where the plateau begins.
                if (before.tangent == 0.0) == (after.tangent == 0.0) {
                    let slope = (after.tension - before.tension) / (2.0 * step);
                    prop_assert!((slope - here.tangent).abs() < 1e-2 * (1.0 + here.tangent));
                }
            }
        }

        #[test]
        fn more_strain_is_never_less_tension(
            strain in -0.2..0.2f64, more in 0.0..0.1f64, floor in 0.0..3.0f64,
        ) {
            for law in laws() {
                prop_assert!(
                    law.tension(strain + more, floor) >= law.tension(strain, floor) - 1e-12
                );
            }
        }

        #[test]
        fn stretch_and_compression_mirror_above_the_floor(strain in 0.0..0.12f64) {
            for law in laws() {
                let (pulled, pushed) = (
                    law.answer(strain, f64::INFINITY),
                    law.answer(-strain, f64::INFINITY),
                );
                prop_assert_eq!(pulled.tension, -pushed.tension);
                prop_assert_eq!(pulled.energy, pushed.energy);
            }
        }
    }
}
