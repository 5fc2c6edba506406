//! Pictures are compared as people do: not by the last bit.

use std::{env, fs, io::Cursor, path::Path};

/// How much a channel of a pixel may differ, of 255.
const CHANNEL: u8 = 8;
/// Share of the pixels that may differ by more: an edge that moved by a part of a pixel.
const PIXELS: f64 = 1e-3;

/// Compares a PNG with `snapshots/<name>.png`. Where they differ, the new one is left in the
/// folder for tests' files under `target`; `INSTA_UPDATE=always` takes it over, as for texts.
pub(crate) fn assert_picture(name: &str, png: &[u8]) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots");
    let reference = folder.join(format!("{name}.png"));
    let difference = match fs::read(&reference) {
        Ok(old) => difference(&old, png),
        Err(error) => Some(error.to_string()),
    };
    let Some(difference) = difference else {
        return;
    };
    if env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        fs::write(reference, png).unwrap();
        return;
    }
    let new = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.png"));
    fs::write(&new, png).unwrap();
    panic!(
        "{} is not {}: {difference}",
        new.display(),
        reference.display()
    );
}

/// What differs, in words.
fn difference(old: &[u8], new: &[u8]) -> Option<String> {
    let ((old_size, old), (new_size, new)) = (pixels(old), pixels(new));
    if old_size != new_size {
        return Some(format!("{new_size:?} pixels, not {old_size:?}"));
    }
    let (old, new) = (old.chunks_exact(3), new.chunks_exact(3));
    let far = |(old, new): &(&[u8], &[u8])| {
        let mut channels = old.iter().zip(*new);
        channels.any(|(a, b)| a.abs_diff(*b) > CHANNEL)
    };
    let count = old.len();
    let share = old.zip(new).filter(far).count() as f64 / count as f64;
    (share > PIXELS).then(|| format!("{:.2} % of the pixels differ", 100.0 * share))
}

/// Width, height and the channels of an RGB picture.
pub(crate) fn pixels(png: &[u8]) -> ([u32; 2], Vec<u8>) {
    let mut reader = png::Decoder::new(Cursor::new(png)).read_info().unwrap();
    let mut channels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut channels).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb);
    ([info.width, info.height], channels)
}

#[test]
fn a_difference_that_is_seen_is_told() {
    let png = |size: u32, change: &dyn Fn(&mut [u8])| {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, size, size);
        encoder.set_color(png::ColorType::Rgb);
        let mut channels = vec![100; 3 * (size * size) as usize];
        change(&mut channels);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&channels).unwrap();
        writer.finish().unwrap();
        bytes
    };
    let old = png(100, &|_| {});
    assert_eq!(difference(&old, &png(100, &|all| all.fill(108))), None);
    assert_eq!(difference(&old, &png(100, &|all| all[..30].fill(0))), None);
    assert!(difference(&old, &png(100, &|all| all.fill(109))).is_some());
    assert!(difference(&old, &png(100, &|all| all[..33].fill(91))).is_some());
    assert!(difference(&old, &png(99, &|_| {})).is_some());
}
