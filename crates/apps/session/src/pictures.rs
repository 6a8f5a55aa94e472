//! Pictures of messages: images and scans.

use std::fmt;

use periplus_grid::Line;
use periplus_images::{Layout, write_png};
use periplus_msgs::sensor_msgs::{Image, LaserScan};

/// Width and height of the picture of a scan \[px\].
const SIDE_PX: usize = 800;

const BACKGROUND_COLOUR: [u8; 3] = [250, 250, 248];
const RAY_COLOUR: [u8; 3] = [206, 222, 240];
const HIT_COLOUR: [u8; 3] = [200, 30, 40];
const ROBOT_COLOUR: [u8; 3] = [30, 60, 120];
/// Pixels of a depth image that hit nothing.
const NO_RETURN_COLOUR: [u8; 3] = [40, 60, 110];

/// Renders a scan from above as PNG, with the robot in the centre and its front up.
#[must_use]
pub fn of_scan(scan: &LaserScan) -> Vec<u8> {
    let reach_m = f64::from(scan.range_max).clamp(0.1, 1000.0);
    let middle = SIDE_PX as f64 / 2.0;
    let scale = 0.96 * middle / reach_m;
    let mut pixels = vec![BACKGROUND_COLOUR; SIDE_PX * SIDE_PX];
    let pixel = |x_m: f64, y_m: f64| {
        let place = |value: f64| value.clamp(0.0, SIDE_PX as f64 - 1.0) as usize;
        (place(middle - scale * y_m), place(middle - scale * x_m))
    };
    let beams = scan.ranges.iter().enumerate().map(|(beam, range)| {
        let angle = f64::from(scan.angle_min) + beam as f64 * f64::from(scan.angle_increment);
        let is_hit = range.is_finite() && *range <= scan.range_max && *range >= scan.range_min;
        let length = if is_hit { f64::from(*range) } else { reach_m };
        (pixel(length * libm::cos(angle), length * libm::sin(angle)), is_hit)
    });
    let beams: Vec<_> = beams.collect();
    for (end, _) in &beams {
        for (column, row) in Line::between(pixel(0.0, 0.0), *end) {
            pixels[row * SIDE_PX + column] = RAY_COLOUR;
        }
    }
    let mut dot = |(column, row): (usize, usize), radius: usize, colour: [u8; 3]| {
        for row in row.saturating_sub(radius)..=(row + radius).min(SIDE_PX - 1) {
            for column in column.saturating_sub(radius)..=(column + radius).min(SIDE_PX - 1) {
                pixels[row * SIDE_PX + column] = colour;
            }
        }
    };
    beams.iter().filter(|(_, is_hit)| *is_hit).for_each(|(end, _)| dot(*end, 2, HIT_COLOUR));
    dot(pixel(0.0, 0.0), 6, ROBOT_COLOUR);
    write_png(SIDE_PX as u32, SIDE_PX as u32, Layout::Rgb, pixels.as_flattened())
}

/// Reason for which an image cannot be drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PictureError {
    /// Encoding that is not supported.
    Encoding(String),
    /// Number of bytes that does not fit the size.
    Bytes {
        /// Number of bytes.
        bytes: usize,
        /// Width \[px\].
        width: usize,
        /// Height \[px\].
        height: usize,
        /// Encoding.
        encoding: String,
    },
}

impl fmt::Display for PictureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Encoding(encoding) => write!(f, "its encoding is `{encoding}`"),
            Self::Bytes { bytes, width, height, encoding } => {
                write!(f, "{bytes} bytes are not {width} by {height} pixels of `{encoding}`")
            }
        }
    }
}

impl std::error::Error for PictureError {}

