//! How far a point is outside the flesh: balls, and between neighbours the hull of their balls.
//!
//! The hull of two balls is a cone with round ends, that of three a plate with round edges; flesh so
//! made is smooth along each limb however far apart its balls are, and no thicker where many overlap.
//! Limbs blend into each other where they meet at an angle, so that there is no crease to catch on.

use super::muscles::{Ball, Limb, Muscles};
use crate::math::{Vec2, Vec3};

/// How far from a crease limbs begin to blend [cm], where they meet at a right angle. They do not
/// where they run alongside each other, one inside the other, nor where they face each other, as
/// thighs do.
const BLEND: f64 = 2.0;

/// How far a point is outside, and the direction in which that grows (of length 1, but where limbs
/// blend).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Outside {
    pub(super) distance: f64,
    pub(super) slope: Vec3,
}

/// Flesh as pieces, limb by limb.
#[derive(Clone, Debug, Default)]
pub(super) struct Field {
    pieces: Vec<Piece>,
}

/// The hull of a ball, of two or of three, and a ball around it.
#[derive(Clone, Debug)]
struct Piece {
    limb: Limb,
    hull: Hull,
    around: Ball,
}

#[derive(Clone, Debug)]
enum Hull {
    Ball(Ball),
    Cone(Ball, Ball),
    Plate(Plate),
}

/// Three balls whose hull has flat sides.
#[derive(Clone, Debug)]
struct Plate {
    first: Ball,
    /// Its sides, and the plane's normal.
    sides: [Vec3; 2],
    normal: Vec3,
    /// From parts along normal directions to shares of the sides.
    across: [Vec3; 2],
    /// How the radius grows in the plane.
    growth: Vec3,
}

impl Field {
    /// The flesh of a body whose muscles are in place.
    pub(super) fn of(muscles: &Muscles, balls: &[Ball]) -> Self {
        let mut edges: Vec<(Limb, usize, usize)> = Vec::new();
        let mut pieces = Vec::new();
        for link in &muscles.links {
            let [a, b, c] = link.ends;
            for (one, other) in [(a, b), (b, c), (c, a)] {
                edges.push((link.limb, one.min(other), one.max(other)));
            }
            let corners = [a, b, c].map(|end| balls.get(end).copied());
            if let [Some(a), Some(b), Some(c)] = corners {
                pieces.extend(Plate::of(a, b, c).map(|plate| Piece {
                    limb: link.limb,
                    around: around(&[a, b, c]),
                    hull: Hull::Plate(plate),
                }));
            }
        }
        edges.sort_unstable();
        edges.dedup();
        for (limb, one, other) in edges {
            if let (Some(one), Some(other)) = (balls.get(one), balls.get(other)) {
                pieces.push(Piece {
                    limb,
                    around: around(&[*one, *other]),
                    hull: cone(*one, *other),
                });
            }
        }
        // In the order of the limbs, in which they are blended.
        pieces.sort_by_key(|piece| piece.limb);
        Self { pieces }
    }

    /// The pieces that count within `reach` [cm] of a point.
    pub(super) fn near(&self, point: &Vec3, reach: f64) -> Self {
        let counts = |piece: &&Piece| piece.at_least(point) <= reach;
        Self {
            pieces: self.pieces.iter().filter(counts).cloned().collect(),
        }
    }

    /// How far a point is outside the flesh; none where there is none.
    pub(super) fn outside(&self, point: &Vec3) -> Option<Outside> {
        let mut whole: Option<Outside> = None;
        for limb in self.pieces.chunk_by(|one, next| one.limb == next.limb) {
            let nearest = nearest(
                limb,
                point,
                whole.map_or(f64::INFINITY, |o| o.distance + BLEND),
            );
            whole = match (whole, nearest) {
                (Some(whole), Some(limb)) => Some(blended(whole, limb)),
                (whole, limb) => whole.or(limb),
            };
        }
        whole
    }

    /// The limb that a point is nearest to.
    #[cfg(test)]
    pub(super) fn limb(&self, point: &Vec3) -> Option<Limb> {
        let distance = |piece: &Piece| piece.hull.outside(point).distance;
        let nearest = self
            .pieces
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.map(|piece| piece.limb)
    }

    /// How far a point is outside, limbs not blended [cm].
    pub(super) fn bare(&self, point: &Vec3) -> f64 {
        let distances = self
            .pieces
            .iter()
            .map(|piece| piece.hull.outside(point).distance);
        distances.fold(f64::INFINITY, f64::min)
    }

