//! Batches of environments: episodes, collisions, seeds, threads.

use std::sync::Arc;

use periplus_environments::{
    AgentState, BatchError, EnvironmentRobot, EnvironmentRobotParams, NavigationBatch,
    NavigationRewardParams, NavigationSettings, NavigationTaskParams, NavigationWorld,
    ResetRequest, StepOutputs, WorldGeneratorParams, WorldKind, generate_world,
};
use periplus_geometry::{DVec3, Pose, Pose2};
use periplus_rendering::NoAssets;
use periplus_scene::{Collision, Link, Model, Shape, Visual, World};

/// A room of 8 x 4 m about the origin; its walls are outside of it.
fn room() -> World {
    let mut link = Link::new("link");
    for (x, y, size) in [
        (4.1, 0.0, [0.2, 4.4]),
        (-4.1, 0.0, [0.2, 4.4]),
        (0.0, 2.1, [8.4, 0.2]),
        (0.0, -2.1, [8.4, 0.2]),
    ] {
        let shape = Shape::Box { size_m: DVec3::new(size[0], size[1], 1.0) };
        let pose = Pose::from_xyz(x, y, 0.5);
        let collision = Collision::new("c", shape.clone());
        link.collisions.push(Collision { link_from_collision: pose, ..collision });
        link.visuals.push(Visual { link_from_visual: pose, ..Visual::new("v", shape) });
    }
    let mut world = World::empty("room");
    world.models.push(Model { is_static: true, links: vec![link], ..Model::new("walls") });
    world
}

struct Run {
    batch: NavigationBatch,
    observations: Vec<f32>,
    rewards: Vec<f64>,
    terminated: Vec<bool>,
    truncated: Vec<bool>,
}

/// Settings of a run.
struct Case {
    world: World,
    robot: EnvironmentRobotParams,
    task: NavigationTaskParams,
    count: usize,
    agents: usize,
    threads: usize,
}

impl Default for Case {
    fn default() -> Self {
        let robot = EnvironmentRobotParams {
            max_acceleration_m_s2: 0.0,
            max_turn_acceleration_rad_s2: 0.0,
            ..EnvironmentRobotParams::default()
        };
        let task = NavigationTaskParams::default();
        Self { world: room(), robot, task, count: 1, agents: 1, threads: 1 }
    }
}

impl Case {
    fn run(self) -> Run {
        let Self { world, robot, task, count, agents, threads } = self;
        let robot = EnvironmentRobot::new(robot).expect("a robot");
        let (world, findings) = NavigationWorld::new(&world, &robot, &NoAssets, 1);
        assert!(!findings.has_errors(), "{findings:?}");
        let reward = NavigationRewardParams::default();
        let worlds = vec![Arc::new(world)];
        let settings =
            NavigationSettings { worlds, robot, task, reward, agents, resets_in_next_step: true };
        let batch = NavigationBatch::new(settings, count, threads).expect("a batch");
        let rows = count * agents;
        let observations = vec![0.0; rows * batch.observation_size()];
        let (rewards, flags) = (vec![0.0; rows], vec![false; rows]);
        Run { batch, observations, rewards, terminated: flags.clone(), truncated: flags }
    }
}

impl Run {
    fn reset(&mut self, request: ResetRequest<'_>) {
        self.batch.reset(request, &mut self.observations).expect("a reset");
    }

    fn place(&mut self, starts: &[Pose2], goals_m: &[[f64; 2]]) {
        let seeds = vec![0; self.batch.environment_count()];
        let seeds = Some(seeds.as_slice());
        self.reset(ResetRequest {
            seeds,
            starts: Some(starts),
            goals_m: Some(goals_m),
            mask: None,
        });
    }

    /// Steps until the first episode ends; returns the number of steps.
    fn step_to_end(&mut self, actions: &[f32]) -> usize {
        for step in 1..=100 {
            self.step(actions);
            if self.terminated[0] || self.truncated[0] {
                return step;
            }
        }
        panic!("no end")
    }

    fn step(&mut self, actions: &[f32]) {
        let outputs = StepOutputs {
            observations: &mut self.observations,
            rewards: &mut self.rewards,
            terminated: &mut self.terminated,
            truncated: &mut self.truncated,
        };
        self.batch.step(actions, outputs).expect("a step");
    }
}

#[test]
fn ranges_goal_and_velocity_in_a_room() {
    let mut run = Case::default().run();
    run.place(&[Pose2::new(1.0, 0.5, 0.0)], &[[1.0, 1.5]]);
    // Beams begin behind the robot and turn to the left: -180, -90, 0, 90 degrees.
    let ranges = [0, 90, 180, 270].map(|beam| run.observations[beam]);
    let near = |a: f32, b: f32| (a - b).abs() < 1e-5;
    assert!(ranges.iter().zip([5.0, 2.5, 3.0, 1.5]).all(|(a, b)| near(*a, b)), "{ranges:?}");
    let [distance, cosine, sine] = [0, 1, 2].map(|at| run.observations[360 + at]);
    assert!(near(distance, 1.0) && near(cosine, 0.0) && near(sine, 1.0));
    run.step(&[1.0, 0.0]);
    assert_eq!(&run.observations[363..], [0.8, 0.0], "the velocity");
    assert!(near(run.observations[180], 2.92));
}

