//! Costs of single critics that one can compute by hand.

use periplus_controllers::mppi::probe::{CriticScene, SampleTable, score};
use periplus_controllers::mppi::{CriticKind, MppiModel, MppiVelocityLimits};
use periplus_costmap::{Costmap, CostmapView, Footprint, InflationLaw, Nav2Release};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose2;
use periplus_grid::GridInfo;
use periplus_params::Given;

/// Inputs of a check: two samples of four steps of 0.1 s on a path along x.
struct Scene {
    release: Nav2Release,
    model: MppiModel,
    table: SampleTable,
    robot: [f32; 3],
    path: Vec<[f32; 3]>,
    path_length: f32,
    goal: [f32; 3],
    goal_tolerance: Option<f32>,
    furthest: Option<usize>,
    valid: Option<Vec<bool>>,
    costmap: Costmap,
    tracks_unknown: bool,
    footprint: Footprint,
    inflation: Option<InflationLaw>,
}

impl Default for Scene {
    fn default() -> Self {
        let rows = |value: f32| vec![vec![value; 4]; 2];
        let info = GridInfo::new(0.1, 60, 60, Pose2::new(-3.0, -3.0, 0.0)).unwrap();
        Self {
            release: Nav2Release::Main,
            model: MppiModel::DiffDrive,
            table: SampleTable {
                vx: rows(0.0),
                vy: rows(0.0),
                wz: rows(0.0),
                x: rows(0.05),
                y: rows(0.05),
                yaw: rows(0.0),
            },
            robot: [0.0; 3],
            path: (0..30).map(|i| [0.1 * i as f32, 0.0, 0.0]).collect(),
            path_length: 2.9,
            goal: [2.9, 0.0, 0.0],
            goal_tolerance: None,
            furthest: Some(20),
            valid: None,
            costmap: Costmap::new(info, 0),
            tracks_unknown: false,
            footprint: Footprint::circle(0.2),
            inflation: None,
        }
    }
}

impl Scene {
    fn costs(&self, kind: CriticKind, params: &[(&str, &str)]) -> (Vec<f32>, bool) {
        let mut diagnostics = Diagnostics::new();
        let given = params.iter().map(|(name, text)| Given::new(name, *text));
        let values = kind.table().check_given(given, &mut diagnostics);
        assert!(diagnostics.is_empty(), "{diagnostics:?}");
        let scene = CriticScene {
            release: self.release,
            model: self.model,
            step_s: 0.1,
            limits: MppiVelocityLimits { vx_max: 0.5, vx_min: -0.4, vy_max: 0.3, wz_max: 1.9 },
            robot: self.robot,
            path: self.path.clone(),
            path_length: self.path_length,
            goal: self.goal,
            goal_tolerance: self.goal_tolerance,
            furthest: self.furthest,
            valid: self.valid.clone(),
            costmap: CostmapView {
                costs: &self.costmap,
                footprint: &self.footprint,
                is_circular: false,
                tracks_unknown: self.tracks_unknown,
                inflation: self.inflation,
            },
        };
        score(kind, &values, &scene, &self.table)
    }

    fn check(&self, kind: CriticKind, params: &[(&str, &str)], expected: [f32; 2]) {
        let (costs, _) = self.costs(kind, params);
        for (cost, expected) in costs.iter().zip(expected) {
            let tolerance = 2e-5 * expected.abs().max(1.0);
            assert!((cost - expected).abs() < tolerance, "{} {params:?}: {costs:?}", kind.name());
        }
    }
}

#[test]
fn velocities_beyond_the_limits_cost() {
    let mut scene = Scene::default();
    scene.table.vx = vec![vec![0.7; 4], vec![-0.5, -0.5, 0.2, 0.2]];
    // 0.1 s * 4 * 0.2 m/s and 0.1 s * 2 * 0.1 m/s, times 4.
    scene.check(CriticKind::Constraint, &[], [0.32, 0.08]);
    scene.check(CriticKind::Constraint, &[("cost_power", "2")], [0.32 * 0.32, 0.08 * 0.08]);
    scene.check(CriticKind::Constraint, &[("enabled", "false")], [0.0, 0.0]);
    // Before main the limits are those of both axes: hypot(0.5, 0.3) and -hypot(0.4, 0.3).
    scene.release = Nav2Release::Jazzy;
    scene.check(CriticKind::Constraint, &[], [4.0 * 0.4 * (0.7 - 0.34_f32.sqrt()), 0.0]);
}

