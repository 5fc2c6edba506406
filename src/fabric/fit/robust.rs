//! Least squares that a few wrong readings do not lead astray.
//!
//! Tukey's biweight: a reading whose error is u robust standard deviations counts by
//! (1 − (u/C)²)², and not at all beyond C. P. J. Huber and E. M. Ronchetti, *Robust Statistics*,
//! 2nd ed. (2009), chapters 7.6 to 7.8 (named from memory).

/// With it the estimate keeps 95 % of its efficiency where the errors are normal.
const C: f64 = 4.685;

/// A share below which errors are those of rounding.
const EXACT: f64 = 1e-9;

/// How much a reading of error u [standard deviations] counts, 0 to 1.
pub(super) fn weight(u: f64) -> f64 {
    let left = (1.0 - (u / C) * (u / C)).max(0.0);
    left * left
}

/// Standard deviation of errors, by the median of their sizes; never 0.
pub(super) fn deviation(errors: &[f64]) -> f64 {
    let sizes: Vec<f64> = errors.iter().map(|error| error.abs()).collect();
    // 1.4826: the ratio of the two for normal errors.
    (1.4826 * median(&sizes)).max(EXACT)
}

/// The middle value; 0 of none.
pub(super) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let upper = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
    let lower = sorted.get(sorted.len().saturating_sub(1) / 2);
    0.5 * (lower.copied().unwrap_or(0.0) + upper)
}

/// Variance of one reading, as the estimate sees it [unit of the errors, squared]: Huber's
/// s²·[Σψ²/(n − k)] / [Σψ′/n]² for k parameters.
pub(super) fn variance(errors: &[f64], deviation: f64, parameters: usize) -> f64 {
    let count = errors.len() as f64;
    let (mut pull, mut slope) = (0.0, 0.0);
    for error in errors {
        let u = error / deviation;
        let left = 1.0 - (u / C) * (u / C);
        if left > 0.0 {
            pull += u * u * left * left * left * left;
            slope += left * (1.0 - 5.0 * (u / C) * (u / C));
        }
    }
    let freedom = (count - parameters as f64).max(1.0);
    let slope = (slope / count).max(0.1);
    deviation * deviation * (pull / freedom) / (slope * slope)
}

/// Half of the 95 % interval of a value with the given variance, from n readings and k parameters:
/// Student's quantile, by the first terms of its series in 1/(n − k) (2 % low at 3).
pub(super) fn half_width(variance: f64, readings: usize, parameters: usize) -> f64 {
    let freedom = readings.saturating_sub(parameters).max(1) as f64;
    let quantile = 1.96 + 2.372 / freedom + 2.823 / (freedom * freedom);
    quantile * variance.sqrt()
}

/// Whether a reading of that error is left out.
pub(super) fn is_outlier(u: f64) -> bool {
    u.abs() >= C
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle() {
        assert_eq!(median(&[]), 0.0);
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
    }

    #[test]
    fn far_readings_do_not_count() {
        assert_eq!(weight(0.0), 1.0);
        assert_eq!(weight(5.0), 0.0);
        assert!(is_outlier(-5.0) && !is_outlier(4.0));
    }

    #[test]
    fn the_interval_is_students() {
        for (freedom, quantile) in [(3, 3.182), (5, 2.571), (10, 2.228), (30, 2.042)] {
            assert!((half_width(1.0, freedom + 2, 2) / quantile - 1.0_f64).abs() < 0.04);
        }
    }
}
