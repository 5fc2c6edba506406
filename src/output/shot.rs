//! A frame as it is kept: what the next one goes on from, to the last bit, and its proof.
//!
//! The file (`soen frame 2`): 16 bytes of name, then 8-byte words, little-endian: the digest of what
//! it is a frame of, the counts of nodes and of numbers, the proof, positions [cm], velocities [cm/s],
//! numbers, and a digest of all words before.

use crate::{certificate::Equilibrium, contact::Footing, math::Vec3, solver::Settled};

/// A frame that was made.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// Positions [cm], one per node.
    pub positions: Vec<Vec3>,
    /// Velocities [cm/s], one per node.
    pub velocities: Vec<Vec3>,
    /// Where friction holds on ([`Footing::numbers`]).
    pub footing: Vec<f64>,
    /// Whether all of its certificate holds.
    pub converged: bool,
    /// Which equilibrium it is of.
    pub equilibrium: Equilibrium,
    /// Greatest residual [-].
    pub residual_max: f64,
    /// Estimate of the farthest node's way to rest [cm].
    pub remaining_move: f64,
    /// Deepest point of the cloth in a body [cm].
    pub deepest: f64,
    /// Lowest and highest point [cm].
    pub heights: [f64; 2],
}

const NAME: &[u8; 16] = b"soen frame 2\n\0\0\0";
/// Words before the positions: digest, two counts, nine of the proof.
const HEAD: usize = 12;

impl Shot {
    /// Of a drape.
    #[must_use]
    pub fn of(settled: &Settled) -> Self {
        let (positions, footing) = settled.state();
        Self {
            positions: positions.to_vec(),
            velocities: settled.velocities.clone(),
            footing: Footing::numbers(footing),
            converged: settled.converged,
            equilibrium: settled.certificate.equilibrium,
            residual_max: settled.certificate.residual_max,
            remaining_move: settled.certificate.remaining_move,
            deepest: settled.certificate.deepest,
            heights: [settled.shape.lowest, settled.shape.highest],
        }
    }

    /// The file, for a frame of what has this digest.
    #[must_use]
    pub fn to_bytes(&self, of: u64) -> Vec<u8> {
        let [kind, fastest, kinetic_energy] = match self.equilibrium {
            Equilibrium::Static => [0.0; 3],
            Equilibrium::Dynamic {
                fastest,
                kinetic_energy,
            } => [1.0, fastest, kinetic_energy],
        };
        let counts = [self.positions.len() as u64, self.footing.len() as u64];
        let proof = [
            f64::from(u8::from(self.converged)),
            self.residual_max,
            self.remaining_move,
            self.deepest,
            self.heights[0],
            self.heights[1],
            kind,
            fastest,
            kinetic_energy,
        ];
        let vectors = self.positions.iter().chain(&self.velocities).flatten();
        let numbers = proof.iter().chain(vectors);
        let numbers = numbers.chain(&self.footing).map(|number| number.to_bits());
        let words = [of].into_iter().chain(counts).chain(numbers);
        let mut bytes = NAME.to_vec();
        bytes.extend(words.flat_map(u64::to_le_bytes));
        let check = digest(&bytes);
        bytes.extend(check.to_le_bytes());
        bytes
    }

    /// Reads such a file; `None` where it is not whole, or is of something else.
    #[must_use]
    pub fn from_bytes(bytes: &[u8], of: u64) -> Option<Self> {
        let (content, check) = bytes.split_at_checked(bytes.len().checked_sub(8)?)?;
        if check != digest(content).to_le_bytes() {
            return None;
        }
        let words = content.strip_prefix(NAME)?.chunks_exact(8);
        let words: Option<Vec<u64>> = words
            .map(|word| Some(u64::from_le_bytes(word.try_into().ok()?)))
            .collect();
        let words = words?;
        let (head, body) = words.split_at_checked(HEAD)?;
        let nodes = usize::try_from(head[1]).ok()?.checked_mul(3)?;
        let numbers = usize::try_from(head[2]).ok()?;
        if head[0] != of || body.len() != nodes.checked_mul(2)?.checked_add(numbers)? {
            return None;
        }
        let number = |word: &u64| f64::from_bits(*word);
        let (positions, body) = body.split_at(nodes);
        let (velocities, footing) = body.split_at(nodes);
        let vectors = |words: &[u64]| {
            let vectors = words
                .chunks_exact(3)
                .map(|words| Vec3::from_fn(|k, _| number(&words[k])));
            vectors.collect()
        };
        Some(Self {
            positions: vectors(positions),
            velocities: vectors(velocities),
            footing: footing.iter().map(number).collect(),
            converged: number(&head[3]) == 1.0,
            residual_max: number(&head[4]),
            remaining_move: number(&head[5]),
            deepest: number(&head[6]),
            heights: [number(&head[7]), number(&head[8])],
            equilibrium: if number(&head[9]) == 0.0 {
                Equilibrium::Static
            } else {
                Equilibrium::Dynamic {
                    fastest: number(&head[10]),
                    kinetic_energy: number(&head[11]),
                }
            },
        })
    }
}

/// A digest of bytes (FNV-1a, 64 bit): the same on every machine, to tell one content from another.
#[must_use]
pub fn digest(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xCBF2_9CE4_8422_2325, |digest, byte| {
        (digest ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shot() -> Shot {
        Shot {
            positions: vec![Vec3::new(1.0, -2.0, 1.0 / 3.0), Vec3::zeros()],
            velocities: vec![Vec3::new(-3.0, 1.0 / 7.0, 90.0), Vec3::zeros()],
            footing: vec![0.1, 0.2, 0.3],
            converged: true,
            equilibrium: Equilibrium::Dynamic {
                fastest: 90.1,
                kinetic_energy: 1.0 / 9.0,
            },
            residual_max: 1e-9,
            remaining_move: 2e-4,
            deepest: 0.01,
            heights: [-1.0, 2.0],
        }
    }

    #[test]
    fn a_frame_is_read_back_to_the_last_bit() {
        assert_eq!(Shot::from_bytes(&shot().to_bytes(7), 7), Some(shot()));
    }

    #[test]
    fn a_frame_of_something_else_or_cut_off_anywhere_or_changed_is_none() {
        let bytes = shot().to_bytes(7);
        assert_eq!(Shot::from_bytes(&bytes, 8), None);
        for end in 0..bytes.len() {
            assert_eq!(Shot::from_bytes(&bytes[..end], 7), None, "cut at {end}");
            let mut changed = bytes.clone();
            changed[end] ^= 1;
            assert_eq!(Shot::from_bytes(&changed, 7), None, "changed at {end}");
        }
    }

    /// The test vectors of FNV-1a (Fowler, Noll & Vo).
    #[test]
    fn the_digest_is_fnv() {
        assert_eq!(digest(b""), 0xCBF2_9CE4_8422_2325);
        assert_eq!(digest(b"a"), 0xAF63_DC4C_8601_EC8C);
        assert_eq!(digest(b"foobar"), 0x8594_4171_F739_67E8);
    }
}
