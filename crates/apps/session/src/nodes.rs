//! Estimator nodes beside a robot: EKF, costmaps, localization, mapping.

mod costmap_file;
mod costmaps;
mod localization;
mod mapping;
mod navigation;
pub(crate) mod profile;
mod selection;

use std::io::{self, Write};
use std::path::PathBuf;

use periplus_nav_nodes::ekf_node::EkfNode;
use periplus_nav_nodes::slam_toolbox::Pace;
use periplus_sim::Simulation;

pub use costmap_file::{CostmapFile, read as read_costmaps, read_text as read_costmap_text};
pub use costmaps::{CostmapRequest, CostmapSource, Costmaps, FloorPoint};
pub use localization::{Localization, ParameterFile, amcl_parameters};
pub use mapping::{MappingNode, MappingRequest, MappingSource, slam_parameters};
pub use navigation::{
    GoalDriver, GoalOutcome, GoalReport, Navigation, NavigationDefaults, NavigationRequest,
    PlanningMap, RobotBase, pose_text,
};
pub use profile::RobotProfile;
pub use selection::EstimatorSelection;

use crate::error::RunError;
use crate::terminal;

/// Estimator nodes that run beside a robot.
#[derive(Clone, Debug, Default)]
pub struct EstimatorRequest {
    /// True to run both costmaps on the detected topics of the robot, unless `costmaps` sets
    /// others. The robot needs scans.
    pub has_stack: bool,
    /// True to detect topics and frames of the robot, and to run an EKF if nothing publishes the
    /// odometry transform.
    pub detects_robot: bool,
    /// Costmaps.
    pub costmaps: Option<CostmapRequest>,
    /// YAML of a map, parameter file of `map_server` and `amcl`, or both.
    pub localization: Vec<PathBuf>,
    /// Mapping.
    pub mapping: Option<MappingRequest>,
    /// Navigation; needs `detects_robot`.
    pub navigation: Option<NavigationRequest>,
}

/// Running estimator nodes.
#[derive(Default)]
pub struct Estimators {
    /// Mapping.
    pub mapping: Option<MappingNode>,
    /// Localization.
    pub localization: Option<Localization>,
    /// Costmaps; empty if there are none.
    pub costmaps: Costmaps,
    /// Servers of navigation; empty if there are none.
    pub navigation: Navigation,
    _filter: Option<EkfNode>,
}

impl EstimatorRequest {
    /// Detects topics and frames of the robot if the nodes need them, and prints them.
    ///
    /// # Errors
    /// When the world cannot run, or the robot has no scans for the stack.
    pub(crate) fn detect(
        &self,
        simulation: &mut Simulation,
        is_quiet: bool,
    ) -> Result<Option<RobotProfile>, RunError> {
        if !self.detects_robot {
            return Ok(None);
        }
        let profile = RobotProfile::detect(simulation)?;
        if profile.scan.is_none() && self.has_stack {
            return Err(RunError::Robot(
                "no sensor of this robot publishes laser scans, which mapping, localization and \
                 costmaps need; give the robot a lidar",
            ));
        }
        if !is_quiet && profile.needs_filter() {
            profile.print_filter();
        }
        if !is_quiet && self.has_stack {
            profile.print();
        }
        Ok(Some(profile))
    }

    /// Starts the nodes.
    ///
    /// # Errors
    /// When one of them cannot start.
    pub(crate) fn start(
        self,
        simulation: &Simulation,
        profile: Option<&RobotProfile>,
        pace: Pace,
    ) -> Result<Estimators, RunError> {
        let graph = simulation.graph();
        let filter = profile.filter(|profile| profile.needs_filter());
        let filter = filter.map(|profile| profile.filter(graph)).transpose();
        let filter = filter.map_err(|error| RunError::node("the odometry filter", error))?;
        let usual = profile.filter(|_| self.has_stack).map(|profile| CostmapRequest {
            source: CostmapSource::Text("the default costmaps", profile.costmap_parameters()),
            cells: Vec::new(),
            images: None,
        });
        let costmaps = self.costmaps.or(usual).map(|request| Costmaps::new(graph, request));
        let costmaps = costmaps.transpose()?.unwrap_or_default();
        costmaps.start();
        let is_localized = !self.localization.is_empty();
        let localization =
            is_localized.then(|| Localization::from_files(graph, &self.localization, profile));
        let localization = localization.transpose()?;
        let mapping = self.mapping.map(|it| MappingNode::in_simulation(graph, it, pace, profile));
        let mapping = mapping.transpose()?;
        let navigation = self.navigation.zip(profile);
        let navigation =
            navigation.map(|(request, profile)| Navigation::start(graph, &request, profile));
        let navigation = navigation.transpose()?.unwrap_or_default();
        Ok(Estimators { mapping, localization, costmaps, navigation, _filter: filter })
    }
}

impl Estimators {
    /// Writes the reports at the end of a run.
    ///
    /// # Errors
    /// A failed write.
    pub fn write_reports(&self, out: &mut dyn Write) -> io::Result<()> {
        self.costmaps.write_report(out)?;
        if let Some(localization) = &self.localization {
            localization.write_report(out)?;
        }
        if let Some(mapping) = &self.mapping {
            mapping.write_report(out)?;
        }
        Ok(())
    }

    /// Writes the map, if it is requested, and prints its folder.
    ///
    /// # Errors
    /// When there is no map, or a file cannot be written.
    pub fn write_map(&self, is_quiet: bool) -> Result<(), RunError> {
        let folder = self.mapping.as_ref().map_or(Ok(None), MappingNode::write_results)?;
        if let Some(folder) = folder.filter(|_| !is_quiet) {
            terminal::say(&format!("map: {}", folder.display()));
        }
        Ok(())
    }
}
