//! People walk on the floor of a world, are seen by its sensors, avoid robots, and are solid for them.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use std::path::Path;
use std::sync::Arc;

use periplus_geometry::{DVec3, Pose2};
use periplus_graph::{Mailbox, NodeSettings, Qos};
use periplus_grid::occupancy::OCCUPIED;
use periplus_loader::LoadContext;
use periplus_msgs::radar_msgs::RadarTracks;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_srvs::{SetBool, SetBoolRequest};
use periplus_msgs::vision_msgs::Detection3DArray;
use periplus_resources::{MemoryHost, Resolver};
use periplus_sim::{
    AssetFiles, Options, PeopleFile, PeopleRequest, PhysicsMode, RequestedDoor, RequestedGoal,
    RequestedParty, RequestedPerson, RequestedPlan, Search, Services, Simulation, compose,
    wall_grid,
};

/// Room of 8 m by 6 m between x = -1 m and y = -3 m, with a table and a scanner 0.3 m above the floor at the origin.
const WORLD: &str = r#"<sdf version="1.9"><world name="w">
  <plugin filename="gz-sim-sensors-system" name="gz::sim::systems::Sensors"/>
  <model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry>
  </collision></link></model>
  <model name="walls"><static>true</static><link name="l">
    <collision name="a"><pose>3 -3.1 1 0 0 0</pose><geometry><box><size>8.4 0.2 2</size></box></geometry></collision>
    <collision name="b"><pose>3 3.1 1 0 0 0</pose><geometry><box><size>8.4 0.2 2</size></box></geometry></collision>
    <collision name="c"><pose>-1.1 0 1 0 0 0</pose><geometry><box><size>0.2 6.4 2</size></box></geometry></collision>
    <collision name="d"><pose>7.1 0 1 0 0 0</pose><geometry><box><size>0.2 6.4 2</size></box></geometry></collision>
  </link></model>
  <model name="table"><static>true</static><link name="l">
    <collision name="top"><pose>5 -2 0.74 0 0 0</pose><geometry><box><size>1 1 0.02</size></box></geometry></collision>
  </link></model>
  <model name="eye"><static>true</static><pose>0 0.1 0.3 0 0 0</pose><link name="head">
    <sensor name="lidar" type="lidar"><topic>scan</topic><update_rate>RATE</update_rate><lidar>
      <scan><horizontal>
        <samples>3</samples><min_angle>-0.1</min_angle><max_angle>0.1</max_angle>
      </horizontal></scan>
      <range><min>0.1</min><max>20</max></range>
    </lidar></sensor>
  </link></model>
  CONTENT
</world></sdf>"#;

/// Box of 0.6 m by 0.4 m with a sensor, so that it is a robot.
const ROBOT: &str = r#"<model name="cart"><pose>POSE</pose><link name="base">
  <collision name="c"><geometry><box><size>0.6 0.4 0.4</size></box></geometry>
    <surface><friction><ode><mu>0</mu></ode></friction></surface></collision>
  <inertial><mass>10</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>
  <sensor name="imu" type="imu"><update_rate>10</update_rate></sensor>
</link></model>"#;

fn world(content: &str, rate_hz: &str, options: Options) -> Simulation {
    let text = WORLD.replace("CONTENT", content).replace("RATE", rate_hz);
    let host = MemoryHost::new().with_file("/w.sdf", text);
    let resolver = Resolver::new(&host, &[]);
    let setting = LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder: "/".into(),
        arguments: Vec::new(),
        open_meshes: true,
    };
    let mut composition = compose(Path::new("/w.sdf"), &[], &setting);
    Simulation::new(&mut composition, Arc::new(AssetFiles::default()), options)
}

fn simulate(content: &str, request: &PeopleRequest, options: Options) -> Simulation {
    let mut simulation = world(content, "10", options);
    let findings = simulation.add_people(request);
    assert!(findings.is_empty(), "{findings:?}");
    simulation
}

fn cart(x: f64, y: f64) -> String {
    ROBOT.replace("POSE", &format!("{x} {y} 0.2 0 0 0"))
}

fn person(at: [f64; 2]) -> RequestedPerson {
    RequestedPerson {
        name: None,
        position_m: Some(at),
        radius_m: 0.2,
        speed_m_per_s: Some(1.2),
        origin: Default::default(),
    }
}

