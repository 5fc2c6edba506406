//! Pictures side by side on one sheet.

use super::png::Image;

/// Between pictures [pixels].
const GAP: usize = 4;
const PAPER: [u8; 3] = [255; 3];

/// Pictures in rows of so many, from the upper left, on white; a PNG file. Every place is as wide
/// and high as the largest picture. Empty for no pictures.
pub fn contact_sheet(pictures: &[Image], columns: usize) -> Vec<u8> {
    let columns = columns.clamp(1, pictures.len().max(1));
    let rows = pictures.len().div_ceil(columns);
    let most = |size: fn(&Image) -> u32| pictures.iter().map(size).max().unwrap_or(0) as usize;
    let place = [most(|p| p.width), most(|p| p.height)];
    let all = |count: usize, place: usize| (count * (place + GAP)).saturating_sub(GAP);
    let (width, height) = (all(columns, place[0]), all(rows, place[1]));
    let mut sheet = Image {
        width: width as u32,
        height: height as u32,
        pixels: vec![PAPER; width * height],
    };
    for (index, picture) in pictures.iter().enumerate() {
        let left = index % columns * (place[0] + GAP);
        let top = index / columns * (place[1] + GAP);
        let rows = picture.pixels.chunks(picture.width.max(1) as usize);
        for (down, row) in rows.take(picture.height as usize).enumerate() {
            let start = (top + down) * width + left;
            if let Some(line) = sheet.pixels.get_mut(start..start + row.len()) {
                line.copy_from_slice(row);
            }
        }
    }
    sheet.to_png()
}
