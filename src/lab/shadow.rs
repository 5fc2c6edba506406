//! The shadow of a drape, as a drapemeter's lamp below its disc throws it: how far the cloth
//! reaches in every direction, seen from above.

use crate::{lattice::Lattice, math::Vec3};
use std::f64::consts::{PI, TAU};

/// Directions that are looked in.
const DIRECTIONS: usize = 3600;

/// How far the cloth reaches from the axis, every tenth of a degree [cm].
#[derive(Clone, Debug, PartialEq)]
pub struct Shadow {
    /// Radii [cm], from the x axis on towards y.
    pub radii: Vec<f64>,
}

/// The folds at the rim of a shadow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Folds {
    /// How many there are.
    pub count: usize,
    /// How far crests stand out beyond troughs, on average [cm].
    pub depth: f64,
}

impl Shadow {
    /// Of a cloth about the z axis.
    #[must_use]
    pub fn of(lattice: &Lattice, at: &[Vec3]) -> Self {
        let mut shadow = Self {
            radii: vec![0.0; DIRECTIONS],
        };
        for [a, b, c, d] in &lattice.cells {
            for [from, to] in [[a, b], [b, c], [c, d], [d, a], [a, c]] {
                shadow.add(&at[*from as usize], &at[*to as usize]);
            }
        }
        shadow
    }

    /// A line of the cloth, where it is the farthest out.
    fn add(&mut self, from: &Vec3, to: &Vec3) {
        let (start, mut turn) = (libm::atan2(from.y, from.x), libm::atan2(to.y, to.x));
        turn = (turn - start + PI).rem_euclid(TAU) - PI;
        let (first, last) = if turn < 0.0 {
            (start + turn, start)
        } else {
            (start, start + turn)
        };
        let width = TAU / DIRECTIONS as f64;
        let (first, last) = ((first / width).ceil() as i64, (last / width).floor() as i64);
        for direction in first..=last {
            let (sine, cosine) = libm::sincos(direction as f64 * width);
            let across = |at: &Vec3| at.y * cosine - at.x * sine;
            let (near, far) = (across(from), across(to));
            let part = if near == far {
                0.0
            } else {
                near / (near - far)
            };
            let there = from + (to - from) * part;
            let reach = there.x * cosine + there.y * sine;
            let radius = &mut self.radii[direction.rem_euclid(DIRECTIONS as i64) as usize];
            *radius = radius.max(reach);
        }
    }

    /// Its area [cm²].
    #[must_use]
    pub fn area(&self) -> f64 {
        let width = TAU / DIRECTIONS as f64;
        0.5 * width * self.radii.iter().map(|radius| radius * radius).sum::<f64>()
    }

    /// Crests that stand out beyond the troughs beside them by more than `least` [cm].
    #[must_use]
    pub fn folds(&self, least: f64) -> Folds {
        let turns = self.turns(least);
        let count = turns.len() / 2;
        if count == 0 {
            return Folds::default();
        }
        let steps = turns.iter().zip(turns.iter().cycle().skip(1));
        let sum: f64 = steps.map(|(one, next)| (one - next).abs()).sum();
        Folds {
            count,
            depth: sum / (2 * count) as f64,
        }
    }

    /// Radii of crests and troughs in turn, once around from the lowest trough [cm].
    fn turns(&self, least: f64) -> Vec<f64> {
        let radii = &self.radii;
        let lowest = (0..radii.len()).min_by(|a, b| radii[*a].total_cmp(&radii[*b]));
        let Some(lowest) = lowest else {
            return Vec::new();
        };
        let around = radii.iter().cycle().skip(lowest).take(radii.len() + 1);
        let (mut turns, mut extreme, mut rising) = (vec![radii[lowest]], radii[lowest], true);
        for radius in around {
            let beyond = if rising {
                radius - extreme
            } else {
                extreme - radius
            };
            if beyond > 0.0 {
                extreme = *radius;
            } else if -beyond > least {
                turns.push(extreme);
                (extreme, rising) = (*radius, !rising);
            }
        }
        // Back at the lowest trough: the last crest is known, the trough is the first again.
        if turns.len() % 2 == 1 {
            turns.pop();
        }
        turns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rim(radius: impl Fn(f64) -> f64) -> Shadow {
        let angle = |k: usize| TAU * k as f64 / DIRECTIONS as f64;
        let radii = (0..DIRECTIONS).map(|k| radius(angle(k))).collect();
        Shadow { radii }
    }

    #[test]
    fn waves_are_counted_and_measured_wherever_they_begin() {
        for phase in [0.0, 0.3, 1.0, 2.0, 5.0] {
            let shadow = rim(|angle| 12.0 + 0.7 * (6.0 * angle + phase).cos());
            let folds = shadow.folds(0.3);
            assert_eq!(folds.count, 6, "{phase}");
            assert!((folds.depth - 1.4).abs() < 1e-3, "{folds:?}");
            let mean_square = 144.0 + 0.5 * 0.49;
            assert!((shadow.area() - PI * mean_square).abs() < 1e-9);
        }
    }

    #[test]
    fn ripples_are_no_folds() {
        let shadow = rim(|angle| 12.0 + 0.7 * (4.0 * angle).cos() + 0.05 * (90.0 * angle).sin());
        assert_eq!(shadow.folds(0.3).count, 4);
        assert_eq!(rim(|_| 12.0).folds(0.3), Folds::default());
    }

    #[test]
    fn a_flat_square_throws_its_own_shadow() {
        let lattice = crate::lattice::sample::cut(
            crate::lattice::Outline::rectangle(6.0, 4.0).unwrap(),
            0.0,
            0.5,
        );
        let coordinates = lattice.coordinates.iter();
        let at: Vec<Vec3> = coordinates.map(|at| Vec3::new(at.x, at.y, at.x)).collect();
        let shadow = Shadow::of(&lattice, &at);
        assert!((shadow.area() - 24.0).abs() < 0.01, "{}", shadow.area());
        assert!((shadow.radii[0] - 3.0).abs() < 1e-12);
        assert!((shadow.radii[DIRECTIONS / 4] - 2.0).abs() < 1e-12);
    }
}
