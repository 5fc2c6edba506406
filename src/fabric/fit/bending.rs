//! Bending from the overhang of strips: the cantilever test of figure 2.
//!
//! A strip of weight W per area that reaches L beyond an edge bends down until its end lies on a
//! plane at the angle θ below the horizontal. Its bending per width is M_BN = W·c³ with the bending
//! length c, of which three relations to L and θ are in use:
//!
//! - (2), the paper's: c = L/2, at 41.5° alone;
//! - Peirce's, c = L·(cos(θ/2)/(8·tan θ))^(1/3), F. T. Peirce, *The Handle of Cloth as a Measurable
//!   Quantity*, J. Text. Inst. 21 (1930) T377: 0.5093·L at 41.5°, 5.7 % more bending than (2);
//! - the exact one, of a heavy strip that cannot stretch: L = 2.00035·c at 41.5°, so (2) is right to
//!   0.1 %.

use super::{Doubt, Estimate, Unfit, robust};

/// From the overhang to the bending length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// (2): c = L/2, at 41.5°.
    Paper,
    /// Peirce's, at any angle.
    Peirce,
    /// The heavy strip's own shape, at any angle.
    Exact,
}

/// Readings of one thread direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overhangs<'a> {
    /// L with the face up [cm].
    pub face: &'a [f64],
    /// L with the back up [cm].
    pub back: &'a [f64],
    /// θ [rad].
    pub angle: f64,
    /// From L to c.
    pub relation: Relation,
    /// Weight per area [gf/cm²].
    pub weight: f64,
}

/// What the readings give.
#[derive(Clone, Debug, PartialEq)]
pub struct BendingFit {
    /// Mean of face and back [gf·cm].
    pub bending: Estimate,
    /// With the face up [gf·cm].
    pub face: Option<f64>,
    /// With the back up [gf·cm].
    pub back: Option<f64>,
    /// How many readings there were.
    pub readings: usize,
    /// Least and greatest overhang [cm].
    pub lengths: [f64; 2],
    /// Standard deviation of a reading, as a share of it [-].
    pub spread: f64,
    /// What is doubtful.
    pub doubts: Vec<Doubt>,
}

/// The angle of the tester at which c is half of L [rad].
pub const PAPER_ANGLE: f64 = 41.5 * core::f64::consts::PI / 180.0;

/// Bending from overhangs, face and back counting alike.
///
/// # Errors
/// [`Unfit`] where there is no reading, or the angle is not the relation's.
pub fn bending(test: &Overhangs<'_>) -> Result<BendingFit, Unfit> {
    let lengths: Vec<f64> = test.face.iter().chain(test.back).copied().collect();
    if lengths.is_empty() {
        return Err(Unfit::NoOverhang);
    }
    let ratio = bending_length(test.angle, test.relation)?;
    let side = |lengths: &[f64]| (!lengths.is_empty()).then(|| mean_bending(test, ratio, lengths));
    let (face, back) = (side(test.face), side(test.back));
    let sides: Vec<f64> = face.into_iter().chain(back).collect();
    let value = mean(&sides);
    let spread = spread(test);
    let freedom = usize::from(face.is_some()) + usize::from(back.is_some());
    // M goes as L³; a single reading has no spread to judge it by.
    let variance = 9.0 * spread * spread / lengths.len() as f64;
    let half = robust::half_width(variance, lengths.len(), freedom) * value;
    let known = lengths.len() > freedom;
    Ok(BendingFit {
        bending: Estimate {
            value,
            half_width: known.then_some(half),
        },
        face,
        back,
        readings: lengths.len(),
        lengths: lengths.iter().fold([f64::MAX, 0.0], |[low, high], length| {
            [length.min(low), length.max(high)]
        }),
        spread,
        doubts: doubts(test, face, back),
    })
}

/// c/L at an angle [rad].
///
/// # Errors
/// [`Unfit::NotItsAngle`] for the paper's relation at any other angle than 41.5°.
pub fn bending_length(angle: f64, relation: Relation) -> Result<f64, Unfit> {
    match relation {
        Relation::Paper if (angle - PAPER_ANGLE).abs() < 0.01 => Ok(0.5),
        Relation::Paper => Err(Unfit::NotItsAngle {
            degrees: angle.to_degrees(),
        }),
        Relation::Peirce => {
            let cube = libm::cos(0.5 * angle) / (8.0 * libm::tan(angle));
            Ok(libm::cbrt(cube))
        }
        Relation::Exact => Ok(1.0 / heavy_strip(angle)),
    }
}

