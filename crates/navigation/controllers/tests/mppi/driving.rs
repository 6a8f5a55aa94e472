//! A kinematic robot driven by the controller.

use periplus_controllers::{ControlError, Controller};
use periplus_costmap::Nav2Release;
use periplus_geometry::{Pose2, Twist2};
use proptest::prelude::*;

use crate::world::{Robot, STOCK_CRITICS, World, controller, drive, pruned, straight};

const MODELS: [&str; 3] = ["DiffDrive", "Omni", "Ackermann"];

fn model_params(model: &str) -> [(&str, &str); 3] {
    [("motion_model", model), ("batch_size", "600"), ("AckermannConstraints.min_turning_r", "0.4")]
}

#[test]
fn a_free_path_is_followed_at_nearly_the_highest_speed() {
    let world = World::new(&[]);
    for release in Nav2Release::ALL {
        for model in MODELS {
            let mut controller = controller(release, &model_params(model));
            let plan = straight([0.0, 0.0], [9.0, 0.0]);
            let drive = drive(&world, &mut controller, Robot::default(), &plan, 120).unwrap();
            let speeds: f64 = drive.commands[60..].iter().map(|it| it.vx_m_s).sum();
            let mean = speeds / 60.0;
            assert!((0.41..=0.505).contains(&mean), "{release} {model}: {mean} m/s");
            assert!(drive.robot.pose.y_m.abs() < 0.1, "{release} {model}: {:?}", drive.robot.pose);
            let fastest = drive.commands.iter().map(|it| it.vx_m_s).fold(0.0, f64::max);
            // The filter of releases before main may exceed the limit a little.
            assert!(fastest <= 0.505, "{release} {model}: {fastest}");
        }
    }
}

/// Beside the goal, with its heading: it must turn away from it to come nearer.
#[test]
fn a_robot_does_not_stand_just_outside_of_the_tolerance() {
    let world = World::new(&[]);
    for release in Nav2Release::ALL {
        for offset_m in [0.27, 0.35] {
            let mut controller = controller(release, &model_params("DiffDrive"));
            let mut plan = straight([0.0, 0.0], [offset_m, 0.0]);
            let quarter = std::f64::consts::FRAC_PI_2;
            plan.last_mut().unwrap().yaw_rad = quarter;
            let mut robot = Robot { pose: Pose2::new(0.0, 0.0, quarter), ..Robot::default() };
            let goal = plan[plan.len() - 1];
            let distance_m = |pose: Pose2| libm::hypot(pose.x_m - goal.x_m, pose.y_m - goal.y_m);
            while distance_m(robot.pose) > 0.25 {
                assert!(robot.time_ns < 8_000_000_000, "{release} {offset_m}: {:?}", robot.pose);
                let local = pruned(&plan, robot.pose, &mut 0);
                let input = world.input(&robot, &local, goal);
                robot.apply(controller.compute_velocity(&input).unwrap());
            }
        }
    }
}

#[test]
fn obstacles_are_avoided_on_the_path_to_the_goal() {
    // Two boxes that the plan avoids, and one that reaches to 0.05 m from it.
    let boxes = [[2.0, -1.5, 2.4, 0.12], [4.4, -0.12, 4.8, 1.5], [3.3, 0.05, 3.5, 1.0]];
    let world = World::new(&boxes);
    for release in [Nav2Release::Humble, Nav2Release::Jazzy, Nav2Release::Main] {
        for model in MODELS {
            let mut controller = controller(release, &model_params(model));
            let drive = drive(&world, &mut controller, Robot::default(), &around(), 500).unwrap();
            assert!(drive.is_at_goal, "{release} {model}: {:?}", drive.robot.pose);
            assert!(drive.highest_cost < 253, "{release} {model}: {}", drive.highest_cost);
        }
    }
}

