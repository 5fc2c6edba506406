//! The square held at two corners.

use crate::square::{Tried, square};
use soen::{
    math::{Vec2, Vec3},
    solver::{Grip, Hold, Problem},
};

pub(crate) fn hang(nodes: u32) -> Tried<Problem> {
    let corner = |x| Hold {
        grip: Grip::Point(Vec2::new(x, 50.0)),
        clamp: false,
        carry: Vec3::zeros(),
    };
    Ok(Problem {
        holds: vec![corner(-50.0), corner(50.0)],
        ..square(nodes)?
    })
}
