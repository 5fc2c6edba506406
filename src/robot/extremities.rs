//! Head, hands and feet, whose girths no one gives: as large as their lengths have it.

use super::{
    bones::{ANKLE_FROM_HEEL, Side},
    measurements::Girth,
    muscles::{Builder, Flesh, Limb, starts},
    profile::Profile,
};
use crate::{
    math::Vec3,
    skeleton::{Skeleton, Sole},
};

/// Balls of the head: how far above the chin, how far back, and radius, as shares of its height.
/// Its breadth comes to 0.65 of its height, its depth to 0.79 (from memory of anthropometry).
const HEAD: [[f64; 3]; 6] = [
    // Chin, cheeks, below the ears, eyes, brow, back of the head; the last two reach the top.
    [0.19, -0.165, 0.19],
    [0.36, -0.115, 0.25],
    [0.50, 0.085, 0.26],
    [0.52, -0.075, 0.29],
    [0.675, -0.045, 0.325],
    [0.675, 0.095, 0.325],
];

/// Rows across the hand: how far from the wrist, half the breadth between the outer balls, and
/// radius, as shares of the hand's length.
const HAND: [[f64; 3]; 8] = [
    [0.08, 0.075, 0.115],
    [0.21, 0.11, 0.105],
    [0.34, 0.13, 0.098],
    [0.47, 0.13, 0.09],
    [0.59, 0.125, 0.08],
    [0.71, 0.115, 0.072],
    [0.83, 0.10, 0.064],
    [0.94, 0.075, 0.056],
];

/// The thumb: how far from the wrist, how far forward, radius.
const THUMB: [[f64; 3]; 4] = [
    [0.16, 0.14, 0.085],
    [0.28, 0.22, 0.072],
    [0.39, 0.26, 0.062],
    [0.50, 0.28, 0.055],
];

/// Rows across the foot: how far from the heel, half the breadth between the outer balls, their
/// radius, and the radius of the one between, as shares of the foot's length.
const FOOT: [[f64; 4]; 10] = [
    [0.12, 0.03, 0.115, 0.12],
    [0.24, 0.04, 0.12, 0.14],
    [0.34, 0.055, 0.115, 0.145],
    [0.44, 0.07, 0.105, 0.13],
    [0.54, 0.085, 0.092, 0.11],
    [0.63, 0.1, 0.082, 0.09],
    [0.71, 0.107, 0.073, 0.076],
    [0.79, 0.107, 0.065, 0.066],
    [0.87, 0.098, 0.058, 0.06],
    [0.945, 0.075, 0.052, 0.055],
];

/// Rows of a foot of a length [cm] from heel to toes: middles [cm] from below the ankle, and radii.
fn foot_rows(length: f64) -> impl Iterator<Item = [(Vec3, f64); 3]> {
    FOOT.into_iter().map(move |[along, half, outer, inner]| {
        let back = ANKLE_FROM_HEEL - along;
        [(-half, outer), (0.0, inner), (half, outer)]
            .map(|(x, radius)| (Vec3::new(x, back, radius) * length, radius * length))
    })
}

/// What both feet of a standing skeleton stand on, the balls of [`Builder::foot`].
pub(super) fn soles(skeleton: &Skeleton, length: f64) -> Vec<Sole> {
    let starts = starts(skeleton);
    let sides = [Side::Right, Side::Left];
    let feet = sides.iter().filter_map(|side| {
        let bone = skeleton.bone(&side.of("foot"))?;
        Some((bone, starts.get(bone)?.z))
    });
    feet.flat_map(|(bone, ankle)| {
        foot_rows(length).flatten().map(move |(at, radius)| Sole {
            bone,
            at: at - Vec3::z() * ankle,
            radius,
        })
    })
    .collect()
}

