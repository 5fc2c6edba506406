//! A measured S–S curve: a monotone cubic through its points.
//!
//! F. N. Fritsch and R. E. Carlson, *Monotone Piecewise Cubic Interpolation*, SIAM J. Numer. Anal.
//! 17 (1980): 1. the slope at an inner point is the mean of the secants beside it, 0 where one of
//! them is 0; 2. the slope at an end is its secant; 3. slopes of an interval are shortened into
//! the circle of radius 3 secants, within which its cubic is monotone. Beyond the last point the
//! curve goes on straight.

use crate::fabric::tension::Answer;

/// A monotone, once differentiable tension curve T(S) for S ≥ 0, through (0, 0).
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    knots: Vec<Knot>,
}

/// Points that are no S–S curve.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidCurve {
    /// Fewer than two points, (0, 0) counted.
    #[error("{count} points; allowed: 2 or more, (0, 0) counted")]
    TooFew {
        /// How many, (0, 0) counted.
        count: usize,
    },
    /// Not a number, infinite, negative, or beyond what cloth does.
    #[error(
        "point {index} is ({strain}, {tension}); allowed: strain 0 to 10, tension 0 to 1e9 gf/cm"
    )]
    OutOfRange {
        /// Which point, from 1, as given.
        index: usize,
        /// Its strain [-].
        strain: f64,
        /// Its tension [gf/cm].
        tension: f64,
    },
    /// The strain does not increase.
    #[error("strain {strain} of point {index} is not above {before}, that of the point before")]
    StrainNotIncreasing {
        /// Which point, from 1, as given.
        index: usize,
        /// Its strain [-].
        strain: f64,
        /// The strain before it [-].
        before: f64,
    },
    /// The tension falls.
    #[error("tension {tension} gf/cm of point {index} is below {before}, that of the point before")]
    TensionFalls {
        /// Which point, from 1, as given.
        index: usize,
        /// Its tension [gf/cm].
        tension: f64,
        /// The tension before it [gf/cm].
        before: f64,
    },
    /// The cloth never pulls.
    #[error("the last tension is 0 gf/cm; allowed: above 0")]
    NeverPulls,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Knot {
    strain: f64,
    tension: f64,
    slope: f64,
    /// Integral of the tension up to here [gf/cm].
    energy: f64,
}

impl Curve {
    /// The curve through points (strain [-], tension [gf/cm]); (0, 0) is added where the first
    /// strain is above 0.
    ///
    /// # Errors
    /// [`InvalidCurve`] where strains do not increase, tensions fall, or a value is out of range.
    pub fn new(points: &[[f64; 2]]) -> Result<Self, InvalidCurve> {
        let mut knots: Vec<Knot> = Vec::with_capacity(points.len() + 1);
        if points.first().is_none_or(|[strain, _]| *strain > 0.0) {
            knots.push(Knot::at(0.0, 0.0));
        }
        for (place, &[strain, tension]) in points.iter().enumerate() {
            check_point(place + 1, strain, tension, knots.last())?;
            knots.push(Knot::at(strain, tension));
        }
        if knots.len() < 2 {
            return Err(InvalidCurve::TooFew { count: knots.len() });
        }
        if knots.last().is_none_or(|last| last.tension <= 0.0) {
            return Err(InvalidCurve::NeverPulls);
        }
        set_slopes(&mut knots);
        add_energies(&mut knots);
        Ok(Self { knots })
    }

    /// The points (strain [-], tension [gf/cm]), (0, 0) first.
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.knots.iter().map(|knot| [knot.strain, knot.tension])
    }

    /// Energy, tension and tangent at a strain ≥ 0.
    pub(in crate::fabric) fn at(&self, strain: f64) -> Answer {
        let after = self.knots.partition_point(|knot| knot.strain <= strain);
        let last = Knot::at(0.0, 0.0);
        let from = after.checked_sub(1).and_then(|k| self.knots.get(k));
        let from = from.copied().unwrap_or(last);
        match self.knots.get(after) {
            Some(to) => from.towards(to).at(strain - from.strain),
            None => from.straight().at(strain - from.strain),
        }
    }

    /// The least strain with the given tension ≥ 0; infinite where the curve never gets there.
    pub(in crate::fabric) fn strain_at(&self, tension: f64) -> f64 {
        let after = self.knots.partition_point(|knot| knot.tension < tension);
        let Some(from) = after.checked_sub(1).and_then(|k| self.knots.get(k)) else {
            return 0.0;
        };
        let Some(to) = self.knots.get(after) else {
            return from.strain + (tension - from.tension) / from.slope;
        };
        let cubic = from.towards(to);
        let (mut low, mut high) = (0.0, to.strain - from.strain);
        // Halving 60 times leaves less than the spacing of numbers.
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if cubic.at(middle).tension < tension {
                low = middle;
            } else {
                high = middle;
            }
        }
        from.strain + high
    }
}

