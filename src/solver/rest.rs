//! One lattice brought to rest: sweeps and joint steps in turn, until the certificate holds.

use super::{
    Progress, Settings,
    film::Film,
    inertia::Inertia,
    joint::{Joint, Step, has_factors},
    leap::Leaps,
    level::Level,
    march::March,
    model::longest,
    start::Start,
};
use crate::{
    certificate::{Case, greatest_residual},
    math::Vec3,
};

/// Steps with inertia before the first joint step is tried, or before the first leap, by how much more
/// each time, and at most.
const FIRST_TRY: usize = 60;
const FIRST_LEAP: usize = 20;
const LATER_TRIES: f64 = 1.5;
const RAREST_TRY: f64 = 200.0;
/// A coarse level is left when a joint step asks for less than this part of its pitch.
const COARSE_ENOUGH: f64 = 0.05;
/// Most sweeps on a coarse level: its task is a start for the next.
const COARSE_SWEEPS: usize = 300;
/// Most rounds on a coarse level.
const COARSE_ROUNDS: usize = 150;
/// A drape with less than this to go [cm] at a tolerance of 1e-3 is where it will be.
const SETTLED: f64 = 1e-3;
/// A node on a sharp feature may swing between two equilibria this near to each other [cm]: after
/// as many rounds as patience lasts, either is accepted, and the swing is reported as the move
/// that remains.
pub(super) const SWINGING: f64 = 0.02;
/// Rounds of short steps before a swing is accepted.
pub(super) const PATIENCE: usize = 8;
/// Rounds of short steps before their contraction is known: an estimate is the worst of so many.
const ACQUAINTED: usize = 3;
/// While the cloth lands, friction is so many times as strong: the forces of a cloth far from rest
/// are not those that it will rest under, and would drag it along by chance. It has landed when a
/// free step asks for less than this part of a pitch.
const LANDING_GRIP: f64 = 10.0;
const LANDED: f64 = 0.2;
/// Sweeps before each step of a landing: they settle what is near, it settles what is far.
const SWEEPS: usize = 4;
/// Holds are carried so far at a time, in pitches, with so many steps to follow them.
pub(super) const CARRIED: f64 = 0.1;
pub(super) const CARRYING: usize = 10;
/// A shape that is not stable is moved on by this part of a pitch.
const KICK: f64 = 0.02;
/// A cloth whose steps ask for less than this part of a pitch stands still.
const STUCK: f64 = 1e-7;
/// Bold joint steps go on as long as each goes farther than this part of a pitch.
const WORTHWHILE: f64 = 0.02;
/// A cloth is to leap where a joint step asks for more than this part of a pitch.
const FAR: f64 = 0.1;
/// Sweeps between two looks at the residual where there are no joint steps.
const PLAIN_SWEEPS: usize = 20;
/// No estimate of the way to rest is below this [cm]: the laws of contact are looked at anew only
/// so often.
const LEAST_ESTIMATE: f64 = 1e-5;

/// A run under its watcher.
pub(super) struct Run<'w> {
    pub(super) watch: &'w mut dyn FnMut(&Progress) -> bool,
    pub(super) settings: &'w Settings,
    pub(super) levels: usize,
    pub(super) film: Film,
    pub(super) stopped: bool,
    /// Whether the coarsest level starts flat, far above its rest; else it goes on from a drape.
    pub(super) lands: bool,
    /// How a cloth that goes on is held while it is disturbed.
    pub(super) firmness: Firmness,
}

/// How a cloth that goes on from a drape is held while it is not near rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Firmness {
    /// Friction is so many times as strong.
    pub(super) times: f64,
    /// Until a joint step asks for less than this part of a pitch; 0: until bodies and holds are where
    /// they belong.
    pub(super) until: f64,
}

impl Firmness {
    /// Of a cloth on bodies that stand still while holds move: as stiff as yarns are, so that no jolt
    /// of theirs tears off what sticks.
    pub(super) const STUCK: Self = Self {
        times: 1e5,
        until: 2e-3,
    };
    /// Of a cloth on bodies that move under it: as when it lands, so that what must slip can.
    pub(super) const CARRIED: Self = Self {
        times: LANDING_GRIP,
        until: 0.0,
    };
}

