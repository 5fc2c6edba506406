//! What leads the conjugate gradients of a joint step: the answer of a positive matrix, exact by its
//! factors, nearly so by factors in 32 bits, near by multigrid.

use super::{
    dissection::{Neighbours, dissect},
    factor::{Factor, Plan},
    level::Level,
    multigrid::{Levels, Multigrid},
    stiffness::{Pattern, Stiffness},
};
use crate::math::Vec3;
use std::sync::Arc;

/// A lattice of more nodes than this is answered by multigrid: factors take n^1.5 operations.
const FACTORED: usize = 1500;

/// How a lattice is answered: found once.
#[derive(Debug)]
pub(super) enum Way {
    /// By factors.
    Factors(Arc<Plan>),
    /// By multigrid.
    Levels(Arc<Levels>),
}

impl Way {
    /// For a level, and which blocks its matrix has.
    pub(super) fn of(level: &Level<'_>) -> (Self, Arc<Pattern>) {
        let nodes = level.at.len();
        let mut pairs = level.sheet.joined();
        for cell in &level.lattice.cells {
            for (k, a) in cell.iter().enumerate() {
                pairs.extend(cell[k + 1..].iter().map(|b| [*a.min(b), *a.max(b)]));
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        let neighbours = Neighbours::new(nodes, &pairs);
        let pattern = Arc::new(Pattern::new(&neighbours, &level.held));
        let way = if nodes > FACTORED {
            Self::Levels(Levels::new(&level.lattice.grid, &pattern).into())
        } else {
            Self::Factors(plan_of(level, &pattern).into())
        };
        (way, pattern)
    }
}

/// How a level's matrix is factored.
pub(super) fn plan_of(level: &Level<'_>, pattern: &Pattern) -> Plan {
    let nodes = pattern.len();
    let free = |node: &u32| !level.held[*node as usize];
    let neighbours = Neighbours::new(nodes, &pattern.pairs());
    let free = (0..nodes as u32).filter(free).collect();
    let parts = dissect(free, &level.lattice.coordinates, &neighbours);
    Plan::new(parts, &neighbours, nodes)
}

/// A positive matrix, ready to answer.
#[derive(Debug)]
pub(super) enum Leader {
    /// By its factors.
    Factors(Arc<Plan>, Factor<f64>),
    /// By its factors in 32 bits: in half the memory.
    Rounded(Arc<Plan>, Factor<f32>),
    /// By multigrid.
    Levels(Arc<Levels>, Multigrid),
}

impl Leader {
    /// Of a matrix; `None` where it is not positive definite.
    pub(super) fn new(way: &Way, matrix: &Stiffness) -> Option<Self> {
        Some(match way {
            Way::Factors(plan) => Self::by_factors(plan, matrix)?,
            Way::Levels(levels) => {
                Self::Levels(Arc::clone(levels), Multigrid::new(levels, matrix)?)
            }
        })
    }

    /// The same for what sweeps would take long to find of an answer: by multigrid, its smooth part.
    pub(super) fn smooth(way: &Way, matrix: &Stiffness) -> Option<Self> {
        Some(match way {
            Way::Factors(plan) => Self::by_factors(plan, matrix)?,
            Way::Levels(levels) => {
                Self::Levels(Arc::clone(levels), Multigrid::smooth(levels, matrix)?)
            }
        })
    }

    /// Of a matrix by its factors; `None` where it is not positive definite.
    pub(super) fn by_factors(plan: &Arc<Plan>, matrix: &Stiffness) -> Option<Self> {
        Some(Self::Factors(Arc::clone(plan), Factor::new(plan, matrix)?))
    }

    /// Of a matrix by its factors in 32 bits; `None` where it is not positive definite when rounded.
    pub(super) fn rounded(plan: &Arc<Plan>, matrix: &Stiffness) -> Option<Self> {
        Some(Self::Rounded(Arc::clone(plan), Factor::new(plan, matrix)?))
    }

    /// The same, or in 64 bits where rounding makes it indefinite; `None` where it is not positive
    /// definite.
    pub(super) fn by_rounded_factors(plan: &Arc<Plan>, matrix: &Stiffness) -> Option<Self> {
        Self::rounded(plan, matrix).or_else(|| Self::by_factors(plan, matrix))
    }

    /// The moves [cm] that answer forces [gf], or nearly so; held nodes stay.
    pub(super) fn answer(&self, forces: &[Vec3]) -> Vec<Vec3> {
        match self {
            Self::Factors(plan, factor) => factor.solve(plan, forces),
            Self::Rounded(plan, factor) => factor.solve(plan, forces),
            Self::Levels(levels, multigrid) => multigrid.answer(levels, forces),
        }
    }
}