#[test]
fn sideways_speeds_and_narrow_curves_cost() {
    let mut scene = Scene { model: MppiModel::Omni, ..Scene::default() };
    scene.table.vx = vec![vec![0.4; 4]; 2];
    scene.table.vy = vec![vec![0.5; 4], vec![-0.3; 4]];
    scene.check(CriticKind::Constraint, &[], [4.0 * 0.4 * 0.2, 0.0]);
    scene.release = Nav2Release::Humble;
    let excess = 0.41_f32.sqrt() - 0.34_f32.sqrt();
    scene.check(CriticKind::Constraint, &[], [4.0 * 0.4 * excess, 0.0]);
    scene.model = MppiModel::Ackermann { min_turning_radius_m: 0.4, samples_curvatures: false };
    scene.release = Nav2Release::Main;
    scene.table.wz = vec![vec![2.0; 4], vec![-1.0; 4]];
    scene.check(CriticKind::Constraint, &[], [4.0 * 0.4 * 0.2, 0.0]);
}

#[test]
fn costs_along_a_trajectory_count() {
    let mut scene = Scene::default();
    for (x, cost) in [(30, 100), (31, 200), (32, 254)] {
        scene.costmap.set((x, 30), cost);
    }
    scene.table.x = vec![vec![0.05, 0.05, 0.15, 0.15], vec![0.05, 0.15, 0.25, 0.35]];
    // Steps 0 and 2: (100 + 200) / 2, and a collision.
    let weight = 3.81 / 254.0;
    scene.check(CriticKind::Cost, &[], [weight * 150.0, weight * 1e6 / 2.0]);
    scene.check(
        CriticKind::Cost,
        &[("trajectory_point_step", "1")],
        [weight * 150.0, weight * 1e6 / 4.0],
    );
    // From 150 a point is critical.
    scene.check(
        CriticKind::Cost,
        &[("near_collision_cost", "150")],
        [weight * 200.0, weight * 1e6 / 2.0],
    );
    scene.path_length = 0.4;
    scene.check(CriticKind::Cost, &[("collision_cost", "10")], [0.0, weight * 5.0]);
    let (_, has_failed) = scene.costs(CriticKind::Cost, &[]);
    assert!(!has_failed, "one sample is free");
    scene.costmap.fill(254);
    assert!(scene.costs(CriticKind::Cost, &[]).1);
    // Unknown cells are obstacles unless the costmap distinguishes them.
    scene.costmap.fill(255);
    assert!(scene.costs(CriticKind::Cost, &[]).1);
    scene.tracks_unknown = true;
    assert!(!scene.costs(CriticKind::Cost, &[]).1);
}

#[test]
fn the_outline_of_the_robot_collides_where_its_centre_does_not() {
    let footprint = Footprint::new(vec![[0.5, 0.1], [0.5, -0.1], [-0.1, -0.1], [-0.1, 0.1]]);
    let mut scene = Scene { footprint, ..Scene::default() };
    scene.costmap.fill(1);
    scene.costmap.set((34, 31), 254);
    // Ahead of a robot at (0.05, 0.05) along x, beside one along y.
    scene.table.yaw = vec![vec![0.0; 4], vec![1.570_796; 4]];
    let weight = 3.81 / 254.0;
    let params = [("consider_footprint", "true"), ("collision_cost", "1000")];
    scene.check(CriticKind::Cost, &params, [weight * 500.0, weight]);
    scene.check(CriticKind::Cost, &params[1..], [weight, weight]);
}

