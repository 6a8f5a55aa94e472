//! Heightmaps.

use std::fmt;
use std::sync::Arc;

use periplus_geometry::Pose;
use periplus_images::{BadImage, Grey};
use periplus_raycast::Heightfield;
use periplus_scene::Heightmap;

use crate::assets::AssetLoader;

/// Maximum number of samples: 8193 by 8193.
const MAX_SAMPLES: usize = 1 << 27;

/// Heights over a rectangle centred on its frame.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightmapSamples {
    /// Samples along x, at least two.
    pub columns: usize,
    /// Samples along y, at least two.
    pub rows: usize,
    /// Heights \[m\], row by row from the lowest y, each from low x to high.
    pub heights_m: Vec<f64>,
    /// Lengths of the rectangle along x and y \[m\].
    pub size_m: [f64; 2],
    /// Centre of the rectangle in the frame of the shape.
    pub shape_from_heightmap: Pose,
}

/// Returns the heights of a heightmap as Gazebo computes them (`HeightmapShape`, `ImageHeightmap`):
/// white is the height of `size`, black is zero; the top row of the image has the highest y; heights
/// are interpolated bilinearly with `sampling` steps per pixel. Unlike in Gazebo, the image need not
/// be square, nor have a side of 2^n + 1 pixels.
///
/// # Errors
/// When the image cannot be used.
pub fn sample_heightmap(
    heightmap: &Heightmap,
    shapes: &dyn AssetLoader,
) -> Result<HeightmapSamples, HeightmapError> {
    let bytes = shapes.image(&heightmap.uri, heightmap.origin).ok_or(HeightmapError::NotRead)?;
    let image = Grey::decode(&bytes).map_err(HeightmapError::Image)?;
    let (width, height) = (image.width as usize, image.height as usize);
    if width < 2 || height < 2 {
        return Err(HeightmapError::TooSmall);
    }
    let sampling = heightmap.sampling.clamp(1, 64) as usize;
    let (columns, rows) = ((width - 1) * sampling + 1, (height - 1) * sampling + 1);
    if columns.saturating_mul(rows) > MAX_SAMPLES {
        return Err(HeightmapError::TooLarge { columns, rows });
    }
    let brightest = image.values.iter().copied().max().unwrap_or(0).max(1);
    let scale = heightmap.size_m.z.abs() / f64::from(brightest);
    let pixel = |x: usize, y: usize| f64::from(image.values[y * width + x]);
    let intensity = |step: usize| (step % sampling) as f64 / sampling as f64;
    let mut heights_m = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        // Rows count from the bottom of the image.
        let down = rows - 1 - row;
        let (y, dy) = (down / sampling, intensity(down));
        let y_next = (y + 1).min(height - 1);
        for column in 0..columns {
            let (x, dx) = (column / sampling, intensity(column));
            let x_next = (x + 1).min(width - 1);
            let upper = pixel(x, y) + (pixel(x_next, y) - pixel(x, y)) * dx;
            let lower = pixel(x, y_next) + (pixel(x_next, y_next) - pixel(x, y_next)) * dx;
            heights_m.push((upper + (lower - upper) * dy) * scale);
        }
    }
    Ok(HeightmapSamples {
        columns,
        rows,
        heights_m,
        size_m: [heightmap.size_m.x, heightmap.size_m.y],
        shape_from_heightmap: Pose { translation: heightmap.position_m, ..Pose::IDENTITY },
    })
}

/// Reason for which a heightmap cannot be used. Its text completes the sentence "the heightmap ...".
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HeightmapError {
    /// The image was not read.
    NotRead,
    /// The image cannot be decoded.
    Image(BadImage),
    /// The image has fewer than two by two pixels.
    TooSmall,
    /// The image has too many samples.
    TooLarge {
        /// Samples along x.
        columns: usize,
        /// Samples along y.
        rows: usize,
    },
}

impl fmt::Display for HeightmapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotRead => write!(f, "was not read"),
            Self::Image(error) => write!(f, "cannot be used: {error}"),
            Self::TooSmall => write!(f, "has fewer than two by two pixels"),
            Self::TooLarge { columns, rows } => {
                write!(f, "has {columns} by {rows} samples, too many; scale the image down")
            }
        }
    }
}

impl std::error::Error for HeightmapError {}

impl HeightmapSamples {
    pub(crate) fn into_heightfield(self) -> Result<Arc<Heightfield>, String> {
        Heightfield::new(self.columns, self.rows, self.size_m, self.heights_m)
            .map(Arc::new)
            .map_err(|error| format!("cannot be used: {error}"))
    }
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::Origin;
    use periplus_geometry::DVec3;
    use periplus_scene::MeshShape;

    use super::*;

    struct OneImage(Arc<[u8]>);

    impl AssetLoader for OneImage {
        fn mesh(&self, _: &MeshShape) -> Option<Arc<periplus_meshes::Mesh>> {
            None
        }
        fn image(&self, _: &str, _: Origin) -> Option<Arc<[u8]>> {
            Some(Arc::clone(&self.0))
        }
        fn texture(&self, _: &MeshShape, _: &str) -> Option<Arc<[u8]>> {
            None
        }
    }

    /// Two by two pixels: 200 and 0 in the top row, 100 and 0 in the bottom row.
    fn check(sampling: u32) -> HeightmapSamples {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.write_header().unwrap().write_image_data(&[200, 0, 100, 0]).unwrap();
        let heightmap = Heightmap {
            uri: "ground.png".into(),
            path: None,
            size_m: DVec3::new(4.0, 4.0, 2.0),
            position_m: DVec3::new(1.0, 0.0, 0.0),
            sampling,
            extra: Vec::new(),
            origin: Origin::default(),
        };
        sample_heightmap(&heightmap, &OneImage(bytes.into())).unwrap()
    }

    #[test]
    fn the_brightest_pixel_is_the_highest_and_the_top_row_is_north() {
        let samples = check(1);
        assert_eq!((samples.columns, samples.rows), (2, 2));
        assert_eq!(samples.heights_m, [1.0, 0.0, 2.0, 0.0]);
        assert_eq!(samples.shape_from_heightmap.translation.x, 1.0);
    }

    #[test]
    fn samples_between_pixels_are_bilinear() {
        let samples = check(2);
        assert_eq!(samples.heights_m, [1.0, 0.5, 0.0, 1.5, 0.75, 0.0, 2.0, 1.0, 0.0]);
    }
}