impl Builder<'_> {
    /// Height at which the neck is measured: half way up.
    pub(super) fn neck_level(&self) -> f64 {
        0.5 * (self.levels.collar + self.levels.skull)
    }

    pub(super) fn neck_and_head(&mut self) {
        let since = self.count();
        let (levels, radius) = (*self.levels, self.radius(Girth::Neck));
        let has_head = self.person.head;
        let [low, middle] = [levels.collar - 0.006 * levels.stature, self.neck_level()];
        // A body without a head ends above where the neck is measured.
        let high = if has_head {
            levels.skull
        } else {
            middle + 0.1 * radius
        };
        let bone = self.bone(if has_head { "neck" } else { "thorax" });
        let widths = Profile::new(&[
            (low, 1.12 * radius),
            (middle, radius),
            (levels.skull, 0.98 * radius),
        ]);
        let leans = Profile::new(&[(low, 0.01), (levels.skull, 0.004)]);
        let steps = ((high - low) / (0.8 * radius).max(1.0)).ceil().max(1.0);
        let balls: Vec<usize> = (0..=steps as usize)
            .map(|step| {
                let height = low + (high - low) * step as f64 / steps;
                let centre = Vec3::new(0.0, leans.at(height) * levels.stature, height);
                self.ball(bone, centre, widths.at(height))
            })
            .collect();
        self.string(Limb::Head, &balls);
        self.group(Flesh::Neck, None, since);
        if has_head {
            self.head();
        }
    }

    fn head(&mut self) {
        let since = self.count();
        let (bone, height) = (self.bone("head"), self.levels.head);
        let balls = HEAD.map(|[up, back, radius]| {
            let centre = Vec3::new(0.0, back * height, self.levels.chin + up * height);
            self.ball(bone, centre, radius * height)
        });
        let [chin, cheeks, ears, eyes, brow, nape] = balls;
        self.web(Limb::Head, &[chin, chin], &[cheeks, ears]);
        self.web(Limb::Head, &[cheeks, ears], &[eyes, ears]);
        self.web(Limb::Head, &[eyes, ears], &[brow, nape]);
        self.group(Flesh::Head, None, since);
    }

    /// A mitten: three balls abreast along the hand, whose palm faces the thigh, and a thumb.
    pub(super) fn hand(&mut self, side: Side, limb: Limb, wrist: Option<usize>) {
        let since = self.count();
        let bone = self.bone(&side.of("hand"));
        let (start, vector) = self.line(bone);
        let length = vector.norm();
        let at =
            |along: f64, back: f64| start + vector * along + Vec3::new(0.0, back * length, 0.0);
        let mut before: Vec<usize> = wrist.map(|wrist| vec![wrist; 3]).unwrap_or_default();
        for [along, half, radius] in HAND {
            let row: Vec<usize> = [-1.0, 0.0, 1.0]
                .map(|place| self.ball(bone, at(along, place * half), radius * length))
                .to_vec();
            self.web(limb, &before, &row);
            before = row;
        }
        let thumb = THUMB
            .map(|[along, forward, radius]| self.ball(bone, at(along, -forward), radius * length));
        self.string(limb, &thumb);
        self.group(Flesh::Hand, Some(side), since);
    }

    /// Three balls abreast from heel to toes, all on the floor.
    pub(super) fn foot(&mut self, side: Side, limb: Limb, ankle: Option<usize>) {
        let since = self.count();
        let bone = self.bone(&side.of("foot"));
        let (start, length) = (self.line(bone).0, self.levels.foot);
        let mut before: Vec<usize> = Vec::new();
        let mut instep = Vec::new();
        for row in foot_rows(length) {
            let row: Vec<usize> = row
                .map(|(at, radius)| {
                    let centre = Vec3::new(start.x + at.x, start.y + at.y, radius);
                    self.ball(bone, centre, radius)
                })
                .to_vec();
            self.web(limb, &before, &row);
            instep.extend(row.get(1));
            before = row;
        }
        if let (Some(ankle), [heel, next, arch, rise, ..]) = (ankle, instep.as_slice()) {
            let below = [*heel, *next, *arch, *rise];
            let between = below.map(|ball| self.between(bone, ball, ankle));
            self.web(limb, &below, &between);
            self.web(limb, &between, &[ankle; 4]);
        }
        self.group(Flesh::Foot, Some(side), since);
    }

    /// Lays a ball on a bone half way between two others.
    pub(super) fn between(&mut self, bone: usize, one: usize, other: usize) -> usize {
        let [one, other] = [one, other].map(|ball| self.laid(ball));
        let centre = 0.5 * (one.centre + other.centre);
        self.ball(bone, centre, 0.5 * (one.radius + other.radius))
    }
}
