//! The heavy elastica: what a continuous strip does that bends under its own weight, without any
//! lattice: clamped level at one end, or at both as a heart.
//!
//! With s the rest length from the free end, δ the strip's angle to the vertical, W its weight and
//! M its bending moment per curvature, equilibrium is `M·δ'' = W·s·(1 + S)·sin δ`, `δ'(0) = 0`, and
//! δ = π/2 at the root; the strain S answers the tension `W·s·cos δ`. Long strips have looped
//! equilibria besides: this is the first, which a strip takes that was let go.
//!
//! Shooting from the free end: 1. the angle there is found by halving its logarithm, for it is
//! some 10⁻²² of a long strip; 2. each shot is the classic Runge–Kutta method of fourth order.

use crate::fabric::{Fabric, Tension, Yarn};
use std::f64::consts::{FRAC_PI_2, PI};

/// Steps from the free end to the root.
const STEPS: u32 = 4000;
/// Steps along half a heart.
const HEART_STEPS: u32 = 1000;
/// A strip longer than this many bending lengths hangs down.
const LONGEST: f64 = 60.0;

/// A strip under its own weight.
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

/// Angle and its slope by the length, and the way so far, level and upright.
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

    /// Where the free end is of a strip clamped level at its root, level from there and above it [cm].
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
        let slope = |s: f64, state: &State| self.slope(s, state);
        integrate([angle, 0.0, 0.0, 0.0], (STEPS, step), slope, |state| {
            state[0] > FRAC_PI_2
        })
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

/// Weights through which a loop is led from none to its own.
const WEIGHTS: u32 = 120;
/// Newton's steps for each.
const NEWTON: usize = 20;

impl Heavy<'_> {
    /// How high a heart of this strip is that hangs from both ends, clamped together and upwards: from
    /// the clamp to the lowest point [cm]; `None` where Newton's method does not find it.
    ///
    /// From the lowest point on, s the rest length, θ the strip's angle to the level and H its level
    /// tension: `M·θ'' = (1 + S)·(H·sin θ − W·s·cos θ)`. Half a length on it is back in the middle,
    /// and θ = 3π/2. The curvature at the lowest point and H are found by Newton's method, the weight
    /// raised from none in steps.
    #[must_use]
    pub fn heart(&self) -> Option<f64> {
        let half = 0.5 * self.length;
        // A circle is near what a loop without weight is.
        let mut start = [1.5 * PI / half, 0.0];
        let mut before = None;
        let mut height = None;
        for k in 0..=WEIGHTS {
            let weight = self.weight * f64::from(k * k) / f64::from(WEIGHTS * WEIGHTS);
            height = Some(Self { weight, ..*self }.close(&mut start)?);
            // On from here by as much as the last weight changed it.
            let here = start;
            if let Some([curvature, level]) = before.replace(here) {
                start = [2.0 * here[0] - curvature, 2.0 * here[1] - level];
            }
        }
        height
    }

    /// Newton's method from a curvature and a level tension; leaves those that close the loop.
    fn close(&self, start: &mut [f64; 2]) -> Option<f64> {
        let half = 0.5 * self.length;
        let steps = [1e-6 / half, 1e-6 * self.bending / (half * half)];
        for _ in 0..NEWTON {
            let [turn, off, height] = self.shoot_heart(*start);
            if turn.abs() < 1e-10 && off.abs() < 1e-10 * half {
                return Some(height);
            }
            let beside = |axis: usize| {
                let mut moved = *start;
                moved[axis] += steps[axis];
                let [there, off_there, _] = self.shoot_heart(moved);
                [
                    (there - turn) / steps[axis],
                    (off_there - off) / steps[axis],
                ]
            };
            let ([a, c], [b, d]) = (beside(0), beside(1));
            let over = 1.0 / (a * d - b * c);
            start[0] -= (d * turn - b * off) * over;
            start[1] -= (a * off - c * turn) * over;
            if !(start[0].is_finite() && start[1].is_finite()) {
                return None;
            }
        }
        None
    }

    /// How far the angle at the clamp is from 3π/2, how far the clamp is from the middle [cm], and
    /// how high it is [cm].
    fn shoot_heart(&self, [curvature, level]: [f64; 2]) -> [f64; 3] {
        let step = 0.5 * self.length / f64::from(HEART_STEPS);
        let slope = |s: f64, [angle, turn, ..]: &State| -> State {
            let (sine, cosine) = libm::sincos(*angle);
            let below = self.weight * s;
            let tension = (level * cosine + below * sine).max(0.0);
            let long = 1.0 + self.tension.map_or(0.0, |law| law.strain_at(tension));
            let couple = level * sine - below * cosine;
            [
                *turn,
                long * couple / self.bending,
                long * cosine,
                long * sine,
            ]
        };
        let [angle, _, off, height] = integrate(
            [0.0, curvature, 0.0, 0.0],
            (HEART_STEPS, step),
            slope,
            |_| false,
        )
        .unwrap_or_default();
        [angle - 1.5 * PI, off, height]
    }
}

