//! Texts of the example worlds.

use super::parts::{
    AIR_PRESSURE, ALTIMETER, BLUE, CONTACT, FORCE_TORQUE, GREEN, GREY, IMU, MAGNETOMETER, NAVSAT,
    RED, RENDERING, Rgb, WHITE, YELLOW, ball, camera, capsule, cuboid, cylinder, ellipsoid, lidar,
    plain_sensor, scenery, world,
};
use super::robots::{
    battery, car, diff_drive, mecanum, pendulum, rotor, two_wheels, velocity_control,
};

/// Name without `.sdf`, and function that returns the text.
type Entry = (&'static str, fn() -> String);

/// All worlds.
pub(super) const WORLDS: [Entry; 30] = [
    ("empty", || world("empty", &[CONTACT], "")),
    ("default", || world("default", &[CONTACT, RENDERING, IMU], "")),
    ("shapes", || world("shapes", &[], &shapes(0.0))),
    ("rolling_shapes", || world("shapes", &[], &shapes(2.0))),
    ("physics_options", || world("shapes", &[], &shapes(0.0))),
    ("lights", lights),
    ("nested_model", nested),
    ("camera_sensor", || seen_by("camera_sensor", &camera("camera", "camera", "camera", 30, ""))),
    ("triggered_camera_sensor", || {
        let sensor = camera("camera", "camera", "camera", 30, "camera/trigger");
        seen_by("triggered_camera_sensor", &sensor)
    }),
    ("depth_camera_sensor", || {
        let sensor = camera("depth_camera1", "depth_camera", "depth_camera", 10, "");
        seen_by("depth_camera_sensor", &sensor)
    }),
    ("rgbd_camera_sensor", || {
        seen_by("rgbd_camera_sensor", &camera("rgbd_camera", "rgbd_camera", "rgbd_camera", 30, ""))
    }),
    ("gpu_lidar_sensor", || seen_by("gpu_lidar_sensor", &lidar("gpu_lidar", "lidar"))),
    ("visualize_lidar", visualize_lidar),
    ("sensors_demo", sensors_demo),
    ("sensors", sensors),
    ("altimeter", sensors),
    ("air_pressure", sensors),
    ("imu", sensors),
    ("magnetometer", sensors),
    ("contact_sensor", contact_sensor),
    ("spherical_coordinates", spherical_coordinates),
    ("diff_drive", || vehicles("diff_drive", &diff_drive())),
    ("velocity_control", || vehicles("velocity_control", &velocity_control())),
    ("linear_battery_demo", || vehicles("default", &(diff_drive() + &battery()))),
    ("mecanum_drive", || world("mecanum_drive", &[], &mecanum("vehicle_blue", BLUE))),
    ("ackermann_steering", || world("ackermann_steering", &[], &car("vehicle_blue", BLUE))),
    ("joint_controller", joint_controller),
    ("joint_position_controller", joint_position_controller),
    ("joint_state_publisher", || {
        let plugin = "<plugin filename=\"gz-sim-joint-state-publisher-system\" \
                      name=\"gz::sim::systems::JointStatePublisher\"/>";
        world("default", &[], &pendulum("double_pendulum_with_base", plugin))
    }),
    ("pose_publisher", || {
        let plugin = "<plugin filename=\"gz-sim-pose-publisher-system\" \
                      name=\"gz::sim::systems::PosePublisher\">\
                      <publish_link_pose>true</publish_link_pose>\
                      <use_pose_vector_msg>true</use_pose_vector_msg></plugin>";
        world("pose_publisher", &[], &pendulum("double_pendulum_with_base", plugin))
    }),
];

/// Text of a built-in world.
pub(super) fn text(name: &str) -> Option<String> {
    WORLDS.iter().find(|(known, _)| *known == name).map(|(_, make)| make())
}

/// Row of simple shapes, `above_m` above the floor.
fn shapes(above_m: f64) -> String {
    let at = |y_m: f64, half_height_m: f64| {
        format!("0 {y_m} {} 0 {} 0", half_height_m + above_m, above_m / 10.0)
    };
    [
        cuboid([1.0, 1.0, 1.0]).model("box", &at(0.0, 0.5), 1.0, RED),
        cylinder(0.5, 1.0).model("cylinder", &at(-1.5, 0.5), 2.0, GREEN),
        ball(0.5).model("sphere", &at(1.5, 0.5), 3.0, BLUE),
        capsule(0.2, 0.6).model("capsule", &at(-3.0, 0.5), 1.0, YELLOW),
        ellipsoid([0.2, 0.3, 0.5]).model("ellipsoid", &at(3.0, 0.5), 1.0, WHITE),
    ]
    .concat()
}

fn lights() -> String {
    let light = |name: &str, kind: &str, pose: &str, colour: &str, more: &str| {
        format!(
            "<light name=\"{name}\" type=\"{kind}\"><pose>{pose}</pose><diffuse>{colour} 1</diffuse>\
             <specular>0.1 0.1 0.1 1</specular><attenuation><range>10</range>\
             <constant>0.2</constant><linear>0.1</linear><quadratic>0.01</quadratic></attenuation>\
             {more}</light>\n"
        )
    };
    let spot = "<direction>0 0 -1</direction><spot><inner_angle>0.2</inner_angle>\
                <outer_angle>0.6</outer_angle><falloff>0.8</falloff></spot>";
    let content = light("point_light", "point", "0 -1.5 3 0 0 0", "1 0.2 0.2", "")
        + &light("spot_light", "spot", "0 1.5 3 0 0 0", "0.2 1 0.2", spot)
        + &shapes(0.0);
    world("lights", &[], &content)
}

fn nested() -> String {
    let inner = cuboid([0.5, 0.5, 0.5]).model("model_01", "0 0 0.5 0 0 0", 0.5, GREEN);
    let base = cuboid([1.0, 1.0, 0.5]).on_link(2.0, "", BLUE, "");
    let content = format!(
        "<model name=\"model_00\"><pose>0 0 0.25 0 0 0</pose><link name=\"link_00\">{base}</link>\
         {inner}<joint name=\"joint_00\" type=\"fixed\"><parent>link_00</parent>\
         <child>model_01::model_01_link</child></joint></model>\n"
    );
    world("nested_model_world", &[], &content)
}

/// Sensor housing at the height of a robot, in front of some models.
fn stand(name: &str, pose: &str, sensors: &str) -> String {
    cuboid([0.1, 0.1, 0.1]).fixed(name, pose, GREY, sensors)
}

fn seen_by(name: &str, sensor: &str) -> String {
    // The housing of a lidar must be closer than its minimum range.
    let model = if name.contains("lidar") { "model_with_lidar" } else { "camera" };
    let content = stand(model, "0 0 0.5 0 0 0", sensor) + &scenery();
    world(name, &[RENDERING], &content)
}

fn visualize_lidar() -> String {
    let vehicle = two_wheels(
        "vehicle_blue",
        "0 3 0 0 0 0",
        BLUE,
        &lidar("gpu_lidar", "lidar2").replacen("<topic>", "<pose>0 0 0.4 0 0 0</pose><topic>", 1),
        &diff_drive(),
    );
    let content = stand("model_with_lidar", "0 0 0.5 0 0 0", &lidar("gpu_lidar", "lidar"))
        + &vehicle
        + &scenery();
    world("visualize_lidar_world", &[RENDERING], &content)
}

fn sensors_demo() -> String {
    let alone = camera("cameras_alone", "camera", "camera_alone", 30, "")
        + &camera("depth_camera1", "depth_camera", "depth_camera", 10, "");
    let both = camera("camera", "camera", "camera", 30, "") + &lidar("gpu_lidar", "lidar");
    let content = [
        stand("cameras_alone", "0 1 0.5 0 0 0", &alone),
        stand("camera_with_lidar", "0 0 0.5 0 0 0", &both),
        stand(
            "rgbd_camera",
            "0 -1 0.5 0 0 0",
            &camera("rgbd_camera", "rgbd_camera", "rgbd_camera", 30, ""),
        ),
        scenery(),
    ]
    .concat();
    world("lidar_sensor", &[RENDERING], &content)
}

fn sensors() -> String {
    let all = [
        plain_sensor("altimeter", "altimeter", 30),
        plain_sensor("air_pressure", "air_pressure", 30),
        plain_sensor("imu", "imu", 100),
        plain_sensor("magnetometer", "magnetometer", 100),
    ]
    .concat();
    let falling = format!(
        "<model name=\"sensors_box\"><pose>0 0 3 0 0 0</pose><link name=\"link\">{}{all}</link>\
         </model>\n",
        cuboid([0.4, 0.4, 0.4]).on_link(1.0, "", RED, "")
    );
    let weighed = format!(
        "<model name=\"force_torque_demo\"><pose>2 0 0 0 0 0</pose><link name=\"base\">{}</link>\
         <link name=\"load\"><pose>0 0 0.75 0 0 0</pose>{}</link>\
         <joint name=\"joint_00\" type=\"fixed\"><parent>world</parent><child>base</child></joint>\
         <joint name=\"joint_01\" type=\"fixed\"><parent>base</parent><child>load</child>\
         <sensor name=\"force_torque\" type=\"force_torque\"><topic>force_torque</topic>\
         <update_rate>10</update_rate><always_on>true</always_on></sensor></joint></model>\n",
        cuboid([0.3, 0.3, 0.5]).on_link(10.0, "0 0 0.25 0 0 0", GREY, ""),
        cuboid([0.5, 0.5, 0.5]).on_link(4.0, "", YELLOW, "")
    );
    let systems = [AIR_PRESSURE, ALTIMETER, IMU, MAGNETOMETER, FORCE_TORQUE];
    world("sensors", &systems, &(falling + &weighed))
}

fn contact_sensor() -> String {
    let sensor = "<sensor name=\"sensor_contact\" type=\"contact\"><topic>/contact_example</topic>\
                  <update_rate>100</update_rate><always_on>true</always_on><contact>\
                  <collision>collision</collision><topic>/contact_example</topic></contact></sensor>";
    let content = format!(
        "<model name=\"contact_model\"><pose>0 0 1 0 0 0</pose><link name=\"link\">{}{sensor}</link>\
         </model>\n",
        cuboid([1.0, 1.0, 1.0]).on_link(1.0, "", RED, "")
    );
    world("contact_sensor", &[CONTACT], &content)
}

fn spherical_coordinates() -> String {
    // Massalia (Marseille), where the Massaliote Periplus began.
    let origin = "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model>\
                  <world_frame_orientation>ENU</world_frame_orientation>\
                  <latitude_deg>43.2952</latitude_deg><longitude_deg>5.3745</longitude_deg>\
                  <elevation>10</elevation><heading_deg>0</heading_deg></spherical_coordinates>\n";
    let model = format!(
        "<model name=\"NavSat\"><pose>0 0 0.25 0 0 0</pose><link name=\"link\">{}{}</link></model>\n",
        cuboid([0.5, 0.5, 0.5]).on_link(1.0, "", BLUE, ""),
        plain_sensor("navsat", "navsat", 1)
    );
    world("spherical_coordinates", &[NAVSAT], &(origin.to_owned() + &model))
}

/// Blue and green vehicle with the same plugins.
fn vehicles(name: &str, plugins: &str) -> String {
    let vehicle =
        |model: &str, pose: &str, colour: Rgb| two_wheels(model, pose, colour, "", plugins);
    let content = vehicle("vehicle_blue", "0 2 0 0 0 0", BLUE)
        + &vehicle("vehicle_green", "0 -2 0 0 0 0", GREEN);
    world(name, &[], &content)
}

fn joint_controller() -> String {
    let plugin = |force: &str| {
        format!(
            "<plugin filename=\"gz-sim-joint-controller-system\" \
             name=\"gz::sim::systems::JointController\"><joint_name>j1</joint_name>{force}</plugin>"
        )
    };
    let by_force = "<use_force_commands>true</use_force_commands><p_gain>0.2</p_gain>\
                    <i_gain>0.01</i_gain>";
    let content = rotor("joint_controller_demo", "0 0 0 0 0 0", &plugin(""))
        + &rotor("joint_controller_demo_2", "0 2 0 0 0 0", &plugin(by_force));
    world("default", &[], &content)
}

fn joint_position_controller() -> String {
    let plugin = "<plugin filename=\"gz-sim-joint-position-controller-system\" \
                  name=\"gz::sim::systems::JointPositionController\"><joint_name>j1</joint_name>\
                  <topic>rotor_cmd</topic><p_gain>1</p_gain><i_gain>0.1</i_gain>\
                  <d_gain>0.01</d_gain></plugin>";
    world("default", &[], &rotor("joint_position_controller_demo", "0 0 0 0 0 0", plugin))
}
