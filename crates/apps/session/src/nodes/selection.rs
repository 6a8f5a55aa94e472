//! Selection of the estimator nodes of a run, as the options of `periplus sim` name them.

use std::path::PathBuf;

use super::mapping::MappingRequest;
use super::{CostmapRequest, EstimatorRequest, NavigationDefaults, NavigationRequest, PlanningMap};

/// Requested nodes, some of which imply others.
#[derive(Clone, Debug)]
pub struct EstimatorSelection {
    /// The usual nodes of the robot: filter, mapping or localization, costmaps.
    pub has_stack: bool,
    /// The servers of Nav2, with a parameter file or with parameters for the robot.
    pub navigation: Option<Option<PathBuf>>,
    /// Costmaps.
    pub costmaps: Option<CostmapRequest>,
    /// YAML of a map, parameter file of `map_server` and `amcl`, or both.
    pub localization: Vec<PathBuf>,
    /// True to map although neither stack nor navigation asks for it.
    pub is_mapping_requested: bool,
    /// Parameters and results of mapping, where it runs.
    pub mapping: MappingRequest,
}

impl EstimatorSelection {
    /// Returns true if a mapping node runs, requested or as a part of stack or navigation.
    #[must_use]
    pub fn runs_mapping(&self) -> bool {
        let is_usual = self.has_stack || self.navigation.is_some();
        self.is_mapping_requested || (is_usual && self.localization.is_empty())
    }

    /// Nodes to start. Each of several robots has its own stack, navigation and localization; the topics of other
    /// nodes are set by the user.
    #[must_use]
    pub fn request(self, robot_count: usize) -> EstimatorRequest {
        let is_several = robot_count > 1;
        let is_localized = !self.localization.is_empty();
        let is_per_robot = self.has_stack || self.navigation.is_some() || is_localized;
        let needs_topics = is_per_robot || self.is_mapping_requested;
        let runs_mapping = self.runs_mapping();
        let navigation = self.navigation.map(|parameters| NavigationRequest {
            parameters,
            defaults: NavigationDefaults {
                map: if is_localized { PlanningMap::Known } else { PlanningMap::Growing },
                ..NavigationDefaults::for_robots(robot_count)
            },
        });
        EstimatorRequest {
            // The servers own both costmaps.
            has_stack: self.has_stack && navigation.is_none(),
            detects_robot: if is_several { is_per_robot } else { needs_topics },
            is_fleet: is_several && is_per_robot,
            costmaps: self.costmaps,
            localization: self.localization,
            mapping: runs_mapping.then_some(self.mapping),
            navigation,
        }
    }
}