/// L/c of a heavy strip whose end lies at an angle below the edge.
///
/// Counted from its free end in units of c, the strip's slope φ follows φ″ = −σ·cos φ with φ′ = 0
/// there, and is 0 at the edge: one pass per slope of the end, and halving over that slope.
fn heavy_strip(angle: f64) -> f64 {
    let (mut low, mut high) = (0.5 * angle, 0.999 * core::f64::consts::FRAC_PI_2);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if hang(middle).1 < angle {
            low = middle;
        } else {
            high = middle;
        }
    }
    hang(0.5 * (low + high)).0
}

/// L/c, and the angle of the end below the edge [rad], for the slope of the end [rad].
fn hang(end: f64) -> (f64, f64) {
    // Steps of fourth order: 0.002 leaves 1e-10.
    const STEP: f64 = 2e-3;
    let rate = |[slope, turn, _, _]: [f64; 4], at: f64| {
        let (sin, cos) = (libm::sin(slope), libm::cos(slope));
        [turn, -at * cos, cos, sin]
    };
    let moved = |state: [f64; 4], rate: [f64; 4], by: f64| {
        core::array::from_fn(|k| state[k] + by * rate[k])
    };
    let (mut state, mut at) = ([end, 0.0, 0.0, 0.0], 0.0);
    loop {
        let first = rate(state, at);
        let second = rate(moved(state, first, 0.5 * STEP), at + 0.5 * STEP);
        let third = rate(moved(state, second, 0.5 * STEP), at + 0.5 * STEP);
        let fourth = rate(moved(state, third, STEP), at + STEP);
        let mean = core::array::from_fn(|k| {
            (first[k] + 2.0 * second[k] + 2.0 * third[k] + fourth[k]) / 6.0
        });
        let next: [f64; 4] = moved(state, mean, STEP);
        // Near the edge the slope is straight to the third order, its own turn being the greatest.
        if next[0] <= 0.0 || at > 100.0 {
            let share = state[0] / (state[0] - next[0]);
            let [_, _, x, y] = moved(state, mean, share * STEP);
            return (at + share * STEP, libm::atan2(y, x));
        }
        (state, at) = (next, at + STEP);
    }
}

