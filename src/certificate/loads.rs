//! What each node bears, element by element from the positions alone, by statics instead of by
//! derivatives: tensions along rods, couples that rods carry as pairs of forces.

use super::{Equilibrium, Passage};
use crate::{
    fabric::Fabric,
    forces::{Clamp, GRAVITY, Laws},
    lattice::Lattice,
    math::Vec3,
};

/// The forces of cloth and weight on a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Load {
    /// Their sum [gf].
    pub(super) net: Vec3,
    /// The sum of their magnitudes, weight included [gf].
    pub(super) sum: f64,
}

/// Everything that acts, one after the other.
pub(super) struct Loads<'a> {
    pub(super) lattice: &'a Lattice,
    pub(super) fabric: &'a Fabric,
    pub(super) laws: Laws,
    pub(super) clamps: &'a [Clamp],
    /// Figures 7–9: bends and corners act on their own node only, twist on none.
    pub(super) own_only: bool,
    /// The last step of a cloth in motion.
    pub(super) passage: Option<Passage<'a>>,
}

impl Loads<'_> {
    /// The load on every node.
    pub(super) fn at(&self, at: &[Vec3]) -> Vec<Load> {
        let mut loads: Vec<Load> = self
            .lattice
            .area
            .iter()
            .map(|area| area * self.fabric.weight)
            .map(|weight| Load {
                net: Vec3::new(0.0, 0.0, -weight),
                sum: weight,
            })
            .collect();
        if self.laws.tension {
            self.add_tensions(at, &mut loads);
        }
        if self.laws.bending {
            self.add_bends(at, &mut loads);
            self.add_clamps(at, &mut loads);
            self.add_twists(at, &mut loads);
        }
        if self.laws.shear {
            self.add_corners(at, &mut loads);
        }
        if let Some(passage) = &self.passage {
            self.add_inertia(passage, at, &mut loads);
        }
        loads
    }

    /// Mass of a node [gf·s²/cm].
    fn mass(&self, node: usize) -> f64 {
        self.lattice.area[node] * self.fabric.weight / GRAVITY
    }

    /// D'Alembert's load, mass times acceleration backwards, and the resistance of the air.
    fn add_inertia(&self, passage: &Passage<'_>, at: &[Vec3], loads: &mut [Load]) {
        for (node, load) in loads.iter_mut().enumerate() {
            let velocity = passage.velocity(node, at);
            let gain = velocity - passage.velocities[node];
            load.add(gain * (-self.mass(node) / passage.step));
            load.add(velocity * (-self.mass(node) * passage.damping));
        }
    }

    /// Which equilibrium the loads are of.
    pub(super) fn equilibrium(&self, at: &[Vec3]) -> Equilibrium {
        let Some(passage) = &self.passage else {
            return Equilibrium::Static;
        };
        let (mut fastest, mut twice) = (0.0_f64, 0.0);
        for node in 0..at.len() {
            let square = passage.velocity(node, at).norm_squared();
            fastest = fastest.max(square.sqrt());
            twice += self.mass(node) * square;
        }
        Equilibrium::Dynamic {
            fastest,
            kinetic_energy: 0.5 * twice,
        }
    }

    /// (5).
    fn add_tensions(&self, at: &[Vec3], loads: &mut [Load]) {
        for rod in &self.lattice.rods {
            let direction = self.fabric.along(rod.yarn);
            let [a, b] = rod.nodes.map(|node| node as usize);
            let along = at[b] - at[a];
            let length = along.norm();
            let pi = core::f64::consts::PI;
            let euler = pi * pi * direction.bending / (rod.rest * rod.rest);
            let tension = direction.tension.tension(length / rod.rest - 1.0, euler);
            let pull = along * (rod.width * tension / length.max(1e-12));
            loads[a].add(pull);
            loads[b].add(-pull);
        }
    }

    /// (6): a joint of three nodes carries the couple M_BN·w·θ/b.
    fn add_bends(&self, at: &[Vec3], loads: &mut [Load]) {
        for bend in &self.lattice.bends {
            let [a, b, c] = bend.nodes.map(|node| node as usize);
            let stiffness = self.fabric.along(bend.yarn).bending * bend.width / bend.length;
            let (first, second) = couple(
                &(at[b] - at[a]),
                &(at[c] - at[b]),
                stiffness,
                bend.rest_angle,
            );
            if !self.own_only {
                loads[a].add(-first);
                loads[c].add(second);
            }
            loads[b].add(first - second);
        }
    }

    /// A vice bends the rod beside it over half a cell.
    fn add_clamps(&self, at: &[Vec3], loads: &mut [Load]) {
        for clamp in self.clamps {
            let [held, next] = clamp.nodes.map(|node| node as usize);
            let stiffness =
                2.0 * self.fabric.along(clamp.yarn).bending * clamp.width / clamp.length;
            let (_, second) = couple(&clamp.slope, &(at[next] - at[held]), stiffness, 0.0);
            loads[next].add(second);
            loads[held].add(-second);
        }
    }

    /// The nodes of a twisted cell enclose a volume V, six times which is the gap h between the
    /// diagonals times the area that they span. Each node feels that volume by the face opposite to
    /// it, and the span, an area in their common plane, by the other diagonal.
    fn add_twists(&self, at: &[Vec3], loads: &mut [Load]) {
        if self.own_only || self.fabric.twist == 0.0 {
            return;
        }
        for twist in &self.lattice.twists {
            let stiffness = self.fabric.twist * twist.area * twist.per_gap * twist.per_gap;
            let nodes = twist.nodes.map(|node| node as usize);
            let [b, c, d] = [1, 2, 3].map(|k| at[nodes[k]] - at[nodes[0]]);
            let faces = [c.cross(&d), d.cross(&b), b.cross(&c)];
            let (first, second) = (c, d - b);
            let normal = first.cross(&second);
            let span = normal.norm();
            if span <= 1e-9 {
                continue;
            }
            let gap = b.dot(&faces[0]) / span;
            let by_first = second.cross(&normal) * (gap / span);
            let by_second = normal.cross(&first) * (gap / span);
            let slopes = [
                by_first - faces[0] - faces[1] - faces[2],
                faces[0] + by_second,
                faces[1] - by_first,
                faces[2] - by_second,
            ];
            for (node, slope) in nodes.into_iter().zip(slopes) {
                loads[node].add(slope * (-stiffness * gap / span));
            }
        }
    }

    /// (7): a corner carries the couple M_SH·area·(φ₀ − φ).
    fn add_corners(&self, at: &[Vec3], loads: &mut [Load]) {
        let shear = 0.5 * (self.fabric.warp.shear + self.fabric.weft.shear);
        for corner in &self.lattice.corners {
            let [node, a, b] = corner.nodes.map(|node| node as usize);
            let stiffness = shear * corner.area;
            let (first, second) = couple(
                &(at[a] - at[node]),
                &(at[b] - at[node]),
                stiffness,
                corner.rest_angle,
            );
            if !self.own_only {
                loads[a].add(first);
                loads[b].add(second);
            }
            loads[node].add(-first - second);
        }
    }
}

