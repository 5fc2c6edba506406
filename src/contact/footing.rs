//! Where a cloth holds on to bodies, taken along as they move: friction remembers its way.

use super::{Friction, Site, Skin, places::PLACES, touch::Touch, touches::Touches};
use crate::{body::Bodies, lattice::Lattice, math::Vec3};

/// The touches in which friction acts, and the bodies as they were then.
#[derive(Clone, Debug, Default)]
pub struct Footing {
    bodies: Bodies,
    touches: Vec<Touch>,
}

impl Footing {
    /// The bodies that the cloth lay on.
    #[must_use]
    pub fn bodies(&self) -> &Bodies {
        &self.bodies
    }

    /// Whether the bodies stay where they are.
    #[must_use]
    pub fn stands_on(&self, through: &[Bodies], bodies: &Bodies) -> bool {
        let places = self.bodies.places();
        let mut stations = through.iter().chain([bodies]);
        stations.all(|station| station.places() == places)
    }

    /// Whether it is that of a cloth cut like this.
    #[must_use]
    pub fn fits(&self, lattice: &Lattice) -> bool {
        let nodes = lattice.coordinates.len();
        let known = |touch: &Touch| touch.site.nodes.iter().all(|node| (*node as usize) < nodes);
        self.touches.iter().all(known)
    }

    /// The footing after the bodies, part by part the same, have moved: what friction holds on to
    /// goes with its part.
    #[must_use]
    pub fn carried(&self, bodies: &Bodies) -> Self {
        let carry = |touch: &Touch| {
            let (from, to) = self.bodies.part_then_and_now(touch.part as usize, bodies)?;
            let normal = to.carries_direction(from, &touch.normal);
            Some(Touch {
                anchor: to.carries(from, &touch.anchor),
                normal,
                turn: Vec3::zeros(),
                ..*touch
            })
        };
        Self {
            bodies: bodies.clone(),
            touches: self.touches.iter().filter_map(carry).collect(),
        }
    }

    /// How the bodies' motion takes along what lies on them: for every touch where friction holds
    /// on, there before and now [cm], and the load's limit of friction [gf].
    pub fn ways<'a>(&'a self, carried: &'a Self) -> impl Iterator<Item = (Vec3, Vec3, f64)> + 'a {
        let pairs = self.touches.iter().zip(&carried.touches);
        pairs.map(|(from, to)| (from.anchor, to.anchor, to.friction.limit))
    }
}

impl Touches {
    /// Where nodes and samples hold on. Friction that has reached its limit lets its anchor follow, so
    /// that it can turn round (return mapping). Places of features are not among them: under a cloth
    /// that moves on, they are others.
    #[must_use]
    pub fn footing(&self, at: &[Vec3], bodies: &Bodies) -> Footing {
        let holds = |touch: &&Touch| touch.friction.limit > 0.0 && self.is_lasting(touch.number);
        let touches = self.list().iter().filter(holds).map(|touch| {
            let here = touch.site.at(at);
            let slip = touch.slip(&here);
            let kept = touch.friction.give / slip.norm().max(touch.friction.give);
            Touch {
                anchor: here - slip * kept,
                swings: 0,
                ..*touch
            }
        });
        Footing {
            bodies: bodies.clone(),
            touches: touches.collect(),
        }
    }

    /// Sets Coulomb friction [-] and keeps every friction force as it is, as far as the new limit
    /// allows: a cloth that is held more firmly for a while, or less, is not pushed by that. While it
    /// is held `firm`ly, limits outlast a moment without load.
    pub fn grip(&mut self, friction: f64, firm: bool, at: &[Vec3]) {
        self.rub(friction);
        self.firm = firm;
        for touch in &mut self.touches {
            let here = touch.site.at(at);
            let depth = touch.top - touch.normal.dot(&here);
            let (_, load, _) = touch.skin.answer(depth);
            let force = touch.friction.force(&touch.slip(&here));
            let limit = friction * load;
            touch.friction.limit = limit;
            let share = touch.friction.give / force.norm().max(limit);
            touch.anchor = if limit > 0.0 {
                here + force * share
            } else {
                here
            };
        }
    }

