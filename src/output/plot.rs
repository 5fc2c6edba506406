//! A plot of measured and computed curves, as SVG text.

use plotters::{
    chart::{ChartBuilder, ChartContext, SeriesLabelPosition},
    coord::{Shift, types::RangedCoordf64},
    element::{Circle, Cross, DynElement, IntoDynElement, PathElement},
    prelude::{Cartesian2d, DrawingArea, IntoDrawingArea, SVGBackend},
    style::{Color, RGBColor, ShapeStyle, WHITE},
};
use std::{error::Error, ops::Range};

/// What a plot shows. Both axes begin or end at 0, or have it between their ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// Stands above it.
    pub title: String,
    /// What runs to the right, with its unit.
    pub x_label: String,
    /// What runs upward, with its unit.
    pub y_label: String,
    /// What is drawn, the first one undermost.
    pub series: Vec<Series>,
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What the legend calls them.
    pub name: String,
    /// How they are drawn.
    pub mark: Mark,
    /// Where they are, in the units of the axes. One that is not finite, or beyond 1e30, is left
    /// out.
    pub points: Vec<[f64; 2]>,
}

/// How the points of a series are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Joined, in their order.
    Line,
    /// Filled dots.
    Dots,
    /// Hollow dots.
    Rings,
    /// Crosses.
    Crosses,
}

/// Width and height [pixels].
const SIZE: (u32, u32) = (800, 560);

/// Colours that people with any colour vision tell apart (Okabe and Ito, *Color Universal Design*,
/// 2008), in the order of the series.
const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The plot as SVG text, of the same bytes each time.
#[must_use]
pub fn plot(plot: &Plot) -> String {
    let mut svg = String::new();
    let area = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
    // A drawing in memory meets no fault of the system's.
    let _ = draw(plot, &area);
    drop(area);
    svg
}

fn draw(plot: &Plot, area: &Area<'_>) -> Result<(), Box<dyn Error>> {
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(area)
        .caption(&plot.title, ("sans-serif", 20))
        .margin(14)
        .x_label_area_size(46)
        .y_label_area_size(72)
        .build_cartesian_2d(span(plot, 0), span(plot, 1))?;
    let (x_number, y_number) = (numbers(span(plot, 0)), numbers(span(plot, 1)));
    chart
        .configure_mesh()
        .max_light_lines(1)
        .max_light_lines(1)
        .bold_line_style(RGBColor(225, 225, 225))
        .x_desc(&plot.x_label)
        .y_desc(&plot.y_label)
        .x_label_formatter(&|value| x_number(*value))
        .y_label_formatter(&|value| y_number(*value))
        .label_style(("sans-serif", 14))
        .draw()?;
    for (series, colour) in plot.series.iter().zip(COLOURS.iter().cycle()) {
        draw_series(&mut chart, series, *colour)?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE.mix(0.85))
        .border_style(RGBColor(190, 190, 190))
        .label_font(("sans-serif", 14))
        .draw()?;
    area.present()?;
    Ok(())
}

fn draw_series<'a>(
    chart: &mut Chart<'a, 'a>,
    series: &Series,
    colour: RGBColor,
) -> Result<(), Box<dyn Error>> {
    let mark = series.mark;
    let points: Vec<(f64, f64)> = drawn(series).map(|[x, y]| (x, y)).collect();
    let shapes: Vec<DynElement<'_, SVGBackend<'_>, (f64, f64)>> = match mark {
        Mark::Line => vec![PathElement::new(points, colour.stroke_width(2)).into_dyn()],
        Mark::Dots => each(points, |at| Circle::new(at, 3, colour.filled()).into_dyn()),
        Mark::Rings => each(points, |at| Circle::new(at, 3, thin(colour)).into_dyn()),
        Mark::Crosses => each(points, |at| Cross::new(at, 4, thin(colour)).into_dyn()),
    };
    chart
        .draw_series(shapes)?
        .label(&series.name)
        .legend(move |(x, y)| match mark {
            Mark::Line => {
                PathElement::new(vec![(x, y), (x + 20, y)], colour.stroke_width(2)).into_dyn()
            }
            Mark::Dots => Circle::new((x + 10, y), 4, colour.filled()).into_dyn(),
            Mark::Rings => Circle::new((x + 10, y), 4, thin(colour)).into_dyn(),
            Mark::Crosses => Cross::new((x + 10, y), 5, thin(colour)).into_dyn(),
        });
    Ok(())
}

