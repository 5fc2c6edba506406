//! The trunk as rows of balls abreast, four to a row: each section is a stadium, flat before and
//! behind and round at the sides.
//!
//! A row of balls as thick as the trunk would hang through the crotch: the lowest rows are double,
//! one in front and one behind, of smaller balls.

use super::{
    bones::Side,
    measurements::Girth,
    muscles::{Builder, Flesh, Limb},
    profile::Profile,
};
use crate::math::Vec3;
use core::f64::consts::PI;

/// Depth over breadth of the sections (`anthropometry`: waist 0.72 to 0.75, chest 0.70 to 0.75; the
/// bust deeper by the breasts).
const WAIST: f64 = 0.75;
const UNDER_BUST: f64 = 0.75;
const BUST: f64 = 0.76;

/// Levels of the girths between crotch (0) and tips of the shoulders (1): at 0.495, 0.62, 0.68 and
/// 0.72 of the stature of a woman of 158 cm, 0.498, 0.62, 0.69 and 0.725 of a man of 170.
const HIP_LEVEL: f64 = 0.11;
const WAIST_LEVEL: f64 = 0.47;
const UNDER_BUST_LEVEL: f64 = 0.65;
const BUST_LEVEL: f64 = 0.76;
/// Where the arms leave the trunk, and the last row, below the collar bones.
const ARMPIT_LEVEL: f64 = 0.88;
const TOP_LEVEL: f64 = 0.97;

/// Deepest dent between rows [cm]: r − √(r² − s²/4), about s²/8r, for balls of radius r every s.
const DENT: f64 = 0.2;

/// Places of the balls of a row, from the person's right, over half the row's length.
const ABREAST: [f64; 4] = [-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0];

/// Balls of a breast: how far above the bust (between crotch and tips of the shoulders), how much of
/// what it stands out, and radius as a share of the stature.
const BREAST: [[f64; 3]; 3] = [
    [0.0, 1.0, 0.0345],
    [0.04, 0.75, 0.0345],
    [0.09, 0.25, 0.034],
];

/// A stadium's breadth and depth, halved, and how far back its middle is [cm], by height.
struct Sections {
    breadth: Profile,
    depth: Profile,
    back: Profile,
}

impl Sections {
    /// Where the chest is in front, some way to the side [cm].
    fn front(&self, x: f64, height: f64) -> f64 {
        let (breadth, depth) = (self.breadth.at(height), self.depth.at(height));
        let beyond = x - (breadth - depth).max(0.0);
        let round = (depth * depth - beyond.max(0.0).powi(2)).max(0.0).sqrt();
        self.back.at(height) - round
    }
}