#[test]
fn a_robot_before_a_wall_stops_and_explains_it() {
    let world = World::new(&[[2.0, -3.0, 2.4, 3.0]]);
    let mut controller = controller(Nav2Release::Jazzy, &model_params("DiffDrive"));
    let plan = straight([0.0, 0.0], [7.0, 0.0]);
    let drive = drive(&world, &mut controller, Robot::default(), &plan, 200).unwrap();
    assert!(drive.robot.pose.x_m < 1.8 && drive.highest_cost < 253, "{drive:?}");
    let reason = controller.explain_speed().unwrap();
    assert!(reason.contains("the path is blocked"), "{reason}");
}

/// Plan around two boxes, as a planner makes it.
fn around() -> Vec<Pose2> {
    let corners = [[0.0, 0.0], [2.0, 0.45], [2.6, 0.45], [4.2, -0.45], [5.0, -0.45], [7.0, 0.0]];
    let legs = corners.windows(2).map(|leg| straight(leg[0], leg[1]));
    let mut plan: Vec<Pose2> = legs
        .flat_map(|mut leg| {
            leg.pop();
            leg
        })
        .collect();
    plan.push(Pose2::new(7.0, 0.0, 0.0));
    plan
}

#[test]
fn steered_wheels_get_curves_that_they_can_drive() {
    let world = World::new(&[]);
    for release in Nav2Release::ALL {
        let mut controller = controller(release, &model_params("Ackermann"));
        let plan = straight([0.0, 0.0], [2.0, 2.0]);
        let drive = drive(&world, &mut controller, Robot::default(), &plan, 80).unwrap();
        // The filter of releases before main follows the limit and may exceed it a little.
        let slack = if release == Nav2Release::Main { 1e-3 } else { 0.3 };
        for Twist2 { vx_m_s, wz_rad_s, .. } in drive.commands {
            assert!(wz_rad_s.abs() <= vx_m_s.abs() / 0.4 + slack, "{release}: {vx_m_s} {wz_rad_s}");
        }
    }
}

/// Regression test: a car with a heading beside that of its path stopped before a cusp, because samples turned in place.
#[test]
fn a_car_that_samples_curvatures_reaches_a_near_cusp() {
    let world = World::new(&[]);
    // Backwards along an arc of 0.45 m, up to the cusp.
    let on_arc = |step: u32| {
        let (sine, cosine) = libm::sincos(0.18 * f64::from(step));
        Pose2::new(-0.5 * sine, 0.5 * (1.0 - cosine), -0.18 * f64::from(step))
    };
    let plan: Vec<Pose2> = (0..6).map(on_arc).collect();
    let critics = STOCK_CRITICS.replace(" PreferForwardCritic", "");
    let reaches = |samples_curvatures: &str| {
        let params = [
            ("critics", critics.as_str()),
            ("motion_model", "Ackermann"),
            ("AckermannConstraints.min_turning_r", "0.5"),
            ("AckermannConstraints.sample_curvatures", samples_curvatures),
            ("GoalCritic.threshold_to_consider", "0.3"),
            ("PathFollowCritic.threshold_to_consider", "0.3"),
            ("PathAlignCritic.threshold_to_consider", "0.1"),
            ("PathAlignCritic.offset_from_furthest", "1"),
            ("PathAlignCritic.use_path_orientations", "true"),
            ("PathAngleCritic.mode", "2"),
        ];
        let mut controller = controller(Nav2Release::Main, &params);
        let robot = Robot { pose: Pose2::new(0.0, 0.0, 0.35), ..Robot::default() };
        let drive = drive(&world, &mut controller, robot, &plan, 150).unwrap();
        for Twist2 { vx_m_s, wz_rad_s, .. } in &drive.commands {
            assert!(wz_rad_s.abs() <= vx_m_s.abs() / 0.5 + 1e-3, "{vx_m_s} {wz_rad_s}");
        }
        drive.is_at_goal
    };
    assert!(reaches("true"));
    assert!(!reaches("false"), "as in Nav2");
}

