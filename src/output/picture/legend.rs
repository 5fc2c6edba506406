//! The legend of a heat map, and a line at the foot of a picture.

use super::glyphs::{width, write};
use crate::output::{HeatMap, colour::to_srgb, heat::Scale, png::Image};

const INK: [u8; 3] = [44, 46, 52];

/// Draws a bar of the map's colours at the right, with title, unit, ticks at round numbers, and
/// the range of all values.
pub(super) fn draw(image: &mut Image, heat: &HeatMap) {
    let scale = heat.scale();
    let bar = Bar::new(image);
    bar.fill(image, &scale);
    bar.ticks(image, &scale);
    let title = format!("{} [{}]", heat.map.title(), heat.map.unit());
    let letter = bar
        .letter
        .min(0.26 * f64::from(image.width) / width(&title, 1.0));
    // Kept off the right margin, a title longer than bar and figures moves to the left.
    let right = f64::from(image.width) - bar.letter * 6.0;
    let left = bar.left.min(right - width(&title, letter));
    write(
        image,
        &title,
        [left, bar.top - 14.0 * bar.letter],
        letter,
        INK,
    );
    if let Some((least, most)) = heat.extremes() {
        let digits = digits(&scale) + 1;
        let range = format!("{} to {}", number(least, digits), number(most, digits));
        let left = bar.left.min(right - width(&range, 0.8 * bar.letter));
        write(
            image,
            &range,
            [left, bar.bottom + 7.0 * bar.letter],
            0.8 * bar.letter,
            INK,
        );
    }
}

/// Writes a line at the foot of the picture.
pub(super) fn caption(image: &mut Image, text: &str) {
    let letter = letter(image);
    let room = 0.92 * f64::from(image.width) / width(text, 1.0).max(1.0);
    let at = [
        0.04 * f64::from(image.width),
        f64::from(image.height) - 16.0 * letter,
    ];
    write(image, text, at, letter.min(room), INK);
}

/// Between the dots of letters [pixels]: letters 1/43 of the height.
fn letter(image: &Image) -> f64 {
    f64::from(image.height) / 300.0
}

/// Where the bar is [pixels].
struct Bar {
    left: f64,
    width: f64,
    top: f64,
    bottom: f64,
    letter: f64,
}

impl Bar {
    fn new(image: &Image) -> Self {
        let (width, height) = (f64::from(image.width), f64::from(image.height));
        Self {
            left: 0.80 * width,
            width: 0.024 * width,
            top: 0.24 * height,
            bottom: 0.76 * height,
            letter: letter(image),
        }
    }

    fn fill(&self, image: &mut Image, scale: &Scale) {
        let span = scale.end() - scale.start();
        for y in self.top as i64..self.bottom as i64 {
            let share = (self.bottom - (y as f64 + 0.5)) / (self.bottom - self.top);
            let colour = to_srgb(scale.colour(scale.start() + span * share));
            for x in self.left as i64..(self.left + self.width) as i64 {
                image.blend(x, y, colour, 1.0);
            }
        }
    }

    fn ticks(&self, image: &mut Image, scale: &Scale) {
        let steps = i64::from(scale.steps);
        let first = if scale.signed { -steps } else { 0 };
        let right = self.left + self.width;
        for tick in first..=steps {
            let share = (tick - first) as f64 / (steps - first) as f64;
            let y = self.bottom - share * (self.bottom - self.top);
            let thick = (0.6 * self.letter).max(1.0);
            for (row, x) in (0..thick as i64)
                .flat_map(|row| (0..(2.5 * self.letter) as i64).map(move |x| (row, x)))
            {
                image.blend(right as i64 + x, (y - 0.5 * thick) as i64 + row, INK, 1.0);
            }
            let text = number(tick as f64 * scale.step, digits(scale));
            write(
                image,
                &text,
                [right + 5.0 * self.letter, y - 3.5 * self.letter],
                self.letter,
                INK,
            );
        }
    }
}

/// Decimals that tell the ticks of a scale apart.
fn digits(scale: &Scale) -> usize {
    (-libm::floor(libm::log10(scale.step) + 1e-9)).max(0.0) as usize
}

/// A number with decimals, by powers of ten where that would be long.
fn number(value: f64, digits: usize) -> String {
    if digits > 4 || value.abs() >= 1e6 {
        return format!("{value:.1e}");
    }
    let text = format!("{value:.digits$}");
    let zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if zero { text.replace('-', "") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::Map;

    #[test]
    fn numbers_are_short_and_zero_has_no_sign() {
        assert_eq!(number(-0.001, 2), "0.00");
        assert_eq!(number(-0.25, 2), "-0.25");
        assert_eq!(number(20.0, 0), "20");
        assert_eq!(number(3.2e-7, 8), "3.2e-7");
        assert_eq!(number(2.0e7, 0), "2.0e7");
    }

    #[test]
    fn ticks_have_as_many_decimals_as_they_need() {
        let digits = |step| {
            digits(&Scale {
                signed: false,
                step,
                steps: 4,
            })
        };
        assert_eq!(
            [5.0, 1.0, 0.5, 0.1, 0.02, 0.001].map(digits),
            [0, 0, 1, 1, 2, 3]
        );
    }

    #[test]
    fn the_bar_shows_the_colours_of_its_ends() {
        let mut image = Image {
            width: 1200,
            height: 900,
            pixels: vec![[255; 3]; 1200 * 900],
        };
        let heat = HeatMap {
            map: Map::StrainWarp,
            values: vec![-2.0, 1.0],
        };
        draw(&mut image, &heat);
        let at = |y: usize| image.pixels[y * 1200 + 975];
        let near = |a: [u8; 3], b: [u8; 3]| a.iter().zip(b).all(|(a, b)| a.abs_diff(b) < 3);
        assert!(
            near(at(217), to_srgb(heat.scale().colour(2.0))),
            "{:?}",
            at(217)
        );
        assert!(
            near(at(682), to_srgb(heat.scale().colour(-2.0))),
            "{:?}",
            at(682)
        );
        assert!(
            near(at(450), to_srgb(heat.scale().colour(0.0))),
            "{:?}",
            at(450)
        );
    }
}
