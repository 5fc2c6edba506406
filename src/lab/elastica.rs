//! The heavy elastica: what a continuous strip does that is clamped level and bends under its own
//! weight, without any lattice.
//!
//! With s the rest length from the free end, δ the strip's angle to the vertical, W its weight and
//! M its bending moment per curvature, equilibrium is `M·δ'' = W·s·(1 + S)·sin δ`, `δ'(0) = 0`, and
//! δ = π/2 at the root; the strain S answers the tension `W·s·cos δ`. Long strips have looped
//! equilibria besides: this is the first, which a strip takes that was let go.
//!
//! Shooting from the free end: 1. the angle there is found by halving its logarithm, for it is
//! some 10⁻²² of a long strip; 2. each shot is the classic Runge–Kutta method of fourth order.

use crate::fabric::{Fabric, Tension, Yarn};
use std::f64::consts::FRAC_PI_2;

/// Steps from the free end to the root.
const STEPS: u32 = 4000;
/// A strip longer than this many bending lengths hangs down.
const LONGEST: f64 = 60.0;

/// A strip clamped level at its root.
#[derive(Clone, Copy, Debug)]
pub struct Heavy<'a> {
    /// Weight per area [gf/cm²].
    pub weight: f64,
    /// Bending moment per width and curvature [gf·cm].
    pub bending: f64,
    /// How it stretches; not at all where absent.
    pub tension: Option<&'a Tension>,
    /// Length [cm].
    pub length: f64,
}

/// Angle to the vertical and its slope, and the way from the free end, level and down.
type State = [f64; 4];

impl<'a> Heavy<'a> {
    /// Of a fabric along a yarn, free over a length [cm].
    #[must_use]
    pub fn of(fabric: &'a Fabric, yarn: Yarn, length: f64) -> Self {
        let direction = fabric.along(yarn);
        Self {
            weight: fabric.weight,
            bending: direction.bending,
            tension: Some(&direction.tension),
            length,
        }
    }

    /// Where the free end is, level from the root and above it [cm].
    #[must_use]
    pub fn tip(&self) -> [f64; 2] {
        let bending_length = libm::cbrt(self.bending / self.weight);
        if self.length >= LONGEST * bending_length {
            return [0.0, -self.shoot(0.0).map_or(self.length, |[.., down]| down)];
        }
        // At e^-700 a number is still one; at π/2 the root is passed at once.
        let (mut low, mut high) = (-700.0, libm::log(FRAC_PI_2));
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            match self.shoot(libm::exp(middle)) {
                Some(_) => low = middle,
                None => high = middle,
            }
        }
        let [_, _, level, down] = self.shoot(libm::exp(low)).unwrap_or_default();
        [level, -down]
    }

    /// From the free end at an angle to the root; `None` where the strip passes the level before.
    fn shoot(&self, angle: f64) -> Option<State> {
        let step = self.length / f64::from(STEPS);
        let mut state = [angle, 0.0, 0.0, 0.0];
        for k in 0..STEPS {
            let s = f64::from(k) * step;
            let along = |state: &State, by: f64, slope: &State| -> State {
                core::array::from_fn(|axis| state[axis] + by * slope[axis])
            };
            let first = self.slope(s, &state);
            let second = self.slope(s + 0.5 * step, &along(&state, 0.5 * step, &first));
            let third = self.slope(s + 0.5 * step, &along(&state, 0.5 * step, &second));
            let fourth = self.slope(s + step, &along(&state, step, &third));
            for axis in 0..4 {
                let middle = second[axis] + third[axis];
                state[axis] += step / 6.0 * (first[axis] + 2.0 * middle + fourth[axis]);
            }
            if state[0] > FRAC_PI_2 {
                return None;
            }
        }
        Some(state)
    }

    fn slope(&self, s: f64, [angle, turn, ..]: &State) -> State {
        let (sine, cosine) = libm::sincos(*angle);
        let below = self.weight * s;
        let strain = self
            .tension
            .map_or(0.0, |law| law.strain_at((below * cosine).max(0.0)));
        let long = 1.0 + strain;
        [
            *turn,
            below * long * sine / self.bending,
            long * sine,
            long * cosine,
        ]
    }
}

/// The bending moment per width and curvature [gf·cm] with which an inextensible strip of a weight
/// [gf/cm²] and a length [cm] has its tip so far below its root [cm].
#[must_use]
pub fn bending_of_drop(weight: f64, length: f64, drop: f64) -> f64 {
    let drop_of = |bending: f64| {
        let tension = None;
        -Heavy {
            weight,
            bending,
            tension,
            length,
        }
        .tip()[1]
    };
    let whole = weight * length * length * length;
    let (mut low, mut high) = (libm::log(1e-5 * whole), libm::log(1e5 * whole));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if drop_of(libm::exp(middle)) > drop {
            low = middle;
        } else {
            high = middle;
        }
    }
    libm::exp(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tips [cm] of `reference.json`, `b_elastica_cantilever`: inextensible and extensible, computed
    /// by Taylor series and by collocation.
    #[test]
    fn the_tip_is_where_taylor_series_and_collocation_put_it() {
        let strips = [
            (
                "a",
                Yarn::Warp,
                2.0,
                [1.72236773546, 0.947698178109],
                [1.72445404928, 0.95040684236],
            ),
            (
                "a",
                Yarn::Warp,
                4.0,
                [1.1868438028, 3.55996946639],
                [1.18785894207, 3.57067414331],
            ),
        ];
        for (name, yarn, length, rigid, elastic) in strips {
            let fabric = crate::scene::fabric(name).unwrap();
            let strip = Heavy::of(&fabric, yarn, length);
            check(strip.tip(), elastic);
            check(
                Heavy {
                    tension: None,
                    ..strip
                }
                .tip(),
                rigid,
            );
        }
    }

    fn check([x, z]: [f64; 2], [reach, drop]: [f64; 2]) {
        assert!(
            (x - reach).abs() < 1e-7 && (z + drop).abs() < 1e-7,
            "{x} {z}"
        );
    }

    #[test]
    fn relation_2_is_right_to_a_twentieth_of_a_percent() {
        // b_elastica_cantilever: the tip meets 41.5° at L = 2.00034969157 (M/W)^(1/3).
        let length = 2.00034969157;
        let strip = Heavy {
            weight: 1.0,
            bending: 1.0,
            tension: None,
            length,
        };
        let [x, z] = strip.tip();
        assert!((libm::atan2(-z, x).to_degrees() - 41.5).abs() < 1e-6);
    }

    #[test]
    fn a_drop_tells_the_bending() {
        let (weight, length) = (0.014, 6.0);
        let strip = Heavy {
            weight,
            bending: 0.05,
            tension: None,
            length,
        };
        let found = bending_of_drop(weight, length, -strip.tip()[1]);
        assert!((found - 0.05).abs() < 1e-8, "{found}");
    }

    #[test]
    fn a_strip_of_many_bending_lengths_hangs_down() {
        let strip = Heavy {
            weight: 0.014,
            bending: 1e-9,
            tension: None,
            length: 30.0,
        };
        assert_eq!(strip.tip(), [0.0, -30.0]);
    }
}
