//! Lettering: a type case of dots, 5 wide and 7 high with two rows below the line, written with a
//! round pen from dot to dot.

use crate::output::png::Image;

/// Rows of dots in a glyph.
const ROWS: usize = 9;

/// Writes a line of text, its upper left corner at `(x, y)` [pixels]; dots stand `scale` pixels
/// apart. What the type case lacks is left blank.
pub(super) fn write(image: &mut Image, text: &str, [x, y]: [f64; 2], scale: f64, ink: [u8; 3]) {
    let mut left = x;
    for letter in text.chars() {
        let glyph = Glyph::of(letter);
        let from = [left - scale * glyph.start, y];
        ink_strokes(image, &glyph.strokes(), from, scale, ink);
        left += scale * glyph.advance;
    }
}

/// Width of a line of text [pixels].
pub(super) fn width(text: &str, scale: f64) -> f64 {
    scale
        * text
            .chars()
            .map(|letter| Glyph::of(letter).advance)
            .sum::<f64>()
}

/// A stroke of the pen between two dots (across, down).
type Stroke = [[f64; 2]; 2];

/// A letter as dots.
struct Glyph {
    rows: [[bool; 5]; ROWS],
    /// First column that has a dot.
    start: f64,
    /// Columns to the next letter.
    advance: f64,
}

impl Glyph {
    fn of(letter: char) -> Self {
        let rows = dots(letter).unwrap_or_default();
        let inked = |column: usize| rows.iter().any(|row| row.get(column) == Some(&true));
        let start = (0..5).find(|&column| inked(column));
        let end = (0..5).rev().find(|&column| inked(column));
        match start.zip(end) {
            // Figures keep their width, so that columns of them stand in line.
            Some((start, end)) if !letter.is_ascii_digit() => Self {
                rows,
                start: start as f64,
                advance: (end - start) as f64 + 2.0,
            },
            Some(_) => Self {
                rows,
                start: 0.0,
                advance: 6.0,
            },
            None => Self {
                rows,
                start: 0.0,
                advance: 3.5,
            },
        }
    }

    fn dot(&self, column: usize, row: usize) -> bool {
        self.rows
            .get(row)
            .and_then(|row| row.get(column))
            .copied()
            .unwrap_or(false)
    }

    /// Dots beside each other are joined, and across a corner where nothing else joins them.
    fn strokes(&self) -> Vec<Stroke> {
        let mut strokes = Vec::new();
        for (row, column) in (0..ROWS).flat_map(|row| (0..5).map(move |column| (row, column))) {
            if !self.dot(column, row) {
                continue;
            }
            let from = [column as f64, row as f64];
            strokes.push([from, from]);
            let (right, below) = (self.dot(column + 1, row), self.dot(column, row + 1));
            let left = column > 0 && self.dot(column - 1, row);
            let below_left = column > 0 && self.dot(column - 1, row + 1);
            let below_right = self.dot(column + 1, row + 1);
            let mut join = |there: bool, across: f64, down: f64| {
                if there {
                    strokes.push([from, [from[0] + across, from[1] + down]]);
                }
            };
            join(right, 1.0, 0.0);
            join(below, 0.0, 1.0);
            join(below_right && !right && !below, 1.0, 1.0);
            join(below_left && !left && !below, -1.0, 1.0);
        }
        strokes
    }
}

/// Draws strokes with a round pen whose edge is smooth.
fn ink_strokes(image: &mut Image, strokes: &[Stroke], [x, y]: [f64; 2], scale: f64, ink: [u8; 3]) {
    let pen = 0.46 * scale;
    let (columns, rows) = ((7.0 * scale) as i64, ((ROWS as f64 + 2.0) * scale) as i64);
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let (px, py) = ((x - scale) as i64 + column, (y - scale) as i64 + row);
        let at = [
            (px as f64 + 0.5 - x) / scale - 0.5,
            (py as f64 + 0.5 - y) / scale - 0.5,
        ];
        let nearest = strokes
            .iter()
            .map(|stroke| distance(at, *stroke))
            .fold(f64::MAX, f64::min);
        image.blend(px, py, ink, pen - scale * nearest + 0.5);
    }
}

/// Distance of a point from a stroke.
fn distance([x, y]: [f64; 2], [from, to]: Stroke) -> f64 {
    let (across, down) = (to[0] - from[0], to[1] - from[1]);
    let length = f64::max(across * across + down * down, 1e-9);
    let t = (((x - from[0]) * across + (y - from[1]) * down) / length).clamp(0.0, 1.0);
    let (dx, dy) = (x - from[0] - t * across, y - from[1] - t * down);
    libm::sqrt(dx * dx + dy * dy)
}

