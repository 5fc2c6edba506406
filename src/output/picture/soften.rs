//! Light, averaged over a period of the lamp's pattern between neighbours on one surface.

use super::{Met, Sample, lamp::PERIOD, rows};

/// Replaces each sample's shares of lamp and sky by their means over the samples around it that
/// lie on the same surface. Where all of them do, each place in the pattern counts once.
///
/// On the floor, far from what casts the shadow, the lamp's points are seen one by one as streaks;
/// there a second mean is taken, twice as wide.
pub(super) fn soften(samples: &mut [Sample], width: usize) {
    for (stride, all) in [(1, true), (2, false)] {
        let softened =
            |sample: &Sample| sample.on == Met::Floor || (all && sample.on != Met::Nothing);
        let height = samples.len() / width.max(1);
        let row = |y| {
            let own = samples.get(y * width..(y + 1) * width).unwrap_or_default();
            let light = |(x, sample): (usize, &Sample)| {
                softened(sample).then(|| mean(samples, width, [x, y], stride))
            };
            own.iter().enumerate().map(light).collect()
        };
        let light = rows(height, row);
        for (sample, light) in samples.iter_mut().zip(light) {
            if let Some([lamp, sky]) = light {
                (sample.lamp, sample.sky) = (lamp, sky);
            }
        }
    }
}

fn mean(samples: &[Sample], width: usize, [x, y]: [usize; 2], stride: usize) -> [f32; 2] {
    let Some(own) = samples.get(y * width + x) else {
        return [0.0; 2];
    };
    let reach = stride * PERIOD / 2;
    let (left, right) = (x.saturating_sub(reach), (x + reach).min(width));
    let [mut lamp, mut sky, mut count] = [0.0_f32; 3];
    for row in (y.saturating_sub(reach)..y + reach).step_by(stride) {
        let around = samples
            .get(row * width + left..row * width + right)
            .unwrap_or_default();
        for other in around.chunks(stride).map(|few| &few[0]) {
            if same_surface(own, other) {
                lamp += other.lamp;
                sky += other.sky;
                count += 1.0;
            }
        }
    }
    if count > 0.0 {
        [lamp / count, sky / count]
    } else {
        [own.lamp, own.sky]
    }
}

/// Whether two samples lie on one smooth piece: met alike, facing alike, and as deep as the slope
/// between neighbours allows.
fn same_surface(a: &Sample, b: &Sample) -> bool {
    // Written out: this is asked a hundred times a sample.
    let ([ax, ay, az], [bx, by, bz]) = (a.normal, b.normal);
    let as_deep = (a.depth - b.depth).abs() < 0.02 * a.depth;
    a.on == b.on && as_deep && ax * bx + ay * by + az * bz > 0.85
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall(width: usize, height: usize) -> Vec<Sample> {
        let at = |k: usize| Sample {
            on: if k % width < 10 {
                Met::Body
            } else {
                Met::Cloth
            },
            normal: [0.0, 0.0, 1.0],
            depth: 100.0,
            lamp: ((k % 2) ^ (k / width % 2)) as f32,
            sky: 0.25,
            ..Sample::default()
        };
        (0..width * height).map(at).collect()
    }

    #[test]
    fn a_pattern_becomes_its_mean() {
        let mut samples = wall(40, 20);
        soften(&mut samples, 40);
        let middle = samples[10 * 40 + 20];
        assert_eq!((middle.lamp, middle.sky), (0.5, 0.25));
    }

    #[test]
    fn light_does_not_leak_between_surfaces() {
        let mut samples = wall(40, 20);
        for sample in &mut samples {
            sample.lamp = if sample.on == Met::Body { 1.0 } else { 0.0 };
        }
        let before: Vec<f32> = samples.iter().map(|sample| sample.lamp).collect();
        soften(&mut samples, 40);
        assert_eq!(
            samples.iter().map(|sample| sample.lamp).collect::<Vec<_>>(),
            before
        );
    }
}
