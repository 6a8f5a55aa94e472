//! COCO: images, and boxes and masks of their objects in one JSON file.
//!
//! Format: "COCO - Common Objects in Context", <https://cocodataset.org/#format-data>. Masks are run-length encoded column
//! by column, beginning with pixels outside, as `pycocotools` reads them.

use std::collections::BTreeMap;
use std::path::PathBuf;

use periplus_images::{Layout, write_png};
use periplus_sim::{CameraFrame, ObjectLabel, PixelBox, RenderedImages};
use serde_json::{Value, json};

use crate::error::CliError;
use crate::paths;

pub(super) struct CocoWriter {
    folder: PathBuf,
    classes: BTreeMap<u8, String>,
    images: Vec<Value>,
    annotations: Vec<Value>,
}

impl CocoWriter {
    pub(super) fn new(folder: PathBuf, classes: BTreeMap<u8, String>) -> Result<Self, CliError> {
        for name in ["images", "annotations"] {
            paths::make_folder(&folder.join(name))?;
        }
        Ok(Self { folder, classes, images: Vec::new(), annotations: Vec::new() })
    }

    pub(super) fn add(&mut self, number: usize, frame: &CameraFrame) -> Result<(), CliError> {
        let images = &frame.images;
        let file_name = format!("{number:06}.png");
        let png = write_png(images.width, images.height, Layout::Rgb, &images.rgb);
        paths::write(&self.folder.join("images").join(&file_name), &png)?;
        let image_id = number + 1;
        self.images.push(json!({
            "id": image_id,
            "file_name": file_name,
            "width": images.width,
            "height": images.height,
        }));
        for detected in &frame.objects {
            let PixelBox { left_px, top_px, width_px, height_px } = detected.visible.bounds;
            self.annotations.push(json!({
                "id": self.annotations.len() + 1,
                "image_id": image_id,
                "category_id": detected.object.label.class,
                "bbox": [left_px, top_px, width_px, height_px],
                "area": detected.visible.pixel_count,
                "iscrowd": 0,
                "segmentation": {
                    "size": [images.height, images.width],
                    "counts": run_lengths(images, detected.object.label),
                },
            }));
        }
        Ok(())
    }

    pub(super) fn finish(&self) -> Result<(), CliError> {
        let categories: Vec<Value> = self
            .classes
            .iter()
            .map(|(id, name)| json!({ "id": id, "name": name, "supercategory": "object" }))
            .collect();
        let all = json!({
            "info": { "description": "Simulated by Periplus", "version": "1.0" },
            "licenses": [],
            "images": self.images,
            "annotations": self.annotations,
            "categories": categories,
        });
        let path = self.folder.join("annotations").join("instances.json");
        paths::write(&path, all.to_string().as_bytes())?;
        Ok(())
    }
}

/// Returns the numbers of pixels outside and inside of an object, in turn, column by column.
fn run_lengths(images: &RenderedImages, label: ObjectLabel) -> Vec<usize> {
    let (width, height) = (images.width as usize, images.height as usize);
    let mut counts = vec![0];
    let mut was_inside = false;
    for column in 0..width {
        for row in 0..height {
            let pixel = row * width + column;
            let is_inside =
                images.classes[pixel] == label.class && images.instances[pixel] == label.instance;
            if is_inside != was_inside {
                counts.push(0);
                was_inside = is_inside;
            }
            if let Some(last) = counts.last_mut() {
                *last += 1;
            }
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three columns of two rows: the object has the lower pixel of the first column, and both of the second.
    #[test]
    fn masks_are_encoded_by_columns() {
        let images = RenderedImages {
            width: 3,
            height: 2,
            classes: vec![0, 7, 7, 7, 7, 0],
            instances: vec![0, 1, 2, 1, 1, 0],
            ..RenderedImages::default()
        };
        let label = |instance| ObjectLabel { class: 7, instance };
        assert_eq!(run_lengths(&images, label(1)), [1, 3, 2]);
        assert_eq!(run_lengths(&images, label(2)), [4, 1, 1]);
        assert_eq!(run_lengths(&images, label(3)), [6]);
    }

    /// A mask that begins with the object has no pixels outside before it.
    #[test]
    fn masks_begin_with_the_outside() {
        let images = RenderedImages {
            width: 1,
            height: 2,
            classes: vec![7, 0],
            instances: vec![1, 0],
            ..RenderedImages::default()
        };
        assert_eq!(run_lengths(&images, ObjectLabel { class: 7, instance: 1 }), [0, 1, 1]);
    }
}