/// Finds a letter in the type case.
fn dots(letter: char) -> Option<[[bool; 5]; ROWS]> {
    let lines: Vec<&str> = TYPE_CASE.trim_matches('\n').lines().collect();
    let (band, place) = lines.chunks(ROWS + 1).find_map(|band| {
        let place = band
            .first()?
            .chars()
            .position(|c| c == letter && c != ' ')?;
        Some((band, place))
    })?;
    Some(std::array::from_fn(|row| {
        let line = band.get(row + 1).copied().unwrap_or_default().as_bytes();
        std::array::from_fn(|column| line.get(place + column) == Some(&b'#'))
    }))
}

/// Bands of a line of names over nine rows of dots.
const TYPE_CASE: &str = r##"
!     "     #     $     %     &     '     (     )     *     +     ,     -     .
..#.. .#.#. .#.#. ..#.. ##..# .##.. ..#.. ...#. .#... ..... ..... ..... ..... .....
..#.. .#.#. .#.#. .#### ##.#. #..#. ..#.. ..#.. ..#.. #.#.# ..#.. ..... ..... .....
..#.. ..... ##### #.#.. ...#. #.#.. ..... .#... ...#. .###. ..#.. ..... ..... .....
..#.. ..... .#.#. .###. ..#.. .#... ..... .#... ...#. ##### ##### ..... .###. .....
..#.. ..... ##### ..#.# .#... #.#.# ..... .#... ...#. .###. ..#.. ..... ..... .....
..... ..... .#.#. ####. .#.## #..#. ..... ..#.. ..#.. #.#.# ..#.. ..... ..... .....
..#.. ..... .#.#. ..#.. #..## .##.# ..... ...#. .#... ..... ..... ..#.. ..... ..#..
..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..#.. ..... .....
..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... .#... ..... .....
/     0     1     2     3     4     5     6     7     8     9     :     ;     <
....# .###. ..#.. .###. .###. ...#. ##### .###. ##### .###. .###. ..... ..... ....#
....# #...# .##.. #...# #...# ..##. #.... #.... ....# #...# #...# ..... ..... ...#.
...#. #...# ..#.. ....# ....# .#.#. ####. #.... ...#. #...# #...# ..#.. ..#.. ..#..
..#.. #...# ..#.. ...#. ..##. #..#. ....# ####. ...#. .###. .#### ..... ..... .#...
.#... #...# ..#.. ..#.. ....# ##### ....# #...# ..#.. #...# ....# ..... ..... ..#..
#.... #...# ..#.. .#... #...# ...#. #...# #...# ..#.. #...# ....# ..... ..... ...#.
#.... .###. .###. ##### .###. ...#. .###. .###. ..#.. .###. .###. ..#.. ..#.. ....#
..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..#.. .....
..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... .#... .....
=     >     ?     @     A     B     C     D     E     F     G     H     I     J
..... #.... .###. .###. .###. ####. .###. ####. ##### ##### .###. #...# .###. ....#
..... .#... #...# #...# #...# #...# #...# #...# #.... #.... #...# #...# ..#.. ....#
##### ..#.. ....# #.### #...# #...# #.... #...# #.... #.... #.... #...# ..#.. ....#
..... ...#. ...#. #.#.# #...# ####. #.... #...# ####. ####. #.### ##### ..#.. ....#
##### ..#.. ..#.. #.### ##### #...# #.... #...# #.... #.... #...# #...# ..#.. ....#
..... .#... ..... #.... #...# #...# #...# #...# #.... #.... #...# #...# ..#.. #...#
..... #.... ..#.. .###. #...# ####. .###. ####. ##### #.... .###. #...# .###. .###.
..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... .....
..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... .....
K     L     M     N     O     P     Q     R     S     T     U     V     W     X
#...# #.... #...# #...# .###. ####. .###. ####. .#### ##### #...# #...# #...# #...#
#..#. #.... ##.## ##..# #...# #...# #...# #...# #.... ..#.. #...# #...# #...# #...#
#.#.. #.... #.#.# #.#.# #...# #...# #...# #...# #.... ..#.. #...# #...# #...# .#.#.
##... #.... #...# #.#.# #...# ####. #...# ####. .###. ..#.. #...# #...# #...# ..#..
#.#.. #.... #...# #.#.# #...# #.... #.#.# #.#.. ....# ..#.. #...# .#.#. #.#.# .#.#.
#..#. #.... #...# #..## #...# #.... #..#. #..#. ....# ..#.. #...# .#.#. ##.## #...#
#...# ##### #...# #...# .###. #.... .##.# #...# ####. ..#.. .###. ..#.. #...# #...#
..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... .....
..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... .....
Y     Z     [     \     ]     ^     _     `     a     b     c     d     e     f
#...# ##### .##.. #.... ..##. ..#.. ..... .#... ..... #.... ..... ....# ..... ..##.
#...# ....# .#... #.... ...#. .#.#. ..... ..#.. ..... #.... ..... ....# ..... .#...
.#.#. ...#. .#... .#... ...#. #...# ..... ..... .###. ####. .#### .#### .###. ####.
..#.. ..#.. .#... ..#.. ...#. ..... ..... ..... ....# #...# #.... #...# #...# .#...
..#.. .#... .#... ...#. ...#. ..... ..... ..... .#### #...# #.... #...# ##### .#...
..#.. #.... .#... ....# ...#. ..... ..... ..... #...# #...# #.... #...# #.... .#...
..#.. ##### .##.. ....# ..##. ..... ##### ..... .#### ####. .#### .#### .#### .#...
..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... .....
..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... .....
g     h     i     j     k     l     m     n     o     p     q     r     s     t
..... #.... ..#.. ...#. #.... .#... ..... ..... ..... ..... ..... ..... ..... .#...
..... #.... ..... ..... #.... .#... ..... ..... ..... ..... ..... ..... ..... .#...
.#### ####. ..#.. ...#. #..#. .#... ##.#. ####. .###. ####. .#### #.##. .#### ####.
#...# #...# ..#.. ...#. #.#.. .#... #.#.# #...# #...# #...# #...# ##..# #.... .#...
#...# #...# ..#.. ...#. ##... .#... #.#.# #...# #...# #...# #...# #.... .###. .#...
#...# #...# ..#.. ...#. #.#.. .#... #.#.# #...# #...# #...# #...# #.... ....# .#...
.#### #...# ..#.. ...#. #..#. ..#.. #.#.# #...# .###. ####. .#### #.... ####. ..##.
....# ..... ..... ...#. ..... ..... ..... ..... ..... #.... ....# ..... ..... .....
.###. ..... ..... .##.. ..... ..... ..... ..... ..... #.... ....# ..... ..... .....
u     v     w     x     y     z     {     |     }     ~     °
..... ..... ..... ..... ..... ..... ...#. ..#.. .#... ..... .###.
..... ..... ..... ..... ..... ..... ..#.. ..#.. ..#.. ..... .#.#.
#...# #...# #...# #...# #...# ##### ..#.. ..#.. ..#.. .#..# .###.
#...# #...# #...# .#.#. #...# ...#. .#... ..#.. ...#. #.#.# .....
#...# .#.#. #.#.# ..#.. #...# ..#.. ..#.. ..#.. ..#.. #..#. .....
#...# .#.#. #.#.# .#.#. #...# .#... ..#.. ..#.. ..#.. ..... .....
.#### ..#.. .#.#. #...# .#### ##### ...#. ..#.. .#... ..... .....
..... ..... ..... ..... ....# ..... ..... ..... ..... ..... .....
..... ..... ..... ..... .###. ..... ..... ..... ..... ..... .....
"##;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_printable_letter_has_a_shape_of_its_own() {
        let letters: Vec<char> = ('!'..='~').chain(['°']).collect();
        let shapes: Vec<_> = letters
            .iter()
            .map(|&letter| dots(letter).unwrap())
            .collect();
        for (k, shape) in shapes.iter().enumerate() {
            assert!(shape.as_flattened().contains(&true), "{}", letters[k]);
            // Nought and O are drawn alike, as on old typewriters.
            let twin = shapes[..k].iter().position(|other| other == shape);
            let alike = twin.map(|twin| (letters[twin], letters[k]));
            assert!(alike.is_none_or(|pair| pair == ('0', 'O')), "{alike:?}");
        }
        assert_eq!(dots(' '), None);
        assert_eq!(dots('布'), None);
    }

    #[test]
    fn a_letter_is_drawn_where_it_is_asked_for() {
        let mut image = Image {
            width: 40,
            height: 40,
            pixels: vec![[255; 3]; 1600],
        };
        write(&mut image, "-", [10.0, 10.0], 2.0, [0; 3]);
        let dark = |k: &usize| image.pixels[*k][0] < 128;
        let inked: Vec<(usize, usize)> = (0..1600).filter(dark).map(|k| (k % 40, k / 40)).collect();
        // Three dots from the left in the fourth row, each 2 × 2 pixels.
        let expected: Vec<(usize, usize)> = (16..18)
            .flat_map(|y| (10..16).map(move |x| (x, y)))
            .collect();
        assert_eq!(inked, expected);
    }

    #[test]
    fn text_beyond_the_picture_is_cut_off() {
        let mut image = Image {
            width: 9,
            height: 9,
            pixels: vec![[255; 3]; 81],
        };
        write(&mut image, "###", [-20.0, 5.0], 3.0, [0; 3]);
        assert!(image.pixels.contains(&[0; 3]) && width("0 0", 2.0) == 31.0);
    }
}
