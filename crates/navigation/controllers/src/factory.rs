//! Creation of plugins from the names of their classes and their parameters.

use periplus_diagnostics::{Diagnostic, Diagnostics, closest};

use crate::goal_checker::{
    ADAPTIVE_GOAL_CHECKER, AXIS_GOAL_CHECKER, AdaptiveGoalChecker, AxisGoalChecker, GoalChecker,
    POSITION_GOAL_CHECKER, SIMPLE_GOAL_CHECKER, STOPPED_GOAL_CHECKER, SimpleGoalChecker,
};
use crate::path_handler::{FEASIBLE_PATH_HANDLER, PathHandler};
use crate::progress_checker::{POSE_PROGRESS_CHECKER, ProgressChecker, SIMPLE_PROGRESS_CHECKER};
use crate::{Controller, PluginSetup};

/// Function that creates a controller; none after an error that it has reported.
type CreateController = fn(&PluginSetup<'_>, &mut Diagnostics) -> Option<Box<dyn Controller>>;

/// Classes of controllers.
const CONTROLLERS: &[(&str, CreateController)] = &[
    ("nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController", crate::rpp::create),
    ("nav2_graceful_controller::GracefulController", crate::graceful::create),
    ("nav2_rotation_shim_controller::RotationShimController", crate::rotation_shim::create),
    ("dwb_core::DWBLocalPlanner", crate::dwb::create),
    ("nav2_mppi_controller::MPPIController", crate::mppi::create_plugin),
    ("dwa_local_planner::DWAPlannerROS", crate::ros1::create_dwa),
    ("base_local_planner::TrajectoryPlannerROS", crate::ros1::create_trajectory_planner),
    ("teb_local_planner::TebLocalPlannerROS", crate::ros1::create_teb),
];

/// Function that creates a goal checker.
type CreateGoalChecker = fn(&PluginSetup<'_>, &mut Diagnostics) -> Box<dyn GoalChecker>;

/// Classes of goal checkers.
const GOAL_CHECKERS: &[(&str, CreateGoalChecker)] = &[
    ("nav2_controller::SimpleGoalChecker", |setup, diagnostics| {
        let values = setup.read(&SIMPLE_GOAL_CHECKER, diagnostics);
        Box::new(SimpleGoalChecker::new(values, setup.release))
    }),
    ("nav2_controller::StoppedGoalChecker", |setup, diagnostics| {
        let values = setup.read(&STOPPED_GOAL_CHECKER, diagnostics);
        Box::new(SimpleGoalChecker::new(values, setup.release))
    }),
    ("nav2_controller::PositionGoalChecker", |setup, diagnostics| {
        let values = setup.read(&POSITION_GOAL_CHECKER, diagnostics);
        Box::new(SimpleGoalChecker::new(values, setup.release))
    }),
    ("nav2_controller::AxisGoalChecker", |setup, diagnostics| {
        Box::new(AxisGoalChecker::new(setup.read(&AXIS_GOAL_CHECKER, diagnostics)))
    }),
    ("nav2_controller::AdaptiveToleranceGoalChecker", |setup, diagnostics| {
        Box::new(AdaptiveGoalChecker::new(setup.read(&ADAPTIVE_GOAL_CHECKER, diagnostics)))
    }),
];

/// Function that creates a progress checker.
type CreateProgressChecker = fn(&PluginSetup<'_>, &mut Diagnostics) -> ProgressChecker;

/// Classes of progress checkers.
const PROGRESS_CHECKERS: &[(&str, CreateProgressChecker)] = &[
    ("nav2_controller::SimpleProgressChecker", |setup, diagnostics| {
        ProgressChecker::new(setup.read(&SIMPLE_PROGRESS_CHECKER, diagnostics))
    }),
    ("nav2_controller::PoseProgressChecker", |setup, diagnostics| {
        ProgressChecker::new(setup.read(&POSE_PROGRESS_CHECKER, diagnostics))
    }),
];

/// Function that creates a path handler.
type CreatePathHandler = fn(&PluginSetup<'_>, &mut Diagnostics) -> PathHandler;

/// Classes of path handlers.
const PATH_HANDLERS: &[(&str, CreatePathHandler)] =
    &[("nav2_controller::FeasiblePathHandler", |setup, diagnostics| {
        PathHandler::from_values(setup.read(&FEASIBLE_PATH_HANDLER, diagnostics), setup.release)
    })];

/// Creates a controller of a class, `package::Class` or `package/Class`, from parameters of its group. Findings about
/// the parameters are reported; none after an error that makes the controller impossible.
///
/// ```
/// use periplus_controllers::{PluginSetup, create_controller};
/// use periplus_diagnostics::Diagnostics;
///
/// let mut diagnostics = Diagnostics::new();
/// let setup = PluginSetup::new("FollowPath");
/// let class = "nav2_regulated_pure_pursuit_controler::RegulatedPurePursuitControler";
/// assert!(create_controller(class, &setup, &mut diagnostics).is_none());
/// let finding = diagnostics.iter().next().expect("a finding");
/// assert!(finding.help[0].contains("did you mean"));
/// ```
#[must_use]
pub fn create_controller(
    class: &str,
    setup: &PluginSetup<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Controller>> {
    find("controller", CONTROLLERS, class, setup, diagnostics)
        .and_then(|create| create(setup, diagnostics))
}

/// Creates a goal checker of a class; none after an error that it has reported.
#[must_use]
pub fn create_goal_checker(
    class: &str,
    setup: &PluginSetup<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn GoalChecker>> {
    find("goal checker", GOAL_CHECKERS, class, setup, diagnostics)
        .map(|create| create(setup, diagnostics))
}

/// Creates a path handler of a class; none after an error that it has reported.
#[must_use]
pub fn create_path_handler(
    class: &str,
    setup: &PluginSetup<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<PathHandler> {
    find("path handler", PATH_HANDLERS, class, setup, diagnostics)
        .map(|create| create(setup, diagnostics))
}

impl ProgressChecker {
    /// Creates a progress checker of a class; none after an error that it has reported.
    #[must_use]
    pub fn create(
        class: &str,
        setup: &PluginSetup<'_>,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        find("progress checker", PROGRESS_CHECKERS, class, setup, diagnostics)
            .map(|create| create(setup, diagnostics))
    }
}

/// Returns the names of all classes of controllers.
pub fn controller_classes() -> impl Iterator<Item = &'static str> {
    CONTROLLERS.iter().map(|(class, _)| *class)
}

/// Returns the function for a class, or reports that there is none.
fn find<T: Copy>(
    what: &str,
    classes: &'static [(&'static str, T)],
    class: &str,
    setup: &PluginSetup<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<T> {
    let written = class.trim().replace('/', "::");
    if let Some((_, create)) = classes.iter().find(|(known, _)| *known == written) {
        return Some(*create);
    }
    let names: Vec<&str> = classes.iter().map(|(known, _)| *known).collect();
    let mut diagnostic = Diagnostic::error(
        "unknown-plugin",
        format!("`{}`: there is no {what} `{class}`", setup.name),
    )
    .at(setup.class_origin)
    .note(format!("known are {}", names.join(", ")));
    if let Some(near) = nearest_class(&written, &names) {
        let near = if class.contains('/') { near.replace("::", "/") } else { near.to_owned() };
        let message = format!("did you mean `{near}`?");
        diagnostic = diagnostic.replace(setup.class_origin, near, message);
    }
    diagnostics.push(diagnostic);
    None
}

/// Returns the class with the most similar name, first without regard to the package.
fn nearest_class<'a>(written: &str, known: &[&'a str]) -> Option<&'a str> {
    let name_of = |class: &'a str| class.rsplit("::").next().unwrap_or(class);
    let name = written.rsplit("::").next().unwrap_or(written);
    if let Some(class) = known.iter().find(|class| name_of(class) == name) {
        return Some(class);
    }
    let near = closest(name, known.iter().map(|class| name_of(class)))?;
    known.iter().find(|class| name_of(class) == near).copied()
}