fn mean_bending(test: &Overhangs<'_>, ratio: f64, lengths: &[f64]) -> f64 {
    let length = ratio * mean(lengths);
    test.weight * length * length * length
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// Standard deviation of a reading about the mean of its side, as a share of that [-].
fn spread(test: &Overhangs<'_>) -> f64 {
    let sides = [test.face, test.back];
    let (mut sum, mut freedom) = (0.0, 0);
    for side in sides {
        let mean = mean(side);
        sum += side
            .iter()
            .map(|length| square(length / mean - 1.0))
            .sum::<f64>();
        freedom += side.len().saturating_sub(1);
    }
    (sum / freedom.max(1) as f64).sqrt()
}

fn square(value: f64) -> f64 {
    value * value
}

fn doubts(test: &Overhangs<'_>, face: Option<f64>, back: Option<f64>) -> Vec<Doubt> {
    let mut doubts = Vec::new();
    match (face, back) {
        (Some(face), Some(back)) => {
            let apart = (face - back).abs() / (0.5 * (face + back));
            if apart > 0.2 {
                doubts.push(Doubt::FaceAndBack { face, back });
            }
        }
        (None, _) => doubts.push(Doubt::OneSide { absent: "face" }),
        (_, None) => doubts.push(Doubt::OneSide { absent: "back" }),
    }
    let all = test.face.iter().chain(test.back).copied();
    // Strips are 20 to 25 cm long; below 1.5 cm the edge's own radius and half a millimetre of
    // reading are 10 % of the bending.
    doubts.extend(
        all.clone()
            .find(|length| !(1.5..=20.0).contains(length))
            .map(|length| Doubt::OverhangRange { length }),
    );
    let middle = robust::median(&all.clone().collect::<Vec<_>>());
    doubts.extend(
        all.clone()
            .find(|length| (length / middle - 1.0).abs() > 0.15)
            .filter(|_| !doubts_sides(face, back))
            .map(|length| Doubt::OverhangApart { length, middle }),
    );
    doubts
}

/// Whether face and back are so unlike that their readings must lie apart.
fn doubts_sides(face: Option<f64>, back: Option<f64>) -> bool {
    matches!((face, back), (Some(face), Some(back)) if (face - back).abs() > 0.2 * (face + back) * 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabric::fit::sample::{CLOTHS, Noise};

    fn test<'a>(face: &'a [f64], back: &'a [f64]) -> Overhangs<'a> {
        Overhangs {
            face,
            back,
            angle: PAPER_ANGLE,
            relation: Relation::Paper,
            weight: 0.014,
        }
    }

    #[test]
    fn the_relations_are_those_of_their_sources() {
        let ratio = |relation| bending_length(PAPER_ANGLE, relation).unwrap();
        assert_eq!(ratio(Relation::Paper), 0.5);
        assert!((ratio(Relation::Peirce) - 0.5093).abs() < 1e-4);
        // The heavy elastica: L = 2.00035·c.
        assert!((1.0 / ratio(Relation::Exact) - 2.000_35).abs() < 2e-5);
    }

    #[test]
    fn a_small_angle_is_that_of_a_straight_beam() {
        // Deflection of a cantilever under its weight: W·L⁴/(8·M) = L·tan θ, so (L/c)³ = 8·tan θ.
        let ratio = bending_length(0.01, Relation::Exact).unwrap();
        assert!(
            (ratio.powi(3) * 8.0 * 0.01_f64.tan() - 1.0).abs() < 1e-3,
            "{ratio}"
        );
        let peirce = bending_length(0.01, Relation::Peirce).unwrap();
        assert!((ratio / peirce - 1.0).abs() < 1e-3);
    }

    #[test]
    fn any_angle_gives_a_length() {
        for degrees in [0.5, 10.0, 30.0, 41.5, 43.0, 60.0, 80.0, 85.0] {
            for relation in [Relation::Peirce, Relation::Exact] {
                let ratio = bending_length(f64::to_radians(degrees), relation).unwrap();
                assert!(ratio > 0.1 && ratio < 3.0, "{degrees} {relation:?} {ratio}");
            }
        }
        let refused = bending_length(0.7, Relation::Paper)
            .unwrap_err()
            .to_string();
        assert!(refused.contains("41.5 degrees, not at 40.1"), "{refused}");
    }

    /// Eight strips, both ends, face and back: M goes as L³, so 1 % of a reading is 3 % of M.
    #[test]
    fn overhangs_with_errors_of_1_percent_give_bending_within_2_percent() {
        for (name, [_, _, truth, _, weight]) in CLOTHS {
            for seed in 0..20 {
                let mut noise = Noise::new(seed);
                let length = 2.0 * libm::cbrt(truth / weight);
                let readings: Vec<f64> = (0..32).map(|_| noise.about(length, 0.01)).collect();
                let (face, back) = readings.split_at(16);
                let found = bending(&Overhangs {
                    weight,
                    ..test(face, back)
                })
                .unwrap();
                let off = found.bending.value / truth - 1.0;
                assert!(off.abs() < 0.02, "{name}, {seed}: {off}");
                let half = found.bending.half_width.unwrap() / truth;
                assert!((0.005..0.02).contains(&half), "{name}, {seed}: ± {half}");
            }
        }
    }

    #[test]
    fn one_reading_is_a_value_without_a_spread() {
        let found = bending(&test(&[2.0], &[])).unwrap();
        assert_eq!(
            found.bending,
            Estimate {
                value: 0.014,
                half_width: None
            }
        );
        assert_eq!(found.doubts, [Doubt::OneSide { absent: "back" }]);
        assert_eq!(bending(&test(&[], &[])), Err(Unfit::NoOverhang));
    }

    #[test]
    fn unlike_sides_and_odd_readings_are_doubted() {
        let said = |face: &[f64], back: &[f64]| {
            let found = bending(&test(face, back)).unwrap();
            found
                .doubts
                .iter()
                .map(Doubt::to_string)
                .collect::<Vec<_>>()
                .join("; ")
        };
        assert_eq!(said(&[3.0, 3.02], &[2.9, 2.95]), "");
        assert!(said(&[3.0], &[2.6]).starts_with("face and back differ"));
        assert!(said(&[3.0, 3.0, 3.0], &[3.0, 3.0, 3.6]).contains("3.6 cm is more than 15 % off"));
        assert!(said(&[1.2], &[1.2]).contains("1.2 cm is outside"));
    }
}
