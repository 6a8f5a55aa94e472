//! Images of sensor data, rendered without a browser.

use std::path::Path;
use std::sync::Arc;

use periplus_graph::{Graph, GraphError, Mailbox, Node, NodeSettings, Qos};
use periplus_msgs::sensor_msgs::{Image, LaserScan};

use crate::files::{FileError, write};
use crate::pictures;

/// Time before the end at which the camera is subscribed \[ns\]: images cost more than all other
/// sensors.
const CAMERA_LEAD_NS: i64 = 200_000_000;

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
            ("scan.png", self.scan.as_deref().map(pictures::of_scan)),
            ("depth.png", self.depth.as_deref().and_then(|image| pictures::of_image(image).ok())),
            ("camera.png", self.colour.as_deref().and_then(|image| pictures::of_image(image).ok())),
        ];
        for (name, bytes) in pictures {
            let Some(bytes) = bytes else { continue };
            write(&folder.join(name), &bytes)?;
        }
        Ok(())
    }
}
