//! What a picture shows, chosen so that a film does not jitter.

use crate::math::Vec3;

/// The box that a picture shows [cm]. Its foot is the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The corner of least x, y and z.
    pub low: Vec3,
    /// The corner of greatest x, y and z.
    pub high: Vec3,
}

impl Frame {
    /// The box around all points of a film, for a camera that stands still; `None` where no point
    /// is finite.
    pub fn standing(points: impl IntoIterator<Item = Vec3>) -> Option<Self> {
        let finite = points.into_iter().filter(is_finite);
        let boxes = finite.map(|p| Self { low: p, high: p });
        boxes.reduce(|all, more| Self {
            low: all.low.inf(&more.low),
            high: all.high.sup(&more.high),
        })
    }

    /// A box per picture for a camera that goes with a figure, given each time the figure's points
    /// and where its middle is (a person's: the pelvis).
    ///
    /// All boxes are of one size and as wide to each side of the middle. Heights stay: who jumps
    /// leaves the floor. Empty where no point is finite; a middle that is not is the one before.
    pub fn following<'p>(
        figures: impl IntoIterator<Item = (&'p [Vec3], Vec3)> + Clone,
    ) -> Vec<Self> {
        let mut middle = Vec3::zeros();
        let mut floored = |at: Vec3| {
            if is_finite(&at) {
                middle = Vec3::new(at.x, at.y, 0.0);
            }
            middle
        };
        let middles: Vec<Vec3> = figures
            .clone()
            .into_iter()
            .map(|(_, at)| floored(at))
            .collect();
        let around = figures.into_iter().zip(&middles);
        let points =
            around.flat_map(|((points, _), middle)| points.iter().map(move |p| p - middle));
        let Some(all) = Self::standing(points) else {
            return Vec::new();
        };
        let half = all.low.abs().sup(&all.high.abs());
        let low = Vec3::new(-half.x, -half.y, all.low.z);
        let high = Vec3::new(half.x, half.y, all.high.z);
        let boxes = middles.iter().map(|middle| Self {
            low: low + middle,
            high: high + middle,
        });
        boxes.collect()
    }

    /// The eight corners.
    pub(super) fn corners(&self) -> [Vec3; 8] {
        let side = |k: usize, axis: usize| {
            let end = if k >> axis & 1 == 0 {
                self.low
            } else {
                self.high
            };
            end[axis]
        };
        std::array::from_fn(|k| Vec3::new(side(k, 0), side(k, 1), side(k, 2)))
    }

    /// Whether a camera can be turned on it.
    pub(super) fn can_be_seen(&self) -> bool {
        let across = (self.high - self.low).norm();
        is_finite(&self.low) && across.is_finite() && across > 0.0
    }
}

fn is_finite(p: &Vec3) -> bool {
    p.iter().all(|x| x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_still_camera_sees_all_that_is_finite() {
        let points = [
            Vec3::new(1.0, -2.0, 3.0),
            Vec3::repeat(f64::NAN),
            Vec3::new(-1.0, 5.0, 0.0),
        ];
        let frame = Frame::standing(points).unwrap();
        assert_eq!(frame.low, Vec3::new(-1.0, -2.0, 0.0));
        assert_eq!(frame.high, Vec3::new(1.0, 5.0, 3.0));
        assert_eq!(frame.corners()[5], Vec3::new(1.0, -2.0, 3.0));
        assert!(Frame::standing([]).is_none());
    }

    #[test]
    fn a_camera_that_follows_has_one_size_and_the_figure_in_it() {
        let figures: Vec<(Vec<Vec3>, Vec3)> = (0..9)
            .map(|k| {
                let middle = Vec3::new(3.0, -20.0 * f64::from(k), 90.0 + f64::from(k % 3));
                let foot = middle + Vec3::new(0.0, 30.0 * libm::sin(f64::from(k)), -90.0);
                (vec![middle, foot], middle)
            })
            .collect();
        let frames = Frame::following(figures.iter().map(|(all, at)| (&all[..], *at)));
        assert_eq!(frames.len(), figures.len());
        for (frame, (points, middle)) in frames.iter().zip(&figures) {
            let size = frame.high - frame.low;
            assert!((size - (frames[0].high - frames[0].low)).norm() < 1e-12);
            let centre = 0.5 * (frame.low + frame.high);
            assert!((centre - middle).xy().norm() < 1e-12);
            assert_eq!((frame.low.z, frame.high.z), (0.0, 92.0));
            let inside = |p: &Vec3| (p.sup(&frame.low).inf(&frame.high) - p).norm() < 1e-12;
            assert!(points.iter().all(inside));
        }
    }
}
