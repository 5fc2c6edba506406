//! How near the cloth comes to the bodies.

use crate::{body::Bodies, math::Vec3};

/// Distances searched in turn [cm]: most drapes touch, and a near surface is found fast.
const REACHES: [f64; 4] = [0.1, 1.0, 30.0, 1000.0];

/// The least distance of a node to a body [cm], negative inside a solid; `None` where no body is
/// within 1000 cm.
#[must_use]
pub fn least_clearance(bodies: &Bodies, positions: &[Vec3]) -> Option<f64> {
    let nearest = |reach: f64| {
        let near = positions.iter().flat_map(|at| bodies.near(at, reach));
        near.map(|near| near.distance).reduce(f64::min)
    };
    REACHES.into_iter().find_map(nearest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        body::{Part, Shape},
        math::Pose,
    };

    #[test]
    fn it_is_the_distance_to_the_nearest_ball() {
        let ball = |x| {
            let shape = Shape::Ball { radius: 2.0 };
            Part::new("ball".into(), &shape, Pose::translation(x, 0.0, 0.0)).unwrap()
        };
        let bodies = Bodies::new(vec![ball(0.0), ball(100.0)]);
        let of = |xs: &[f64]| {
            let at: Vec<Vec3> = xs.iter().map(|x| Vec3::new(*x, 0.0, 0.0)).collect();
            least_clearance(&bodies, &at)
        };
        for (places, expected) in [
            (&[50.0, 2.5, 60.0][..], 0.5),
            (&[50.0, 110.0], 8.0),
            (&[1.5, 2.01], -0.5),
            (&[250.0], 148.0),
        ] {
            let clearance = of(places).unwrap();
            assert!((clearance - expected).abs() < 1e-9, "{clearance}");
        }
        assert_eq!(of(&[2000.0]), None);
        assert_eq!(of(&[]), None);
        assert_eq!(least_clearance(&Bodies::default(), &[Vec3::zeros()]), None);
    }
}
