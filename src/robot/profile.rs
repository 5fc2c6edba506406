//! A smooth line through a few lengths that makes no waves between them.

/// Cubic pieces through points whose first numbers rise, slopes limited as Fritsch and Carlson have
/// it (1980), so that the line rises and falls only where the points do; level beyond the ends.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Profile(Vec<(f64, f64)>);

impl Profile {
    pub(super) fn new(points: &[(f64, f64)]) -> Self {
        Self(points.to_vec())
    }

    pub(super) fn at(&self, x: f64) -> f64 {
        let next = self.0.partition_point(|(known, _)| *known <= x);
        let (Some(before), Some(after)) = (next.checked_sub(1), self.0.get(next)) else {
            let end = if next == 0 {
                self.0.first()
            } else {
                self.0.last()
            };
            return end.map_or(0.0, |(_, y)| *y);
        };
        let (Some((x0, y0)), (x1, y1)) = (self.0.get(before), after) else {
            return 0.0;
        };
        let width = x1 - x0;
        let t = (x - x0) / width;
        let rest = 1.0 - t;
        y0 * rest * rest * (1.0 + 2.0 * t)
            + y1 * t * t * (3.0 - 2.0 * t)
            + width * t * rest * (rest * self.slope(before) - t * self.slope(next))
    }

    /// The points' first numbers and, evenly between them, as many more as it takes for no step to
    /// be wider than what goes with the lesser of the two values beside it.
    pub(super) fn divided(&self, widest: impl Fn(f64) -> f64) -> Vec<f64> {
        let mut places: Vec<f64> = self.0.first().map(|(x, _)| *x).into_iter().collect();
        for pair in self.0.windows(2) {
            if let &[(x0, y0), (x1, y1)] = pair {
                let steps = ((x1 - x0) / widest(y0.min(y1))).ceil().clamp(1.0, 1e3) as usize;
                let share = |step: usize| x0 + (x1 - x0) * step as f64 / steps as f64;
                places.extend((1..=steps).map(share));
            }
        }
        places
    }

    /// The harmonic mean of the steps to either side, which is within three times the flatter one;
    /// 0 at peaks, hollows and ends.
    fn slope(&self, point: usize) -> f64 {
        let step = |from: usize| {
            let ((x0, y0), (x1, y1)) = (self.0.get(from)?, self.0.get(from + 1)?);
            Some((y1 - y0) / (x1 - x0))
        };
        match (point.checked_sub(1).and_then(step), step(point)) {
            (Some(before), Some(after)) if before * after > 0.0 => {
                2.0 * before * after / (before + after)
            }
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_passes_through_its_points_and_rises_only_where_they_do() {
        let points = [(0.0, 4.0), (1.0, 5.0), (3.0, 5.0), (4.0, 9.0), (9.0, 2.0)];
        let profile = Profile::new(&points);
        for (x, y) in points {
            assert!((profile.at(x) - y).abs() < 1e-12);
        }
        for pair in points.windows(2) {
            let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
            let at = |i: i32| profile.at(x0 + (x1 - x0) * f64::from(i) / 50.0);
            for i in 0..50 {
                assert!((at(i + 1) - at(i)) * (y1 - y0) >= 0.0);
            }
        }
        let places = profile.divided(|y| 0.1 * y);
        assert!(points.iter().all(|(x, _)| places.contains(x)));
        assert!(places.windows(2).all(|pair| pair[1] - pair[0] <= 0.9));
        assert_eq!((profile.at(-3.0), profile.at(20.0)), (4.0, 2.0));
    }
}
