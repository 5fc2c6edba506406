//! Shear by (3) and (4) from a record of force against angle.
//!
//! Two clamps of length L, a gap A apart, move along each other by D under a load W that keeps the
//! cloth taut. By (3) and (4) the force per width that the cloth itself answers with is
//! f = (F − W·tan θ)/L with tan θ = D/A, and M_SH = f/tan θ. Friction between the threads adds a
//! part that changes its sign with the direction of motion, so M_SH is the slope of f over tan θ
//! along the branches of the record, all of one slope, each at a height of its own. How far the
//! branch out lies above the branch back is the hysteresis, 2HG of KES-F.
//!
//! The load's part is often far greater than the cloth's: with 200 gf it is 10 gf/cm, where cloth A
//! has 1. The paper asks for a tenth of that load or less, and so does [`Doubt::LoadRules`].

use super::{Doubt, Estimate, Unfit, robust};

/// A shear test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearRecord<'a> {
    /// tan θ = D/A [-] and force F along the clamps [gf], in the order of their reading.
    pub readings: &'a [[f64; 2]],
    /// W [gf].
    pub load: f64,
    /// L [cm].
    pub width: f64,
    /// Least and greatest θ to use, on either side [rad].
    pub angles: [f64; 2],
}

/// What a record gives.
#[derive(Clone, Debug, PartialEq)]
pub struct ShearFit {
    /// M_SH [gf/cm], per radian.
    pub shear: Estimate,
    /// How far the way out lies above the way back, 2HG [gf/cm]; absent without a way back.
    pub hysteresis: Option<f64>,
    /// Error, root mean square, as a share of the greatest force used [-].
    pub residual: f64,
    /// Readings used.
    pub used: usize,
    /// All readings.
    pub of: usize,
    /// What is doubtful.
    pub doubts: Vec<Doubt>,
}

/// A part of a record in one direction of motion and on one side of 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Branch {
    /// Toward greater angles.
    up: bool,
    /// On the side of positive angles.
    positive: bool,
}

#[derive(Clone, Copy, Debug)]
struct Reading {
    branch: Branch,
    tangent: f64,
    /// F/L [gf/cm].
    whole: f64,
    /// f: F/L without the load's part [gf/cm].
    force: f64,
}

/// M_SH of a record.
///
/// # Errors
/// [`Unfit`] where fewer than 4 readings lie within the angles, the way back lies above the way
/// out, or the force rises by less than the load's part.
pub fn shear(record: &ShearRecord<'_>) -> Result<ShearFit, Unfit> {
    let readings = within(record);
    if readings.len() < 4 {
        return Err(Unfit::TooFewAngles {
            found: readings.len(),
            needed: 4,
        });
    }
    let line = Lines::fit(&readings).ok_or(Unfit::OneAngle)?;
    let greatest = readings
        .iter()
        .map(|one| one.whole.abs())
        .fold(0.0, f64::max);
    let hysteresis = line.hysteresis();
    if let Some(width) = hysteresis.filter(|width| *width < -line.deviation.max(0.01 * greatest)) {
        return Err(Unfit::NegativeHysteresis { width });
    }
    let mut value = line.slope;
    let mut doubts = Vec::new();
    if value < 0.0 {
        if value < -2.0 * line.half_width {
            return Err(Unfit::LoadAlone { shear: value });
        }
        doubts.push(Doubt::ShearIsZero { shear: value });
        value = 0.0;
    }
    doubts.extend(load_rules(record, value));
    if hysteresis.is_none() {
        doubts.push(Doubt::NoWayBack);
    }
    Ok(ShearFit {
        shear: Estimate::new(value, line.half_width),
        hysteresis,
        residual: line.residual / greatest.max(f64::MIN_POSITIVE),
        used: line.used,
        of: record.readings.len(),
        doubts,
    })
}

fn within(record: &ShearRecord<'_>) -> Vec<Reading> {
    let [from, to] = record.angles.map(libm::tan);
    let places = 0..record.readings.len();
    let read = |place: usize| {
        let [tangent, force] = record.readings[place];
        // Rounding of the ends must not leave them out.
        let inside = (from - 1e-9..=to + 1e-9).contains(&tangent.abs());
        let branch = Branch {
            up: goes_up(record.readings, place),
            positive: tangent > 0.0,
        };
        inside.then(|| Reading {
            branch,
            tangent,
            whole: force / record.width,
            force: (force - record.load * tangent) / record.width,
        })
    };
    places.filter_map(read).collect()
}

/// Whether the angle grows about a reading: from the one before to the one after, so that a single
/// trembling reading turns no branch.
fn goes_up(readings: &[[f64; 2]], place: usize) -> bool {
    let before = readings[place.saturating_sub(1)][0];
    let after = readings[(place + 1).min(readings.len() - 1)][0];
    after >= before
}

