//! Colours in linear light, and the two scales of the heat maps.

use crate::math::Vec3;
use std::f64::consts::TAU;

/// Red, green, blue in linear light, 0 to 1 (the primaries of sRGB).
pub(super) type Rgb = Vec3;

/// Dark violet to bright yellow for `t` from 0 to 1.
///
/// Lightness rises evenly, so that order is seen in print and by colour-blind eyes; hue turns the
/// short way through blue and green. `NaN` is grey.
pub(super) fn sequential(t: f64) -> Rgb {
    if t.is_nan() {
        return NO_VALUE;
    }
    let t = t.clamp(0.0, 1.0);
    let chroma = 0.098 + 0.065 * t * t * t * t;
    oklch(0.32 + 0.58 * t, chroma, 0.83 - 0.53 * t)
}

/// Blue over near-white to orange for `t` from −1 to 1; lightness falls evenly to both sides.
/// Blue and orange are told apart by every common form of colour blindness. `NaN` is grey.
pub(super) fn diverging(t: f64) -> Rgb {
    if t.is_nan() {
        return NO_VALUE;
    }
    let t = t.clamp(-1.0, 1.0);
    let hue = if t < 0.0 { 0.70 } else { 0.13 };
    oklch(0.95 - 0.45 * t.abs(), 0.125 * t.abs(), hue)
}

/// Where a node has no value.
const NO_VALUE: Rgb = Rgb::new(0.3, 0.3, 0.3);

/// A colour by lightness, chroma and hue [turns] in Oklab (B. Ottosson, "A perceptual color space
/// for image processing", 2020), whose distances are near those that are seen.
fn oklch(lightness: f64, chroma: f64, hue: f64) -> Rgb {
    let (a, b) = (chroma * libm::cos(TAU * hue), chroma * libm::sin(TAU * hue));
    let cube = |x: f64| x * x * x;
    let l = cube(lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b);
    let m = cube(lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b);
    let s = cube(lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b);
    Rgb::new(
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s,
    )
}

/// A colour given as it is written for screens, sRGB 0 to 255.
pub(super) fn from_srgb(screen: [u8; 3]) -> Rgb {
    Rgb::from(screen.map(f64::from)).map(|byte| {
        let value = byte / 255.0;
        if value <= 0.040_45 {
            value / 12.92
        } else {
            libm::pow((value + 0.055) / 1.055, 2.4)
        }
    })
}

/// The colour as it is stored for screens, sRGB 0 to 255; what is out of range is cut off.
pub(super) fn to_srgb(light: Rgb) -> [u8; 3] {
    let byte = |value: f64| {
        let value = value.clamp(0.0, 1.0);
        let screen = if value <= 0.003_130_8 {
            12.92 * value
        } else {
            1.055 * libm::pow(value, 1.0 / 2.4) - 0.055
        };
        (255.0 * screen + 0.5) as u8
    };
    light.map(byte).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lightness and opponents of Oklab, by the forward matrices of the same source.
    fn oklab(c: Rgb) -> Vec3 {
        let l = libm::cbrt(0.412_221_470_8 * c.x + 0.536_332_536_3 * c.y + 0.051_445_992_9 * c.z);
        let m = libm::cbrt(0.211_903_498_2 * c.x + 0.680_699_545_1 * c.y + 0.107_396_956_6 * c.z);
        let s = libm::cbrt(0.088_302_461_9 * c.x + 0.281_718_837_6 * c.y + 0.629_978_700_5 * c.z);
        Vec3::new(
            0.210_454_255_3 * l + 0.793_617_785_0 * m - 0.004_072_046_8 * s,
            1.977_998_495_1 * l - 2.428_592_205_0 * m + 0.450_593_709_9 * s,
            0.025_904_037_1 * l + 0.782_771_766_2 * m - 0.808_675_766_0 * s,
        )
    }

    #[track_caller]
    fn check_even(colours: &[Rgb]) {
        let steps: Vec<Vec3> = colours
            .windows(2)
            .map(|w| oklab(w[1]) - oklab(w[0]))
            .collect();
        let seen: Vec<f64> = steps.iter().map(Vec3::norm).collect();
        let (least, most) = seen
            .iter()
            .fold((f64::INFINITY, 0.0_f64), |(a, b), &x| (a.min(x), b.max(x)));
        assert!(most < 1.6 * least, "steps from {least} to {most}");
        let lightness = steps[0].x;
        assert!(steps.iter().all(|step| (step.x - lightness).abs() < 1e-6));
        let shown = |c: &Rgb| c.iter().all(|x| (-0.003..=1.0).contains(x));
        assert!(
            colours.iter().all(shown),
            "outside what screens show: {colours:?}"
        );
    }

    #[test]
    fn equal_steps_of_value_look_equal_and_lightness_keeps_order() {
        let step = |k: i32| f64::from(k) / 32.0;
        check_even(&(0..=32).map(|k| sequential(step(k))).collect::<Vec<_>>());
        check_even(&(0..=32).map(|k| diverging(step(k))).collect::<Vec<_>>());
        check_even(&(0..=32).map(|k| diverging(-step(k))).collect::<Vec<_>>());
    }

    #[test]
    fn screens_colours_read_back() {
        for byte in 0..=255 {
            let screen = [byte, 255 - byte, byte / 2];
            assert_eq!(to_srgb(from_srgb(screen)), screen);
        }
        assert_eq!(to_srgb(Rgb::new(-1.0, 2.0, f64::NAN)), [0, 255, 0]);
    }
}