impl Knot {
    fn at(strain: f64, tension: f64) -> Self {
        Self {
            strain,
            tension,
            slope: 0.0,
            energy: 0.0,
        }
    }

    fn secant(&self, next: &Self) -> f64 {
        (next.tension - self.tension) / (next.strain - self.strain)
    }

    /// The Hermite cubic from here to the next knot.
    fn towards(&self, next: &Self) -> Cubic {
        let (width, secant) = (next.strain - self.strain, self.secant(next));
        Cubic {
            energy: self.energy,
            constant: self.tension,
            linear: self.slope,
            square: (3.0 * secant - 2.0 * self.slope - next.slope) / width,
            cube: (self.slope + next.slope - 2.0 * secant) / (width * width),
        }
    }

    /// The line that goes on from here.
    fn straight(&self) -> Cubic {
        Cubic {
            energy: self.energy,
            constant: self.tension,
            linear: self.slope,
            square: 0.0,
            cube: 0.0,
        }
    }
}

/// Tension as a polynomial of the strain from a knot, and the energy up to that knot.
struct Cubic {
    energy: f64,
    constant: f64,
    linear: f64,
    square: f64,
    cube: f64,
}

impl Cubic {
    fn at(&self, t: f64) -> Answer {
        let Self {
            energy,
            constant,
            linear,
            square,
            cube,
        } = *self;
        Answer {
            energy: energy
                + t * (constant + t * (linear / 2.0 + t * (square / 3.0 + t * cube / 4.0))),
            tension: constant + t * (linear + t * (square + t * cube)),
            tangent: linear + t * (2.0 * square + t * 3.0 * cube),
        }
    }
}

fn check_point(
    index: usize,
    strain: f64,
    tension: f64,
    before: Option<&Knot>,
) -> Result<(), InvalidCurve> {
    let at_zero = strain != 0.0 || tension == 0.0;
    if !((0.0..=10.0).contains(&strain) && (0.0..=1e9).contains(&tension) && at_zero) {
        return Err(InvalidCurve::OutOfRange {
            index,
            strain,
            tension,
        });
    }
    match before {
        Some(last) if strain <= last.strain => Err(InvalidCurve::StrainNotIncreasing {
            index,
            strain,
            before: last.strain,
        }),
        Some(last) if tension < last.tension => Err(InvalidCurve::TensionFalls {
            index,
            tension,
            before: last.tension,
        }),
        _ => Ok(()),
    }
}

fn set_slopes(knots: &mut [Knot]) {
    let secants: Vec<f64> = knots
        .iter()
        .zip(knots.iter().skip(1))
        .map(|(from, to)| from.secant(to))
        .collect();
    for (k, knot) in knots.iter_mut().enumerate() {
        let left = k.checked_sub(1).and_then(|k| secants.get(k)).copied();
        knot.slope = match (left, secants.get(k).copied()) {
            (Some(left), Some(right)) if left > 0.0 && right > 0.0 => 0.5 * (left + right),
            (Some(_), Some(_)) => 0.0,
            (one, other) => one.or(other).unwrap_or(0.0),
        };
    }
    for (k, secant) in secants.iter().enumerate() {
        if let Some([from, to, ..]) = knots.get_mut(k..) {
            let size = (from.slope * from.slope + to.slope * to.slope).sqrt();
            let allowed = 3.0 * secant;
            if size > allowed {
                from.slope *= allowed / size;
                to.slope *= allowed / size;
            }
        }
    }
}

