//! A and B of (1) from a measured S–S curve.
//!
//! T = A·S^(B+1) is fitted by robust least squares of *relative* errors (T − A·S^(B+1))/(A·S^(B+1)).
//! That is the weight which the paper asks for: cloth that is worn bears only itself (1 m of cloth A
//! 0.35 gf/cm), so "the change of strain where the force is very small" decides, and a reading of
//! 0.35 gf/cm counts here as much as one of 350. Plain least squares of tensions would give it a
//! millionth of that.
//!
//! 1. The way up is taken: points up to the greatest strain.
//! 2. A reading can be no better than its last digit: q, the least step between two readings, adds
//!    30·q to what an error is divided by, so that the digits of readings below some 30·q count
//!    for less and less (q/√12 is 1 % of 30·q).
//! 3. The start is the median of the slopes between points in ln T over ln S (Theil and Sen);
//!    from it Gauss–Newton steps in (ln A, B), the readings weighted anew each time by Tukey's
//!    biweight.
//! 4. Where the law does not hold to 5 % over the whole curve, its upper end is left out, each time
//!    down to half the tension, until it does.
//!
//! A and B are strongly correlated: A is the tension at S = 1, far beyond the curve. With a
//! relative error σ of n readings spread evenly from 0 to S_m, B is known to σ/√n and ln A to
//! σ·√(1 + (1 − ln S_m)²)/√n: A to 2 % with 95 % certainty takes 30 readings where S_m is 0.3, 150
//! where it is 0.02.

use super::{Doubt, Estimate, Unfit, robust};

/// Points below which a curve is no curve.
const LEAST: usize = 4;
/// Relative error, root mean square, above which the law does not hold.
const HOLDS: f64 = 0.05;
/// Points that a part of a curve must keep.
const PART: usize = 10;
/// Steps of the last digit below which a reading counts for less than half.
const DIGITS: f64 = 30.0;

/// What is wished of a fit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Range {
    /// Greatest strain to use [-]; chosen where not given.
    pub up_to: Option<f64>,
    /// Strain at which the machine's slack ends and the cloth's begins [-].
    pub slack: f64,
}

/// What became of a reading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// The law was fitted to it.
    Used,
    /// Too far from the law that the others follow.
    Outlier,
    /// Outside the range that was used.
    Outside,
    /// Read on the way back.
    WayBack,
}

/// The law that a curve follows.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerFit {
    /// Factor A [gf/cm].
    pub a: Estimate,
    /// Exponent B [-].
    pub b: Estimate,
    /// Relative error, root mean square over the points used [-].
    pub residual: f64,
    /// Least and greatest strain used, readings near the last digit apart [-].
    pub strains: [f64; 2],
    /// Their tensions [gf/cm].
    pub tensions: [f64; 2],
    /// What became of each point, in their order.
    pub fates: Vec<Fate>,
    /// What is doubtful.
    pub doubts: Vec<Doubt>,
}

/// The power law (1) through points (strain [-], tension [gf/cm]) in the order of their reading.
///
/// # Errors
/// [`Unfit`] where fewer than 4 points rise from 0, or the curve is none that the law can follow.
pub fn power_law(points: &[[f64; 2]], range: &Range) -> Result<PowerFit, Unfit> {
    let rising = way_up(points);
    let readings: Vec<Reading> = (0..rising)
        .filter_map(|place| Reading::new(place, points[place], range))
        .collect();
    let step = least_step(&readings);
    let whole = Law::fit(&readings, step).ok_or(Unfit::TooFewPoints {
        found: readings.iter().filter(|one| one.tension > 0.0).count(),
        needed: LEAST,
    })?;
    let mut doubts: Vec<Doubt> = slack(&readings, step, &whole).into_iter().collect();
    let law = if range.up_to.is_none() && doubts.is_empty() {
        whole.narrowed(&readings, step)
    } else {
        whole
    };
    if law.misfit > HOLDS {
        let residual = law.misfit;
        doubts.push(Doubt::LawDoesNotHold { residual });
    }
    let fit = law.result(points, rising, doubts);
    match fit.b.value {
        b if b < 0.0 => Err(Unfit::Flattens { b }),
        _ => Ok(fit),
    }
}

/// How many points the way up has.
fn way_up(points: &[[f64; 2]]) -> usize {
    let greatest = points.iter().map(|point| point[0]).fold(0.0, f64::max);
    let last = points.iter().position(|point| point[0] >= greatest);
    last.map_or(0, |last| last + 1)
}

#[derive(Clone, Copy, Debug)]
struct Reading {
    place: usize,
    strain: f64,
    ln_strain: f64,
    tension: f64,
}

impl Reading {
    /// `None` for a reading outside the range.
    fn new(place: usize, [strain, tension]: [f64; 2], range: &Range) -> Option<Self> {
        let up_to = range.up_to.unwrap_or(f64::INFINITY);
        let strain = strain - range.slack;
        let inside = strain > 0.0 && strain <= up_to && tension.is_finite();
        inside.then(|| Self {
            place,
            strain,
            ln_strain: libm::log(strain),
            tension,
        })
    }
}