#[test]
fn accelerations_are_limited() {
    let world = World::new(&[]);
    let params = [("ax_max", "1.0"), ("az_max", "1.0"), ("batch_size", "600")];
    let mut controller = controller(Nav2Release::Main, &params);
    let plan = straight([0.0, 0.0], [3.0, 3.0]);
    let drive = drive(&world, &mut controller, Robot::default(), &plan, 60).unwrap();
    let mut last = Twist2::ZERO;
    for command in drive.commands {
        assert!(command.vx_m_s - last.vx_m_s <= 0.0501, "{last:?} {command:?}");
        assert!((command.wz_rad_s - last.wz_rad_s).abs() <= 0.0501, "{last:?} {command:?}");
        last = command;
    }
}

#[test]
fn the_optimal_trajectory_is_free_of_obstacles() {
    let world = World::new(&[[1.0, -0.3, 1.2, 0.1]]);
    let plan = straight([0.0, 0.0], [3.0, 0.0]);
    let mut robot = Robot::default();
    let mut first = 0;
    let mut controller = controller(Nav2Release::Main, &[("batch_size", "600")]);
    for _ in 0..60 {
        let local = pruned(&plan, robot.pose, &mut first);
        let input = world.input(&robot, &local, plan[plan.len() - 1]);
        let command = controller.compute_velocity(&input).unwrap();
        let trajectory = controller.optimal_trajectory();
        assert_eq!(trajectory.len(), 56);
        for point in &trajectory[..40] {
            let cost = world.costmap.cost_at(point.pose.x_m, point.pose.y_m);
            assert!(cost.unwrap_or(0) < 253, "{cost:?} at {point:?}");
        }
        robot.apply(command);
    }
}

#[test]
fn a_robot_in_an_obstacle_gets_no_command_and_a_reason() {
    let world = World::new(&[
        [0.3, -2.0, 0.4, 2.0],
        [-0.5, -2.0, -0.3, 2.0],
        [-0.5, 0.25, 0.5, 0.3],
        [-0.5, -0.35, 0.5, -0.25],
    ]);
    for release in Nav2Release::ALL {
        let mut controller = controller(release, &[("batch_size", "200")]);
        let robot = Robot { pose: Pose2::new(0.15, 0.0, 0.0), ..Robot::default() };
        let plan = straight([0.15, 0.0], [3.0, 0.0]);
        let input = world.input(&robot, &plan, plan[plan.len() - 1]);
        let Err(ControlError::NoValidControl(reason)) = controller.compute_velocity(&input) else {
            panic!("{release}: there is no valid control");
        };
        assert!(
            reason.starts_with("all 200 samples collide: the nearest obstacle is 0.1"),
            "{reason}"
        );
        assert!(reason.contains("m ahead of the robot's centre"), "{reason}");
        assert!(reason.contains("nearer to an obstacle than its inscribed radius"), "{reason}");
        assert_eq!(controller.collision_ratio(), 0.0, "the optimizer starts again");
    }
}

#[test]
fn a_robot_outside_of_the_costmap_is_reported() {
    let world = World::new(&[]);
    let robot = Robot { pose: Pose2::new(40.0, 0.0, 0.0), ..Robot::default() };
    let plan = straight([40.0, 0.0], [43.0, 0.0]);
    let mut controller = controller(Nav2Release::Jazzy, &[("batch_size", "64")]);
    let input = world.input(&robot, &plan, plan[plan.len() - 1]);
    let error = controller.compute_velocity(&input).unwrap_err().to_string();
    assert!(error.contains("(40.00, 0.00) is outside the local costmap"), "{error}");
}

#[test]
fn wrong_inputs_are_errors() {
    let world = World::new(&[]);
    let mut controller = controller(Nav2Release::Main, &[("batch_size", "64")]);
    let robot = Robot::default();
    let error = controller.compute_velocity(&world.input(&robot, &[], Pose2::IDENTITY));
    assert!(matches!(error, Err(ControlError::InvalidPath(_))), "{error:?}");
    let bad = Robot { velocity: Twist2::new(f64::NAN, 0.0, 0.0), ..robot };
    let plan = straight([0.0, 0.0], [3.0, 0.0]);
    let error = controller.compute_velocity(&world.input(&bad, &plan, plan[0]));
    assert!(matches!(error, Err(ControlError::NoValidControl(_))), "{error:?}");
}

