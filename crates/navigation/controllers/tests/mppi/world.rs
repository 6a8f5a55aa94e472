//! Costmaps, parameters and a robot for the tests.

use periplus_controllers::mppi::{Mppi, MppiSetup, create};
use periplus_controllers::{ControlError, ControlInput, Controller, GoalTolerance};
use periplus_costmap::inflation::{CostTable, InflationBuffers, InflationSettings, inflate};
use periplus_costmap::{CellWindow, Costmap, CostmapView, Footprint, InflationLaw, Nav2Release};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose2, Twist2, normalize_angle};
use periplus_grid::GridInfo;
use periplus_params::Given;

/// Critics of the stock files.
pub(crate) const STOCK_CRITICS: &str = "ConstraintCritic CostCritic GoalCritic GoalAngleCritic PathAlignCritic \
                                 PathFollowCritic PathAngleCritic PreferForwardCritic";

/// Period of the controller \[s\].
const PERIOD_S: f64 = 0.05;

/// Length of the plan that the controller gets \[m\].
const PRUNE_DISTANCE_M: f64 = 1.7;

pub(crate) fn setup(release: Nav2Release) -> MppiSetup<'static> {
    MppiSetup {
        group: "FollowPath",
        release,
        controller_frequency_hz: 1.0 / PERIOD_S,
        seed: 7,
        others: &[],
    }
}

/// Controller with the stock critics and some parameters.
pub(crate) fn controller(release: Nav2Release, params: &[(&str, &str)]) -> Mppi {
    let mut named = vec![
        ("FollowPath.critics".to_owned(), STOCK_CRITICS.to_owned()),
        ("FollowPath.PathAlignCritic.cost_weight".to_owned(), "14.0".to_owned()),
        ("FollowPath.PathFollowCritic.offset_from_furthest".to_owned(), "5".to_owned()),
    ];
    for (name, text) in params {
        named.retain(|(known, _)| known != &format!("FollowPath.{name}"));
        named.push((format!("FollowPath.{name}"), (*text).to_owned()));
    }
    let given = named.iter().map(|(name, text)| Given::new(name, text.as_str()));
    let mut diagnostics = Diagnostics::new();
    let controller = create(&setup(release), given, &mut diagnostics);
    assert!(!diagnostics.has_errors(), "{diagnostics:?}");
    controller.expect("a controller")
}

/// Room with a round robot of 0.2 m radius.
pub(crate) struct World {
    pub(crate) costmap: Costmap,
    pub(crate) footprint: Footprint,
    pub(crate) law: InflationLaw,
}

impl World {
    /// Room of 12 x 6 m from (-1, -3), with obstacles: x0, y0, x1, y1 \[m\].
    pub(crate) fn new(obstacles: &[[f64; 4]]) -> Self {
        let info = GridInfo::new(0.05, 240, 120, Pose2::new(-1.0, -3.0, 0.0)).unwrap();
        let mut costmap = Costmap::new(info, 0);
        for [x0, y0, x1, y1] in obstacles {
            for index in 0..info.len() {
                let cell = info.cell(index);
                let (x, y) = info.centre_of(cell);
                if (*x0..=*x1).contains(&x) && (*y0..=*y1).contains(&y) {
                    costmap.set(cell, 254);
                }
            }
        }
        let law = InflationLaw { radius_m: 0.6, scaling_per_m: 3.0 };
        let table = CostTable::new(0.05, law.radius_m, 0.2, law.scaling_per_m, Nav2Release::Main);
        let (all, how) = (CellWindow::all(&info), InflationSettings::default());
        inflate(&mut costmap, &all, &table, how, &mut InflationBuffers::default());
        Self { costmap, footprint: Footprint::circle(0.2), law }
    }