/// The least difference between two readings [gf/cm].
fn least_step(readings: &[Reading]) -> f64 {
    let mut tensions: Vec<f64> = readings.iter().map(|one| one.tension).collect();
    tensions.sort_by(f64::total_cmp);
    let steps = tensions.windows(2).map(|pair| pair[1] - pair[0]);
    let greatest = tensions.last().copied().unwrap_or(0.0);
    // Equal readings differ by no step, those of one value by rounding at most.
    let least = steps
        .filter(|step| *step > 1e-9 * greatest)
        .fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

/// T = exp(height + power·(ln S − centre)), and how its readings lie about it.
#[derive(Clone, Debug)]
struct Law {
    /// q [gf/cm].
    step: f64,
    centre: f64,
    height: f64,
    power: f64,
    readings: Vec<Reading>,
    /// Relative errors.
    errors: Vec<f64>,
    deviation: f64,
    /// Σ g² and Σ g²(ln S − centre)², g the share of the tension in what errors are divided by.
    sums: [f64; 2],
    residual: f64,
    /// The same over all readings but the worst tenth: a part of the curve that the law leaves out
    /// as a whole is no slip of single readings.
    misfit: f64,
}

impl Law {
    /// `None` where too few readings pull.
    fn fit(readings: &[Reading], step: f64) -> Option<Self> {
        let (slope, level) = start(readings)?;
        let mut law = Self {
            step,
            centre: 0.0,
            height: level,
            power: slope,
            readings: readings.to_vec(),
            errors: Vec::new(),
            deviation: 0.0,
            sums: [0.0; 2],
            residual: 0.0,
            misfit: 0.0,
        };
        for _ in 0..100 {
            if law.improve() < 1e-10 {
                break;
            }
        }
        let sound = law.height.is_finite() && law.power.is_finite() && law.sums[1] > 0.0;
        sound.then_some(law)
    }

    fn tension(&self, ln_strain: f64) -> f64 {
        libm::exp(self.height + self.power * (ln_strain - self.centre))
    }

    /// One weighted Gauss–Newton step; how far it went.
    fn improve(&mut self) -> f64 {
        let sized = |one: &Reading| {
            let tension = self.tension(one.ln_strain);
            let size = tension + DIGITS * self.step;
            ((one.tension - tension) / size, tension / size)
        };
        let (errors, shares): (Vec<f64>, Vec<f64>) = self.readings.iter().map(sized).unzip();
        self.deviation = robust::deviation(&errors);
        let weights: Vec<f64> = errors
            .iter()
            .map(|error| robust::weight(error / self.deviation))
            .collect();
        let rows = || {
            let pairs = self.readings.iter().zip(&errors).zip(&shares).zip(&weights);
            pairs.map(|(((one, error), share), weight)| (one.ln_strain, *error, *share, *weight))
        };
        let total: f64 = rows().map(|(_, _, g, w)| w * g * g).sum();
        // About the centre of the readings, height and power do not depend on each other.
        let centre = rows().map(|(x, _, g, w)| w * g * g * x).sum::<f64>() / total;
        let spread: f64 = rows()
            .map(|(x, _, g, w)| w * g * g * (x - centre) * (x - centre))
            .sum();
        let rise = rows().map(|(_, r, g, w)| w * g * r).sum::<f64>() / total;
        let turn = rows()
            .map(|(x, r, g, w)| w * g * r * (x - centre))
            .sum::<f64>()
            / spread;
        // A step of more than a factor e is cut: the tangent says nothing so far away.
        let (rise, turn) = (rise.clamp(-1.0, 1.0), turn.clamp(-1.0, 1.0));
        self.height += self.power * (centre - self.centre) + rise;
        self.centre = centre;
        self.power += turn;
        self.sums = [total, spread];
        self.residual = rms_of_kept(&errors, self.deviation);
        self.misfit = rms_but_worst(&errors);
        self.errors = errors;
        rise.abs() + turn.abs()
    }

    /// The law over the widest part from the origin over which it holds; over the part where it
    /// comes nearest to that, where it holds over none.
    fn narrowed(self, readings: &[Reading], step: f64) -> Self {
        let mut best = self;
        let mut part = readings.to_vec();
        let mut law = best.clone();
        while best.misfit > HOLDS {
            let top = part.iter().map(|one| one.ln_strain).fold(-1e3, f64::max);
            let limit = top - core::f64::consts::LN_2 / law.power.max(0.5);
            part.retain(|one| one.ln_strain <= limit);
            if part.len() < PART {
                break;
            }
            let Some(next) = Self::fit(&part, step) else {
                break;
            };
            law = next;
            if law.misfit < best.misfit {
                best = law.clone();
            }
        }
        best
    }

    fn kept(&self) -> impl Iterator<Item = &Reading> {
        let pairs = self.readings.iter().zip(&self.errors);
        pairs
            .filter(|(_, error)| !robust::is_outlier(**error / self.deviation))
            .map(|(one, _)| one)
    }

    /// Of those, the ones well above the last digit.
    fn telling(&self) -> impl Iterator<Item = &Reading> {
        self.kept()
            .filter(|one| self.tension(one.ln_strain) >= DIGITS * self.step)
    }

    fn result(&self, points: &[[f64; 2]], rising: usize, doubts: Vec<Doubt>) -> PowerFit {
        let count = self.readings.len();
        let variance = robust::variance(&self.errors, self.deviation, 2);
        let half = |variance: f64| robust::half_width(variance, count, 2);
        let power = variance / self.sums[1];
        let ln_a = variance / self.sums[0] + self.centre * self.centre * power;
        let a = libm::exp(self.height - self.power * self.centre);
        let mut fates = vec![Fate::Outside; rising];
        fates.resize(points.len(), Fate::WayBack);
        for one in &self.readings {
            fates[one.place] = Fate::Outlier;
        }
        for one in self.kept() {
            fates[one.place] = Fate::Used;
        }
        PowerFit {
            a: Estimate::new(a, a * libm::expm1(half(ln_a))),
            b: Estimate::new(self.power - 1.0, half(power)),
            residual: self.residual,
            strains: ends(self.telling().map(|one| one.strain)),
            tensions: ends(self.telling().map(|one| one.tension)),
            fates,
            doubts,
        }
    }
}

/// Least and greatest; 0 and 0 of none.
fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let ends = values.map(|value| [value, value]);
    ends.reduce(|[low, high], [value, _]| [low.min(value), high.max(value)])
        .unwrap_or_default()
}

