//! The cubic between two keys: cumulative, so that turns and places are treated alike.

use super::{Key, way};
use crate::{
    math::{Rotation, Vec3, turn},
    skeleton::Posture,
};

/// Two neighbouring keys and those beside them, and a time between.
pub(super) struct Span<'k> {
    before: Option<&'k Posture>,
    from: &'k Posture,
    to: &'k Posture,
    after: Option<&'k Posture>,
    /// Seconds before, between and after the two.
    steps: [f64; 3],
    /// How much of the way is gone, 0 to 1.
    part: f64,
}

impl<'k> Span<'k> {
    /// The span of a time; before the first key and after the last their own. At least one key.
    pub(super) fn find(keys: &'k [Key], time: f64, cycle: bool) -> Self {
        let last = keys.len() - 1;
        let here = keys.partition_point(|key| key.time <= time);
        let here = here.saturating_sub(1).min(last.saturating_sub(1));
        let next = (here + 1).min(last);
        let key = |index: usize| &keys[index];
        // The last key of a cycle is its first: beside it stands the second but one.
        let before = match here {
            0 => (cycle && last > 1).then(|| [last - 1, last]),
            _ => Some([here - 1, here]),
        };
        let after = match next {
            _ if next == last => (cycle && last > 1).then_some([0, 1]),
            _ => Some([next, next + 1]),
        };
        let step = |pair: Option<[usize; 2]>| {
            pair.map_or(0.0, |[one, other]| key(other).time - key(one).time)
        };
        let between = key(next).time - key(here).time;
        let part = if between > 0.0 {
            (time - key(here).time) / between
        } else {
            0.0
        };
        Self {
            before: before.map(|[one, _]| &key(one).posture),
            from: &key(here).posture,
            to: &key(next).posture,
            after: after.map(|[_, other]| &key(other).posture),
            steps: [step(before), between, step(after)],
            part: part.clamp(0.0, 1.0),
        }
    }

    pub(super) fn from(&self) -> &'k Posture {
        self.from
    }

    /// A place on the way [cm].
    pub(super) fn place(&self, of: impl Fn(&Posture) -> Vec3) -> Vec3 {
        let (from, to) = (of(self.from), of(self.to));
        let before = self.before.map(|posture| from - of(posture));
        let after = self.after.map(|posture| of(posture) - to);
        let [leave, arrive] = self.thirds(before, to - from, after);
        let [a, b, c] = self.weights();
        from + leave * a + (to - from - leave - arrive) * b + arrive * c
    }

    /// A turn on the way, which starts at `from`.
    pub(super) fn turn(&self, of: impl Fn(&Posture) -> Rotation, from: Rotation) -> Rotation {
        let to = of(self.to);
        let before = self.before.map(|posture| way(&of(posture), &from));
        let after = self.after.map(|posture| way(&to, &of(posture)));
        let [leave, arrive] = self.thirds(before, way(&from, &to), after);
        let [a, b, c] = self.weights();
        let middle = way(&(from * turn(&leave)), &(to * turn(&-arrive)));
        from * turn(&(leave * a)) * turn(&(middle * b)) * turn(&(arrive * c))
    }

    /// A third of the way that the velocity at each end makes in this span's time.
    fn thirds(&self, before: Option<Vec3>, way: Vec3, after: Option<Vec3>) -> [Vec3; 2] {
        let [earlier, here, later] = self.steps;
        // The parabola's velocity: each neighbour's, weighted by the time to the other.
        let third = |beside: Option<Vec3>, step: f64| match beside {
            Some(beside) => (beside * (here * here / step) + way * step) / (3.0 * (here + step)),
            None => way / 3.0,
        };
        [third(before, earlier), third(after, later)]
    }

    /// Bernstein's cubics summed from behind: how much of each of the three parts is gone.
    fn weights(&self) -> [f64; 3] {
        let part = self.part;
        let left = 1.0 - part;
        [
            1.0 - left * left * left,
            part * part * (3.0 - 2.0 * part),
            part * part * part,
        ]
    }
}
