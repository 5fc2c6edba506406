//! What is found on the built body where the tailor's other measurements are taken, and how well the
//! balls fill the trunk.

use super::{
    field::Field,
    figure::Robot,
    measurements::Girth,
    muscles::{Ball, Flesh},
};
use crate::{body::MeshError, skeleton::Posture};

/// A vertex of the skin is on one limb alone when it is so near to it [cm].
const ON: f64 = 1e-4;
/// Pieces of flesh farther than this from a vertex [cm] cannot hold it.
const NEAR: f64 = 1.0;

impl Robot {
    /// From the soles to the top of the standing body [cm]: to that of the neck, if it has no head.
    #[must_use]
    pub fn stature(&self) -> f64 {
        let balls = self.standing();
        let sole = balls.iter().map(|ball| ball.centre.z - ball.radius);
        top(&balls) - sole.fold(f64::INFINITY, f64::min)
    }

    /// From where the legs part to the top of the standing body [cm].
    #[must_use]
    pub fn sitting_height(&self) -> f64 {
        let balls = self.standing();
        let seat = self.of(&balls, &[Flesh::Trunk]).filter_map(|ball| {
            let square = ball.radius * ball.radius - ball.centre.x * ball.centre.x;
            (square > 0.0).then(|| ball.centre.z - square.sqrt())
        });
        top(&balls) - seat.fold(f64::INFINITY, f64::min)
    }

    /// Breadth at the level of the shoulders' tips [cm].
    #[must_use]
    pub fn shoulder_width(&self) -> f64 {
        self.breadth(&[Flesh::Shoulder, Flesh::UpperArm], self.levels.acromion)
    }

    /// Breadth at the level where the tape goes round the hips [cm].
    #[must_use]
    pub fn hip_width(&self) -> f64 {
        self.breadth(&[Flesh::Trunk, Flesh::Thigh], self.height(Girth::Hip))
    }

    /// How deep the standing trunk's balls are, at most, below the skin that is smooth between
    /// them [cm].
    ///
    /// # Errors
    /// [`MeshError`] as of [`skin`](Self::skin).
    pub fn trunk_dent(&self) -> Result<f64, MeshError> {
        let balls = self.standing();
        let field = Field::of(&self.muscles, &balls);
        let skin = self.skin(&Posture::standing(self.skeleton()), &[])?;
        let trunk = self.muscles.group(Flesh::Trunk, None);
        let mut deepest = 0.0_f64;
        for vertex in &skin.vertices {
            let out = |ball: &Ball| (vertex - ball.centre).norm() - ball.radius;
            let nearest = balls.iter().map(out).enumerate();
            let nearest = nearest.min_by(|a, b| a.1.total_cmp(&b.1));
            let Some((muscle, dent)) = nearest else {
                continue;
            };
            // Where limbs blend the skin is farther out than any.
            let bare = || field.near(vertex, NEAR).bare(vertex).abs() <= ON;
            if dent > deepest && trunk.contains(&muscle) && bare() {
                deepest = dent;
            }
        }
        Ok(deepest)
    }

    /// Twice how far flesh of some kinds reaches to the left at a height [cm].
    fn breadth(&self, kinds: &[Flesh], height: f64) -> f64 {
        let balls = self.standing();
        let reach = self.of(&balls, kinds).filter_map(|ball| {
            let square = ball.radius * ball.radius - (ball.centre.z - height).powi(2);
            (square > 0.0).then(|| ball.centre.x + square.sqrt())
        });
        2.0 * reach.fold(0.0, f64::max)
    }

    fn of<'b>(&self, balls: &'b [Ball], kinds: &[Flesh]) -> impl Iterator<Item = &'b Ball> {
        let muscles: Vec<usize> = self.muscles.groups(kinds).collect();
        muscles.into_iter().filter_map(|muscle| balls.get(muscle))
    }
}

fn top(balls: &[Ball]) -> f64 {
    let tops = balls.iter().map(|ball| ball.centre.z + ball.radius);
    tops.fold(0.0, f64::max)
}
