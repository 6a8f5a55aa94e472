//! The demo: a robot in a room, with its sensors, mapping and costmaps.

mod explorer;
mod pictures;
mod stage;

use std::path::Path;

use periplus_graph::{Graph, GraphError};
use periplus_os::Stopwatch;
use periplus_sim::{Options, RunProgress};

use crate::builder::{RecordingRequest, SessionBuilder};
use crate::files::FileError;
use crate::nodes::{
    CostmapRequest, CostmapSource, EstimatorRequest, MappingRequest, MappingSource,
    NavigationRequest,
};
use crate::session::SessionTask;

use pictures::SnapshotRecorder;

pub use explorer::ExplorerNode;
pub use stage::{WORLD_NAME, composition};

/// Session of the demo, at full speed, whose results are written to a folder at its end.
#[must_use]
pub fn builder(options: Options, out: Option<&Path>, start: Stopwatch) -> SessionBuilder {
    let estimators = EstimatorRequest {
        costmaps: Some(CostmapRequest {
            source: CostmapSource::Text("costmaps.yaml", stage::COSTMAPS.to_owned()),
            cells: Vec::new(),
            images: out.map(Path::to_owned),
        }),
        mapping: Some(mapping(out)),
        ..EstimatorRequest::default()
    };
    SessionBuilder::new(stage::composition(), options, start).quiet(true).estimators(estimators)
}

/// Estimators of a demo whose robot drives to goals of the user. The servers of navigation have both costmaps.
#[must_use]
pub fn navigation(out: Option<&Path>) -> EstimatorRequest {
    EstimatorRequest {
        detects_robot: true,
        mapping: Some(mapping(out)),
        navigation: Some(NavigationRequest::default()),
        ..EstimatorRequest::default()
    }
}

fn mapping(out: Option<&Path>) -> MappingRequest {
    let (program, values) = stage::mapping();
    MappingRequest { source: MappingSource::Values(program, values), out: out.map(Path::to_owned) }
}

/// Recording of everything but images, which only a viewer subscribes to.
#[must_use]
pub fn recording(path: &Path) -> RecordingRequest {
    RecordingRequest::new(path, |name| !name.starts_with("/depth_camera/"))
}

/// Exploration, and images at the end.
pub struct DemoTask {
    explorer: Option<ExplorerNode>,
    images: Option<SnapshotRecorder>,
}

impl SessionTask for DemoTask {
    fn after_step(&mut self, progress: RunProgress) {
        self.spin_once(progress.time_ns);
    }
}

impl DemoTask {
    /// Adds the nodes of the task. Images are taken shortly before the end, or all the time without one.
    ///
    /// # Errors
    /// When the graph refuses a node.
    pub fn join(
        graph: &Graph,
        explores: bool,
        has_images: bool,
        end_ns: Option<i64>,
    ) -> Result<Self, GraphError> {
        let explorer = explores.then(|| ExplorerNode::join(graph)).transpose()?;
        let images = has_images.then(|| SnapshotRecorder::join(graph, end_ns)).transpose()?;
        Ok(Self { explorer, images })
    }

    /// Processes everything due at this time.
    pub fn spin_once(&mut self, time_ns: i64) {
        if let Some(explorer) = &mut self.explorer {
            explorer.spin_once(time_ns);
        }
        if let Some(images) = &mut self.images {
            images.look(time_ns);
        }
    }

    /// Node that explores, if it is requested.
    #[must_use]
    pub fn explorer(&self) -> Option<&ExplorerNode> {
        self.explorer.as_ref()
    }

    /// Writes the images, if they are requested.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn write_images(&self, folder: &Path) -> Result<(), FileError> {
        self.images.as_ref().map_or(Ok(()), |images| images.write(folder))
    }
}
