//! One lattice on its way to rest: what the sweeps and the joint steps both work on.

use super::{Level as LevelWork, start::number, stream::Stream};
use crate::{
    body::Bodies,
    certificate::Case,
    contact::Touches,
    forces::{Momentum, Sheet},
    lattice::Lattice,
    math::Vec3,
    threads,
};

/// The state of one level.
#[derive(Debug)]
pub(super) struct Level<'a> {
    pub(super) lattice: &'a Lattice,
    pub(super) sheet: Sheet<'a>,
    pub(super) bodies: &'a Bodies,
    pub(super) touches: Touches,
    /// How nodes go on by themselves over a step of time; `None` of a cloth that comes to rest.
    pub(super) momentum: Option<Momentum>,
    /// Which nodes are held.
    pub(super) held: Vec<bool>,
    /// Free nodes by colour.
    pub(super) colours: Vec<Vec<u32>>,
    /// Positions [cm].
    pub(super) at: Vec<Vec3>,
    /// Whether a node feels only its own ten forces.
    pub(super) own_only: bool,
    /// The nodes in the order of sweeps, from the first sweep on.
    pub(super) stream: Option<Box<Stream>>,
    /// Which nodes a vice acts on.
    pub(super) vices: Vec<bool>,
    pub(super) sweeps: usize,
    pub(super) joint_steps: usize,
    /// Updates of single nodes.
    pub(super) updates: u64,
}

impl<'a> Level<'a> {
    /// A lattice with what acts on it, its nodes at positions [cm].
    pub(super) fn new(case: &Case<'a>, touches: Touches, at: Vec<Vec3>) -> Self {
        let free = |node: &u32| !case.held[*node as usize];
        let colours = case.lattice.colours().into_iter();
        Self {
            lattice: case.lattice,
            sheet: Sheet::new(case.lattice, case.fabric, case.laws, case.clamps),
            bodies: case.bodies,
            touches,
            momentum: None,
            held: case.held.to_vec(),
            colours: colours
                .map(|nodes| nodes.into_iter().filter(free).collect())
                .collect(),
            at,
            own_only: case.own_only,
            stream: None,
            vices: vices(case),
            sweeps: 0,
            joint_steps: 0,
            updates: 0,
        }
    }

    /// The work done on it.
    pub(super) fn work(&self) -> LevelWork {
        LevelWork {
            spacing: self.lattice.pitch,
            nodes: self.at.len(),
            sweeps: self.sweeps,
            joint_steps: self.joint_steps,
            updates: self.updates,
        }
    }

    /// Energy of cloth, weight, touches and momentum [gf·cm].
    pub(super) fn energy(&self, at: &[Vec3]) -> f64 {
        let still = self.sheet.energy(at) + self.touches.energy(at);
        match &self.momentum {
            Some(momentum) => still + momentum.energy(at),
            None => still,
        }
    }

    /// Forces of cloth, weight, touches and momentum; none on held nodes [gf].
    pub(super) fn forces(&self, at: &[Vec3]) -> Vec<Vec3> {
        let mut forces = self.sheet.forces(at);
        self.touches.add_forces(at, &mut forces);
        self.add_momentum(at, &mut forces);
        for (force, held) in forces.iter_mut().zip(&self.held) {
            if *held {
                *force = Vec3::zeros();
            }
        }
        forces
    }

    /// Adds what inertia and air do to the nodes [gf].
    pub(super) fn add_momentum(&self, at: &[Vec3], forces: &mut [Vec3]) {
        if let Some(momentum) = &self.momentum {
            for (node, (force, here)) in forces.iter_mut().zip(at).enumerate() {
                *force += momentum.force(node, here);
            }
        }
    }

    /// Forces that have a part in every move of the whole: those of no law, by the nodes' numbers
    /// [gf].
    pub(super) fn any_forces(&self) -> Vec<Vec3> {
        let any = |node: usize, axis: usize| number((3 * node + axis) as u64);
        let weights = self.sheet.measures();
        (0..self.at.len())
            .map(|node| {
                if self.held[node] {
                    Vec3::zeros()
                } else {
                    Vec3::from_fn(|axis, _| any(node, axis)) * weights[node]
                }
            })
            .collect()
    }

    /// Looks again where bodies are near and how hard they press; moves up to `way` [cm] follow.
    pub(super) fn look(&mut self, way: f64, sample_way: f64) {
        self.look_about(|_| [way, sample_way]);
    }

    /// The same where each node goes such ways [cm] of its own, and the samples beside it.
    pub(super) fn look_about(&mut self, ways: impl Fn(usize) -> [f64; 2] + Sync + Send) {
        self.touches.refresh(&self.at, self.bodies, ways);
        self.touches.look_at_loads(&self.at);
    }

    /// Every node moved by `way` of it, brought back where it pressed into a body, and as far as
    /// bodies leave free.
    pub(super) fn freely(&self, way: impl Fn(usize) -> Vec3 + Sync + Send) -> Vec<Vec3> {
        let moved = |node: usize| {
            if self.held[node] {
                self.at[node]
            } else {
                self.at[node] + way(node)
            }
        };
        let mut to = threads::map(self.at.len(), moved);
        let free = |node: usize| !self.held[node];
        self.touches.bring_back(&self.at, &mut to, free);
        threads::map(to.len(), |node| self.free_way(node, to[node]))
    }

    /// Where a node may go instead of `to`: no farther than the first surface in its way.
    pub(super) fn free_way(&self, node: usize, to: Vec3) -> Vec3 {
        let from = &self.at[node];
        if self.touches.is_clear(node, from, &to) {
            to
        } else {
            stopped(self.bodies, from, to)
        }
    }
}

fn vices(case: &Case<'_>) -> Vec<bool> {
    let mut vices = vec![false; case.held.len()];
    for clamp in case.clamps {
        vices[clamp.nodes[1] as usize] = true;
    }
    vices
}

/// Where a straight move ends: before the first surface in its way.
pub(super) fn stopped(bodies: &Bodies, from: &Vec3, to: Vec3) -> Vec3 {
    let free = bodies.free_way(from, &to);
    if free < 1.0 {
        from + (to - from) * (0.9 * free)
    } else {
        to
    }
}
