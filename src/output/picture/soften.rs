//! Light, averaged over a period of the lamp's pattern between neighbours on one surface.

use super::{Sample, lamp::PERIOD, rows};

/// Replaces each sample's shares of lamp and sky by their means over the samples around it that
/// lie on the same surface. Where all of them do, each place in the pattern counts once.
pub(super) fn soften(samples: &mut [Sample], width: usize) {
    let height = samples.len() / width.max(1);
    let light = rows(height, |y| {
        (0..width).map(|x| mean(samples, width, x, y)).collect()
    });
    for (sample, [lamp, sky]) in samples.iter_mut().zip(light) {
        (sample.lamp, sample.sky) = (lamp, sky);
    }
}

fn mean(samples: &[Sample], width: usize, x: usize, y: usize) -> [f32; 2] {
    let Some(own) = samples.get(y * width + x) else {
        return [0.0; 2];
    };
    if own.on == super::Met::Nothing {
        return [1.0; 2];
    }
    let (left, right) = (x.saturating_sub(PERIOD / 2), (x + PERIOD / 2).min(width));
    let [mut lamp, mut sky, mut count] = [0.0_f32; 3];
    for row in y.saturating_sub(PERIOD / 2)..y + PERIOD / 2 {
        let around = samples
            .get(row * width + left..row * width + right)
            .unwrap_or_default();
        for other in around.iter().filter(|other| same_surface(own, other)) {
            lamp += other.lamp;
            sky += other.sky;
            count += 1.0;
        }
    }
    [lamp / count, sky / count]
}

/// Whether two samples lie on one smooth piece: met alike, facing alike, and as deep as the slope
/// between neighbours allows.
fn same_surface(a: &Sample, b: &Sample) -> bool {
    let facing: f32 = a.normal.iter().zip(b.normal).map(|(a, b)| a * b).sum();
    a.on == b.on && facing > 0.85 && (a.depth - b.depth).abs() < 0.02 * a.depth
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::picture::Met;

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
