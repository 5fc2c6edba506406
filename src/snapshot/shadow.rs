//! The cloth seen from above, as the drape test sees it: its shadow in light that falls straight
//! down.

use crate::{
    lattice::Lattice,
    math::{Vec2, Vec3},
};

/// Lines across the shadow on which it is measured. Their midpoint rule is off by less than 1e-4
/// of a disc's area.
const LINES: usize = 1000;

/// The area of the shadow [cm²]; what lies over itself counts once.
#[must_use]
pub fn shadow_area(lattice: &Lattice, positions: &[Vec3]) -> f64 {
    let faces = faces(lattice, positions);
    let (low, high) = ends(faces.iter().flatten().map(|corner| corner.y));
    if low >= high {
        return 0.0;
    }
    let step = (high - low) / LINES as f64;
    let line = |k: usize| low + (k as f64 + 0.5) * step;
    let mut cuts: Vec<Vec<[f64; 2]>> = vec![Vec::new(); LINES];
    for face in &faces {
        let (least, most) = ends(face.iter().map(|corner| corner.y));
        let first = ((least - low) / step - 0.5).ceil().max(0.0) as usize;
        for (k, cuts) in cuts.iter_mut().enumerate().skip(first) {
            if line(k) > most {
                break;
            }
            cuts.extend(cut(face, line(k)));
        }
    }
    cuts.into_iter().map(covered).sum::<f64>() * step
}

/// The outline's radius [cm] at 0°, 10°, … 350° from x towards y, about the vertical axis through
/// the middle of the cloth's area as it hangs: the farthest point of the shadow in each direction,
/// 0 where it has none.
#[must_use]
pub fn outline_radii(lattice: &Lattice, positions: &[Vec3]) -> [f64; 36] {
    let faces = faces(lattice, positions);
    let middle = middle(lattice, positions);
    core::array::from_fn(|k| {
        let (sin, cos) = libm::sincos((10 * k) as f64 * core::f64::consts::PI / 180.0);
        let edges = faces.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        let crossings =
            edges.filter_map(|(a, b)| crossing(&(a - middle), &(b - middle), &Vec2::new(cos, sin)));
        crossings.fold(0.0, f64::max)
    })
}

/// The cloth's faces seen from above; those that are not finite left out.
fn faces(lattice: &Lattice, positions: &[Vec3]) -> Vec<[Vec2; 3]> {
    let finite = |at: &&Vec3| at.iter().all(|x| x.is_finite());
    let seen = |node: u32| {
        positions
            .get(node as usize)
            .filter(finite)
            .map(|at| at.xy())
    };
    let face = |[a, b, c]: [u32; 3]| Some([seen(a)?, seen(b)?, seen(c)?]);
    lattice.faces().filter_map(face).collect()
}

/// The middle of the cloth's area as it hangs [cm].
fn middle(lattice: &Lattice, positions: &[Vec3]) -> Vec2 {
    let weighted = lattice.area.iter().zip(positions);
    let sum: Vec2 = weighted.map(|(area, at)| *area * at.xy()).sum();
    sum / lattice.area.iter().sum::<f64>()
}

/// How far along a direction of length 1 from the origin a segment is crossed [cm].
fn crossing(a: &Vec2, b: &Vec2, along: &Vec2) -> Option<f64> {
    let side = |p: &Vec2| along.perp(p);
    let (from, to) = (side(a), side(b));
    if (from > 0.0) == (to > 0.0) {
        return None;
    }
    let at = a + (b - a) * (from / (from - to));
    Some(at.dot(along))
}

/// Where a face meets a line of constant y, from least to greatest x [cm].
fn cut(&[a, b, c]: &[Vec2; 3], y: f64) -> Option<[f64; 2]> {
    let crossed = [(a, b), (b, c), (c, a)].into_iter().filter_map(|(a, b)| {
        let (from, to) = (a.y - y, b.y - y);
        ((from > 0.0) != (to > 0.0)).then(|| a.x + (b.x - a.x) * (from / (from - to)))
    });
    let (least, most) = ends(crossed);
    (least <= most).then_some([least, most])
}

/// The least and the greatest.
fn ends(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| {
        (least.min(x), most.max(x))
    })
}

/// The length that intervals cover together [cm].
fn covered(mut intervals: Vec<[f64; 2]>) -> f64 {
    intervals.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut end = f64::NEG_INFINITY;
    let own = |[from, to]: [f64; 2]| {
        let own = (to - from.max(end)).max(0.0);
        end = end.max(to);
        own
    };
    intervals.into_iter().map(own).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::{Outline, sample::cut};
    use core::f64::consts::PI;

    fn lattice(outline: Outline) -> Lattice {
        cut(outline, 0.0, 1.0)
    }

    /// The cloth's coordinates put in space.
    fn laid(lattice: &Lattice, place: impl Fn(f64, f64) -> Vec3) -> Vec<Vec3> {
        lattice
            .coordinates
            .iter()
            .map(|c| place(c.x, c.y))
            .collect()
    }

    #[test]
    fn a_flat_disc_throws_its_own_shadow() {
        let disc = lattice(Outline::disc(15.0).unwrap());
        let flat = laid(&disc, |x, y| Vec3::new(x + 7.0, y - 3.0, 2.0));
        // An inscribed polygon with edges of about 1 cm lacks 0.1 % of its area and of its radius.
        let area = shadow_area(&disc, &flat);
        assert!((area / (225.0 * PI) - 1.0).abs() < 2e-3, "{area}");
        for radius in outline_radii(&disc, &flat) {
            assert!((14.97..=15.0 + 1e-9).contains(&radius), "{radius}");
        }
    }

    #[test]
    fn a_rectangle_has_its_corners_where_they_are() {
        let piece = lattice(Outline::rectangle(30.0, 20.0).unwrap());
        let flat = laid(&piece, |x, y| Vec3::new(x, y, 0.1 * x));
        assert!((shadow_area(&piece, &flat) - 600.0).abs() < 1e-6);
        let radii = outline_radii(&piece, &flat);
        for (k, radius) in radii.into_iter().enumerate() {
            let (sin, cos) = (10.0 * k as f64).to_radians().sin_cos();
            let expected = f64::min(15.0 / cos.abs(), 10.0 / sin.abs());
            assert!((radius - expected).abs() < 1e-9, "{k}: {radius}");
        }
    }

    #[test]
    fn what_is_folded_over_counts_once() {
        let piece = lattice(Outline::rectangle(30.0, 20.0).unwrap());
        let folded = laid(&piece, |x, y| Vec3::new(x.abs(), y, x.min(0.0)));
        assert!((shadow_area(&piece, &folded) - 300.0).abs() < 1e-6);
        let upright = laid(&piece, |x, y| Vec3::new(x, 0.0, y));
        assert!(shadow_area(&piece, &upright).abs() < 1e-9);
    }

    #[test]
    fn a_broken_shape_still_has_figures() {
        let piece = lattice(Outline::rectangle(4.0, 4.0).unwrap());
        let broken = laid(&piece, |_, _| Vec3::repeat(f64::NAN));
        assert_eq!(shadow_area(&piece, &broken), 0.0);
        assert_eq!(outline_radii(&piece, &broken), [0.0; 36]);
        assert_eq!(outline_radii(&piece, &[]), [0.0; 36]);
    }
}
