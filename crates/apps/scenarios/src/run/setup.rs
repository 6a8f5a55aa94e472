//! Session of a scenario: world, robot, nodes.

use std::path::Path;

use periplus_graph::Arguments;
use periplus_nav_nodes::slam_toolbox::Program;
use periplus_os::Machine;
use periplus_resources::Host as _;
use periplus_session::nodes::{
    CostmapRequest, CostmapSource, EstimatorRequest, MappingRequest, MappingSource,
    NavigationDefaults, NavigationRequest, PlanningMap, RobotBase, slam_parameters,
};
use periplus_sim::{
    Composition, Driver, Options, PhysicsMode, PlacementPose, RobotPlacement,
    compose as compose_files,
};

use super::ScenarioRunOptions;
use crate::error::ScenarioError;
use crate::file::Scenario;
use crate::tables::{ScenarioBase, ScenarioPhysics};

/// Map of `localization` that is the true one.
pub(super) const TRUE_MAP: &str = "truth";

/// Reads world and robot.
pub(super) fn compose(
    scenario: &Scenario,
    options: &ScenarioRunOptions,
    seed: u64,
) -> Result<(Composition, Options), ScenarioError> {
    let world = scenario.resolve(&scenario.params.world);
    let start = scenario.start();
    let robots: Vec<RobotPlacement> = scenario
        .robot
        .iter()
        .map(|robot| RobotPlacement {
            file: scenario.resolve(&robot.params.file),
            arguments: robot.arguments.clone(),
            pose: PlacementPose::OnGround([start.x_m, start.y_m, start.yaw_rad]),
            ..RobotPlacement::default()
        })
        .collect();
    for file in robots.iter().map(|robot| robot.file.as_path()).chain([world.as_path()]) {
        require(file)?;
    }
    let composition =
        options.search.with_context(true, |context| compose_files(&world, &robots, context));
    let simulation = Options {
        seed,
        threads: options.threads.max(1),
        mode: match scenario.params.physics {
            ScenarioPhysics::Rigid => PhysicsMode::Rigid,
            ScenarioPhysics::Kinematic => PhysicsMode::Kinematic,
        },
        arguments: arguments(scenario.parameters.iter().chain(&options.parameters))?,
        ..Options::default()
    };
    Ok((composition, simulation))
}

/// Reports a missing file with the nearest name.
fn require(file: &Path) -> Result<(), ScenarioError> {
    // Names of packages and models are resolved when the file is read.
    let is_uri = file.to_string_lossy().contains("://");
    if is_uri || Machine.kind(file).is_some() {
        return Ok(());
    }
    let advice = periplus_session::files::advice(file);
    Err(ScenarioError::Failed(format!("the file {} does not exist{advice}", file.display())))
}

/// Parameters of nodes, as `--ros-args -p node:name:=value`.
fn arguments<'a>(
    parameters: impl Iterator<Item = &'a [String; 3]>,
) -> Result<Arguments, ScenarioError> {
    let mut words = Vec::new();
    for [node, name, value] in parameters {
        let node = node.trim_start_matches('/');
        words.extend(["-p".to_owned(), format!("{node}:{name}:={value}")]);
    }
    let mut sources = periplus_diagnostics::SourceMap::new();
    let mut findings = periplus_diagnostics::Diagnostics::new();
    let arguments = Arguments::read(&words, &mut sources, &mut findings, &mut |_| {
        Err(periplus_graph::ParameterFileError::Missing)
    });
    match findings.iter().find(|_| findings.has_errors()) {
        Some(finding) => {
            Err(ScenarioError::Failed(format!("`parameters` of the scenario: {}", finding.message)))
        }
        None => Ok(arguments),
    }
}

/// Scripted driving.
pub(super) fn driver(scenario: &Scenario) -> Driver {
    scenario.drive.clone().map(Driver::new).unwrap_or_default()
}

/// Nodes beside the robot. Localization starts later, when the true map exists.
pub(super) fn estimators(scenario: &Scenario) -> Result<EstimatorRequest, ScenarioError> {
    let nodes = &scenario.nodes;
    let file = |name: &Option<String>| name.as_deref().map(|name| scenario.resolve(name));
    let mapping = nodes.slam.as_ref().map(|params| {
        let path = file(&params.parameters);
        let program = path.is_none().then_some(Program::Async);
        let (program, values) = slam_parameters(path.as_deref(), program)?;
        Ok::<_, ScenarioError>(MappingRequest {
            source: MappingSource::Values(program, values),
            out: None,
        })
    });
    let costmaps = nodes.costmaps.as_ref().and_then(|params| {
        let path = file(&params.parameters)?;
        let source = CostmapSource::File(path, None);
        Some(CostmapRequest { source, cells: Vec::new(), images: None })
    });
    let navigation = nodes.navigation.as_ref().map(|params| NavigationRequest {
        parameters: file(&params.parameters),
        defaults: NavigationDefaults {
            base: match params.base {
                ScenarioBase::Differential => RobotBase::Differential,
                ScenarioBase::Omni => RobotBase::Omnidirectional,
                ScenarioBase::Ackermann => {
                    RobotBase::Ackermann { min_turning_radius_m: params.min_turning_radius_m }
                }
            },
            max_speed_m_s: params.max_speed_m_s,
            max_turn_rate_rad_s: params.max_turn_rate_rad_s,
            map: planning_map(scenario),
            ..NavigationDefaults::default()
        },
    });
    Ok(EstimatorRequest {
        has_stack: nodes.costmaps.is_some(),
        detects_robot: true,
        costmaps,
        mapping: mapping.transpose()?,
        navigation,
        ..EstimatorRequest::default()
    })
}

/// Map on which paths are planned.
pub(super) fn planning_map(scenario: &Scenario) -> PlanningMap {
    if scenario.nodes.localization.is_some() {
        PlanningMap::Known
    } else if scenario.nodes.slam.is_some() {
        PlanningMap::Growing
    } else {
        PlanningMap::Absent
    }
}