impl Builder<'_> {
    /// Height of a level between crotch (0) and tips of the shoulders (1) [cm].
    fn level(&self, share: f64) -> f64 {
        self.levels.crotch + share * (self.levels.acromion - self.levels.crotch)
    }

    /// Height at which a girth of the trunk is taken [cm].
    pub(super) fn height(&self, girth: Girth) -> Option<f64> {
        match girth {
            Girth::Hip => Some(self.level(HIP_LEVEL)),
            Girth::Waist => Some(self.level(WAIST_LEVEL)),
            Girth::UnderBust => Some(self.level(UNDER_BUST_LEVEL)),
            Girth::Bust => Some(self.level(BUST_LEVEL)),
            _ => None,
        }
    }

    fn sections(&self) -> Sections {
        let half_shoulders = 0.5 * self.person.shoulder_width;
        let stature = self.levels.stature;
        let hip = (0.5 * self.person.hip_width, stadium_depth(self));
        let waist = stadium(self.girth(Girth::Waist), WAIST);
        let under_bust = stadium(self.girth(Girth::UnderBust), UNDER_BUST);
        let bust = stadium(self.chest(), BUST);
        let armpit = ((half_shoulders - 0.02 * stature).min(bust.0), 0.74 * bust.1);
        let top = (0.62 * half_shoulders, 0.55 * bust.1);
        let rows = [
            (HIP_LEVEL, hip, 0.014),
            (WAIST_LEVEL, waist, -0.002),
            (UNDER_BUST_LEVEL, under_bust, 0.0),
            (BUST_LEVEL, bust, 0.0),
            (ARMPIT_LEVEL, armpit, 0.006),
            (TOP_LEVEL, top, 0.01),
        ];
        let profile = |of: fn((f64, f64), f64) -> f64| {
            let points = rows.map(|(share, half, back)| (self.level(share), of(half, back)));
            Profile::new(&points)
        };
        Sections {
            breadth: profile(|half, _| half.0),
            depth: profile(|half, _| half.1),
            back: Profile::new(&rows.map(|(share, _, back)| (self.level(share), back * stature))),
        }
    }

    pub(super) fn trunk(&mut self) {
        let since = self.count();
        let sections = self.sections();
        let [low, high] = [self.level(HIP_LEVEL), self.level(TOP_LEVEL)];
        let spacing = (8.0 * DENT * sections.depth.at(high)).sqrt();
        let steps = ((high - low) / spacing).ceil().max(1.0);
        let mut before: Option<[Vec<usize>; 2]> = None;
        for step in 0..=steps as usize {
            let height = low + (high - low) * step as f64 / steps;
            let rows = self.rows(&sections, height);
            match &before {
                Some(below) => self.weave(below, &rows),
                // The seat closes the trunk from below.
                None => self.web(Limb::Trunk, &rows[0], &rows[1]),
            }
            before = Some(rows);
        }
        self.group(Flesh::Trunk, None, since);
    }

    /// Neighbours of two levels: in front, behind and, where rows are double, at the sides.
    fn weave(&mut self, below: &[Vec<usize>; 2], above: &[Vec<usize>; 2]) {
        let [front, back] = below;
        let [front_above, back_above] = above;
        self.web(Limb::Trunk, front, front_above);
        if front == back && front_above == back_above {
            return;
        }
        self.web(Limb::Trunk, back, back_above);
        for end in [0, ABREAST.len() - 1] {
            let ends = |rows: &[Vec<usize>; 2]| -> Vec<usize> {
                rows.iter()
                    .filter_map(|row| row.get(end).copied())
                    .collect()
            };
            self.web(Limb::Trunk, &ends(below), &ends(above));
        }
    }

    /// The rows of a level, front and back; one and the same where balls are as thick as the trunk.
    fn rows(&mut self, sections: &Sections, height: f64) -> [Vec<usize>; 2] {
        let (breadth, depth) = (sections.breadth.at(height), sections.depth.at(height));
        let back = sections.back.at(height);
        let above_hip = height - self.level(HIP_LEVEL);
        let radius = depth.min(0.6 * (breadth + above_hip)).min(breadth);
        let offset = depth - radius;
        if offset < 0.02 * depth {
            let row = self.row(height, breadth, depth.min(breadth), back);
            return [row.clone(), row];
        }
        [-offset, offset].map(|y| self.row(height, breadth, radius, back + y))
    }

    fn row(&mut self, height: f64, breadth: f64, radius: f64, y: f64) -> Vec<usize> {
        let crotch = self.levels.crotch;
        let bone = self.spine_at(height);
        ABREAST
            .map(|place| {
                let x = place * (breadth - radius);
                // No ball hangs below the crotch where the legs part.
                let under = (radius * radius - x * x).max(0.0).sqrt();
                let centre = Vec3::new(x, y, height.max(crotch + under));
                self.ball(bone, centre, radius)
            })
            .to_vec()
    }

    /// The bone of the spine that is at a height.
    fn spine_at(&self, height: f64) -> usize {
        let above = |name: &str| height >= self.line(self.bone(name)).0.z;
        let spine = ["thorax", "lumbar"].into_iter().find(|name| above(name));
        self.bone(spine.unwrap_or("pelvis"))
    }

    /// Girth of the chest at the level of the bust, breasts left out [cm].
    ///
    /// Up to 4 cm that the bust has more than the girth below it are the chest's own, of the rest
    /// a part; a chest that took all would bulge over the girth below it.
    fn chest(&self) -> f64 {
        let girths = &self.person.girths;
        let breasts = 0.85 * (girths.bust - girths.under_bust - 4.0).max(0.0);
        (girths.bust - breasts) * self.width(Girth::Bust).min(1.0)
    }

    /// How far a breast stands out of the chest [cm]: half of what it adds to the girth, and more or
    /// less until the tape reads the bust.
    fn standing_out(&self) -> f64 {
        let girths = &self.person.girths;
        let breasts = 0.85 * (girths.bust - girths.under_bust - 4.0).max(0.0);
        let more = 0.35 * girths.bust * (self.width(Girth::Bust) - 1.0);
        (0.5 * breasts + more).max(0.0)
    }

    /// Balls for a breast, which stand out the more the bust is larger than the girth below it.
    pub(super) fn breast(&mut self, side: Side) {
        let since = self.count();
        let out = self.standing_out();
        let sections = self.sections();
        let (bone, stature) = (self.bone("thorax"), self.levels.stature);
        let x = 0.046 * stature;
        let balls = BREAST.map(|[above, share, radius]| {
            let (height, radius) = (self.level(BUST_LEVEL + above), radius * stature);
            let chest = sections.front(x, height);
            let centre = Vec3::new(x, chest - share * out + radius, height);
            self.ball(bone, side.vector(centre), radius)
        });
        let limb = match side {
            Side::Right => Limb::RightBreast,
            Side::Left => Limb::LeftBreast,
        };
        self.string(limb, &balls);
        self.group(Flesh::Breast, Some(side), since);
    }
}

/// Breadth and depth, halved, of a stadium of a girth: 4·(b − d) + 2π·d.
fn stadium(girth: f64, depth_over_breadth: f64) -> (f64, f64) {
    let breadth = girth / (4.0 + depth_over_breadth * (2.0 * PI - 4.0));
    (breadth, depth_over_breadth * breadth)
}

/// Depth, halved, at the hip, whose breadth is measured.
fn stadium_depth(builder: &Builder<'_>) -> f64 {
    let depth = (builder.girth(Girth::Hip) - 2.0 * builder.person.hip_width) / (2.0 * PI - 4.0);
    depth.max(0.2 * builder.person.hip_width)
}