    /// Forgets where features met the cells, so that the next look finds those that do now.
    pub fn forget_features(&mut self) {
        self.places.fill([None; PLACES]);
    }

    /// Whether a site is a node or a sample, which stay what they are.
    fn is_lasting(&self, number: u32) -> bool {
        let within = (number as usize).checked_sub(self.clearance.len());
        within.is_none_or(|k| k % self.sites_of_cell() < self.sites.samples())
    }

    /// Holds on where a cloth of the same lattice did before; nothing is known of clearances and of
    /// features.
    pub fn stand_on(&mut self, footing: &Footing) {
        self.touches.clone_from(&footing.touches);
        self.forget_features();
        self.clearance.fill((0.0, Vec3::repeat(f64::INFINITY)));
        self.list_awake(|_| true);
    }
}

/// Numbers of a touch.
const OF_TOUCH: usize = 24;

impl Footing {
    /// All of it but the bodies, as numbers that are finite: to be kept, and read by
    /// [`from_numbers`](Self::from_numbers).
    #[must_use]
    pub fn numbers(&self) -> Vec<f64> {
        let mut numbers = vec![self.touches.len() as f64];
        for touch in &self.touches {
            numbers.extend([f64::from(touch.number), f64::from(touch.part)]);
            numbers.extend(touch.site.nodes.map(f64::from));
            numbers.extend(touch.site.weights);
            for vector in [touch.normal, touch.turn, touch.anchor] {
                numbers.extend(vector.iter());
            }
            let (skin, friction) = (&touch.skin, &touch.friction);
            numbers.extend([touch.top, skin.scale, skin.depth]);
            numbers.extend([friction.limit, friction.give]);
        }
        numbers
    }

    /// The footing of numbers, on bodies as they were; `None` where they are none of a cloth cut like
    /// this on such bodies.
    #[must_use]
    pub fn from_numbers(numbers: &[f64], bodies: Bodies, lattice: &Lattice) -> Option<Self> {
        let (count, rest) = numbers.split_first()?;
        let finite = numbers.iter().all(|number| number.is_finite());
        let whole = rest.len().is_multiple_of(OF_TOUCH);
        if !finite || !whole || *count != (rest.len() / OF_TOUCH) as f64 {
            return None;
        }
        let touches: Option<Vec<Touch>> = rest.chunks_exact(OF_TOUCH).map(touch_of).collect();
        let footing = Self {
            touches: touches?,
            bodies,
        };
        let parts = footing.bodies.parts().len();
        let known = |touch: &Touch| (touch.part as usize) < parts;
        (footing.fits(lattice) && footing.touches.iter().all(known)).then_some(footing)
    }
}

fn touch_of(numbers: &[f64]) -> Option<Touch> {
    let numbers: &[f64; OF_TOUCH] = numbers.try_into().ok()?;
    let whole = |number: f64| {
        let within = (0.0..=f64::from(u32::MAX)).contains(&number) && number.fract() == 0.0;
        within.then_some(number as u32)
    };
    let vector = |first: usize| Vec3::new(numbers[first], numbers[first + 1], numbers[first + 2]);
    Some(Touch {
        number: whole(numbers[0])?,
        part: whole(numbers[1])?,
        site: Site {
            nodes: [
                whole(numbers[2])?,
                whole(numbers[3])?,
                whole(numbers[4])?,
                whole(numbers[5])?,
            ],
            weights: [numbers[6], numbers[7], numbers[8], numbers[9]],
        },
        normal: vector(10),
        turn: vector(13),
        swings: 0,
        anchor: vector(16),
        top: numbers[19],
        skin: Skin {
            scale: numbers[20],
            depth: numbers[21],
        },
        friction: Friction {
            limit: numbers[22],
            give: numbers[23],
        },
    })
}