impl Passage<'_> {
    /// A node's mean velocity over the step [cm/s].
    fn velocity(&self, node: usize, at: &[Vec3]) -> Vec3 {
        (at[node] - self.from[node]) / self.step
    }
}

impl Load {
    fn add(&mut self, force: Vec3) {
        self.net += force;
        self.sum += force.norm();
    }
}

/// The forces on the ends of two rods u and v that a couple k·(θ − θ₀) between them turns towards
/// each other: at a right angle to each rod, in their plane, couple over length.
fn couple(u: &Vec3, v: &Vec3, stiffness: f64, rest: f64) -> (Vec3, Vec3) {
    let (length_u, length_v) = (u.norm(), v.norm());
    let normal = u.cross(v);
    let size = normal.norm();
    if size <= 1e-15 * length_u * length_v {
        return (Vec3::zeros(), Vec3::zeros());
    }
    let axis = normal / size;
    let excess = libm::atan2(size, u.dot(v)) - rest;
    let couple = stiffness * excess;
    (
        axis.cross(u) * (couple / (length_u * length_u)),
        -axis.cross(v) * (couple / (length_v * length_v)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        fabric::{Curve, Tension},
        forces::Sheet,
        lattice::{Outline, sample::cut},
        scene::fabric,
    };
    use proptest::prelude::*;

    /// All laws together, and each alone.
    const LAWS: [[bool; 3]; 4] = [
        [true, true, true],
        [true, false, false],
        [false, true, false],
        [false, false, true],
    ];

    fn lattices() -> [Lattice; 3] {
        let towel = || Outline::rectangle(5.0, 3.0).unwrap();
        [
            cut(towel(), 0.0, 1.0),
            cut(towel(), 35.0, 0.7),
            cut(Outline::disc(2.6).unwrap(), 17.0, 0.8),
        ]
    }

    /// Power laws, a straight one with other numbers along the weft, a measured curve, and twist.
    fn fabrics() -> Vec<Fabric> {
        let mut curved = fabric("d").unwrap();
        let curve = Curve::new(&[[0.0, 0.0], [0.01, 2.1], [0.05, 60.0]]).unwrap();
        curved.warp.tension = Tension::Points(curve);
        curved.weft.tension = Tension::Linear { modulus: 370.0 };
        let mut twisting = fabric("c").unwrap();
        twisting.twist = 0.07;
        vec![fabric("a").unwrap(), fabric("c").unwrap(), curved, twisting]
    }

    /// Vices on some rods of either yarn, sloping away from where the cloth leaves them.
    fn clamps(lattice: &Lattice) -> Vec<Clamp> {
        let every_seventh = lattice.rods.iter().step_by(7);
        every_seventh
            .map(|rod| Clamp {
                nodes: rod.nodes,
                slope: Vec3::new(0.48, 0.64, 0.6),
                yarn: rod.yarn,
                length: rod.rest,
                width: rod.width,
            })
            .collect()
    }

    /// Nodes stand up to a part of a pitch away from flat.
    fn crumpled(lattice: &Lattice, away: &[[f64; 3]]) -> Vec<Vec3> {
        let nodes = lattice.coordinates.iter().zip(away.iter().cycle());
        nodes
            .map(|(at, away)| Vec3::new(at.x, at.y, 0.0) + Vec3::from(*away) * lattice.pitch)
            .collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn statics_and_the_slope_of_the_energy_agree(
            away in prop::collection::vec(prop::array::uniform3(-0.3..0.3f64), 97),
            fabric in prop::sample::select(fabrics()),
        ) {
            for lattice in lattices() {
                let (at, clamps) = (crumpled(&lattice, &away), clamps(&lattice));
                for [tension, bending, shear] in LAWS {
                    let laws = Laws { tension, bending, shear };
                    let sheet = Sheet::new(&lattice, &fabric, laws, &clamps);
                    let loads = |own_only| Loads {
                        lattice: &lattice, fabric: &fabric, laws, clamps: &clamps, own_only, passage: None,
                    }.at(&at);
                    for (load, force) in loads(false).iter().zip(sheet.forces(&at)) {
                        agree(load, &force)?;
                    }
                    // Node by node a sheet leaves out what a vice's own node feels: it is held.
                    let free = |node: &usize| clamps.iter().all(|clamp| clamp.nodes[0] as usize != *node);
                    let own = loads(true);
                    for node in (0..at.len()).filter(free) {
                        agree(&own[node], &sheet.force(node, &at, true))?;
                    }
                }
            }
        }
    }

    /// The same force, and no more of it than the magnitudes come to.
    fn agree(load: &Load, force: &Vec3) -> Result<(), TestCaseError> {
        let error = (load.net - force).norm();
        prop_assert!(error <= 1e-10 * load.sum, "{error} of {}", load.sum);
        prop_assert!(load.net.norm() <= load.sum * (1.0 + 1e-12));
        Ok(())
    }

    /// Newton's second law by hand: 0.1 cm in 0.01 s is 10 cm/s, 4 more than before are 400 cm/s².
    #[test]
    fn inertia_is_a_load_against_the_gain_of_speed_and_air_one_against_speed() {
        let lattice = cut(Outline::rectangle(2.0, 2.0).unwrap(), 0.0, 1.0);
        let cloth = fabric("c").unwrap();
        let nodes = lattice.coordinates.len();
        let (from, to) = (vec![Vec3::zeros(); nodes], vec![Vec3::x() * 0.1; nodes]);
        let velocities = vec![Vec3::x() * 6.0; nodes];
        let none = Laws {
            tension: false,
            bending: false,
            shear: false,
        };
        let loads = Loads {
            lattice: &lattice,
            fabric: &cloth,
            laws: none,
            clamps: &[],
            own_only: false,
            passage: Some(Passage {
                from: &from,
                velocities: &velocities,
                step: 0.01,
                damping: 3.0,
            }),
        };
        for (load, area) in loads.at(&to).iter().zip(&lattice.area) {
            let weight = area * cloth.weight;
            let [inertia, air] = [400.0, 30.0].map(|pull| weight * pull / 980.665);
            let net = Vec3::new(-inertia - air, 0.0, -weight);
            assert!((load.net - net).norm() < 1e-13, "{load:?}");
            assert!((load.sum - weight - inertia - air).abs() < 1e-13);
        }
        let Equilibrium::Dynamic {
            fastest,
            kinetic_energy,
        } = loads.equilibrium(&to)
        else {
            panic!("it moves");
        };
        let mass = 4.0 * cloth.weight / 980.665;
        assert!((fastest - 10.0).abs() < 1e-12);
        assert!((kinetic_energy - 0.5 * mass * 100.0).abs() < 1e-12);
    }

    #[test]
    fn magnitudes_are_summed_and_do_not_cancel() {
        let lattice = cut(Outline::rectangle(3.0, 1.0).unwrap(), 0.0, 1.0);
        let mut cloth = fabric("c").unwrap();
        cloth.warp.tension = Tension::Linear { modulus: 100.0 };
        cloth.weft.tension = Tension::Linear { modulus: 100.0 };
        let at: Vec<Vec3> = lattice
            .coordinates
            .iter()
            .map(|at| Vec3::new(1.1 * at.x, at.y, 0.0))
            .collect();
        let loads = Loads {
            lattice: &lattice,
            fabric: &cloth,
            laws: Laws {
                tension: true,
                bending: false,
                shear: false,
            },
            clamps: &[],
            own_only: false,
            passage: None,
        }
        .at(&at);
        for (load, place) in loads.iter().zip(&lattice.coordinates) {
            // Half a cell's width beside each yarn: 0.1 × 100 gf/cm × 0.5 cm a rod.
            let inner = place.x.abs() < 1.0;
            let weight = cloth.weight * if inner { 0.5 } else { 0.25 };
            let pulls = if inner { 10.0 } else { 5.0 };
            assert!((load.sum - weight - pulls).abs() < 1e-12, "{load:?}");
            let net = if inner {
                weight
            } else {
                (25.0 + weight * weight).sqrt()
            };
            assert!((load.net.norm() - net).abs() < 1e-12, "{load:?}");
        }
    }
}