/// How a level stands after a round.
pub(super) struct Standing {
    /// Which level, from 0 for the coarsest.
    number: usize,
    /// Longest move of the last joint step [cm].
    made: f64,
    /// Whether the last round said that rest is near.
    near: bool,
    /// Estimate of the farthest node's way to rest [cm]; infinite where the shape is not known to
    /// be stable.
    remaining: f64,
    residual: f64,
    /// Rounds of short, exact steps without a break.
    settled_for: usize,
    /// What each of the last rounds alone said of the way to rest [cm], the last one first.
    estimates: [f64; PATIENCE],
    /// Positions after the last round, and each node's way there from the round before [cm].
    at: Vec<Vec3>,
    way: Vec<Vec3>,
}

impl Run<'_> {
    /// Brings one level to rest, or as near as the watcher allows. Returns the estimate of how
    /// far the farthest node still is from rest [cm].
    pub(super) fn rest(
        &mut self,
        level: &mut Level<'_>,
        case: &Case<'_>,
        start: &Start,
        number: usize,
    ) -> f64 {
        if level.own_only {
            return self.rest_by_sweeps(level, case, number);
        }
        let last = number + 1 == self.levels;
        let mut joint = Joint::new(level);
        let mut standing = Standing::new(level, number);
        let mut approach = Approach::of(level, self.lands);
        let lands = number == 0 && self.lands;
        if lands {
            self.carry_holds(level, start, &standing);
            level.touches.rub(LANDING_GRIP * case.surface.friction);
        }
        let mut gripped = !self.lands && self.firmness.until > 0.0;
        if !self.lands && !gripped {
            level.let_go(case.surface.friction);
        }
        for round in 0.. {
            if !self.goes_on(level, &standing) {
                break;
            }
            let step = if lands {
                joint.land_or_step(level, &standing)
            } else {
                self.approach(level, &mut joint, &mut approach, &standing)
            };
            let pitch = level.lattice.pitch;
            standing.count(step.as_ref(), pitch);
            let wants_less = |way: f64| step.is_some_and(|step: Step| step.wants_less_than(way));
            if lands && wants_less(LANDED * pitch) {
                level.touches.rub(case.surface.friction);
            }
            if gripped
                && step.is_some_and(|step| step.asked < self.firmness.until * level.lattice.pitch)
            {
                gripped = false;
                level.let_go(case.surface.friction);
                standing.near = false;
                continue;
            }
            let worn = level.sweeps > COARSE_SWEEPS && !lands || round > COARSE_ROUNDS;
            if !last && (wants_less(COARSE_ENOUGH * pitch) || worn) {
                break;
            }
            let Some(step) = step else { continue };
            if !last {
                continue;
            }
            if !self.lands && !step.exact && step.asked < STUCK * pitch {
                // At a standstill that is no rest: what pushed it there holds it in balance.
                if let Some(way) = joint.way_out(level) {
                    level.kick(&way, KICK);
                    standing.near = false;
                    continue;
                }
            }
            if standing.settled_for > 1 {
                joint.finish(level, step.asked);
            }
            standing.go_to(&level.at, &step, level.touches.list().is_empty());
            if !self.lands
                && standing.settled_for > 0
                && standing.settled_for.is_multiple_of(PATIENCE)
            {
                // At a standstill that its certificate does not bear out: features are sought anew.
                level.touches.forget_features();
            }
            if !gripped && self.is_settled(level, case, &mut standing, round) {
                let Some(way) = joint.way_out(level) else {
                    break;
                };
                level.kick(&way, KICK);
                standing.near = false;
            }
        }
        standing.remaining
    }

    /// Marches, or goes on with inertia and by leaps, while rest is not near, and tries a joint step.
    fn approach(
        &mut self,
        level: &mut Level<'_>,
        joint: &mut Joint,
        approach: &mut Approach,
        standing: &Standing,
    ) -> Option<Step> {
        let pitch = level.lattice.pitch;
        if let Some(march) = approach.march.as_mut().filter(|_| !standing.near) {
            if !self.march(level, joint, march, standing) {
                approach.march = None;
            }
        } else if !standing.near && !approach.bold {
            let steps = approach.patience as usize;
            self.glide(level, joint, &mut approach.inertia, standing, steps);
            approach.patience = (approach.patience * LATER_TRIES).min(RAREST_TRY);
            if self.leap(level, joint, approach, FAR * pitch, standing) {
                return None;
            }
        }
        let last = standing.number + 1 == self.levels;
        let bold = standing.near || joint.goes_farther_than(approach.inertia.last);
        approach.bold = last && (approach.bold || bold);
        let step = joint.round(level, standing.made, approach.bold);
        approach.bold &= step.is_some_and(|step| step.made > WORTHWHILE * pitch);
        if step.is_some() {
            approach.inertia.stop(level);
        }
        step
    }

    /// Carries the holds to where they belong, a part of a pitch at a time.
    fn carry_holds(&mut self, level: &mut Level<'_>, start: &Start, standing: &Standing) {
        let way = start
            .carry
            .iter()
            .map(|(_, carry)| carry.norm())
            .fold(0.0, f64::max);
        let steps = (way / (CARRIED * level.lattice.pitch)).ceil() as usize;
        if steps == 0 {
            return;
        }
        let mut joint = Joint::new(level);
        for _ in 0..steps {
            if self.stopped {
                break;
            }
            for (node, carry) in &start.carry {
                level.at[*node as usize] += carry / steps as f64;
            }
            let mut inertia = Inertia::none(level);
            self.glide(level, &mut joint, &mut inertia, standing, CARRYING);
        }
    }

    /// Asks the watcher, and films.
    pub(super) fn goes_on(&mut self, level: &Level<'_>, standing: &Standing) -> bool {
        let number = standing.number;
        let progress = Progress {
            level: (number, self.levels),
            nodes: level.at.len(),
            sweeps: level.sweeps,
            residual: standing.residual,
            remaining_move: standing.remaining,
        };
        self.film.shoot(number, &level.at);
        self.stopped = self.stopped || !(self.watch)(&progress);
        !self.stopped
    }

    /// Whether the finest level has come to rest.
    fn is_settled(
        &self,
        level: &Level<'_>,
        case: &Case<'_>,
        standing: &mut Standing,
        round: usize,
    ) -> bool {
        let still = (SETTLED * self.settings.tolerance / 1e-3).max(2.0 * LEAST_ESTIMATE);
        let remaining = if standing.remaining < still {
            standing.remaining
        } else {
            standing.worst_of(PATIENCE)
        };
        let stands = standing.settled_for > 1 && remaining < still.max(SWINGING);
        // The residual takes as long as a step: it is asked for when all else says that this is rest.
        if stands || round % 8 == 7 {
            standing.residual = greatest_residual(case, &level.at);
        }
        if !stands || standing.residual > 0.5 * self.settings.tolerance {
            return false;
        }
        standing.remaining = remaining;
        true
    }

    /// The paper's ten forces have no energy, so no joint step: sweeps alone, until the certificate
    /// holds or the watcher ends it.
    fn rest_by_sweeps(&mut self, level: &mut Level<'_>, case: &Case<'_>, number: usize) -> f64 {
        let last = number + 1 == self.levels;
        let pitch = level.lattice.pitch;
        let mut standing = Standing::new(level, number);
        let mut before = f64::INFINITY;
        for round in 0.. {
            if !self.goes_on(level, &standing) {
                break;
            }
            level.look(pitch, 0.1);
            let mut moved = 0.0;
            for _ in 0..PLAIN_SWEEPS {
                moved = level.sweep();
                level.touches.look_at_loads(&level.at);
            }
            // Moves that shrink by a factor r every so many sweeps have moved/(1 − r) to go.
            let contraction = (moved / before).min(1.0);
            before = moved;
            standing.remaining = PLAIN_SWEEPS as f64 * moved / (1.0 - contraction);
            if !last && (moved < 1e-4 * pitch || round > 10 * COARSE_ROUNDS) {
                break;
            }
            standing.residual = greatest_residual(case, &level.at);
            let still = standing.remaining < SWINGING;
            if last && still && standing.residual <= 0.5 * self.settings.tolerance {
                break;
            }
        }
        standing.remaining
    }
}

