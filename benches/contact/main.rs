//! What contact costs: `cargo bench --bench contact`, all on one thread.
//!
//! The same square of 65 × 65 nodes is laid on ever more balls, which shrink as their number grows
//! so that a fifth of the nodes is always above one, and on one ball of ever more faces. Sweeps
//! begin with the flat cloth, which touches the tops alone, and setting up is in their time; all
//! else is measured with a fifth of the nodes standing on the balls. One item is the visit of one
//! node; in `mesh_made` it is one face.

mod bodies;
#[path = "../../examples/bench/square.rs"]
mod square;

use bodies::{RADIUS, balls_abreast, meshed_ball, sag};
use divan::{Bencher, counter::ItemsCount};
use soen::{
    body::{Bodies, Nature},
    contact::{Surface, Touches},
    math::Vec3,
    solver::{Problem, sweeps},
};
use square::{Crew, square};

const SIDE: u32 = 65;
const BALLS: [u32; 4] = [1, 4, 16, 64];
const FACES: [u32; 3] = [500, 5_000, 50_000];
const SWEEPS: usize = 20;

fn main() {
    divan::main();
}

#[divan::bench_group(sample_count = 5, sample_size = 1)]
mod sweep {
    use super::*;

    #[divan::bench(args = BALLS)]
    fn balls(bencher: Bencher<'_, '_>, count: u32) {
        swept(bencher, &over(balls_abreast(count)));
    }

    #[divan::bench(args = FACES)]
    fn mesh(bencher: Bencher<'_, '_>, faces: u32) {
        swept(bencher, &over(meshed_ball(faces)));
    }
}

#[divan::bench_group(sample_count = 10, sample_size = 1)]
mod look {
    use super::*;

    #[divan::bench(args = BALLS)]
    fn balls(bencher: Bencher<'_, '_>, count: u32) {
        looked(bencher, &Laid::on(balls_abreast(count)));
    }

    #[divan::bench(args = FACES)]
    fn mesh(bencher: Bencher<'_, '_>, faces: u32) {
        looked(bencher, &Laid::on(meshed_ball(faces)));
    }
}

#[divan::bench_group(sample_count = 10, sample_size = 10)]
mod sum {
    use super::*;

    #[divan::bench(args = BALLS)]
    fn energy(bencher: Bencher<'_, '_>, count: u32) {
        let laid = Laid::on(balls_abreast(count));
        let touches = laid.touches();
        alone(bencher, laid.at.len(), || {
            let energy = touches.energy(&laid.at);
            assert!(energy.is_finite() && energy > 0.0);
        });
    }

    #[divan::bench(args = BALLS)]
    fn forces(bencher: Bencher<'_, '_>, count: u32) {
        let laid = Laid::on(balls_abreast(count));
        let touches = laid.touches();
        alone(bencher, laid.at.len(), || {
            let mut forces = vec![Vec3::zeros(); laid.at.len()];
            touches.add_forces(&laid.at, &mut forces);
            let lift: f64 = forces.iter().map(|force| force.z).sum();
            assert!(lift.is_finite() && lift > 0.0);
        });
    }
}

/// The nearest surface of each node of the cloth.
#[divan::bench(args = FACES, sample_count = 10, sample_size = 1)]
fn nearest_face(bencher: Bencher<'_, '_>, faces: u32) {
    let laid = Laid::on(meshed_ball(faces));
    alone(bencher, laid.at.len(), || {
        for place in &laid.at {
            for near in laid.problem.bodies.near(place, RADIUS) {
                let gap = near.distance - (place.norm() - RADIUS);
                assert!((-1e-9..=sag(faces)).contains(&gap), "{gap}");
            }
        }
    });
}

#[divan::bench(args = FACES, sample_count = 3, sample_size = 1)]
fn mesh_made(bencher: Bencher<'_, '_>, faces: u32) {
    alone(bencher, faces as usize, || {
        let bodies = meshed_ball(faces);
        assert_eq!(bodies.parts()[0].nature(), Nature::Solid);
    });
}

/// The cloth on bodies: each node that is above one stands on it.
struct Laid {
    problem: Problem,
    at: Vec<Vec3>,
}

impl Laid {
    fn on(bodies: Bodies) -> Self {
        let problem = over(bodies);
        let mut at = sweeps(&problem, 0).unwrap();
        for place in &mut at {
            let fall = problem.bodies.fall(place);
            place.z -= fall.map_or(0.0, |fall| fall - 0.5 * problem.thickness);
        }
        Self { problem, at }
    }

    /// Nothing looked at yet.
    fn blind(&self) -> Touches {
        let piece = &self.problem.piece;
        let surface = Surface {
            friction: self.problem.friction,
            offset: 0.5 * self.problem.thickness,
            pressure: 10.0 * self.problem.fabric.weight,
            node_skin: 0.01,
            sample_skin: 0.004,
            sample_distance: 0.25,
        };
        Touches::new(&piece.cut(piece.pitch).unwrap(), surface)
    }

    fn look(&self, touches: &mut Touches) {
        let way = 0.1 * self.problem.piece.pitch;
        touches.refresh(&self.at, &self.problem.bodies, |_| [way, way]);
    }

    fn touches(&self) -> Touches {
        let mut touches = self.blind();
        self.look(&mut touches);
        touches
    }
}

fn over(bodies: Bodies) -> Problem {
    Problem {
        bodies,
        ..square(SIDE).unwrap()
    }
}

fn swept(bencher: Bencher<'_, '_>, problem: &Problem) {
    let nodes = (SIDE * SIDE) as usize;
    alone(bencher, nodes * SWEEPS, || {
        let at = sweeps(problem, SWEEPS).unwrap();
        let deepest = at.iter().map(|place| problem.bodies.depth(place));
        assert!(at.iter().all(|place| place.z.is_finite() && place.z < 26.0));
        assert!(deepest.fold(0.0, f64::max) < 0.1);
    });
}

fn looked(bencher: Bencher<'_, '_>, laid: &Laid) {
    let crew = Crew::of(1).unwrap();
    let nodes = ItemsCount::new(laid.at.len());
    let bencher = bencher.counter(nodes).with_inputs(|| laid.blind());
    bencher.bench_local_refs(|touches| {
        crew.run(|| laid.look(touches));
        assert!(!touches.list().is_empty());
    });
}

fn alone(bencher: Bencher<'_, '_>, items: usize, work: impl Fn() + Sync) {
    let crew = Crew::of(1).unwrap();
    let bencher = bencher.counter(ItemsCount::new(items));
    bencher.bench_local(|| crew.run(&work));
}
