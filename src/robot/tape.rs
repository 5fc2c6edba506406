//! A measuring tape around balls: it lies in a plane and spans hollows.

use super::muscles::Ball;
use crate::math::{Vec2, Vec3};
use core::f64::consts::PI;

/// Directions in which the tape is looked at.
///
/// Where it leaves one disc for another the breadth has a kink; the sum errs by no more than
/// (2π/n)²/12 times the straight parts' length, 6·10⁻⁶ of it.
const DIRECTIONS: usize = 720;

/// Where a plane cuts balls: discs in the plane, their middles and radii [cm].
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Section(Vec<(Vec2, f64)>);

impl Section {
    /// The cut through a point of the plane, across a direction.
    pub(super) fn of<'b>(
        balls: impl IntoIterator<Item = &'b Ball>,
        point: &Vec3,
        across: &Vec3,
    ) -> Self {
        let [x, y] = sides(across);
        let disc = |ball: &Ball| {
            let from = ball.centre - point;
            let height = from.dot(across);
            let square = ball.radius * ball.radius - height * height;
            (square > 0.0).then(|| (Vec2::new(from.dot(&x), from.dot(&y)), square.sqrt()))
        };
        Self(balls.into_iter().filter_map(disc).collect())
    }

    /// Length of a tape drawn tight around all discs [cm]; 0 around none.
    ///
    /// Cauchy: a convex line is as long as its reach over all directions is on average, times 2π.
    pub(super) fn girth(&self) -> f64 {
        let reach = |direction: Vec2| {
            let reaches = self
                .0
                .iter()
                .map(|(middle, radius)| middle.dot(&direction) + radius);
            reaches.reduce(f64::max).unwrap_or(0.0)
        };
        let step = 2.0 * PI / DIRECTIONS as f64;
        let sum: f64 = (0..DIRECTIONS)
            .map(|index| {
                let (sine, cosine) = libm::sincos(step * index as f64);
                reach(Vec2::new(cosine, sine))
            })
            .sum();
        step * sum
    }
}

/// Two directions at right angles to another and to each other; x and y where it points up.
fn sides(across: &Vec3) -> [Vec3; 2] {
    let least = if across.y.abs() < 0.9 {
        Vec3::y()
    } else {
        Vec3::x()
    };
    let x = least.cross(across).normalize();
    [x, across.cross(&x)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(x: f64, y: f64, z: f64, radius: f64) -> Ball {
        let centre = Vec3::new(x, y, z);
        Ball { centre, radius }
    }

    fn girth(balls: &[Ball], point: Vec3, across: Vec3) -> f64 {
        Section::of(balls, &point, &across.normalize()).girth()
    }

    #[test]
    fn around_one_ball_it_is_a_circle() {
        let balls = [ball(3.0, -2.0, 10.0, 5.0)];
        let at = |z: f64, across| girth(&balls, Vec3::new(3.0, -2.0, z), across);
        assert!((at(10.0, Vec3::z()) - 10.0 * PI).abs() < 1e-9);
        assert!((at(13.0, Vec3::z()) - 8.0 * PI).abs() < 1e-9);
        assert!((at(10.0, Vec3::new(1.0, 2.0, -0.5)) - 10.0 * PI).abs() < 1e-9);
        assert_eq!(at(15.1, Vec3::z()), 0.0);
    }

    #[test]
    fn around_two_equal_balls_it_is_a_stadium() {
        let balls = [ball(-4.0, 1.0, 0.0, 3.0), ball(4.0, 1.0, 0.0, 3.0)];
        let stadium = 6.0 * PI + 16.0;
        assert!((girth(&balls, Vec3::zeros(), Vec3::z()) - stadium).abs() < 1e-3);
        assert!((girth(&balls, Vec3::new(0.0, 1.0, 0.0), Vec3::y()) - stadium).abs() < 1e-3);
    }

    /// A belt over two wheels: 2·√(d² − (R − r)²) straight, and arcs of π ± 2·asin((R − r)/d).
    #[test]
    fn around_two_unequal_balls_it_is_an_open_belt() {
        let (large, small, apart) = (6.0, 2.5, 11.0_f64);
        let balls = [ball(0.0, 0.0, 0.0, large), ball(0.0, apart, 0.0, small)];
        let lean = ((large - small) / apart).asin();
        let straight = (apart * apart - (large - small).powi(2)).sqrt();
        let belt = 2.0 * straight + large * (PI + 2.0 * lean) + small * (PI - 2.0 * lean);
        assert!((girth(&balls, Vec3::zeros(), Vec3::z()) - belt).abs() < 1e-3);
    }

    #[test]
    fn a_ball_inside_another_does_not_show() {
        let alone = [ball(0.0, 0.0, 0.0, 6.0)];
        let both = [alone[0], ball(2.0, 1.0, 1.0, 3.0)];
        let at = |balls| girth(balls, Vec3::zeros(), Vec3::z());
        assert_eq!(at(&alone), at(&both));
    }
}
