//! People and robots in an office: no person freezes, and no robot is walked through.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "helpers of tests may unwrap and print as tests do"
)]

use periplus_crowds::{
    Crowd, CrowdError, CrowdSettings, DVec2, Floor, MovingObstacle, PersonGoal, PersonGoalId,
    PersonPlan, PersonSettings, PersonState, SteeringModel, Wall,
};
use periplus_geometry::Stream;

/// Radius of the robots \[m\].
const ROBOT_RADIUS_M: f64 = 0.3;

/// Rooms on both sides of a corridor of 50 m by 3 m; each is 5 m by 6 m with a door of 1.2 m.
fn office() -> Result<Floor, CrowdError> {
    let mut walls = Wall::rectangle([0.0, 0.0], [50.0, 15.0]).to_vec();
    for room in 0..10 {
        let x = 5.0 * f64::from(room);
        for (wall_y, far_y) in [(6.0, 0.0), (9.0, 15.0)] {
            walls.push(Wall::new([x, wall_y], [x + 1.9, wall_y]));
            walls.push(Wall::new([x + 3.1, wall_y], [x + 5.0, wall_y]));
            walls.push(Wall::new([x, wall_y], [x, far_y]));
        }
    }
    Floor::new(walls)
}

/// Robot that drives along the corridor and back, and stops for people ahead.
struct Robot {
    position: DVec2,
    direction: f64,
    speed: f64,
}

impl Robot {
    fn step(&mut self, crowd: &Crowd, step_s: f64) {
        let ahead = |position: DVec2| {
            let offset = position - self.position;
            let along = offset.x * self.direction;
            along > 0.0 && along < 0.9 && offset.y.abs() < ROBOT_RADIUS_M + 0.25
        };
        let is_blocked = crowd.agents().iter().any(|agent| ahead(agent.position()));
        self.speed = if is_blocked { 0.0 } else { 0.8 };
        self.position.x += self.direction * self.speed * step_s;
        if !(1.0..49.0).contains(&self.position.x) {
            self.direction = if self.position.x < 1.0 { 1.0 } else { -1.0 };
        }
    }
}

/// Result of a run.
#[derive(Debug)]
struct Outcome {
    longest_still_s: f64,
    nearest_robot_m: f64,
    goals_reached: usize,
    mean_speed: f64,
    /// Times for which agents were still for more than 10 s, by number.
    freezes: usize,
}

fn run(
    name: &str,
    people: usize,
    robots: usize,
    duration_s: f64,
    threads: usize,
) -> (Outcome, Vec<DVec2>) {
    let model = SteeringModel::named(name).unwrap();
    let mut crowd = Crowd::new(office().unwrap(), CrowdSettings { model, seed: 7, threads });
    for room in 0..10 {
        for y in [2.5, 12.5] {
            let centre = DVec2::new(5.0 * f64::from(room) + 2.5, y);
            crowd.add_goal(PersonGoal { centre, radius_m: 1.5, stay_s: [5.0, 30.0] }).unwrap();
        }
    }
    let places = crowd.floor().free_points(0.4);
    let mut stream = Stream::keyed(7, "places", 0);
    let mut taken: Vec<DVec2> = Vec::new();
    while taken.len() < people {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss
        )]
        let place = places[(stream.unit() * places.len() as f64) as usize];
        if taken.iter().all(|other| other.distance(place) > 0.5) {
            let speed = 1.34 + 0.26 * stream.normal().clamp(-2.0, 2.0);
            crowd
                .add_agent(PersonSettings::at(place).with_speed(speed), PersonPlan::Wander)
                .unwrap();
            taken.push(place);
        }
    }
    #[expect(clippy::cast_precision_loss)]
    let mut drivers: Vec<Robot> = (0..robots)
        .map(|number| {
            let position = DVec2::new(2.0 + 4.5 * number as f64, 7.1 + 0.8 * (number % 2) as f64);
            let direction = if number % 2 == 0 { 1.0 } else { -1.0 };
            Robot { position, direction, speed: 0.0 }
        })
        .collect();
    let (mut longest_still_s, mut nearest_robot_m) = (0.0_f64, f64::INFINITY);
    let (mut speeds, mut samples, mut freezes) = (0.0, 0.0, 0);
    let (mut goals_reached, mut states) = (0, vec![PersonState::Walking; people]);
    while crowd.time_s() < duration_s {
        for driver in &mut drivers {
            driver.step(&crowd, 0.1);
        }
        let obstacle = |driver: &Robot| {
            let velocity = DVec2::X * (driver.direction * driver.speed);
            MovingObstacle::disc(driver.position, ROBOT_RADIUS_M, velocity)
        };
        crowd.set_obstacles(drivers.iter().map(obstacle).collect());
        crowd.step(0.1);
        for (agent, before) in crowd.agents().iter().zip(&mut states) {
            let is_there = agent.state() == PersonState::Waiting;
            goals_reached += usize::from(is_there && *before != PersonState::Waiting);
            *before = agent.state();
            longest_still_s = longest_still_s.max(agent.still_s());
            freezes += usize::from((10.0..10.1).contains(&agent.still_s()));
            if agent.state() == PersonState::Walking {
                speeds += agent.velocity().length();
                samples += 1.0;
            }
            for obstacle in crowd.obstacles() {
                nearest_robot_m = nearest_robot_m.min(obstacle.distance_m(agent.position()));
            }
        }
    }
    let positions = crowd.agents().iter().map(|agent| agent.position()).collect();
    (
        Outcome {
            longest_still_s,
            nearest_robot_m,
            goals_reached,
            mean_speed: speeds / samples,
            freezes,
        },
        positions,
    )
}