fn load_rules(record: &ShearRecord<'_>, shear: f64) -> Option<Doubt> {
    let part = record.load / record.width;
    let share = part / (part + shear).max(f64::MIN_POSITIVE);
    (share > 0.75).then_some(Doubt::LoadRules { share })
}

/// Lines of one slope, a height for each branch.
struct Lines {
    slope: f64,
    half_width: f64,
    deviation: f64,
    residual: f64,
    used: usize,
    heights: Vec<(Branch, f64)>,
}

impl Lines {
    /// `None` where all readings of each branch have one angle.
    fn fit(readings: &[Reading]) -> Option<Self> {
        let mut branches: Vec<Branch> = readings.iter().map(|one| one.branch).collect();
        branches.sort();
        branches.dedup();
        let mut weights = vec![1.0; readings.len()];
        let mut lines = Self::weighted(readings, &weights, &branches)?;
        for _ in 0..50 {
            let errors = lines.errors(readings);
            // Readings of a perfect record differ by the rounding of their sums.
            let size = readings
                .iter()
                .map(|one| one.whole.abs())
                .fold(0.0, f64::max);
            lines.deviation = robust::deviation(&errors).max(1e-9 * size);
            weights = errors
                .iter()
                .map(|error| robust::weight(error / lines.deviation))
                .collect();
            let before = lines.slope;
            let deviation = lines.deviation;
            lines = Self::weighted(readings, &weights, &branches)?;
            lines.deviation = deviation;
            if (lines.slope - before).abs() <= 1e-12 * before.abs() {
                break;
            }
        }
        lines.judge(readings, &weights, branches.len());
        Some(lines)
    }

    fn weighted(readings: &[Reading], weights: &[f64], branches: &[Branch]) -> Option<Self> {
        let (mut across, mut along) = (0.0, 0.0);
        let mut centres = Vec::new();
        for branch in branches {
            let own = || {
                let pairs = readings.iter().zip(weights);
                pairs.filter(|(one, weight)| one.branch == *branch && **weight > 0.0)
            };
            let total: f64 = own().map(|(_, weight)| weight).sum();
            if total <= 0.0 {
                continue;
            }
            let x = own().map(|(one, weight)| weight * one.tangent).sum::<f64>() / total;
            let y = own().map(|(one, weight)| weight * one.force).sum::<f64>() / total;
            for (one, weight) in own() {
                across += weight * (one.tangent - x) * (one.tangent - x);
                along += weight * (one.tangent - x) * (one.force - y);
            }
            centres.push((*branch, x, y));
        }
        // Angles within a millionth of a degree are one.
        let slope = (across > 1e-14).then(|| along / across)?;
        let height = |(branch, x, y): (Branch, f64, f64)| (branch, y - slope * x);
        Some(Self {
            slope,
            half_width: 0.0,
            deviation: 0.0,
            residual: 0.0,
            used: 0,
            heights: centres.into_iter().map(height).collect(),
        })
    }

    fn height(&self, branch: Branch) -> Option<f64> {
        let of = self.heights.iter().find(|(known, _)| *known == branch);
        of.map(|(_, height)| *height)
    }

    fn errors(&self, readings: &[Reading]) -> Vec<f64> {
        let error = |one: &Reading| {
            let height = self.height(one.branch).unwrap_or(0.0);
            one.force - height - self.slope * one.tangent
        };
        readings.iter().map(error).collect()
    }

    /// How far the slope may be off, and what was used.
    fn judge(&mut self, readings: &[Reading], weights: &[f64], branches: usize) {
        let errors = self.errors(readings);
        let variance = robust::variance(&errors, self.deviation, branches + 1);
        let across: f64 = self.across(readings, weights);
        self.half_width = robust::half_width(variance / across, readings.len(), branches + 1);
        let kept: Vec<f64> = errors
            .iter()
            .zip(weights)
            .filter(|(_, weight)| **weight > 0.0)
            .map(|(error, _)| error * error)
            .collect();
        self.used = kept.len();
        self.residual = (kept.iter().sum::<f64>() / kept.len().max(1) as f64).sqrt();
    }

    /// Σ (tan θ − mean of its branch)² over what was used.
    fn across(&self, readings: &[Reading], weights: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (branch, _) in &self.heights {
            let own = readings.iter().zip(weights);
            let own = own.filter(|(one, weight)| one.branch == *branch && **weight > 0.0);
            let tangents: Vec<f64> = own.map(|(one, _)| one.tangent).collect();
            let mean = tangents.iter().sum::<f64>() / tangents.len().max(1) as f64;
            sum += tangents
                .iter()
                .map(|x| (x - mean) * (x - mean))
                .sum::<f64>();
        }
        sum.max(f64::MIN_POSITIVE)
    }

