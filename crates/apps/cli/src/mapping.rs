//! Mapping options of `periplus sim` and `periplus slam --live`.

use std::path::PathBuf;

use clap::Args;
use periplus_nav_nodes::slam_toolbox::Program;
use periplus_session::nodes::{MappingRequest, MappingSource};

/// Mapping options of `periplus sim`.
#[derive(Debug, Args)]
pub(crate) struct MappingOptions {
    /// Build a map while the robot drives, with a parameter file of `slam_toolbox` or
    /// `slam_gmapping` [default: default parameters]. At full speed every scan is processed
    #[arg(long, value_name = "FILE.yaml", num_args = 0..=1)]
    slam: Option<Option<PathBuf>>,
    /// Node to run: async, sync, localization, lifelong or gmapping [default: the one of the
    /// parameter file]
    #[arg(long, value_name = "PROGRAM")]
    slam_node: Option<Program>,
    /// At the end write map.yaml, map.pgm, map.session, and map.png with the poses of the graph and
    /// red rings at contradictions to a folder
    #[arg(long, value_name = "DIR")]
    slam_out: Option<PathBuf>,
}

impl MappingOptions {
    /// Returns true if mapping is requested.
    pub(crate) fn is_wanted(&self) -> bool {
        self.slam.is_some()
    }

    /// Returns true if an option is set that only a mapping node uses.
    pub(crate) fn needs_mapping(&self) -> bool {
        self.slam_node.is_some() || self.slam_out.is_some()
    }

    /// Parameters and results, with default parameters where mapping is not requested.
    pub(crate) fn request(&self) -> MappingRequest {
        MappingRequest {
            source: MappingSource::File(self.slam.clone().flatten(), self.slam_node),
            out: self.slam_out.clone(),
        }
    }
}