fn each<P, E>(points: Vec<P>, shape: impl Fn(P) -> E) -> Vec<E> {
    points.into_iter().map(shape).collect()
}

fn thin(colour: RGBColor) -> ShapeStyle {
    colour.stroke_width(2)
}

fn drawn(series: &Series) -> impl Iterator<Item = [f64; 2]> + '_ {
    let near = |point: &&[f64; 2]| point.iter().all(|value| value.abs() <= 1e30);
    series.points.iter().filter(near).copied()
}

/// The ends of an axis: those of the points and 0, and a little beyond.
fn span(plot: &Plot, axis: usize) -> Range<f64> {
    let values = plot.series.iter().flat_map(drawn).map(|point| point[axis]);
    let (low, high) = values.fold((0.0_f64, 0.0_f64), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    // Below this there is nothing to see, and ticks would coincide.
    if high - low < 1e-30 {
        return 0.0..1.0;
    }
    let beyond = 0.04 * (high - low);
    let below = if low < 0.0 { beyond } else { 0.0 };
    let above = if high > 0.0 { beyond } else { 0.0 };
    low - below..high + above
}

/// Writes the numbers of an axis: as many decimals as its ticks need, powers of ten where that
/// would be long.
fn numbers(span: Range<f64>) -> impl Fn(f64) -> String {
    let size = span.end - span.start;
    let decimals = (1.0 - libm::log10(size)).ceil().clamp(0.0, 6.0) as usize;
    let plain = (1e-4..1e6).contains(&size);
    move |value| {
        if value.abs() < 1e-9 * size {
            "0".to_owned()
        } else if plain {
            format!("{value:.decimals$}")
        } else {
            format!("{value:.1e}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(mark: Mark, points: &[[f64; 2]]) -> Series {
        Series {
            name: format!("{mark:?} & co"),
            mark,
            points: points.to_vec(),
        }
    }

    fn sample(points: &[[f64; 2]]) -> Plot {
        let marks = [Mark::Line, Mark::Dots, Mark::Rings, Mark::Crosses];
        Plot {
            title: "Cloth <C>, warp".into(),
            x_label: "strain [%]".into(),
            y_label: "tension [gf/cm]".into(),
            series: marks.map(|mark| series(mark, points)).to_vec(),
        }
    }

    #[test]
    fn it_is_whole_and_says_what_its_axes_are() {
        let svg = plot(&sample(&[[0.0, 0.0], [1.0, 2.0], [2.0, 7.5]]));
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
        for part in [
            "Cloth &lt;C&gt;, warp",
            "strain [%]",
            "tension [gf/cm]",
            "Dots &amp; co",
        ] {
            assert!(svg.contains(part), "without {part}:\n{svg}");
        }
        // Three dots, three rings, and one of each in the legend.
        assert_eq!(svg.matches("<circle").count(), 8);
        assert_eq!(svg, plot(&sample(&[[0.0, 0.0], [1.0, 2.0], [2.0, 7.5]])));
    }

    #[test]
    fn points_that_cannot_be_drawn_are_left_out() {
        let wild = [
            [f64::NAN, 1.0],
            [1.0, f64::INFINITY],
            [1e300, -1e300],
            [1.0, 2.0],
        ];
        assert_eq!(plot(&sample(&wild)), plot(&sample(&[[1.0, 2.0]])));
    }

    #[test]
    fn any_scale_is_drawn() {
        for size in [0.0, 1e-300, 1e-29, 1e-6, 0.03, 140.0, 1e7, 1e30, -2.0] {
            let svg = plot(&sample(&[[size, size], [0.5 * size, 0.0]]));
            assert!(svg.trim_end().ends_with("</svg>"), "{size}");
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{size}");
        }
        assert!(plot(&Plot::default()).trim_end().ends_with("</svg>"));
    }

    #[test]
    fn ticks_have_the_decimals_they_need() {
        assert_eq!(numbers(0.0..0.05)(0.015), "0.015");
        assert_eq!(numbers(0.0..0.05)(-1e-18), "0");
        assert_eq!(numbers(0.0..140.0)(20.0), "20");
        assert_eq!(numbers(0.0..3e8)(1.5e8), "1.5e8");
    }
}