fn party(at: [f64; 2], plan: RequestedPlan) -> RequestedParty {
    RequestedParty { members: vec![person(at)], plan, origin: Default::default() }
}

fn goal(at: [f64; 2]) -> RequestedGoal {
    RequestedGoal {
        name: format!("{at:?}"),
        position_m: at,
        radius_m: 0.4,
        stay_s: [0.0; 2],
        origin: Default::default(),
    }
}

/// People that remain at positions.
fn standing(at: &[[f64; 2]]) -> PeopleRequest {
    let parties = at.iter().map(|at| party(*at, RequestedPlan::Stand)).collect();
    PeopleRequest { parties, ..PeopleRequest::wandering(0) }
}

fn positions(simulation: &Simulation) -> Vec<[f64; 2]> {
    simulation.people_motions().map(|(_, motion)| motion.position_m).collect()
}

fn run_to(simulation: &mut Simulation, time_s: f64) {
    while (simulation.time_ns() as f64) < time_s * 1e9 - 1.0 {
        simulation.step().unwrap();
    }
}

fn mailbox<T: periplus_msgs::Message>(simulation: &Simulation, topic: &str) -> Mailbox<T> {
    let name = topic.replace('/', "_");
    let node = simulation.graph().node(NodeSettings::new(format!("user{name}"))).unwrap();
    node.mailbox(topic, Qos::best_effort(1000)).unwrap()
}

#[test]
fn the_leg_of_a_person_is_in_the_scan_and_not_on_the_true_map() {
    let mut simulation = simulate("", &standing(&[[3.0, 0.0]]), Options::default());
    let scans: Mailbox<LaserScan> = mailbox(&simulation, "/scan");
    run_to(&mut simulation, 0.5);
    // The axis of the left leg is at (3, 0.1), its radius 0.07 m.
    let range_m = f64::from(scans.drain().last().unwrap().ranges[1]);
    assert!((range_m - 2.93).abs() < 1e-5, "{range_m}");
    let mut simulation = simulate(&cart(0.0, 0.0), &standing(&[[3.0, 0.0]]), Options::default());
    let map = simulation.truth_map(wall_grid(-2.0, -4.0, 8.0, 4.0)).unwrap();
    let is_wall = |x, y| *map.at(x, y).unwrap() == OCCUPIED;
    assert!(is_wall(7.02, 0.0) && !is_wall(2.93, 0.1) && !is_wall(3.0, 0.0));
}

#[test]
fn people_stay_within_the_walls_and_beside_the_table() {
    for name in periplus_crowds::SteeringModel::NAMES {
        let model = periplus_crowds::SteeringModel::named(name).unwrap();
        let request = PeopleRequest { model, ..PeopleRequest::wandering(12) };
        let mut simulation = simulate(&cart(1.0, 0.0), &request, Options::default());
        let start = positions(&simulation);
        let mut walked_m = 0.0;
        for second in 1..=20 {
            run_to(&mut simulation, f64::from(second));
            for [x, y] in positions(&simulation) {
                assert!((-0.95..6.95).contains(&x) && (-2.95..2.95).contains(&y), "{name} {x} {y}");
                let is_table = (4.55..5.45).contains(&x) && (-2.45..-1.55).contains(&y);
                assert!(!is_table, "{name} {x} {y}");
            }
        }
        for ([x, y], [sx, sy]) in positions(&simulation).iter().zip(start) {
            walked_m += libm::hypot(x - sx, y - sy);
        }
        assert!(walked_m > 5.0, "{name} {walked_m}");
    }
}

#[test]
fn the_same_seed_gives_the_same_people_at_any_threads_and_sensor_rates() {
    for mode in [PhysicsMode::Rigid, PhysicsMode::Kinematic] {
        let run = |threads: usize, rate: &str, seed: u64| {
            let options = Options { threads, seed, mode, ..Options::default() };
            let mut simulation = world(&cart(1.0, 0.0), rate, options);
            assert!(simulation.add_people(&PeopleRequest::wandering(40)).is_empty());
            let _scans: Mailbox<LaserScan> = mailbox(&simulation, "/scan");
            run_to(&mut simulation, 3.0);
            positions(&simulation)
        };
        let first = run(1, "10", 1);
        assert_eq!(run(4, "10", 1), first);
        assert_eq!(run(1, "37", 1), first);
        assert_ne!(run(1, "10", 2), first);
    }
}