    pub(crate) fn view(&self) -> CostmapView<'_> {
        CostmapView {
            costs: &self.costmap,
            footprint: &self.footprint,
            is_circular: true,
            tracks_unknown: false,
            inflation: Some(self.law),
        }
    }

    /// Inputs of a cycle.
    pub(crate) fn input<'a>(
        &'a self,
        robot: &Robot,
        plan: &'a [Pose2],
        goal: Pose2,
    ) -> ControlInput<'a> {
        ControlInput {
            time_ns: robot.time_ns,
            pose: robot.pose,
            velocity: robot.velocity,
            costmap: self.view(),
            plan,
            goal,
            tolerance: GoalTolerance { xy_m: Some(0.25), yaw_rad: Some(0.25) },
            is_position_reached: false,
        }
    }
}

/// Straight plan with a point every 0.05 m, also beyond the last whole one.
pub(crate) fn straight(from: [f64; 2], to: [f64; 2]) -> Vec<Pose2> {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length_m = libm::hypot(dx, dy);
    let count = (length_m / 0.05).ceil() as usize;
    let yaw_rad = libm::atan2(dy, dx);
    let point = |i: usize| {
        let part = i as f64 / count as f64;
        Pose2::new(from[0] + dx * part, from[1] + dy * part, yaw_rad)
    };
    (0..=count).map(point).collect()
}

/// Robot that moves exactly as commanded.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Robot {
    pub(crate) pose: Pose2,
    pub(crate) velocity: Twist2,
    pub(crate) time_ns: i64,
}

impl Robot {
    pub(crate) fn apply(&mut self, command: Twist2) {
        let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = command;
        let middle_rad = self.pose.yaw_rad + 0.5 * wz_rad_s * PERIOD_S;
        let (sine, cosine) = libm::sincos(middle_rad);
        self.pose.x_m += (vx_m_s * cosine - vy_m_s * sine) * PERIOD_S;
        self.pose.y_m += (vx_m_s * sine + vy_m_s * cosine) * PERIOD_S;
        self.pose.yaw_rad = normalize_angle(self.pose.yaw_rad + wz_rad_s * PERIOD_S);
        self.velocity = command;
        self.time_ns += 50_000_000;
    }
}

/// Part of the plan from the point nearest to the robot.
pub(crate) fn pruned(plan: &[Pose2], pose: Pose2, first: &mut usize) -> Vec<Pose2> {
    let distance = |at: &Pose2| libm::hypot(at.x_m - pose.x_m, at.y_m - pose.y_m);
    let window = plan.iter().enumerate().skip(*first).take(30);
    let nearest = window.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
    *first = nearest.map_or(*first, |(index, _)| index);
    let count = (PRUNE_DISTANCE_M / 0.05) as usize;
    plan[*first..].iter().take(count).copied().collect()
}

/// Course of a drive.
#[derive(Clone, Debug, Default)]
pub(crate) struct Drive {
    pub(crate) robot: Robot,
    pub(crate) commands: Vec<Twist2>,
    pub(crate) highest_cost: u8,
    pub(crate) is_at_goal: bool,
}

/// Drives along a plan until the goal is reached, at most for a number of cycles.
pub(crate) fn drive(
    world: &World,
    controller: &mut Mppi,
    robot: Robot,
    plan: &[Pose2],
    cycles: usize,
) -> Result<Drive, ControlError> {
    let mut drive = Drive { robot, ..Drive::default() };
    let goal = *plan.last().expect("a plan");
    let mut first = 0;
    for _ in 0..cycles {
        let pose = drive.robot.pose;
        let distance_m = libm::hypot(pose.x_m - goal.x_m, pose.y_m - goal.y_m);
        let turn_rad = normalize_angle(pose.yaw_rad - goal.yaw_rad);
        if distance_m < 0.25 && turn_rad.abs() < 0.25 {
            drive.is_at_goal = true;
            break;
        }
        let local = pruned(plan, pose, &mut first);
        let command = controller.compute_velocity(&world.input(&drive.robot, &local, goal))?;
        drive.robot.apply(command);
        drive.commands.push(command);
        let cost = world.costmap.cost_at(drive.robot.pose.x_m, drive.robot.pose.y_m);
        drive.highest_cost = drive.highest_cost.max(cost.unwrap_or(255));
    }
    Ok(drive)
}