#[test]
fn a_robot_stops_in_front_of_a_wall() {
    let mut run = Case::default().run();
    run.place(&[Pose2::new(3.0, 0.0, 0.0)], &[[-3.0, 0.0]]);
    // The front of the robot is 0.8 m from the wall: ten steps of 0.08 m, with rounding eleven.
    let steps = run.step_to_end(&[1.0, 0.0]);
    assert!(steps == 10 || steps == 11, "{steps}");
    let agent = run.batch.agents()[0];
    assert_eq!((run.terminated[0], agent.state), (true, AgentState::Collided));
    assert!(agent.pose.x_m <= 3.8 && agent.pose.x_m > 3.78, "{}", agent.pose.x_m);
    assert!(run.rewards[0] < -10.0, "{}", run.rewards[0]);
}

/// Faster than the wall is thick: 20 m/s for 0.1 s, wall of 0.2 m.
#[test]
fn no_speed_passes_a_wall() {
    let mut case = Case::default();
    case.robot.max_speed_m_s = 20.0;
    let mut run = case.run();
    run.place(&[Pose2::new(3.0, 0.0, 0.0)], &[[-3.0, 0.0]]);
    run.step(&[1.0, 0.0]);
    let agent = run.batch.agents()[0];
    assert_eq!(agent.state, AgentState::Collided);
    assert!(agent.pose.x_m <= 3.8 && agent.pose.x_m > 3.78, "{}", agent.pose.x_m);
}

#[test]
fn a_long_robot_collides_when_it_turns() {
    let mut case = Case::default();
    case.robot.footprint_m = vec![0.6, 0.1, -0.6, 0.1, -0.6, -0.1, 0.6, -0.1];
    let mut run = case.run();
    // Beside a wall at y = 2, 0.2 m from its side.
    run.place(&[Pose2::new(0.0, 1.7, 0.0)], &[[-3.0, 0.0]]);
    assert_eq!(run.step_to_end(&[-1.0, 1.0]), 3, "turns of 0.15 rad");
    let agent = run.batch.agents()[0];
    assert_eq!(agent.state, AgentState::Collided);
    // The corner is 0.3 m high where 0.6 sin a + 0.1 cos a = 0.3: at 0.349 rad. Within the 1 cm of the check.
    assert!((0.32..0.35).contains(&agent.pose.yaw_rad), "{}", agent.pose.yaw_rad);
}

#[test]
fn the_goal_ends_an_episode_and_the_next_step_resets() {
    let mut run = Case::default().run();
    run.place(&[Pose2::new(0.0, 0.0, 0.0)], &[[0.45, 0.0]]);
    run.step(&[1.0, 0.0]);
    assert!(!run.terminated[0]);
    run.step(&[1.0, 0.0]);
    assert_eq!((run.terminated[0], run.truncated[0]), (true, false));
    // Progress of 0.08 m, 10 for the goal, -0.01 for the time.
    assert!((run.rewards[0] - 10.07).abs() < 1e-9, "{}", run.rewards[0]);
    let before = run.batch.agents()[0].start;
    run.step(&[1.0, 0.0]);
    let agent = run.batch.agents()[0];
    assert_eq!((run.rewards[0], run.terminated[0], run.batch.steps_of(0)), (0.0, false, 0));
    assert!(agent.start != before && agent.pose == agent.start, "the action is ignored");
}

#[test]
fn long_episodes_are_truncated() {
    let mut case = Case::default();
    case.task.max_steps = 3;
    let mut run = case.run();
    run.place(&[Pose2::new(0.0, 0.0, 0.0)], &[[3.0, 0.0]]);
    let flags: Vec<bool> = (0..5)
        .map(|_| {
            run.step(&[-1.0, 0.0]);
            run.truncated[0]
        })
        .collect();
    assert_eq!(flags, [false, false, true, false, false]);
    assert!(!run.terminated[0]);
}

/// Drives with actions that depend on the observations, and returns all results.
fn drive(mut run: Run, seeds: &[u64], steps: usize) -> (Vec<u32>, Vec<u64>) {
    run.reset(ResetRequest { seeds: Some(seeds), ..ResetRequest::default() });
    let columns = run.batch.observation_size();
    let (mut observed, mut rewarded) = (Vec::new(), Vec::new());
    for _ in 0..steps {
        let actions: Vec<f32> = run
            .observations
            .chunks(columns)
            .flat_map(|row| [0.5, (row[90] - row[270]).clamp(-1.0, 1.0)])
            .collect();
        run.step(&actions);
        observed.extend(run.observations.iter().map(|it| it.to_bits()));
        rewarded.extend(run.rewards.iter().map(|it| it.to_bits()));
    }
    (observed, rewarded)
}