#[test]
fn distances_to_obstacles_follow_from_the_inflation() {
    let mut scene = Scene {
        inflation: Some(InflationLaw { radius_m: 0.5, scaling_per_m: 2.0 }),
        ..Scene::default()
    };
    // 253 exp(-2 * 0.3 m) = 138.8
    scene.costmap.set((30, 30), 139);
    scene.table.x[1] = vec![0.25; 4];
    let distance = (253.0_f32 / 139.0).ln() / 2.0;
    scene.check(CriticKind::Obstacles, &[], [1.5 * (0.5 - distance), 0.0]);
    let margin = 20.0 * 4.0 * (0.35 - distance);
    scene.check(
        CriticKind::Obstacles,
        &[("collision_margin_distance", "0.35")],
        [margin + 1.5 * (0.5 - distance), 0.0],
    );
    // The lowest repulsion of all samples is subtracted, except in Humble, whose parameters give the law.
    scene.table.x[1] = vec![0.05; 4];
    scene.check(CriticKind::Obstacles, &[], [0.0, 0.0]);
    scene.release = Nav2Release::Humble;
    let humble = [("cost_scaling_factor", "2"), ("inflation_radius", "0.5")];
    scene.check(CriticKind::Obstacles, &humble, [1.5 * (0.5 - distance); 2]);
    scene.costmap.set((30, 30), 253);
    let (costs, has_failed) = scene.costs(CriticKind::Obstacles, &[]);
    assert!(has_failed);
    assert_eq!(costs, [20.0 * 1e5; 2]);
}

#[test]
fn goals_attract_when_they_are_near() {
    let mut scene = Scene { path_length: 1.0, ..Scene::default() };
    scene.path = vec![[0.0, 0.0, 0.0], [0.3, 0.4, 1.0]];
    scene.table.x = vec![vec![0.0; 4], vec![0.3; 4]];
    scene.table.y = vec![vec![0.0; 4], vec![0.0, 0.0, 0.4, 0.4]];
    scene.check(CriticKind::Goal, &[], [5.0 * 0.5, 5.0 * 0.2]);
    scene.check(CriticKind::Goal, &[("threshold_to_consider", "0.9")], [0.0, 0.0]);
    // Jazzy measures the distance to the end of the whole plan.
    scene.release = Nav2Release::Jazzy;
    scene.goal = [0.0, 1.0, 0.0];
    scene.check(CriticKind::Goal, &[], [5.0, 5.0 * 0.5 * (1.09_f32.sqrt() + 0.45_f32.sqrt())]);
    scene.goal = [0.0, 1.5, 0.0];
    scene.check(CriticKind::Goal, &[], [0.0, 0.0]);
}

#[test]
fn headings_at_the_goal_count() {
    let mut scene = Scene { path_length: 0.4, ..Scene::default() };
    scene.path = vec![[0.0, 0.0, 0.0], [0.1, 0.0, 3.0]];
    scene.table.yaw = vec![vec![1.0; 4], vec![-3.0, -3.0, 3.0, 3.0]];
    let wrapped = 2.0 * std::f32::consts::PI - 6.0;
    scene.check(CriticKind::GoalAngle, &[], [3.0 * 2.0, 3.0 * wrapped / 2.0]);
    let opposite = std::f32::consts::PI - 2.0;
    scene.check(
        CriticKind::GoalAngle,
        &[("symmetric_yaw_tolerance", "true")],
        [3.0 * opposite, 3.0 * wrapped / 2.0],
    );
}

#[test]
fn trajectories_are_compared_with_the_path_point_by_point() {
    let mut scene = Scene::default();
    scene.table.x = vec![vec![0.0, 0.1, 0.2, 0.3], vec![0.0, 0.1, 0.2, 0.3]];
    scene.table.y = vec![vec![0.0; 4], vec![0.2; 4]];
    let params = [("trajectory_point_step", "1")];
    scene.check(CriticKind::PathAlign, &params, [0.0, 2.0]);
    // Too few reached points, a near goal, obstacles on the path.
    scene.check(CriticKind::PathAlign, &[("offset_from_furthest", "21")], [0.0, 0.0]);
    scene.check(CriticKind::PathAlign, &[("threshold_to_consider", "3.0")], [0.0, 0.0]);
    let mut valid = vec![true; 29];
    valid[1..4].fill(false);
    scene.valid = Some(valid.clone());
    scene.check(CriticKind::PathAlign, &params, [0.0, 0.0]);
    // Two blocked points do not count: that is the only point left.
    valid[3] = true;
    scene.valid = Some(valid);
    scene.check(CriticKind::PathAlign, &params, [0.0, 2.0]);
    scene.table.yaw[0] = vec![0.3; 4];
    scene.check(CriticKind::PathAlign, &[params[0], ("use_path_orientations", "true")], [3.0, 2.0]);
}