#[test]
fn a_speed_limit_slows_the_robot_and_is_explained() {
    let world = World::new(&[]);
    for release in Nav2Release::ALL {
        let mut controller = controller(release, &[("batch_size", "600")]);
        controller.set_speed_limit(40.0, true);
        let plan = straight([0.0, 0.0], [9.0, 0.0]);
        let drive = drive(&world, &mut controller, Robot::default(), &plan, 60).unwrap();
        let speed = drive.commands[59].vx_m_s;
        assert!((0.15..=0.2001).contains(&speed), "{release}: {speed}");
        let reason = controller.explain_speed().unwrap();
        assert!(reason.contains("the speed limit allows 0.20 m/s"), "{reason}");
        controller.set_speed_limit(0.0, false);
        let drive = crate::world::drive(&world, &mut controller, drive.robot, &plan, 60).unwrap();
        assert!(drive.commands[59].vx_m_s > 0.4, "{release}: {:?}", drive.commands[59]);
        assert_eq!(controller.explain_speed(), None, "{release}");
    }
}

#[test]
fn results_are_offered_for_publication() {
    let world = World::new(&[[1.0, 0.25, 1.2, 0.5]]);
    let params = [("batch_size", "500"), ("visualize", "true"), ("critic_index_to_visualize", "2")];
    let mut controller = controller(Nav2Release::Main, &params);
    let robot = Robot { velocity: Twist2::new(0.4, 0.0, 0.0), ..Robot::default() };
    let plan = straight([0.0, 0.0], [3.0, 0.0]);
    let input = world.input(&robot, &plan, plan[plan.len() - 1]);
    controller.compute_velocity(&input).unwrap();
    let candidates = controller.candidates();
    assert_eq!((candidates.len(), candidates[0].poses.len()), (100, 19));
    assert_eq!(candidates[3].sample, 15);
    let free = candidates.iter().filter(|it| !it.collides);
    assert!(free.clone().all(|it| (0.0..=1.0).contains(&it.relative_cost)));
    assert!(free.clone().count() > 50);
    let colliding = candidates.iter().filter(|it| it.collides);
    assert!(colliding.clone().all(|it| it.relative_cost > 1.0 && it.cost > 1e3));
    let names: Vec<&str> = controller.statistics().iter().map(|it| it.critic.name()).collect();
    assert_eq!(names.join(" "), crate::world::STOCK_CRITICS);
    let follow = &controller.statistics()[5];
    assert!(follow.has_changed && follow.lowest > 0.0 && follow.highest > follow.lowest);
    assert!(!controller.statistics()[2].has_changed, "the goal is far");
}

#[test]
fn equal_seeds_give_equal_bytes_in_every_thread() {
    let run = |seed: u64| {
        let world = World::new(&[[1.0, -0.3, 1.2, 0.1]]);
        let mut config =
            controller(Nav2Release::Main, &[("batch_size", "333"), ("regenerate_noises", "true")]);
        let mut parts = config.config().clone();
        parts.seed = seed;
        config = periplus_controllers::mppi::Mppi::new(parts);
        let plan = straight([0.0, 0.0], [3.0, 0.0]);
        let drive = drive(&world, &mut config, Robot::default(), &plan, 20).unwrap();
        let bits = |it: &Twist2| [it.vx_m_s.to_bits(), it.wz_rad_s.to_bits()];
        drive.commands.iter().map(bits).collect::<Vec<_>>()
    };
    let first = run(1);
    let threads: Vec<_> = (0..3).map(|_| std::thread::spawn(move || run(1))).collect();
    for thread in threads {
        assert_eq!(thread.join().unwrap(), first);
    }
    assert_ne!(run(2), first);
}

