//! The check that is woven into every pictured cloth, so that grain and folds are seen: a
//! tattersall, indigo lines along the warp and madder lines along the weft on undyed linen.

use super::{
    colour::{Rgb, from_srgb},
    png::Image,
};
use crate::{math::Vec2, output::colour::to_srgb};

/// After how far along warp and weft the check repeats [cm].
pub(super) const REPEAT: f64 = 4.0;

/// Width of a line [cm].
const LINE: f64 = 0.16;

/// The cloth's colour at cloth coordinates [cm], averaged over a square of side `across` [cm], so
/// that lines thinner than a pixel fade instead of flickering.
pub(super) fn weave(at: Vec2, across: f64) -> Rgb {
    let dyed = |x: f64| {
        [
            coverage(x, across, 0.5 * REPEAT, LINE),
            coverage(x, across, REPEAT, 0.5 * REPEAT),
        ]
    };
    // A line along the warp stands at one weft coordinate.
    let ([warp_line, warp_band], [weft_line, weft_band]) = (dyed(at.y), dyed(at.x));
    let cloth = from_srgb([236, 229, 214]) * (1.0 - 0.07 * (warp_band + weft_band));
    let cloth = cloth.lerp(&from_srgb([62, 82, 122]), 0.72 * warp_line);
    cloth.lerp(&from_srgb([168, 84, 66]), 0.66 * weft_line)
}

/// How much of a line covers a place of the heat map, 0 to 1.
pub(super) fn lines(at: Vec2, across: f64) -> f64 {
    let line = |x| coverage(x, across, 0.5 * REPEAT, LINE);
    f64::max(line(at.x), line(at.y))
}

/// One repeat of the check as an image, to be tiled: its rows run along the weft.
pub(super) fn tile(size: u32) -> Image {
    let step = REPEAT / f64::from(size);
    let at = |k: u32| step * (f64::from(k) + 0.5);
    let pixels = (0..size * size)
        .map(|k| to_srgb(weave(Vec2::new(at(k % size), at(k / size)), step)))
        .collect();
    Image {
        width: size,
        height: size,
        pixels,
    }
}

/// Share of `x ± across/2` that lies on stripes of a width, centred at multiples of the period.
fn coverage(x: f64, across: f64, period: f64, width: f64) -> f64 {
    let stripes_up_to = |x: f64| {
        let start = x + 0.5 * width;
        let whole = libm::floor(start / period);
        width * whole + f64::min(width, start - period * whole)
    };
    let across = f64::max(across, 1e-6);
    ((stripes_up_to(x + 0.5 * across) - stripes_up_to(x - 0.5 * across)) / across).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coverage_is_the_share_of_stripes() {
        let check = |x, across, expected: f64| {
            let share = coverage(x, across, 2.0, 0.5);
            assert!(
                (share - expected).abs() < 1e-6,
                "{share}, not {expected}, at {x}"
            );
        };
        check(0.0, 0.1, 1.0);
        check(-4.2, 0.1, 1.0);
        check(1.0, 0.1, 0.0);
        check(0.25, 0.1, 0.5);
        check(0.3, 200.0, 0.25);
    }

    #[test]
    fn warp_lines_are_blue_and_weft_lines_red() {
        let along_warp = weave(Vec2::new(1.0, 2.0), 0.01);
        let along_weft = weave(Vec2::new(2.0, 1.0), 0.01);
        assert!(along_warp.z > along_warp.x && along_weft.x > along_weft.z);
    }

    #[test]
    fn the_tile_has_the_colour_of_the_cloth_seen_from_afar() {
        let tile = tile(32);
        let sum: Rgb = tile.pixels.iter().map(|&p| from_srgb(p)).sum();
        let far = weave(Vec2::zeros(), 4000.0);
        assert!((sum / 1024.0 - far).amax() < 0.01, "{sum:?} {far:?}");
    }
}
