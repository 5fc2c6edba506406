//! PNG: pixels to bytes.

use png::{BitDepth, ColorType, Encoder, EncodingError, SrgbRenderingIntent};

/// Pixels in sRGB, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width · height` colours.
    pub pixels: Vec<[u8; 3]>,
}

impl Image {
    /// The image as a PNG file; empty for an image without pixels, which PNG cannot hold.
    #[must_use]
    pub fn to_png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        // A Vec takes all that is written, so only a size of 0 or a wrong count of pixels fails.
        if self.encode(&mut bytes).is_err() {
            bytes.clear();
        }
        bytes
    }

    /// Lays a colour over a pixel, as much of it as `share` from 0 to 1 says; outside the image,
    /// nothing.
    pub(super) fn blend(&mut self, x: i64, y: i64, colour: [u8; 3], share: f64) {
        let inside =
            (0..i64::from(self.width)).contains(&x) && (0..i64::from(self.height)).contains(&y);
        if !inside || share <= 0.0 {
            return;
        }
        let share = share.min(1.0);
        if let Some(pixel) = self
            .pixels
            .get_mut((y * i64::from(self.width) + x) as usize)
        {
            for (old, new) in pixel.iter_mut().zip(colour) {
                let mixed = f64::from(*old) + share * (f64::from(new) - f64::from(*old));
                *old = (mixed + 0.5) as u8;
            }
        }
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodingError> {
        let mut encoder = Encoder::new(bytes, self.width, self.height);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels.as_flattened())?;
        writer.finish()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Reads a PNG back.
    pub(in crate::output) fn read(bytes: &[u8]) -> Image {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
            .read_info()
            .unwrap();
        let mut buffer = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut buffer).unwrap();
        assert_eq!(
            (info.color_type, info.bit_depth),
            (ColorType::Rgb, BitDepth::Eight)
        );
        let pixels = buffer.as_chunks::<3>().0.to_vec();
        Image {
            width: info.width,
            height: info.height,
            pixels,
        }
    }

    #[test]
    fn pixels_read_back() {
        let pixels = (0..15).map(|k| [k, 17 * k, 255 - k]).collect();
        let image = Image {
            width: 5,
            height: 3,
            pixels,
        };
        assert_eq!(read(&image.to_png()), image);
    }

    #[test]
    fn nothing_comes_of_no_pixels() {
        assert!(
            Image {
                width: 0,
                height: 3,
                pixels: Vec::new()
            }
            .to_png()
            .is_empty()
        );
        assert!(
            Image {
                width: 2,
                height: 3,
                pixels: Vec::new()
            }
            .to_png()
            .is_empty()
        );
    }
}
