//! Goals, groups, doors and robots, each with a crowd of few people.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use periplus_crowds::{
    Crowd, CrowdError, CrowdSettings, DVec2, Door, DoorControl, Floor, MovingObstacle, PersonGoal,
    PersonId, PersonPlan, PersonSettings, PersonState, SteeringModel, Wall,
};

/// Two rooms of 5 m by 4 m with a door from y = 1.5 m to 2.5 m between them.
fn rooms(name: &str) -> Crowd {
    let mut walls = Wall::rectangle([0.0, 0.0], [10.0, 4.0]).to_vec();
    walls.push(Wall::new([5.0, 0.0], [5.0, 1.5]));
    walls.push(Wall::new([5.0, 2.5], [5.0, 4.0]));
    let model = SteeringModel::named(name).unwrap();
    let settings = CrowdSettings { model, seed: 4, threads: 1 };
    Crowd::new(Floor::new(walls).unwrap(), settings)
}

fn leaf() -> Wall {
    Wall::new([5.0, 1.5], [5.0, 2.5])
}

fn at(x: f64, y: f64) -> PersonSettings {
    PersonSettings::at(DVec2::new(x, y))
}

#[test]
fn people_queue_in_front_of_a_closed_door_and_pass_when_it_opens() {
    for name in SteeringModel::NAMES {
        let mut crowd = rooms(name);
        let goal = crowd.add_goal(PersonGoal::at(DVec2::new(8.0, 2.0))).unwrap();
        let door =
            crowd.add_door(Door { leaf: leaf(), is_open: false, control: DoorControl::Manual });
        for y in [1.0, 2.0, 3.0] {
            let plan = PersonPlan::Visit { goals: vec![goal], repeats: false };
            crowd.add_agent(at(1.0, y), plan).unwrap();
        }
        crowd.step(20.0);
        for agent in crowd.agents() {
            assert_eq!(agent.state(), PersonState::Queueing, "{name}");
            assert!(agent.position().x < 4.8 && agent.velocity().length() < 0.1, "{name}");
        }
        crowd.set_door_open(door, true);
        crowd.step(20.0);
        assert!(crowd.agents().iter().all(|agent| agent.position().x > 6.5), "{name}");
    }
}

#[test]
fn an_automatic_door_opens_for_people_and_closes_behind_them() {
    let mut crowd = rooms("orca");
    let goal = crowd.add_goal(PersonGoal::at(DVec2::new(9.0, 2.0))).unwrap();
    let control = DoorControl::Automatic { range_m: 1.5, opening_s: 1.0 };
    let door = crowd.add_door(Door { leaf: leaf(), is_open: false, control });
    let plan = PersonPlan::Visit { goals: vec![goal], repeats: false };
    let agent = crowd.add_agent(at(1.0, 2.0), plan).unwrap();
    let mut was_open = false;
    while crowd.time_s() < 20.0 {
        crowd.step(0.1);
        was_open |= crowd.door(door).is_open;
    }
    assert!(was_open && !crowd.door(door).is_open);
    assert!(crowd.agent(agent).position().x > 8.0);
}

#[test]
fn a_group_stays_together_at_the_pace_of_its_slowest_member() {
    for name in SteeringModel::NAMES {
        let mut crowd = rooms(name);
        let goal = crowd.add_goal(PersonGoal::at(DVec2::new(9.0, 2.0))).unwrap();
        let plan = PersonPlan::Visit { goals: vec![goal], repeats: false };
        let members = [at(1.0, 1.6).with_speed(0.8), at(1.0, 2.4).with_speed(1.5)];
        crowd.add_group(&members, plan).unwrap();
        let (_, numbers) = crowd.group_of(PersonId(1));
        assert_eq!(numbers, [0, 1]);
        while crowd.time_s() < 8.0 {
            crowd.step(0.1);
            let distance_m = crowd.agents()[0].position().distance(crowd.agents()[1].position());
            assert!(distance_m < 2.0, "{name}: {distance_m} m at {} s", crowd.time_s());
        }
        // 0.8 m/s for 8 s.
        assert!(crowd.agents().iter().all(|agent| agent.position().x < 8.2), "{name}");
    }
}

#[test]
fn people_stay_at_goals_and_go_on() {
    let mut crowd = rooms("social_force");
    let goals = [2.0, 8.0].map(|x| {
        let goal = PersonGoal { stay_s: [3.0, 3.0], ..PersonGoal::at(DVec2::new(x, 2.0)) };
        crowd.add_goal(goal).unwrap()
    });
    let agent =
        crowd.add_agent(at(2.0, 2.0), PersonPlan::Visit { goals: goals.to_vec(), repeats: true });
    let agent = agent.unwrap();
    crowd.step(2.0);
    assert_eq!(crowd.agent(agent).state(), PersonState::Waiting);
    crowd.step(3.0);
    assert_eq!(crowd.agent(agent).state(), PersonState::Walking);
    crowd.step(20.0);
    assert!(crowd.visits(agent) >= 3);
}

#[test]
fn one_who_stands_steps_aside_for_a_robot() {
    for name in SteeringModel::NAMES {
        let mut crowd = rooms(name);
        let agent = crowd.add_agent(at(3.0, 2.05), PersonPlan::Stand).unwrap();
        let mut robot = MovingObstacle::disc(DVec2::new(0.5, 2.0), 0.3, DVec2::new(0.5, 0.0));
        while crowd.time_s() < 8.0 {
            crowd.set_obstacles(vec![robot]);
            crowd.step(0.1);
            robot = crowd.obstacles()[0];
            let gap_m = robot.distance_m(crowd.agent(agent).position());
            assert!(gap_m > 0.1, "{name}: {gap_m}");
        }
    }
}

#[test]
fn people_turn_round_where_a_door_is_blocked() {
    for name in SteeringModel::NAMES {
        let mut crowd = rooms(name);
        for x in [1.5, 8.5] {
            crowd.add_goal(PersonGoal::at(DVec2::new(x, 2.0))).unwrap();
        }
        let agent = crowd.add_agent(at(2.0, 2.0), PersonPlan::Wander).unwrap();
        let robot = MovingObstacle::disc(DVec2::new(5.0, 2.0), 0.45, DVec2::ZERO);
        let (mut longest_still_s, mut is_back) = (0.0_f64, false);
        while crowd.time_s() < 30.0 {
            crowd.set_obstacles(vec![robot]);
            crowd.step(0.1);
            let person = crowd.agent(agent);
            longest_still_s = longest_still_s.max(person.still_s());
            is_back |= crowd.time_s() > 10.0 && person.position().x < 2.2;
        }
        // 3 s until it gives up, and the time in which it turns.
        assert!(is_back && longest_still_s < 5.0, "{name}: {longest_still_s} s");
    }
}

#[test]
fn wrong_numbers_are_refused() {
    let mut crowd = rooms("orca");
    let refused = crowd.add_agent(at(f64::NAN, 1.0), PersonPlan::Stand);
    assert!(matches!(refused, Err(CrowdError::Person("position x", _))));
    assert_eq!(crowd.add_agent(at(1.0, 1.0), PersonPlan::Wander), Err(CrowdError::NoGoals));
    let goal = crowd.add_goal(PersonGoal::at(DVec2::new(50.0, 2.0)));
    assert_eq!(goal, Err(CrowdError::GoalInWall([50.0, 2.0])));
    assert!(crowd.agents().is_empty());
    // No duration, no step.
    crowd.step(f64::NAN);
    crowd.step(-1.0);
    assert_eq!(crowd.time_s(), 0.0);
}
