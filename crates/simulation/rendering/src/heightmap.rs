//! Heightmaps.

use std::sync::Arc;

use periplus_geometry::Pose;
use periplus_images::Grey;
use periplus_raycast::Heightfield;
use periplus_scene::Heightmap;

use crate::shapes::Shapes;

/// More samples than this are refused: 8193 by 8193.
const MOST_SAMPLES: usize = 1 << 27;

/// Heights over a rectangle about its own middle.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground {
    /// Points along x, at least two.
    pub columns: usize,
    /// Points along y, at least two.
    pub rows: usize,
    /// Heights \[m\]: those of the lowest y, from low x to high, and so on.
    pub heights_m: Vec<f64>,
    /// Lengths of the rectangle along x and y \[m\].
    pub size_m: [f64; 2],
    /// The middle of the rectangle in the frame of the shape.
    pub shape_from_ground: Pose,
}

/// The ground of a heightmap, as Gazebo lays it (`HeightmapShape`, `ImageHeightmap`): the brightest
/// pixel is as high as the size says, black is zero; the top row of the image has the highest y;
/// between pixels there are `sampling` steps of bilinear heights. Unlike there, the image need not
/// be square, nor of a side of 2^n + 1 pixels.
///
/// # Errors
/// What is wrong with it, to be read after "the ground `uri`".
pub fn ground(heightmap: &Heightmap, shapes: &dyn Shapes) -> Result<Ground, String> {
    let bytes =
        shapes.image(&heightmap.uri, heightmap.origin).ok_or_else(|| "was not read".to_owned())?;
    let image = Grey::decode(&bytes).map_err(|error| format!("cannot be used: {error}"))?;
    let (width, height) = (image.width as usize, image.height as usize);
    if width < 2 || height < 2 {
        return Err("has fewer than two by two pixels".into());
    }
    let sampling = heightmap.sampling.clamp(1, 64) as usize;
    let (columns, rows) = ((width - 1) * sampling + 1, (height - 1) * sampling + 1);
    if columns.saturating_mul(rows) > MOST_SAMPLES {
        return Err(format!("has {columns} by {rows} samples, too many; scale the image down"));
    }
    let brightest = image.values.iter().copied().max().unwrap_or(0).max(1);
    let scale = heightmap.size_m.z.abs() / f64::from(brightest);
    let pixel = |x: usize, y: usize| f64::from(image.values[y * width + x]);
    let share = |step: usize| (step % sampling) as f64 / sampling as f64;
    let mut heights_m = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        // Rows count from the bottom of the image.
        let down = rows - 1 - row;
        let (y, dy) = (down / sampling, share(down));
        let y_next = (y + 1).min(height - 1);
        for column in 0..columns {
            let (x, dx) = (column / sampling, share(column));
            let x_next = (x + 1).min(width - 1);
            let upper = pixel(x, y) + (pixel(x_next, y) - pixel(x, y)) * dx;
            let lower = pixel(x, y_next) + (pixel(x_next, y_next) - pixel(x, y_next)) * dx;
            heights_m.push((upper + (lower - upper) * dy) * scale);
        }
    }
    Ok(Ground {
        columns,
        rows,
        heights_m,
        size_m: [heightmap.size_m.x, heightmap.size_m.y],
        shape_from_ground: Pose { translation: heightmap.position_m, ..Pose::IDENTITY },
    })
}

impl Ground {
    pub(crate) fn field(self) -> Result<Arc<Heightfield>, String> {
        Heightfield::new(self.columns, self.rows, self.size_m, self.heights_m)
            .map(Arc::new)
            .map_err(|error| format!("cannot be used: {error}"))
    }
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::Origin;
    use periplus_geometry::DVec3;
    use periplus_scene::Mesh;

    use super::*;

    struct OneImage(Arc<[u8]>);

    impl Shapes for OneImage {
        fn mesh(&self, _: &Mesh) -> Option<Arc<periplus_meshes::Mesh>> {
            None
        }
        fn image(&self, _: &str, _: Origin) -> Option<Arc<[u8]>> {
            Some(Arc::clone(&self.0))
        }
        fn texture(&self, _: &Mesh, _: &str) -> Option<Arc<[u8]>> {
            None
        }
    }

    /// Two by two pixels: 200 and 0 above, 100 and 0 below.
    fn check(sampling: u32) -> Ground {
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
        ground(&heightmap, &OneImage(bytes.into())).unwrap()
    }

    #[test]
    fn the_brightest_pixel_is_the_highest_and_the_top_row_is_north() {
        let ground = check(1);
        assert_eq!((ground.columns, ground.rows), (2, 2));
        assert_eq!(ground.heights_m, [1.0, 0.0, 2.0, 0.0]);
        assert_eq!(ground.shape_from_ground.translation.x, 1.0);
    }

    #[test]
    fn samples_between_pixels_are_bilinear() {
        let ground = check(2);
        assert_eq!(ground.heights_m, [1.0, 0.5, 0.0, 1.5, 0.75, 0.0, 2.0, 1.0, 0.0]);
    }
}