#[test]
fn a_robot_cannot_drive_through_a_person_that_cannot_step_aside() {
    // A dead end of 0.6 m between two walls, open to the robot, with a person at its end.
    let niche = r#"<model name="niche"><static>true</static><link name="l">
      <collision name="a"><pose>6 0.5 1 0 0 0</pose><geometry><box><size>2 0.4 2</size></box></geometry></collision>
      <collision name="b"><pose>6 -0.5 1 0 0 0</pose><geometry><box><size>2 0.4 2</size></box></geometry></collision>
    </link></model>"#;
    for mode in [PhysicsMode::Rigid, PhysicsMode::Kinematic] {
        let options = Options { mode, ..Options::default() };
        let content = format!("{}{niche}", cart(3.0, 0.0));
        let mut simulation = simulate(&content, &standing(&[[6.5, 0.0]]), options);
        let mut least_m = f64::INFINITY;
        while simulation.time_ns() < 10_000_000_000 {
            simulation.set_velocity("cart", DVec3::X * 0.5, DVec3::ZERO);
            simulation.step().unwrap();
            let (model, _) = simulation.motion().models().find(|(_, it)| *it == "cart").unwrap();
            let cart = Pose2::from(simulation.motion().model_pose(model).unwrap());
            let [x, y] = positions(&simulation)[0];
            let (dx, dy) = cart.inverse().transform_point(x, y);
            let outside = libm::hypot((dx.abs() - 0.3).max(0.0), (dy.abs() - 0.2).max(0.0));
            least_m = least_m.min(outside);
        }
        // The core of the body has 0.13 m; contacts give way by millimetres.
        assert!((0.1..0.3).contains(&least_m), "{mode:?} {least_m}");
        let report = simulation.people_report().unwrap();
        let comfort = &report.robots["cart"];
        assert!(comfort.min_distance_m.unwrap() < 0.1 && comfort.intimate_s > 1.0, "{comfort:?}");
    }
}

#[test]
fn one_who_stands_steps_aside_for_a_robot() {
    for mode in [PhysicsMode::Rigid, PhysicsMode::Kinematic] {
        let options = Options { mode, ..Options::default() };
        let mut simulation = simulate(&cart(1.0, 0.0), &standing(&[[3.0, 0.1]]), options);
        while simulation.time_ns() < 8_000_000_000 {
            simulation.set_velocity("cart", DVec3::X * 0.5, DVec3::ZERO);
            simulation.step().unwrap();
        }
        let (model, _) = simulation.motion().models().find(|(_, it)| *it == "cart").unwrap();
        let cart = simulation.motion().model_pose(model).unwrap().translation;
        // 0.5 m/s for 8 s: not held up.
        assert!((cart.x - 5.0).abs() < 0.05, "{mode:?} {cart}");
        let [_, y] = positions(&simulation)[0];
        assert!(y > 0.3, "{mode:?} {y}");
        let comfort = &simulation.people_report().unwrap().robots["cart"];
        assert!(comfort.min_distance_m.unwrap() > -0.08, "{comfort:?}");
    }
}

#[test]
fn people_are_published_for_subscribers() {
    let mut simulation = simulate("", &standing(&[[3.0, 0.0], [4.0, 1.0]]), Options::default());
    let mut services = Services::new(&simulation, Search::default()).unwrap();
    let mut serve_to = |simulation: &mut Simulation, time_s: f64| {
        while (simulation.time_ns() as f64) < time_s * 1e9 {
            services.serve(simulation);
            simulation.step().unwrap();
        }
    };
    serve_to(&mut simulation, 0.5);
    let has_topic = |simulation: &Simulation| {
        simulation.graph().topics().iter().any(|topic| topic.name == "/people")
    };
    assert!(!has_topic(&simulation));
    let found: Mailbox<Detection3DArray> = mailbox(&simulation, "/people");
    let tracks: Mailbox<RadarTracks> = mailbox(&simulation, "/people/tracks");
    serve_to(&mut simulation, 1.0);
    let last = found.drain().last().unwrap().clone();
    assert_eq!(last.header.frame_id, "world");
    let ids: Vec<&str> = last.detections.iter().map(|it| it.id.as_str()).collect();
    assert_eq!(ids, ["person_0", "person_1"]);
    let first = &last.detections[0];
    assert_eq!(first.results[0].hypothesis.class_id, "person");
    // Two people at rest near each other part by centimetres.
    assert!((first.bbox.center.position.x - 3.0).abs() < 0.05, "{first:?}");
    assert_eq!((first.bbox.size.x, first.bbox.size.z), (0.4, 1.75));
    let tracks = tracks.drain().last().unwrap().clone();
    assert!((tracks.tracks[1].position.x - 4.0).abs() < 0.05, "{tracks:?}");
}