#[test]
fn positions_far_from_the_origin_are_as_precise() {
    // The same world, moved by whole anchors.
    let run = |offset_m: f64| {
        let mut world = World::new(&[[1.0, -0.3, 1.2, 0.1]]);
        let mut info = *world.costmap.info();
        info.origin.x_m += offset_m;
        info.origin.y_m -= 2.0 * offset_m;
        let mut moved = periplus_costmap::Costmap::new(info, 0);
        moved.costs_mut().copy_from_slice(world.costmap.costs());
        world.costmap = moved;
        let mut controller = controller(Nav2Release::Jazzy, &[("batch_size", "200")]);
        let plan = straight([offset_m, -2.0 * offset_m], [offset_m + 3.0, -2.0 * offset_m]);
        let pose = Pose2::new(offset_m, -2.0 * offset_m, 0.0);
        let robot = Robot { pose, ..Robot::default() };
        drive(&world, &mut controller, robot, &plan, 20).unwrap().commands
    };
    let (near, far) = (run(0.0), run(256.0 * 400.0));
    for (near, far) in near.iter().zip(&far) {
        assert!((near.vx_m_s - far.vx_m_s).abs() < 1e-3, "{near:?} {far:?}");
        assert!((near.wz_rad_s - far.wz_rad_s).abs() < 1e-3, "{near:?} {far:?}");
    }
}

#[test]
fn in_open_loop_the_last_command_counts() {
    let world = World::new(&[]);
    let plan = straight([0.0, 0.0], [9.0, 0.0]);
    let speed = |open: &str| {
        let params = [("open_loop", open), ("batch_size", "400"), ("ax_max", "0.5")];
        let mut controller = controller(Nav2Release::Main, &params);
        let mut last = 0.0;
        for _ in 0..30 {
            // Odometry that reports no motion.
            let input = world.input(&Robot::default(), &plan, plan[plan.len() - 1]);
            last = controller.compute_velocity(&input).unwrap().vx_m_s;
        }
        last
    };
    let (open, closed) = (speed("true"), speed("false"));
    assert!(open > 0.4, "{open}");
    // Closed loop: at most two periods of acceleration ahead of the odometry.
    assert!(closed <= 0.0501, "{closed}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn commands_are_finite_and_within_the_limits(
        x in -0.5_f64..9.0, y in -2.5_f64..2.5, yaw in -7.0_f64..7.0,
        vx in -1.0_f64..1.0, wz in -3.0_f64..3.0, goal_x in 0.0_f64..8.0, goal_y in -2.0_f64..2.0,
        model in 0..3_usize, release in 0..5_usize, steps in 2..40_usize,
    ) {
        let world = World::new(&[[3.0, -1.0, 3.3, 0.5]]);
        let steps = steps.to_string();
        let params = [&model_params(MODELS[model])[..], &[("batch_size", "70"), ("time_steps", &steps)]].concat();
        let mut controller = controller(Nav2Release::ALL[release], &params);
        let robot = Robot { pose: Pose2::new(x, y, yaw), velocity: Twist2::new(vx, 0.0, wz), time_ns: 0 };
        let plan = straight([x, y], [goal_x, goal_y]);
        for _ in 0..3 {
            match controller.compute_velocity(&world.input(&robot, &plan, plan[plan.len() - 1])) {
                Ok(command) => {
                    let values = [command.vx_m_s, command.vy_m_s, command.wz_rad_s];
                    prop_assert!(values.iter().all(|it| it.is_finite()));
                    // The robot may be faster than its limits, and slows down by its deceleration. Filters
                    // before main overshoot a little.
                    prop_assert!(command.vx_m_s.abs() <= 1.25, "{command:?}");
                    prop_assert!(model == 1 || command.vy_m_s == 0.0);
                }
                Err(ControlError::NoValidControl(reason)) => prop_assert!(reason.len() > 20),
                Err(other) => prop_assert!(false, "{other}"),
            }
        }
    }
}