/// How a cloth that has landed comes near rest.
pub(super) struct Approach {
    pub(super) inertia: Inertia,
    /// Steps with inertia before the next leap or joint step is tried.
    patience: f64,
    /// How far it is trusted to leap.
    pub(super) leaps: Leaps,
    /// Whether bold joint steps are what takes it farthest.
    bold: bool,
    /// How it marches, if it does.
    march: Option<March>,
}

impl Approach {
    fn of(level: &Level<'_>, lands: bool) -> Self {
        let pitch = level.lattice.pitch;
        let leaps = Leaps::of(level, lands);
        let leaps_first = leaps.some(pitch);
        // Hung cloth leaps farther. One that follows others' moves shall not leave the folds that it has.
        let marches = lands && !leaps_first && has_factors(level);
        Self {
            inertia: Inertia::none(level),
            patience: if leaps_first { FIRST_LEAP } else { FIRST_TRY } as f64,
            leaps,
            bold: false,
            march: marches.then(|| March::new(pitch)),
        }
    }
}

impl Standing {
    pub(super) fn new(level: &Level<'_>, number: usize) -> Self {
        Self {
            number,
            made: level.lattice.pitch,
            near: false,
            remaining: f64::INFINITY,
            residual: f64::INFINITY,
            settled_for: 0,
            estimates: [f64::INFINITY; PATIENCE],
            at: level.at.clone(),
            way: vec![Vec3::zeros(); level.at.len()],
        }
    }