fn caves(count: usize, threads: usize) -> Case {
    let params = WorldGeneratorParams { kind: WorldKind::Caves, ..WorldGeneratorParams::default() };
    let robot = EnvironmentRobotParams { lidar_noise_m: 0.01, ..EnvironmentRobotParams::default() };
    let world = generate_world(&params, 3);
    Case { world, robot, count, threads, ..Case::default() }
}

#[test]
fn threads_do_not_change_a_byte() {
    let seeds: Vec<u64> = (100..119).collect();
    let one = drive(caves(19, 1).run(), &seeds, 60);
    for threads in [2, 3, 8] {
        assert!(one == drive(caves(19, threads).run(), &seeds, 60), "{threads} threads");
    }
}

#[test]
fn an_environment_of_a_batch_is_one_of_its_own() {
    let columns = 365;
    let (observed, rewarded) = drive(caves(4, 2).run(), &[5, 6, 7, 8], 50);
    let (alone, alone_rewarded) = drive(caves(1, 1).run(), &[7], 50);
    for step in 0..50 {
        let row = (step * 4 + 2) * columns;
        let expected = &alone[step * columns..(step + 1) * columns];
        assert!(&observed[row..row + columns] == expected, "step {step}");
        assert_eq!(rewarded[step * 4 + 2], alone_rewarded[step], "step {step}");
    }
}

#[test]
fn robots_see_each_other_and_collide() {
    let mut run = Case { agents: 2, ..Case::default() }.run();
    let starts = [Pose2::new(-1.0, 0.0, 0.0), Pose2::new(1.0, 0.0, std::f64::consts::PI)];
    run.place(&starts, &[[3.0, 0.0], [-3.0, 0.0]]);
    let columns = run.batch.observation_size();
    // 2 m between the centres, radius 0.2 m.
    for row in 0..2 {
        let ahead = run.observations[row * columns + 180];
        assert!((ahead - 1.8).abs() < 1e-6, "{ahead}");
    }
    // Ten steps of 0.16 m, with rounding eleven, until they are 0.4 m apart.
    let steps = run.step_to_end(&[1.0, 0.0, 1.0, 0.0]);
    assert!(steps == 10 || steps == 11, "{steps}");
    assert_eq!(run.terminated, [true, true]);
    assert!(run.rewards.iter().all(|reward| *reward < -9.0), "{:?}", run.rewards);
    assert!(run.batch.agents().iter().all(|agent| agent.state == AgentState::Collided));
}

#[test]
fn a_robot_at_its_goal_leaves() {
    let mut run = Case { agents: 2, ..Case::default() }.run();
    let starts = [Pose2::new(-1.0, 0.0, 0.0), Pose2::new(1.0, 0.0, 0.0)];
    run.place(&starts, &[[-0.65, 0.0], [3.5, 0.0]]);
    run.step(&[1.0, 0.0, -1.0, 0.0]);
    assert_eq!(run.terminated, [true, false]);
    let columns = run.batch.observation_size();
    assert!((run.observations[columns] - 5.0).abs() < 1e-5, "nothing is behind the second robot");
    run.step(&[1.0, 0.0, -1.0, 0.0]);
    assert_eq!((run.terminated[0], run.rewards[0]), (true, 0.0));
}

#[test]
fn errors_say_what_is_wrong() {
    let mut run = Case::default().run();
    let (mut observations, mut rewards, mut ends, mut cuts) =
        (vec![0.0; 365], vec![0.0], vec![false], vec![false]);
    let mut step = |batch: &mut NavigationBatch, actions: &[f32]| {
        batch.step(
            actions,
            StepOutputs {
                observations: &mut observations,
                rewards: &mut rewards,
                terminated: &mut ends,
                truncated: &mut cuts,
            },
        )
    };
    assert_eq!(step(&mut run.batch, &[0.0, 0.0]), Err(BatchError::NotReset(0)));
    let starts = [Pose2::new(4.0, 0.0, 0.0)];
    let request = ResetRequest { starts: Some(&starts), ..ResetRequest::default() };
    assert_eq!(
        run.batch.reset(request, &mut [0.0; 365]),
        Err(BatchError::StartInCollision(0)),
        "in the wall"
    );
    run.reset(ResetRequest::default());
    assert_eq!(step(&mut run.batch, &[0.0]), Err(BatchError::Length("actions", 1, 2)));
    assert_eq!(step(&mut run.batch, &[0.0, f32::NAN]), Err(BatchError::NotFinite("actions", 1)));
    assert_eq!(step(&mut run.batch, &[0.0, 0.0]), Ok(()));
}
