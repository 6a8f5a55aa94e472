//! Recording of the graph.

use std::path::PathBuf;

use periplus_bags::files::{
    BagError, RecordSettings, Recorder, Storage, WriteSettings, stamp_name,
};
use periplus_graph::{Graph, TopicInfo};
use periplus_transport::unix_ns;

use super::service::RecordingSettings;

/// Types that fill the memory of a tab, in which recordings are kept in WebAssembly, within a minute.
const LARGE: [&str; 2] = ["sensor_msgs/msg/Image", "sensor_msgs/msg/PointCloud2"];

/// A recording of the graph in progress.
pub(super) struct LiveRecording {
    pub(super) path: PathBuf,
    recorder: Recorder,
}

impl LiveRecording {
    /// Starts to record all topics into a new folder below that of the settings, named as `ros2 bag record`
    /// names it.
    pub(super) fn start(graph: &Graph, settings: &RecordingSettings) -> Result<Self, BagError> {
        let path = settings.record_folder.join(format!("rosbag2_{}", stamp_name(unix_ns())));
        let write = WriteSettings {
            custom_data: settings.custom_data.clone(),
            ..WriteSettings::new(Storage::Mcap)
        };
        let settings = RecordSettings {
            wanted: Box::new(|topic: &TopicInfo| {
                let is_kept = !cfg!(target_family = "wasm") || !LARGE.contains(&&*topic.type_name);
                is_kept && !is_hidden(&topic.name)
            }),
            ..RecordSettings::all(write)
        };
        let recorder = Recorder::start(graph, &path, settings)?;
        Ok(Self { path, recorder })
    }

    /// Writes old messages to the disk.
    pub(super) fn keep(&self) -> Result<(), BagError> {
        self.recorder.keep()
    }

    /// Ends the recording; returns its path and the number of lost messages.
    pub(super) fn finish(self) -> Result<(PathBuf, u64), BagError> {
        let recording = self.recorder.finish()?;
        Ok((self.path, recording.dropped))
    }
}

/// True for topics that ROS tools hide.
fn is_hidden(name: &str) -> bool {
    name.split('/').any(|part| part.starts_with('_'))
}