#[test]
fn humble_compares_with_the_nearest_point_too() {
    let mut scene = Scene { release: Nav2Release::Humble, ..Scene::default() };
    scene.table.x = vec![vec![0.0, 0.5, 1.0, 1.5], vec![0.0, 0.5, 1.0, 1.5]];
    scene.table.y = vec![vec![0.0; 4], vec![0.0, 0.1, 0.1, 0.1]];
    let params = [("trajectory_point_step", "1")];
    // Three of four points are compared.
    scene.check(CriticKind::PathAlignLegacy, &params, [0.0, 10.0 * 0.3 / 4.0]);
}

#[test]
fn robots_turn_towards_the_path() {
    let mut scene = Scene { furthest: Some(6), robot: [0.0, 0.0, 2.0], ..Scene::default() };
    scene.table.x = vec![vec![0.0; 4]; 2];
    scene.table.y = vec![vec![0.0; 4]; 2];
    scene.table.yaw = vec![vec![2.0, 2.0, 2.0, 1.5], vec![-3.0; 4]];
    scene.check(CriticKind::PathAngle, &[], [2.2 * 1.5, 2.2 * 3.0]);
    scene.check(CriticKind::PathAngle, &[("max_angle_to_furthest", "2.1")], [0.0, 0.0]);
    // Backwards is nearer.
    let pi = std::f32::consts::PI;
    scene.check(CriticKind::PathAngle, &[("mode", "1")], [2.2 * 1.5, 2.2 * (pi - 3.0)]);
    // The path is to be driven backwards.
    scene.path.iter_mut().for_each(|pose| pose[2] = pi);
    scene.check(CriticKind::PathAngle, &[("mode", "2")], [2.2 * (pi - 1.5), 2.2 * (pi - 3.0)]);
    // Humble takes the mean over all points.
    scene.release = Nav2Release::Humble;
    scene.check(CriticKind::PathAngle, &[], [2.2 * (2.0 * 3.0 + 1.5) / 4.0, 2.2 * 3.0]);
}

#[test]
fn trajectories_end_near_a_point_beyond_the_furthest() {
    let mut scene = Scene { furthest: Some(10), ..Scene::default() };
    scene.table.x = vec![vec![0.0, 0.0, 0.0, 1.2], vec![0.0; 4]];
    scene.table.y = vec![vec![0.0, 0.0, 0.0, 0.3], vec![0.0; 4]];
    scene.check(CriticKind::PathFollow, &[], [5.0 * 0.5, 5.0 * 1.6]);
    // The aim is blocked up to point 19.
    let mut valid = vec![true; 29];
    valid[16..19].fill(false);
    scene.valid = Some(valid);
    scene.check(
        CriticKind::PathFollow,
        &[],
        [5.0 * 0.49_f32.hypot(0.0).max((0.7_f32 * 0.7 + 0.09).sqrt()), 5.0 * 1.9],
    );
    scene.check(CriticKind::PathFollow, &[("threshold_to_consider", "3.0")], [0.0, 0.0]);
}

#[test]
fn preferred_velocities_cost_nothing() {
    let mut scene = Scene::default();
    scene.table.vx = vec![vec![-0.2, -0.2, 0.3, 0.3], vec![0.1; 4]];
    scene.table.wz = vec![vec![0.5, -0.5, 0.5, -0.5], vec![0.0; 4]];
    scene.check(CriticKind::PreferForward, &[], [5.0 * 0.1 * 0.4, 0.0]);
    scene.check(CriticKind::Twirling, &[], [10.0 * 0.5, 0.0]);
    // 0.1 m/s are missing in two steps, and 0.2 rad/s in none.
    let deadband = [("deadband_velocities", "[0.3, 0.0, 0.4]")];
    scene.check(
        CriticKind::VelocityDeadband,
        &deadband,
        [35.0 * 0.1 * 0.2, 35.0 * 0.1 * 4.0 * 0.6],
    );
    scene.goal_tolerance = Some(3.0);
    scene.check(CriticKind::Twirling, &[], [0.0, 0.0]);
}