fn rms_of_kept(errors: &[f64], deviation: f64) -> f64 {
    let kept: Vec<f64> = errors
        .iter()
        .copied()
        .filter(|error| !robust::is_outlier(error / deviation))
        .collect();
    rms(&kept)
}

fn rms_but_worst(errors: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = errors.iter().map(|error| error.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.truncate(sizes.len() - sizes.len() / 10);
    rms(&sizes)
}

fn rms(errors: &[f64]) -> f64 {
    let sum: f64 = errors.iter().map(|error| error * error).sum();
    (sum / errors.len().max(1) as f64).sqrt()
}

/// Slope and level (at S = 1) of ln T over ln S: medians over pairs and over points, which hold
/// while fewer than three in ten readings are wrong.
fn start(readings: &[Reading]) -> Option<(f64, f64)> {
    // Pairs grow as the square; 200 readings spread over the curve have 20,000.
    const MANY: usize = 200;
    let pulling: Vec<(f64, f64)> = readings
        .iter()
        .filter(|one| one.tension > 0.0)
        .map(|one| (one.ln_strain, libm::log(one.tension)))
        .collect();
    if pulling.len() < LEAST {
        return None;
    }
    let some: Vec<(f64, f64)> = pulling
        .iter()
        .step_by(pulling.len().div_ceil(MANY))
        .copied()
        .collect();
    let mut slopes = Vec::new();
    for (place, (x, y)) in some.iter().enumerate() {
        let others = some.iter().skip(place + 1);
        let apart = others.filter(|(other, _)| (other - x).abs() > 1e-6);
        slopes.extend(apart.map(|(other, height)| (height - y) / (other - x)));
    }
    if slopes.is_empty() {
        return None;
    }
    let slope = robust::median(&slopes).clamp(0.1, 20.0);
    let levels: Vec<f64> = pulling.iter().map(|(x, y)| y - slope * x).collect();
    Some((slope, robust::median(&levels)))
}

/// Slack at the start, where a law that begins later fits more than twice as well.
fn slack(readings: &[Reading], step: f64, law: &Law) -> Option<Doubt> {
    const TRIES: u32 = 40;
    let greatest = readings.iter().map(|one| one.tension).fold(0.0, f64::max);
    // Where the tension is a thousandth of the greatest, the cloth pulls already.
    let begins = readings.iter().find(|one| one.tension > 1e-3 * greatest)?;
    if law.misfit < 0.02 {
        return None;
    }
    let moved = |strain: f64| {
        let later = readings.iter().filter_map(|one| {
            let range = Range {
                slack: strain,
                up_to: None,
            };
            Reading::new(one.place, [one.strain, one.tension], &range)
        });
        Law::fit(&later.collect::<Vec<_>>(), step).map(|law| (strain, law.misfit))
    };
    let tried = (1..TRIES)
        .filter_map(|try_number| moved(begins.strain * f64::from(try_number) / f64::from(TRIES)));
    let (strain, residual) = tried.min_by(|one, other| one.1.total_cmp(&other.1))?;
    (residual < 0.5 * law.misfit).then_some(Doubt::Slack {
        strain,
        residual,
        without: law.misfit,
    })
}

#[cfg(test)]
mod tests;