    /// The box around the flesh: its least and its greatest corner [cm].
    pub(super) fn extent(&self) -> Option<(Vec3, Vec3)> {
        let ends = self.pieces.iter().map(|piece| {
            let reach = Vec3::repeat(piece.around.radius);
            (piece.around.centre - reach, piece.around.centre + reach)
        });
        ends.reduce(|a, b| (a.0.inf(&b.0), a.1.sup(&b.1)))
    }
}

/// The piece of a limb that a point is least outside of, where that is less than `within`.
fn nearest(limb: &[Piece], point: &Vec3, within: f64) -> Option<Outside> {
    let mut nearest: Option<Outside> = None;
    let mut within = within;
    for piece in limb {
        if piece.at_least(point) < within {
            let outside = piece.hull.outside(point);
            if outside.distance < within {
                within = outside.distance;
                nearest = Some(outside);
            }
        }
    }
    nearest
}

/// Both, the crease between them filled.
fn blended(one: Outside, other: Outside) -> Outside {
    let (near, far) = if one.distance <= other.distance {
        (one, other)
    } else {
        (other, one)
    };
    let alike = near.slope.dot(&far.slope) / (near.slope.norm() * far.slope.norm()).max(1e-9);
    let width = BLEND * (1.0 - alike * alike).max(0.0).sqrt();
    let share = (width - (far.distance - near.distance)).max(0.0) / width.max(1e-9);
    Outside {
        distance: near.distance - 0.25 * width * share * share,
        slope: near.slope * (1.0 - 0.5 * share) + far.slope * (0.5 * share),
    }
}

impl Piece {
    /// A point is at least so far outside.
    fn at_least(&self, point: &Vec3) -> f64 {
        (point - self.around.centre).norm() - self.around.radius
    }
}

/// A ball around balls, from the middle of the box of their middles.
fn around(balls: &[Ball]) -> Ball {
    let first = balls.first().map_or_else(Vec3::zeros, |ball| ball.centre);
    let low = balls.iter().fold(first, |low, ball| low.inf(&ball.centre));
    let high = balls
        .iter()
        .fold(first, |high, ball| high.sup(&ball.centre));
    let centre = 0.5 * (low + high);
    let reach = balls
        .iter()
        .map(|ball| (ball.centre - centre).norm() + ball.radius);
    Ball {
        centre,
        radius: reach.fold(0.0, f64::max),
    }
}

/// The hull of two balls; the larger one where it holds the other.
fn cone(one: Ball, other: Ball) -> Hull {
    let apart = (other.centre - one.centre).norm();
    if apart > (other.radius - one.radius).abs() + 1e-9 {
        Hull::Cone(one, other)
    } else if one.radius >= other.radius {
        Hull::Ball(one)
    } else {
        Hull::Ball(other)
    }
}

impl Hull {
    /// How far a point is outside: the least of |p − q| − r(q) over all q of the segment or the
    /// triangle, r growing evenly along it.
    fn outside(&self, point: &Vec3) -> Outside {
        match self {
            Self::Ball(ball) => from(point, ball.centre, ball.radius),
            Self::Cone(one, other) => {
                let way = other.centre - one.centre;
                let length = way.norm();
                let along = way / length;
                let growth = (other.radius - one.radius) / length;
                let to = point - one.centre;
                let foot = to.dot(&along);
                let off = (to - along * foot).norm();
                // |q − foot| / |q − p| is the growth, where q is nearest.
                let lean = growth / (1.0 - growth * growth).max(1e-12).sqrt();
                let at = (foot + off * lean).clamp(0.0, length);
                from(point, one.centre + along * at, one.radius + growth * at)
            }
            Self::Plate(plate) => plate.outside(point),
        }
    }
}

impl Plate {
    /// None where the three are in line, or one touches no common plane with the others.
    fn of(a: Ball, b: Ball, c: Ball) -> Option<Self> {
        let sides = [b.centre - a.centre, c.centre - a.centre];
        let [u, v] = sides;
        let normal = u.cross(&v);
        let area = normal.norm();
        if area < 1e-6 * (u.norm_squared() + v.norm_squared()) {
            return None;
        }
        let normal = normal / area;
        let across = [v.cross(&normal) / area, normal.cross(&u) / area];
        let growth = across[0] * (b.radius - a.radius) + across[1] * (c.radius - a.radius);
        (growth.norm_squared() < 0.999).then_some(Self {
            first: a,
            sides,
            normal,
            across,
            growth,
        })
    }