fn add_energies(knots: &mut [Knot]) {
    for k in 1..knots.len() {
        if let Some([from, to, ..]) = knots.get_mut(k - 1..) {
            to.energy = from.towards(to).at(to.strain - from.strain).energy;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_straight_curve_is_the_linear_law() {
        let curve = Curve::new(&[[0.0, 0.0], [0.01, 4.2], [0.04, 16.8]]).unwrap();
        for strain in [0.0, 0.003, 0.01, 0.025, 0.04, 0.3] {
            let answer = curve.at(strain);
            assert!((answer.tension - 420.0 * strain).abs() < 1e-12);
            assert!((answer.tangent - 420.0).abs() < 1e-9);
            assert!((answer.energy - 210.0 * strain * strain).abs() < 1e-12);
        }
    }

    #[test]
    fn dense_points_of_the_power_law_give_the_power_law() {
        let points: Vec<_> = (1..=200)
            .map(|k| f64::from(k) * 1e-3)
            .map(|s| [s, 4.0e4 * libm::pow(s, 2.7)])
            .collect();
        let curve = Curve::new(&points).unwrap();
        let answer = curve.at(0.1005);
        assert!((answer.tension / (4.0e4 * libm::pow(0.1005, 2.7)) - 1.0).abs() < 1e-5);
        assert!((answer.energy / (4.0e4 * libm::pow(0.1005, 3.7) / 3.7) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn the_origin_is_added_where_it_is_absent() {
        let short = Curve::new(&[[0.01, 2.1], [0.02, 9.0]]).unwrap();
        let long = Curve::new(&[[0.0, 0.0], [0.01, 2.1], [0.02, 9.0]]).unwrap();
        assert_eq!(short, long);
    }

    #[test]
    fn what_is_no_curve_is_named() {
        let message = |points: &[[f64; 2]]| Curve::new(points).unwrap_err().to_string();
        assert!(message(&[]).contains("allowed: 2 or more"));
        assert!(message(&[[0.0, 0.0]]).contains("1 points"));
        assert!(message(&[[0.0, 1.0], [0.1, 2.0]]).contains("point 1 is (0, 1)"));
        assert!(message(&[[-0.1, 0.0], [0.1, 2.0]]).contains("point 1"));
        assert!(message(&[[0.1, f64::NAN]]).contains("point 1"));
        assert!(message(&[[0.1, 2.0], [0.1, 3.0]]).contains("point 2 is not above 0.1"));
        assert!(message(&[[0.1, 2.0], [0.2, 1.0]]).contains("point 2 is below 2"));
        assert!(message(&[[0.1, 0.0], [0.2, 0.0]]).contains("last tension"));
    }

    fn curves() -> impl Strategy<Value = Vec<[f64; 2]>> {
        prop::collection::vec((1e-3..0.1f64, prop_oneof![Just(0.0), 0.0..50.0f64]), 2..9).prop_map(
            |steps| {
                let mut point = [0.0, 0.0];
                let mut points = vec![point];
                for (strain, tension) in steps {
                    point = [point[0] + strain, point[1] + tension];
                    points.push(point);
                }
                points.push([point[0] + 0.05, point[1] + 1.0]);
                points
            },
        )
    }

    proptest! {
        #[test]
        fn it_passes_through_its_points_and_never_falls(points in curves()) {
            let curve = Curve::new(&points).unwrap();
            for point in &points {
                prop_assert!((curve.at(point[0]).tension - point[1]).abs() < 1e-9);
            }
            let mut before = 0.0;
            for k in 0..2000 {
                let answer = curve.at(f64::from(k) * 5e-4);
                prop_assert!(answer.tension >= before - 1e-9 && answer.tangent >= -1e-6);
                before = answer.tension;
            }
        }

        #[test]
        fn tension_slope_and_energy_agree_across_knots(
            points in curves(), strain in 0.001..0.9f64,
        ) {
            let curve = Curve::new(&points).unwrap();
            let step = 1e-6;
            let (before, here, after) =
                (curve.at(strain - step), curve.at(strain), curve.at(strain + step));
            let size = 1.0 + here.tension + here.tangent;
            let force = (after.energy - before.energy) / (2.0 * step);
            prop_assert!((force - here.tension).abs() < 1e-3 * size);
            prop_assert!((after.tension - before.tension - 2.0 * step * here.tangent).abs() < 1e-6 * size);
            // Once differentiable: the slope does not jump, at knots either.
            prop_assert!((after.tangent - before.tangent).abs() < 1.0 + 1e-2 * size);
        }

        #[test]
        fn a_tension_is_found_again(points in curves(), strain in 0.0..1.5f64) {
            let curve = Curve::new(&points).unwrap();
            let tension = curve.at(strain).tension;
            let found = curve.strain_at(tension);
            prop_assert!(found <= strain + 1e-7);
            prop_assert!((curve.at(found).tension - tension).abs() < 1e-6 * (1.0 + tension));
        }
    }
}