#[test]
fn nobody_freezes_and_no_robot_is_walked_through() {
    for name in SteeringModel::NAMES {
        let (outcome, _) = run(name, 60, 4, 60.0, 1);
        assert!(outcome.longest_still_s < 10.0 && outcome.freezes == 0, "{name}: {outcome:?}");
        // A body that has turned sideways is 0.13 m wide from its centre.
        assert!(outcome.nearest_robot_m > 0.1, "{name}: {outcome:?}");
        assert!(outcome.goals_reached > 60 && outcome.mean_speed > 0.8, "{name}: {outcome:?}");
    }
}

/// Half an hour of 200 people and ten robots: `cargo test --release -p periplus-crowds -- --ignored --nocapture`.
#[test]
#[ignore = "half an hour of simulated time"]
fn two_hundred_people_and_ten_robots_for_half_an_hour() {
    // Both models beside each other.
    let outcomes = std::thread::scope(|scope| {
        let runs = SteeringModel::NAMES.map(|name| {
            let work = move || (name, run(name, 200, 10, 1800.0, 1).0);
            scope.spawn(work)
        });
        runs.map(|run| run.join().unwrap())
    });
    for (name, outcome) in &outcomes {
        println!("{name}: {outcome:?}");
    }
    for (name, outcome) in outcomes {
        assert!(outcome.longest_still_s < 10.0, "{name}: {outcome:?}");
        assert!(outcome.nearest_robot_m > 0.1, "{name}: {outcome:?}");
    }
}

#[test]
fn the_number_of_threads_has_no_influence() {
    for name in SteeringModel::NAMES {
        let (_, one) = run(name, 150, 3, 10.0, 1);
        for threads in [2, 8] {
            assert_eq!(run(name, 150, 3, 10.0, threads).1, one, "{name}");
        }
    }
}

#[test]
fn a_goal_leads_people_out_of_the_rooms() {
    let model = SteeringModel::named("orca").unwrap();
    let mut crowd = Crowd::new(office().unwrap(), CrowdSettings { model, seed: 1, threads: 1 });
    let goal: PersonGoalId = crowd.add_goal(PersonGoal::at(DVec2::new(47.5, 12.5))).unwrap();
    let plan = PersonPlan::Visit { goals: vec![goal], repeats: false };
    let agent = crowd.add_agent(PersonSettings::at(DVec2::new(2.5, 2.5)), plan).unwrap();
    // 45 m along the corridor and two doors at 1.34 m/s: about 40 s.
    crowd.step(45.0);
    assert!(crowd.agent(agent).position().distance(DVec2::new(47.5, 12.5)) < 0.6);
}