/// Draws an image as PNG. Of depths near is dark, pixels without a return are blue.
///
/// # Errors
/// The encoding, if it is none of `rgb8`, `bgr8`, `rgba8`, `bgra8`, `mono8`, `32FC1` and `16UC1`, or a lack of bytes.
pub fn of_image(image: &Image) -> Result<Vec<u8>, PictureError> {
    let pixels: Vec<[u8; 3]> = match image.encoding.as_str() {
        "rgb8" | "8UC3" => values(image, 3, |of| [of[0], of[1], of[2]])?,
        "bgr8" => values(image, 3, |of| [of[2], of[1], of[0]])?,
        "rgba8" => values(image, 4, |of| [of[0], of[1], of[2]])?,
        "bgra8" => values(image, 4, |of| [of[2], of[1], of[0]])?,
        "mono8" | "8UC1" => values(image, 1, |of| [of[0]; 3])?,
        // Metres, and millimetres where 0 is no return.
        "32FC1" => greys(&values(image, 4, |of| f32::from_le_bytes([of[0], of[1], of[2], of[3]]))?),
        "16UC1" => greys(&values(image, 2, |of| f32::from(u16::from_le_bytes([of[0], of[1]])))?),
        other => return Err(PictureError::Encoding(other.to_owned())),
    };
    Ok(write_png(image.width, image.height, Layout::Rgb, pixels.as_flattened()))
}

/// Reads a value of each pixel from its bytes.
fn values<T>(
    image: &Image,
    bytes: usize,
    read: impl Fn(&[u8]) -> T,
) -> Result<Vec<T>, PictureError> {
    let (width, height) = (image.width as usize, image.height as usize);
    let row_bytes = image.step as usize;
    let is_whole = row_bytes >= width * bytes && image.data.len() >= row_bytes * height;
    if !is_whole || width * height == 0 {
        return Err(PictureError::Bytes {
            bytes: image.data.len(),
            width,
            height,
            encoding: image.encoding.clone(),
        });
    }
    let rows = image.data.chunks_exact(row_bytes).take(height);
    Ok(rows.flat_map(|row| row.chunks_exact(bytes).take(width).map(&read)).collect())
}

/// Grey values of depths, relative to the farthest.
fn greys(depths: &[f32]) -> Vec<[u8; 3]> {
    let far = depths.iter().copied().filter(|depth| depth.is_finite()).fold(0.1, f32::max);
    let grey = |depth: &f32| match depth {
        depth if depth.is_finite() && *depth > 0.0 => [(255.0 * (depth / far).min(1.0)) as u8; 3],
        _ => NO_RETURN_COLOUR,
    };
    depths.iter().map(grey).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(encoding: &str, step: u32, data: &[u8]) -> Image {
        Image {
            width: 2,
            height: 1,
            encoding: encoding.into(),
            step,
            data: data.into(),
            ..Image::default()
        }
    }

    fn pixels(image: &Image) -> Vec<u8> {
        periplus_images::Raster::decode(&of_image(image).unwrap()).unwrap().sample(0).to_vec()
    }

    #[test]
    fn blue_first_and_padded_rows_are_read() {
        assert_eq!(pixels(&image("bgr8", 8, &[1, 2, 3, 4, 5, 6, 0, 0])), [3, 2, 1]);
        assert_eq!(pixels(&image("mono8", 2, &[7, 9])), [7, 7, 7]);
    }

    #[test]
    fn depths_without_a_return_are_blue() {
        let depths = [0.0_f32, 2.0].map(f32::to_le_bytes).concat();
        assert_eq!(pixels(&image("32FC1", 8, &depths)), NO_RETURN_COLOUR);
    }

    #[test]
    fn what_cannot_be_drawn_is_named() {
        assert_eq!(
            of_image(&image("yuv422", 4, &[0; 4])).unwrap_err().to_string(),
            "its encoding is `yuv422`"
        );
        let short = of_image(&image("rgb8", 6, &[0; 5])).unwrap_err().to_string();
        assert_eq!(short, "5 bytes are not 2 by 1 pixels of `rgb8`");
    }
}