/// The classic Runge–Kutta method over all steps; `None` where a state is `beyond`.
fn integrate(
    mut state: State,
    (steps, step): (u32, f64),
    slope: impl Fn(f64, &State) -> State,
    beyond: impl Fn(&State) -> bool,
) -> Option<State> {
    let along = |state: &State, by: f64, slope: &State| -> State {
        core::array::from_fn(|axis| state[axis] + by * slope[axis])
    };
    for k in 0..steps {
        let s = f64::from(k) * step;
        let first = slope(s, &state);
        let second = slope(s + 0.5 * step, &along(&state, 0.5 * step, &first));
        let third = slope(s + 0.5 * step, &along(&state, 0.5 * step, &second));
        let fourth = slope(s + step, &along(&state, step, &third));
        for axis in 0..4 {
            let middle = second[axis] + third[axis];
            state[axis] += step / 6.0 * (first[axis] + 2.0 * middle + fourth[axis]);
        }
        if beyond(&state) {
            return None;
        }
    }
    Some(state)
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

    /// Peirce 1930: 0.1337 of the length without weight; by shooting 0.13386.
    #[test]
    fn a_heart_without_weight_is_as_high_as_peirce_found() {
        let strip = Heavy {
            weight: 1e-12,
            bending: 1.0,
            tension: None,
            length: 1.0,
        };
        let height = strip.heart().unwrap();
        assert!((height - 0.1337).abs() < 2e-4, "{height}");
    }

    /// Peirce's relation, c = ℓ₀·(cos θ/tan θ)^(1/3) with θ = 32.85°·d/ℓ₀, is an approximation: of
    /// loops of 6, 8 and 10 bending lengths it makes 11.4, 12.3 and 9.8 % too much bending, also by
    /// shooting in another program, whose heights these are.
    #[test]
    fn a_heart_that_hangs_is_within_an_eighth_of_peirces_bending() {
        for (length, other) in [(6.0, 1.365_940_3), (8.0, 2.368_349_9), (10.0, 3.484_903_6)] {
            let strip = Heavy {
                weight: 1.0,
                bending: 1.0,
                tension: None,
                length,
            };
            let (height, weightless) = (strip.heart().unwrap(), 0.1337 * length);
            assert!((height - other).abs() < 1e-6, "{length}: {height}");
            let angle = (32.85 * (height / weightless - 1.0)).to_radians();
            let found = (weightless * (angle.cos() / angle.tan()).cbrt()).powi(3);
            assert!((found - 1.0).abs() < 0.125, "{length}: {height}, {found}");
        }
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
        let [level, height] = strip.tip();
        // Its length is summed from 4000 steps.
        assert!(level == 0.0 && (height + 30.0).abs() < 1e-10, "{height}");
    }
}