    /// Mean over the sides of 0 that have both branches.
    fn hysteresis(&self) -> Option<f64> {
        let side = |positive: bool| {
            let at = |up: bool| self.height(Branch { up, positive });
            Some(at(true)? - at(false)?)
        };
        let sides: Vec<f64> = [false, true].into_iter().filter_map(side).collect();
        (!sides.is_empty()).then(|| sides.iter().sum::<f64>() / sides.len() as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabric::fit::sample::{CLOTHS, Noise};

    /// KES-F1 clamps, the tenth of its load that the paper asks for, out to 8° and back, to −8° and
    /// back, with a hysteresis [gf/cm].
    fn record(modulus: f64, hysteresis: f64, load: f64) -> Vec<[f64; 2]> {
        let legs = [(0.0, 8.0), (8.0, 0.0), (0.0, -8.0), (-8.0, 0.0)];
        let mut readings = Vec::new();
        for (from, to) in legs {
            let sign = if to > from { 0.5 } else { -0.5 };
            for k in 1..=32 {
                let angle: f64 = from + (to - from) * f64::from(k) / 32.0;
                let tangent = angle.to_radians().tan();
                let cloth = modulus * tangent + sign * hysteresis;
                readings.push([tangent, 20.0 * cloth + load * tangent]);
            }
        }
        readings
    }

    fn of(readings: &[[f64; 2]], load: f64) -> Result<ShearFit, Unfit> {
        shear(&ShearRecord {
            readings,
            load,
            width: 20.0,
            angles: [0.5, 5.0].map(f64::to_radians),
        })
    }

    #[test]
    fn a_record_without_errors_gives_slope_and_hysteresis_back() {
        for (name, [_, _, _, modulus, _]) in CLOTHS {
            let found = of(&record(modulus, 0.2, 20.0), 20.0).unwrap();
            let off = (found.shear.value - modulus).abs();
            assert!(off < 1e-6 * modulus.max(1.0), "{name}: {:?}", found.shear);
            let hysteresis = found.hysteresis.unwrap();
            assert!(
                (hysteresis - 0.2).abs() < 1e-6 * modulus.max(1.0),
                "{name}: {hysteresis}"
            );
        }
    }

    #[test]
    fn forces_with_errors_of_1_percent_give_shear_within_2_percent() {
        for (name, [_, _, _, modulus, _]) in CLOTHS {
            for seed in 0..20 {
                let mut noise = Noise::new(seed);
                let mut readings = record(modulus, 0.02 * modulus, 20.0);
                for reading in &mut readings {
                    reading[1] = noise.about(reading[1], 0.01);
                }
                let found = of(&readings, 20.0).unwrap();
                let off = (found.shear.value - modulus).abs();
                // Of a shear of 0 (cloth B, warp) no share can be taken.
                assert!(
                    off < (0.02 * modulus).max(0.02),
                    "{name}, {seed}: {:?}",
                    found.shear
                );
            }
        }
    }

    #[test]
    fn wrong_readings_are_left_out() {
        let mut readings = record(18.0, 1.0, 20.0);
        readings[7][1] *= 1.5;
        readings[50][1] -= 30.0;
        let found = of(&readings, 20.0).unwrap();
        assert!((found.shear.value - 18.0).abs() < 1e-6, "{:?}", found.shear);
        assert!(found.used < found.of);
    }

    #[test]
    fn a_load_that_outweighs_the_cloth_is_doubted() {
        let found = of(&record(1.0, 0.1, 200.0), 200.0).unwrap();
        assert!((found.shear.value - 1.0).abs() < 1e-6);
        assert_eq!(
            found.doubts[0].to_string().split(':').next(),
            Some("91 % of the force is the load's own part W·tan θ")
        );
        assert!(
            of(&record(18.0, 0.1, 20.0), 20.0)
                .unwrap()
                .doubts
                .is_empty()
        );
    }

    #[test]
    fn what_is_no_record_is_refused() {
        let message = |readings: &[[f64; 2]], load| of(readings, load).unwrap_err().to_string();
        let good = record(18.0, 1.0, 20.0);
        assert!(message(&good[..3], 20.0).starts_with("2 readings"));
        assert!(message(&record(18.0, -1.0, 20.0), 20.0).starts_with("the hysteresis is -1.000"));
        assert!(message(&good, 2000.0).contains("less than the load's own part"));
        assert!(message(&[[0.05, 1.0]; 9], 20.0).starts_with("all readings"));
        let half = of(&good[..32], 20.0).unwrap();
        assert_eq!(
            (half.hysteresis, &half.doubts[..]),
            (None, &[Doubt::NoWayBack][..])
        );
    }
}
