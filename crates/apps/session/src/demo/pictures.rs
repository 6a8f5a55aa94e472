//! Images of sensor data, rendered without a browser.

use std::path::Path;
use std::sync::Arc;

use periplus_graph::{Graph, GraphError, Mailbox, Node, NodeSettings, Qos};
use periplus_grid::Line;
use periplus_images::{Layout, write_png};
use periplus_msgs::sensor_msgs::{Image, LaserScan};

use crate::files::{FileError, write};

/// Time before the end at which the camera is subscribed \[ns\]: images cost more than all other
/// sensors.
const CAMERA_LEAD_NS: i64 = 200_000_000;

/// Width and height of the image of a scan \[px\].
const SIDE_PX: usize = 800;

const BACKGROUND_COLOUR: [u8; 3] = [250, 250, 248];
const RAY_COLOUR: [u8; 3] = [206, 222, 240];
const HIT_COLOUR: [u8; 3] = [200, 30, 40];
const ROBOT_COLOUR: [u8; 3] = [30, 60, 120];

/// Keeps the last scan and the last images.
pub(crate) struct SnapshotRecorder {
    node: Node,
    end_ns: Option<i64>,
    scans: Mailbox<LaserScan>,
    scan: Option<Arc<LaserScan>>,
    cameras: Option<[Mailbox<Image>; 2]>,
    depth: Option<Arc<Image>>,
    colour: Option<Arc<Image>>,
}

impl SnapshotRecorder {
    pub(super) fn join(graph: &Graph, end_ns: Option<i64>) -> Result<Self, GraphError> {
        let node = graph.node(NodeSettings::new("eyes"))?;
        let scans = node.mailbox("/scan", Qos::sensor_data())?;
        let mut eyes =
            Self { node, end_ns, scans, scan: None, cameras: None, depth: None, colour: None };
        if end_ns.is_none() {
            eyes.open();
        }
        Ok(eyes)
    }

    fn open(&mut self) {
        let topics = ["/depth_camera/depth/image_raw", "/depth_camera/image_raw"];
        let [depth, colour] = topics.map(|topic| self.node.mailbox(topic, Qos::sensor_data()));
        self.cameras = depth.and_then(|depth| Ok([depth, colour?])).ok();
    }

    /// Subscribes to the camera once the end is near, and stores new messages.
    pub(super) fn look(&mut self, now_ns: i64) {
        let is_near = self.end_ns.is_none_or(|end_ns| now_ns >= end_ns - CAMERA_LEAD_NS);
        if !is_near {
            return;
        }
        if self.cameras.is_none() {
            self.open();
        }
        self.scan = self.scans.latest().or(self.scan.take());
        if let Some([depth, colour]) = &self.cameras {
            self.depth = depth.latest().or(self.depth.take());
            self.colour = colour.latest().or(self.colour.take());
        }
    }

    /// Writes `scan.png`, `depth.png` and `camera.png`, as far as messages arrived.
    pub(super) fn write(&self, folder: &Path) -> Result<(), FileError> {
        let pictures = [
            ("scan.png", self.scan.as_deref().map(draw_scan)),
            ("depth.png", self.depth.as_deref().and_then(draw_depth)),
            ("camera.png", self.colour.as_deref().and_then(draw_colour)),
        ];
        for (name, bytes) in pictures {
            let Some(bytes) = bytes else { continue };
            write(&folder.join(name), &bytes)?;
        }
        Ok(())
    }
}

/// Renders a scan from above, with the robot in the centre and its front up.
fn draw_scan(scan: &LaserScan) -> Vec<u8> {
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
        (pixel(length * angle.cos(), length * angle.sin()), is_hit)
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

/// Renders depths \[m\] as grey values: near is dark, missing returns are blue.
fn draw_depth(image: &Image) -> Option<Vec<u8>> {
    const NO_RETURN_COLOUR: [u8; 3] = [40, 60, 110];
    if image.encoding != "32FC1" {
        return None;
    }
    let depth = |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    let rows = image.data.chunks_exact(image.step as usize);
    let width = image.width as usize;
    let depths: Vec<f32> =
        rows.flat_map(|row| row.chunks_exact(4).take(width).map(depth)).collect();
    let far = depths.iter().copied().filter(|depth| depth.is_finite()).fold(0.1, f32::max);
    let colour = |depth: &f32| match depth {
        depth if depth.is_finite() && *depth > 0.0 => [(255.0 * (depth / far).min(1.0)) as u8; 3],
        _ => NO_RETURN_COLOUR,
    };
    let pixels: Vec<[u8; 3]> = depths.iter().map(colour).collect();
    let is_whole = pixels.len() == width * image.height as usize;
    is_whole.then(|| write_png(image.width, image.height, Layout::Rgb, pixels.as_flattened()))
}

fn draw_colour(image: &Image) -> Option<Vec<u8>> {
    if image.encoding != "rgb8" {
        return None;
    }
    let width = 3 * image.width as usize;
    let rows = image.data.chunks_exact(image.step as usize);
    let samples: Vec<u8> = rows.flat_map(|row| row.iter().take(width).copied()).collect();
    let is_whole = samples.len() == width * image.height as usize;
    is_whole.then(|| write_png(image.width, image.height, Layout::Rgb, &samples))
}