#[test]
fn a_manual_door_is_opened_by_its_service() {
    let partition = r#"<model name="partition"><static>true</static><link name="l">
      <collision name="a"><pose>3 -1.8 1 0 0 0</pose><geometry><box><size>0.1 2.4 2</size></box></geometry></collision>
      <collision name="b"><pose>3 1.8 1 0 0 0</pose><geometry><box><size>0.1 2.4 2</size></box></geometry></collision>
    </link></model>"#;
    let visit = RequestedPlan::Visit { goals: vec![0], repeats: false };
    let request = PeopleRequest {
        goals: vec![goal([5.0, 1.0])],
        doors: vec![RequestedDoor {
            name: "lab".into(),
            ends_m: [[3.0, -0.6], [3.0, 0.6]],
            control: periplus_crowds::DoorControl::Manual,
            is_open: false,
            origin: Default::default(),
        }],
        parties: vec![party([1.0, 0.0], visit)],
        ..PeopleRequest::wandering(0)
    };
    let mut simulation = simulate(partition, &request, Options::default());
    let mut services = Services::new(&simulation, Search::default()).unwrap();
    run_to(&mut simulation, 6.0);
    assert!(positions(&simulation)[0][0] < 3.0);
    let node = simulation.graph().node(NodeSettings::new("user")).unwrap();
    let client = node.client::<SetBool>("/people/doors/lab/set_open").unwrap();
    let answer = client.call(SetBoolRequest { data: true });
    for _ in 0..10 {
        services.serve(&mut simulation);
        simulation.step().unwrap();
    }
    drop(answer);
    run_to(&mut simulation, 12.0);
    assert!(positions(&simulation)[0][0] > 4.0, "{:?}", positions(&simulation));
}

#[test]
fn a_reset_and_a_snapshot_bring_people_back() {
    for mode in [PhysicsMode::Rigid, PhysicsMode::Kinematic] {
        let options = Options { mode, seed: 3, ..Options::default() };
        let mut simulation = simulate(&cart(1.0, 0.0), &PeopleRequest::wandering(8), options);
        let start = positions(&simulation);
        run_to(&mut simulation, 1.025);
        let snapshot = simulation.snapshot();
        let then = positions(&simulation);
        run_to(&mut simulation, 3.0);
        let later = positions(&simulation);
        simulation.restore(&snapshot).unwrap();
        assert_eq!(positions(&simulation), then);
        run_to(&mut simulation, 3.0);
        assert_eq!(positions(&simulation), later);
        simulation.reset();
        assert_eq!(positions(&simulation), start);
        run_to(&mut simulation, 3.0);
        for ([x, y], [lx, ly]) in positions(&simulation).iter().zip(later) {
            assert!(libm::hypot(x - lx, y - ly) < 1e-9, "{mode:?}");
        }
    }
}

#[test]
fn people_without_room_are_refused() {
    let check = |request: &PeopleRequest, expected: &str| {
        let mut simulation = world("", "10", Options::default());
        let findings = simulation.add_people(request);
        let messages: Vec<&str> = findings.iter().map(|it| it.message.as_str()).collect();
        assert!(messages.iter().any(|it| it.contains(expected)), "{messages:?}");
        assert!(!simulation.has_people() && positions(&simulation).is_empty());
    };
    check(&PeopleRequest::wandering(1000), "the floor has room for");
    check(&standing(&[[3.0, 0.0], [5.0, -2.0]]), "does not start on free floor");
    let outside = PeopleRequest {
        goals: vec![goal([3.0, 0.0]), goal([20.0, 0.0])],
        ..PeopleRequest::wandering(1)
    };
    check(&outside, "people cannot walk to the goal");
    assert_eq!(PeopleFile::wandering(3).request.count, 3);
}