    fn count(&mut self, step: Option<&Step>, pitch: f64) {
        self.near = step.is_some_and(|step| step.is_near(pitch));
        self.made = step.map_or(pitch, |step| step.made);
        let short = step.is_some_and(|step| step.exact && step.asked < COARSE_ENOUGH * pitch);
        self.settled_for = if short { self.settled_for + 1 } else { 0 };
    }

    /// Ends a round, and estimates what remains from how rounds contract: ways that shrink to a
    /// part ρ each round have way/(1 − ρ) to go in all. A cloth that creeps (ρ = 1) is never near
    /// rest, however short its rounds; one that swings (ρ < 0) goes no farther than it swings. Where
    /// nothing is touched, the laws are `smooth`: an exact step asks for all that is left.
    fn go_to(&mut self, at: &[Vec3], step: &Step, smooth: bool) {
        let (mut longest, mut along, mut square) = (step.asked, 0.0, 0.0);
        for ((to, from), way) in at.iter().zip(&mut self.at).zip(&mut self.way) {
            let next = to - *from;
            longest = longest.max(next.norm());
            along += next.dot(way);
            square += way.norm_squared();
            (*way, *from) = (next, *to);
        }
        let contraction = if square > 0.0 { along / square } else { 0.0 };
        self.estimates.rotate_right(1);
        self.estimates[0] = if self.settled_for == 0 {
            f64::INFINITY
        } else if longest <= LEAST_ESTIMATE {
            LEAST_ESTIMATE
        } else {
            longest / (1.0 - contraction.clamp(0.0, 1.0))
        };
        self.remaining = self.worst_of(if smooth { 1 } else { ACQUAINTED });
    }

    /// The worst that the last rounds said [cm].
    fn worst_of(&self, rounds: usize) -> f64 {
        self.estimates[..rounds].iter().copied().fold(0.0, f64::max)
    }
}

impl Joint {
    /// Looks for bodies as far as a step may go after one of `made` [cm].
    pub(super) fn look(&mut self, level: &mut Level<'_>, made: f64) {
        let way = 0.8 * level.lattice.pitch;
        self.sight = (3.0 * made).clamp(0.02 * level.lattice.pitch, way);
        level.look(way, self.sight);
    }

    /// A joint step of a cloth that is near rest, or one of a landing.
    fn land_or_step(&mut self, level: &mut Level<'_>, standing: &Standing) -> Option<Step> {
        let near = standing
            .near
            .then(|| self.round(level, standing.made, false));
        near.flatten().or_else(|| self.land(level, standing.made))
    }

    /// A step of a cloth that comes down, after sweeps that feel how bodies press.
    fn land(&mut self, level: &mut Level<'_>, made: f64) -> Option<Step> {
        self.look(level, made);
        for _ in 0..SWEEPS {
            level.sweep();
            level.touches.look_at_loads(&level.at);
        }
        self.look(level, made);
        self.damped_step(level)
    }

    /// A joint step with what bodies are near.
    fn round(&mut self, level: &mut Level<'_>, made: f64, bold: bool) -> Option<Step> {
        self.look(level, made);
        self.step(level, bold)
    }
}

impl Level<'_> {
    /// Strengthens friction [-] for a cloth that is not near rest; no force is changed by that.
    pub(super) fn hold(&mut self, friction: f64, firmness: Firmness) {
        self.touches.grip(firmness.times * friction, true, &self.at);
    }

    /// Gives friction its own strength [-] again.
    pub(super) fn let_go(&mut self, friction: f64) {
        self.touches.grip(friction, false, &self.at);
    }

    /// Moves the cloth along a way, the farthest node by so many pitches.
    fn kick(&mut self, way: &[Vec3], pitches: f64) {
        let part = pitches * self.lattice.pitch / longest(way);
        self.at = self.freely(|node| way[node] * part);
    }
}