    /// As of a point above the plane; infinitely far beyond the corners, where cones take over.
    fn outside(&self, point: &Vec3) -> Outside {
        let to = point - self.first.centre;
        let height = to.dot(&self.normal);
        let square = self.growth.norm_squared();
        let lean = height.abs() / (1.0 - square).sqrt();
        let at = to - self.normal * height + self.growth * lean;
        let shares = Vec2::new(at.dot(&self.across[0]), at.dot(&self.across[1]));
        if shares.min() < 0.0 || shares.sum() > 1.0 {
            return Outside {
                distance: f64::INFINITY,
                slope: self.normal,
            };
        }
        let nearest = self.first.centre + self.sides[0] * shares.x + self.sides[1] * shares.y;
        let radius = self.first.radius + self.growth.dot(&at);
        from(point, nearest, radius)
    }
}

/// How far a point is outside a ball.
fn from(point: &Vec3, centre: Vec3, radius: f64) -> Outside {
    let to = point - centre;
    let apart = to.norm();
    Outside {
        distance: apart - radius,
        slope: if apart > 1e-9 { to / apart } else { Vec3::z() },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn any_ball() -> impl Strategy<Value = Ball> {
        (-6.0..6.0, -6.0..6.0, -6.0..6.0, 0.5..3.0).prop_map(|(x, y, z, radius)| Ball {
            centre: Vec3::new(x, y, z),
            radius,
        })
    }

    /// Every ball of the hull, rolled along in small steps.
    fn rolled(point: &Vec3, balls: [Ball; 3]) -> f64 {
        const STEPS: usize = 120;
        let mut least = f64::INFINITY;
        for i in 0..=STEPS {
            for j in 0..=STEPS - i {
                let (s, t) = (i as f64 / STEPS as f64, j as f64 / STEPS as f64);
                let of = |f: fn(&Ball) -> f64| {
                    let [a, b, c] = balls.each_ref().map(f);
                    a * (1.0 - s - t) + b * s + c * t
                };
                let centre = Vec3::new(of(|b| b.centre.x), of(|b| b.centre.y), of(|b| b.centre.z));
                least = least.min((point - centre).norm() - of(|b| b.radius));
            }
        }
        least
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn a_hull_is_the_ball_rolled_between_its_ends(
            a in any_ball(), b in any_ball(), c in any_ball(),
            x in -9.0..9.0, y in -9.0..9.0, z in -9.0..9.0,
        ) {
            let point = Vec3::new(x, y, z);
            let muscles = Muscles {
                links: vec![super::super::muscles::Link { ends: [0, 1, 2], limb: Limb::Trunk }],
                ..Muscles::default()
            };
            let field = Field::of(&muscles, &[a, b, c]);
            let ours = field.outside(&point).unwrap();
            let theirs = rolled(&point, [a, b, c]);
            // The steps are coarse: theirs is a little farther, where not deep inside.
            prop_assert!(ours.distance <= theirs + 1e-9, "{} {theirs}", ours.distance);
            if theirs > 0.0 {
                prop_assert!(theirs - ours.distance < 0.05, "{} {theirs}", ours.distance);
            }
            let step = point + ours.slope * 1e-6;
            let grown = field.outside(&step).unwrap().distance - ours.distance;
            prop_assert!((grown - 1e-6).abs() < 1e-9);
        }
    }

    #[test]
    fn a_crease_is_filled_and_what_runs_alongside_is_not() {
        let at = |distance, slope: Vec3| Outside { distance, slope };
        let crease = blended(at(0.0, Vec3::x()), at(0.0, Vec3::y()));
        assert!(crease.distance < -0.1);
        let alongside = blended(at(0.0, Vec3::x()), at(0.0, Vec3::x()));
        assert_eq!(alongside.distance, 0.0);
        let facing = blended(at(0.0, Vec3::x()), at(0.0, -Vec3::x()));
        assert_eq!(facing.distance, 0.0);
        let apart = blended(at(0.0, Vec3::x()), at(3.0, Vec3::y()));
        assert_eq!(apart, at(0.0, Vec3::x()));
    }
}
