//! Tasks at waypoints.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_images::{Layout, write_png};
use periplus_msgs::sensor_msgs::Image;
use periplus_params::ParamValues;
use periplus_resources::FileWriteError;

use super::config::{InputAtWaypointParams, PhotoAtWaypointParams, TaskKind, WaitAtWaypointParams};

/// Saves a photo as a file, and creates its folder if that is missing. An error is logged.
pub type SavePhoto = Arc<dyn Fn(&Path, &[u8]) -> Result<(), FileWriteError> + Send + Sync>;

/// Task with its state.
pub(super) struct WaypointTask {
    kind: TaskKind,
    values: ParamValues,
    save: SavePhoto,
    /// Newest image.
    pub(super) image: Option<Arc<Image>>,
    /// True once the input arrived.
    pub(super) has_input: bool,
    started_ns: i64,
}

/// Result of a task.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum TaskOutcome {
    /// The task goes on.
    Running,
    /// The task is complete.
    Done,
    /// The task failed.
    Failed(String),
}

impl WaypointTask {
    pub(super) fn new(kind: TaskKind, values: ParamValues, save: SavePhoto) -> Self {
        Self { kind, values, save, image: None, has_input: false, started_ns: 0 }
    }

    /// Applies changed parameters.
    pub(super) fn adopt(&mut self, values: ParamValues) {
        self.values = values;
    }

    /// Starts the task at a pose.
    pub(super) fn start(&mut self, now_ns: i64) {
        self.started_ns = now_ns;
        self.has_input = false;
    }

    /// Works on the task at the pose of an index, to which the robot was sent at a time \[s\].
    pub(super) fn work(&mut self, index: usize, sent_s: i32, now_ns: i64) -> TaskOutcome {
        let elapsed_ns = now_ns - self.started_ns;
        match self.kind {
            TaskKind::Wait => {
                let params = WaitAtWaypointParams::from_values(&self.values);
                let is_over = elapsed_ns >= params.pause_ms.saturating_mul(1_000_000);
                if is_over || !params.task.is_enabled {
                    TaskOutcome::Done
                } else {
                    TaskOutcome::Running
                }
            }
            TaskKind::Photo => {
                let params = PhotoAtWaypointParams::from_values(&self.values);
                if !params.task.is_enabled {
                    return TaskOutcome::Done;
                }
                match self.take_photo(&params, index, sent_s) {
                    Ok(()) => TaskOutcome::Done,
                    Err(why) => TaskOutcome::Failed(format!("no photo was taken: {why}")),
                }
            }
            TaskKind::Input => {
                let params = InputAtWaypointParams::from_values(&self.values);
                if self.has_input || !params.task.is_enabled {
                    TaskOutcome::Done
                } else if elapsed_ns >= (params.timeout_s * 1e9) as i64 {
                    let (topic, limit_s) = (&params.input_topic, params.timeout_s);
                    TaskOutcome::Failed(format!("no input on `{topic}` within {limit_s} s"))
                } else {
                    TaskOutcome::Running
                }
            }
        }
    }

    fn take_photo(
        &self,
        params: &PhotoAtWaypointParams,
        index: usize,
        sent_s: i32,
    ) -> Result<(), String> {
        let image = self.image.as_ref();
        let image =
            image.ok_or_else(|| format!("no image was received on `{}`", params.image_topic))?;
        if params.image_format != "png" {
            let format = &params.image_format;
            return Err(format!("the format `{format}` is not supported; set `image_format: png`"));
        }
        let content = png(image)?;
        let path = PathBuf::from(&params.save_dir).join(format!("{index}_{sent_s}.png"));
        let named = |error| format!("`{}`: {error}", path.display());
        (self.save)(&path, &content).map_err(named)
    }
}

/// Encodes an image message.
fn png(image: &Image) -> Result<Vec<u8>, String> {
    // Channels, and those of the file in the order of the message.
    let (channels, layout, order): (usize, Layout, &[usize]) = match image.encoding.as_str() {
        "rgb8" | "8UC3" => (3, Layout::Rgb, &[0, 1, 2]),
        "bgr8" => (3, Layout::Rgb, &[2, 1, 0]),
        "rgba8" => (4, Layout::Rgba, &[0, 1, 2, 3]),
        "bgra8" => (4, Layout::Rgba, &[2, 1, 0, 3]),
        "mono8" | "8UC1" => (1, Layout::Grey, &[0]),
        other => return Err(format!("images of encoding `{other}` cannot be saved")),
    };
    let (width, height, step) = (image.width as usize, image.height as usize, image.step as usize);
    let row_bytes = width.checked_mul(channels).filter(|bytes| *bytes <= step && *bytes > 0);
    let is_complete =
        height > 0 && step.checked_mul(height).is_some_and(|bytes| bytes <= image.data.len());
    let Some(row_bytes) = row_bytes.filter(|_| is_complete) else {
        return Err(format!(
            "an image of {width} x {height} with {} bytes is malformed",
            image.data.len()
        ));
    };
    let rows = image.data.chunks_exact(step).take(height);
    let pixels = rows.flat_map(|row| row[..row_bytes].chunks_exact(channels));
    let samples: Vec<u8> = pixels.flat_map(|pixel| order.iter().map(|at| pixel[*at])).collect();
    Ok(write_png(image.width, image.height, layout, &samples))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(encoding: &str, step: u32, data: &[u8]) -> Image {
        Image {
            encoding: encoding.to_owned(),
            width: 1,
            height: 2,
            step,
            data: data.to_vec(),
            ..Image::default()
        }
    }

    #[test]
    fn images_are_encoded_with_their_colours() {
        let check = |message: &Image, expected: &[u8]| {
            let raster = periplus_images::Raster::decode(&png(message).unwrap()).unwrap();
            let pixels = (0..2).flat_map(|pixel| raster.sample(pixel).to_vec());
            assert_eq!(pixels.collect::<Vec<u8>>(), expected);
        };
        // A row may be longer than its pixels.
        check(&image("rgb8", 4, &[1, 2, 3, 0, 4, 5, 6, 0]), &[1, 2, 3, 4, 5, 6]);
        check(&image("bgr8", 3, &[1, 2, 3, 4, 5, 6]), &[3, 2, 1, 6, 5, 4]);
        check(&image("mono8", 1, &[7, 9]), &[7, 9]);
        assert!(png(&image("rgb8", 3, &[1, 2, 3])).unwrap_err().contains("malformed"));
        assert!(png(&image("32FC1", 4, &[0; 8])).unwrap_err().contains("32FC1"));
    }
}
