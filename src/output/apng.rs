//! A film of pictures: an animated PNG, which browsers show like a picture.

use super::png::Image;
use png::{BitDepth, ColorType, Encoder, EncodingError, SrgbRenderingIntent, Writer};
use std::collections::BTreeSet;

/// Pictures as a film that loops for ever; an animated PNG file, every pixel as it was.
///
/// All pictures must have the size of the first; those that have not are left out. Of each picture
/// only the rectangle is stored in which it differs from the one before; up to 256 colours in all go
/// by a palette where that is smaller. Empty for no pictures, and for pictures without pixels.
pub fn animated_png(pictures: &[Image], frames_per_second: u16) -> Vec<u8> {
    let Some(first) = pictures.first() else {
        return Vec::new();
    };
    let fits = |picture: &&Image| {
        let size = picture.width as usize * picture.height as usize;
        (picture.width, picture.height) == (first.width, first.height)
            && picture.pixels.len() == size
    };
    let pictures: Vec<&Image> = pictures.iter().filter(fits).collect();
    let rate = frames_per_second.max(1);
    // Only a picture without pixels fails: a Vec takes all that is written.
    let plain = encode(&pictures, rate, None).unwrap_or_default();
    let palette = palette(&pictures);
    let indexed = palette.and_then(|colours| encode(&pictures, rate, Some(&colours)).ok());
    // Of few pixels a palette is the greater part.
    let smaller = |indexed: &Vec<u8>| indexed.len() < plain.len();
    indexed.filter(smaller).unwrap_or(plain)
}

fn encode(
    pictures: &[&Image],
    rate: u16,
    palette: Option<&[[u8; 3]]>,
) -> Result<Vec<u8>, EncodingError> {
    let mut bytes = Vec::new();
    let Some(first) = pictures.first() else {
        return Ok(bytes);
    };
    let mut encoder = Encoder::new(&mut bytes, first.width, first.height);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    match palette {
        None => encoder.set_color(ColorType::Rgb),
        Some(colours) => {
            encoder.set_color(ColorType::Indexed);
            encoder.set_palette(colours.as_flattened().to_vec());
        }
    }
    encoder.set_animated(pictures.len() as u32, 0)?;
    encoder.set_frame_delay(1, rate)?;
    let mut writer = encoder.write_header()?;
    let mut before: Option<&Image> = None;
    for &picture in pictures {
        let part = before.map_or(Part::whole(picture), |old| Part::changed(old, picture));
        part.write(&mut writer, picture, palette)?;
        before = Some(picture);
    }
    writer.finish()?;
    Ok(bytes)
}

/// All colours of all pictures, in order, where a byte can tell them apart.
fn palette(pictures: &[&Image]) -> Option<Vec<[u8; 3]>> {
    let mut colours = BTreeSet::new();
    for colour in pictures.iter().flat_map(|picture| &picture.pixels) {
        if colours.insert(*colour) && colours.len() > 256 {
            return None;
        }
    }
    Some(colours.into_iter().collect())
}

/// A rectangle of a picture [pixels].
#[derive(Clone, Copy, Debug, PartialEq)]
struct Part {
    left: u32,
    top: u32,
    width: u32,
    height: u32,
}

impl Part {
    fn whole(picture: &Image) -> Self {
        Self {
            left: 0,
            top: 0,
            width: picture.width,
            height: picture.height,
        }
    }

    /// Around all pixels that differ; one pixel where none does, since a frame cannot be empty.
    fn changed(before: &Image, now: &Image) -> Self {
        let (mut low, mut high) = ([u32::MAX; 2], [0; 2]);
        let pairs = (0_u32..).zip(before.pixels.iter().zip(&now.pixels));
        for (index, _) in pairs.filter(|(_, (old, new))| old != new) {
            let at = [index % now.width, index / now.width];
            low = [low[0].min(at[0]), low[1].min(at[1])];
            high = [high[0].max(at[0]), high[1].max(at[1])];
        }
        if low[0] > high[0] {
            (low, high) = ([0; 2], [0; 2]);
        }
        Self {
            left: low[0],
            top: low[1],
            width: high[0] - low[0] + 1,
            height: high[1] - low[1] + 1,
        }
    }

    fn write(
        self,
        writer: &mut Writer<&mut Vec<u8>>,
        picture: &Image,
        palette: Option<&[[u8; 3]]>,
    ) -> Result<(), EncodingError> {
        writer.reset_frame_position()?;
        writer.set_frame_dimension(self.width, self.height)?;
        writer.set_frame_position(self.left, self.top)?;
        let rows = picture.pixels.chunks_exact(picture.width.max(1) as usize);
        let rows = rows.skip(self.top as usize).take(self.height as usize);
        let pixels = rows.flat_map(|row| {
            let row = row.iter().skip(self.left as usize);
            row.take(self.width as usize)
        });
        let bytes: Vec<u8> = match palette {
            None => pixels.flatten().copied().collect(),
            Some(colours) => pixels
                .map(|pixel| colours.binary_search(pixel).unwrap_or(0) as u8)
                .collect(),
        };
        writer.write_image_data(&bytes)
    }
}
