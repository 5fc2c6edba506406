//! What holds a cloth, and how it is laid out before it is let go.

use crate::specimen::hang_at;
use soen::{
    math::{Vec2, Vec3},
    solver::Placement,
};

/// Forces on a cloth at rest sum to nothing: hands bear what it weighs, and nothing sideways.
#[test]
fn hands_bear_the_weight_of_the_cloth_that_they_hold() {
    let rest = hang_at(
        "[cloth]\nfabric = \"d\"\nsize_cm = [20, 30]\nspacing_cm = 2\n\
         [[hold]]\npoint_cm = [-10, 15]\n[[hold]]\npoint_cm = [10, 15]\nmove_cm = [-3, 0, 0]\n",
        1e-6,
        1000,
    );
    assert!(rest.converged, "{:?}", rest.certificate);
    let sum: Vec3 = rest.holding.iter().sum();
    let weight = 20.0 * 30.0 * 0.023;
    assert!((sum.z - weight).abs() < 1e-4 * weight, "{sum:?}");
    assert!(sum.x.hypot(sum.y) < 1e-4 * weight, "{sum:?}");
    let hands = rest.holding.iter().filter(|force| force.norm() > 0.0);
    assert_eq!(hands.count(), 2);
}

/// A cloth that is rolled up is as long as it was, and leaves every point along its tangent.
#[test]
fn rolling_a_cloth_up_stretches_nothing() {
    let rolled = Placement {
        centre: Vec3::new(1.0, 2.0, 3.0),
        x_axis: Vec3::y(),
        y_axis: Vec3::z(),
        curl: 0.3,
    };
    let step = 1e-6;
    for x in [-20.0, -3.0, 0.0, 0.1, 15.0] {
        for across in [Vec2::x(), Vec2::y(), Vec2::new(0.6, 0.8)] {
            let from = Vec2::new(x, 4.0);
            let way = (rolled.at(from + across * step) - rolled.at(from)) / step;
            assert!(
                (way - rolled.along(across, from)).norm() < 1e-6,
                "{x} {across:?}"
            );
            assert!((rolled.along(across, from).norm() - 1.0).abs() < 1e-12);
        }
    }
    assert_eq!(rolled.at(Vec2::zeros()), rolled.centre);
    // Once around: 2π of curvature times length.
    let around = Vec2::new(core::f64::consts::TAU / 0.3, 0.0);
    assert!((rolled.at(around) - rolled.centre).norm() < 1e-12);
}
