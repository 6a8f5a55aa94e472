//! Topics, frames, rates and values of sensors.
#![allow(missing_docs, clippy::unwrap_used, reason = "tests")]

mod bench;
mod boxes;
mod radar;

use bench::Bench;
use periplus_msgs::gazebo_msgs::ContactsState;
use periplus_msgs::geometry_msgs::Vector3Stamped;
use periplus_msgs::ros_gz_interfaces::{Altimeter, Contacts, LogicalCameraImage};
use periplus_msgs::sensor_msgs::{
    CameraInfo, FluidPressure, Image, Imu, LaserScan, MagneticField, NavSatFix, PointCloud,
    PointCloud2, Range,
};

/// At rest on the floor the box measures 9.8 m/s² upwards, at the sensor's own rate.
#[test]
fn an_imu_of_ros_2() {
    let mut bench = Bench::with(
        "<sensor name='imu' type='imu'><update_rate>100</update_rate>
           <pose>0 0 0.1 0 0 0</pose>
           <imu><angular_velocity><x><noise type='gaussian'><stddev>0.01</stddev></noise></x>
             </angular_velocity></imu>
           <plugin name='imu_plugin' filename='libgazebo_ros_imu_sensor.so'>
             <ros><namespace>/demo</namespace><remapping>~/out:=imu</remapping></ros>
             <frame_name>imu_link</frame_name></plugin></sensor>",
    );
    assert_eq!(bench.said, "");
    assert_eq!(bench.topics(), ["/demo/imu sensor_msgs/msg/Imu"]);
    let heard = bench.hear::<Imu>("/demo/imu");
    bench.run(1.0);
    let messages = heard.drain();
    // One at the first step, and one each 10 ms.
    assert_eq!(messages.len(), 101);
    let last = messages.last().unwrap();
    assert_eq!(last.header.frame_id, "imu_link");
    assert!((last.linear_acceleration.z - 9.8).abs() < 0.01, "{last:?}");
    assert!((last.orientation.w.abs() - 1.0).abs() < 1e-6);
    assert_eq!(last.angular_velocity_covariance[0], 1e-4);
    let spread = messages.iter().map(|it| it.angular_velocity.x.abs()).sum::<f64>() / 100.0;
    assert!((0.005..0.012).contains(&spread), "{spread}");
}

/// The same bytes after a reset.
#[test]
fn a_reset_brings_the_same_noise() {
    let mut bench = Bench::with(
        "<sensor name='imu' type='imu'><update_rate>50</update_rate><topic>imu</topic>
           <imu><linear_acceleration><x><noise type='gaussian'><stddev>1</stddev>
             <bias_mean>2</bias_mean></noise></x></linear_acceleration></imu></sensor>",
    );
    let heard = bench.hear::<Imu>("/imu");
    let mut run = || {
        bench.run(0.2);
        let values: Vec<Imu> = heard.drain().iter().map(|it| (**it).clone()).collect();
        bench.reset();
        values
    };
    let first = run();
    assert_eq!(first.len(), 11);
    assert_eq!(first, run());
}

#[test]
fn an_imu_of_ros_1() {
    let mut bench = Bench::with(
        "<sensor name='imu' type='imu'><always_on>1</always_on><update_rate>200</update_rate>
           <plugin name='p' filename='libgazebo_ros_imu_sensor.so'>
             <topicName>imu/data</topicName><frameName>imu_link</frameName>
             <updateRateHZ>20</updateRateHZ></plugin></sensor>",
    );
    let heard = bench.hear::<Imu>("/imu/data");
    bench.run(1.0);
    assert_eq!(heard.drain().len(), 21);
}

#[test]
fn a_receiver_knows_where_the_world_lies() {
    let mut bench = Bench::in_world(
        "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model>
           <latitude_deg>47.5</latitude_deg><longitude_deg>8.5</longitude_deg>
           <elevation>400</elevation><heading_deg>0</heading_deg></spherical_coordinates>",
        "<sensor name='gps' type='gps'><update_rate>10</update_rate>
           <plugin name='gps' filename='libgazebo_ros_gps_sensor.so'/></sensor>",
    );
    assert_eq!(bench.topics().len(), 2);
    let (fix, velocity) =
        (bench.hear::<NavSatFix>("/gps/out"), bench.hear::<Vector3Stamped>("/gps/vel"));
    bench.run(0.5);
    let last = fix.latest().unwrap();
    assert!((last.latitude - 47.5).abs() < 1e-9 && (last.longitude - 8.5).abs() < 1e-9);
    assert!((last.altitude - 400.2).abs() < 1e-3, "{last:?}");
    assert_eq!(last.header.frame_id, "base");
    assert!(velocity.latest().unwrap().vector.x.abs() < 1e-3);
}

#[test]
fn a_receiver_nowhere_is_told() {
    let bench = Bench::with("<sensor name='n' type='navsat'><topic>fix</topic></sensor>");
    assert!(bench.said.contains("does not define where its origin is"), "{}", bench.said);
    assert!(bench.said.contains("hall.sdf:"), "{}", bench.said);
}

#[test]
fn fields_of_todays_gazebo() {
    let mut bench = Bench::in_world(
        "<magnetic_field>1e-5 2e-5 -3e-5</magnetic_field>",
        "<sensor name='mag' type='magnetometer'><update_rate>10</update_rate></sensor>
         <sensor name='alt' type='altimeter'><update_rate>10</update_rate></sensor>
         <sensor name='air' type='air_pressure'><update_rate>10</update_rate>
           <topic>air</topic></sensor>",
    );
    assert_eq!(bench.said, "");
    let at = "/world/hall/model/robot/link/base/sensor";
    let magnetic = bench.hear::<MagneticField>(&format!("{at}/mag/magnetometer"));
    let height = bench.hear::<Altimeter>(&format!("{at}/alt/altimeter"));
    let air = bench.hear::<FluidPressure>("/air");
    bench.run(0.3);
    let field = magnetic.latest().unwrap().magnetic_field.clone();
    assert!((field.x - 1e-5).abs() < 1e-9 && (field.z + 3e-5).abs() < 1e-9, "{field:?}");
    let height = height.latest().unwrap();
    assert!(height.vertical_position.abs() < 1e-3);
    assert!((height.vertical_reference - 0.2).abs() < 1e-3);
    assert!((air.latest().unwrap().fluid_pressure - 101_322.6).abs() < 0.5);
}

/// The box of 2 kg presses on the floor with 19.6 N.
#[test]
fn a_bumper_feels_the_floor() {
    let mut bench = Bench::with(
        "<sensor name='bump' type='contact'><update_rate>50</update_rate>
           <contact><collision>body</collision></contact>
           <plugin name='p' filename='libgazebo_ros_bumper.so'>
             <ros><remapping>bumper_states:=bumps</remapping></ros></plugin></sensor>
         <sensor name='touch' type='contact'><contact><collision>body</collision>
           <topic>/touched</topic></contact></sensor>",
    );
    let (bumps, touched) =
        (bench.hear::<ContactsState>("/bumps"), bench.hear::<Contacts>("/touched"));
    bench.run(1.0);
    let bumps = bumps.latest().unwrap();
    assert_eq!(bumps.header.frame_id, "world");
    let up: f64 = bumps.states.iter().map(|state| state.total_wrench.force.z).sum();
    assert!((up - 19.6).abs() < 0.5, "{bumps:?}");
    assert_eq!(bumps.states[0].collision1_name, "robot::base::body");
    assert_eq!(bumps.states[0].collision2_name, "floor::link::plane");
    assert!(bumps.states[0].contact_normals[0].z > 0.99);
    let touched = touched.latest().unwrap();
    assert_eq!(touched.contacts[0].collision2.name, "floor::link::plane");
}

#[test]
fn a_bumper_without_its_collision_is_told() {
    let bench = Bench::with(
        "<sensor name='bump' type='contact'><contact><collision>nose</collision></contact></sensor>",
    );
    assert!(bench.said.contains("uses the collision `nose`"), "{}", bench.said);
    assert!(bench.said.contains("body"), "{}", bench.said);
}

#[test]
fn a_sonar_finds_the_wall() {
    let mut bench = Bench::with(
        "<sensor name='sonar' type='sonar'><update_rate>10</update_rate><pose>0.2 0 1 0 0 0</pose>
           <sonar><min>0.1</min><max>4</max><radius>0.5</radius></sonar></sensor>",
    );
    let topic = "/world/hall/model/robot/link/base/sensor/sonar/sonar";
    let heard = bench.hear::<Range>(topic);
    bench.run(0.2);
    let range = heard.latest().unwrap();
    assert!((range.range - 2.8).abs() < 1e-3, "{range:?}");
    assert_eq!(range.radiation_type, Range::ULTRASOUND);
}

#[test]
fn a_logical_camera_names_the_wall() {
    let mut bench = Bench::with(
        "<sensor name='logic' type='logical_camera'><topic>seen</topic>
           <update_rate>10</update_rate><logical_camera><near>0.1</near><far>5</far>
           <horizontal_fov>1</horizontal_fov><aspect_ratio>1</aspect_ratio></logical_camera>
         </sensor>",
    );
    let heard = bench.hear::<LogicalCameraImage>("/seen");
    bench.run(0.2);
    let seen = heard.latest().unwrap();
    assert_eq!(seen.model.len(), 1);
    assert_eq!(seen.model[0].name, "wall");
    assert!((seen.model[0].pose.position.x - 3.5).abs() < 1e-3);
}

#[test]
fn what_is_not_measured_is_told_and_the_rest_runs() {
    let bench = Bench::with(
        "<sensor name='odd' type='air_flow'/>
         <sensor name='logic' type='logical_camera'><logical_camera><near>5</near><far>1</far>
           <horizontal_fov>1</horizontal_fov><aspect_ratio>1</aspect_ratio></logical_camera>
         </sensor>
         <sensor name='imu' type='imu'><topic>imu</topic></sensor>",
    );
    assert!(bench.said.contains("`odd` of type `air_flow` is not supported"), "{}", bench.said);
    assert!(bench.said.contains("do not define a frustum"), "{}", bench.said);
    assert_eq!(bench.topics(), ["/imu sensor_msgs/msg/Imu"]);
}

fn float(bytes: &[u8], at: usize) -> f32 {
    f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

/// Classic's depth camera 3 m before the wall: optical frame, x right, y down, z ahead.
#[test]
fn a_depth_camera_of_ros_2() {
    let mut bench = Bench::with(
        "<sensor name='depth' type='depth'><update_rate>10</update_rate><pose>0 0 1 0 0 0</pose>
           <camera name='c'><horizontal_fov>1.5707963267948966</horizontal_fov>
             <image><width>64</width><height>48</height></image>
             <clip><near>0.05</near><far>8</far></clip></camera>
           <plugin name='plug' filename='libgazebo_ros_camera.so'>
             <ros><namespace>/demo</namespace></ros><camera_name>eye</camera_name>
             <frame_name>eye_optical</frame_name><hack_baseline>0.07</hack_baseline>
             <min_depth>0.1</min_depth><max_depth>3.2</max_depth></plugin></sensor>",
    );
    assert_eq!(bench.said, "");
    let depth = bench.hear::<Image>("/demo/eye/depth/image_raw");
    let info = bench.hear::<CameraInfo>("/demo/eye/camera_info");
    let points = bench.hear::<PointCloud2>("/demo/eye/points");
    let colour = bench.hear::<Image>("/demo/eye/image_raw");
    bench.run(0.05);
    let depth = depth.latest().unwrap();
    assert_eq!((depth.width, depth.height, depth.step), (64, 48, 256));
    assert_eq!((depth.encoding.as_str(), depth.header.frame_id.as_str()), ("32FC1", "eye_optical"));
    for pixel in 0..64 * 48 {
        assert!((float(&depth.data, pixel * 4) - 3.0).abs() < 1e-5);
    }
    let info = info.latest().unwrap();
    assert!((info.k[0] - 32.0).abs() < 1e-9 && info.k[2] == 32.5 && info.k[5] == 24.5);
    assert!((info.p[3] + 32.0 * 0.07).abs() < 1e-9, "{:?}", info.p);
    let points = points.latest().unwrap();
    assert_eq!((points.point_step, points.row_step, points.is_dense), (32, 32 * 64, true));
    // The first pixel looks 31.5 / 32 to the left and 23.5 / 32 up.
    let first: Vec<f32> = [0, 4, 8].iter().map(|&at| float(&points.data, at)).collect();
    let expected = [-3.0 * 31.5 / 32.0, -3.0 * 23.5 / 32.0, 3.0];
    assert!(first.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5), "{first:?}");
    assert_eq!(colour.latest().unwrap().encoding, "rgb8");
}

/// gz-sim: topics below the sensor's topic, points with x forward, and none beyond the clip
/// distance.
#[test]
fn an_rgbd_camera_of_todays_gazebo() {
    let mut bench = Bench::with(
        "<sensor name='eye' type='rgbd_camera'><update_rate>10</update_rate><topic>eye</topic>
           <pose>0 0 1 0 0 0</pose>
           <camera><horizontal_fov>1.5707963267948966</horizontal_fov>
             <image><width>8</width><height>8</height></image>
             <clip><near>0.1</near><far>10</far></clip>
             <depth_camera><clip><near>0.1</near><far>2.5</far></clip></depth_camera>
             <optical_frame_id>eye_optical</optical_frame_id></camera></sensor>",
    );
    let (depth, points) =
        (bench.hear::<Image>("/eye/depth_image"), bench.hear::<PointCloud2>("/eye/points"));
    let info = bench.hear::<CameraInfo>("/eye/camera_info");
    bench.run(0.05);
    let depth = depth.latest().unwrap();
    assert_eq!(depth.header.frame_id, "eye_optical");
    assert_eq!(float(&depth.data, 0), f32::INFINITY);
    let points = points.latest().unwrap();
    assert_eq!((points.point_step, points.is_dense), (24, false));
    assert_eq!(points.header.frame_id, "base");
    assert_eq!(info.latest().unwrap().k[2], 4.0);
}

#[test]
fn an_impossible_camera_is_told() {
    let bench = Bench::with(
        "<sensor name='c' type='camera'><camera><horizontal_fov>4</horizontal_fov></camera></sensor>",
    );
    assert!(bench.said.contains("hall.sdf:"), "{}", bench.said);
    assert!(!bench.topics().iter().any(|topic| topic.contains("Image")), "{:?}", bench.topics());
}

/// The floor 1 m below a camera: row by row, depth = f / (rows below the middle).
#[test]
fn depths_follow_the_pinhole_formula() {
    let mut bench = Bench::still(
        "<model name='ground'><static>true</static><link name='l'><visual name='v'><geometry>
           <plane><normal>0 0 1</normal><size>100 100</size></plane></geometry></visual></link>
         </model>",
        "<sensor name='down' type='depth_camera'><update_rate>10</update_rate><topic>d</topic>
           <pose>0 0 0.8 0 0 3.141592653589793</pose>
           <camera><horizontal_fov>1.2</horizontal_fov>
             <image><width>64</width><height>48</height></image>
             <clip><near>0.1</near><far>10</far></clip></camera></sensor>",
    );
    let heard = bench.hear::<Image>("/d");
    bench.run(0.001);
    let depth = heard.latest().unwrap();
    let focal = 32.0 / libm::tan(0.6);
    for pixel in 0..64 * 48 {
        let (below, seen) = ((pixel / 64) as f64 - 23.5, float(&depth.data, pixel * 4));
        if below > 0.0 && focal / below < 10.0 {
            assert!((f64::from(seen) - focal / below).abs() < 1e-5, "{pixel}: {seen}");
        } else {
            assert_eq!(seen, f32::INFINITY);
        }
    }
}

/// Every plugin of a lidar, 2.8 m before a wall: `ray` measures collisions (retro 50), `gpu_ray`
/// visuals (70).
#[test]
fn lidars_through_every_plugin() {
    let lidar = |name: &str, kind: &str, plugin: &str| {
        format!(
            "<sensor name='{name}' type='{kind}'><update_rate>10</update_rate>
               <pose>0.2 0 1 0 0 0</pose>
               <ray><scan><horizontal><samples>3</samples><min_angle>-0.1</min_angle>
                 <max_angle>0.1</max_angle></horizontal></scan>
                 <range><min>0.1</min><max>10</max></range></ray>{plugin}</sensor>"
        )
    };
    let ros2 = |name: &str, output: &str| {
        let plugin = format!(
            "<plugin name='{name}' filename='libgazebo_ros_ray_sensor.so'>
               <ros><remapping>~/out:={name}</remapping></ros><frame_name>front</frame_name>
               <output_type>sensor_msgs/{output}</output_type></plugin>"
        );
        lidar(name, "ray", &plugin)
    };
    let ros1 = |name: &str, kind: &str, library: &str| {
        let plugin = format!(
            "<plugin name='{name}' filename='libgazebo_ros_{library}.so'>
               <topicName>{name}</topicName><frameName>/front</frameName></plugin>"
        );
        lidar(name, kind, &plugin)
    };
    let all = [
        ros2("scan", "LaserScan"),
        ros2("points", "PointCloud2"),
        ros2("old_points", "PointCloud"),
        ros2("nearest", "Range"),
        ros1("laser", "ray", "laser"),
        ros1("gpu", "gpu_ray", "gpu_laser"),
        ros1("block", "ray", "block_laser"),
        ros1("range", "ray", "range"),
        lidar("plain", "gpu_lidar", "<topic>plain</topic>"),
    ];
    let mut bench = Bench::with(&all.concat());
    let scans = ["scan", "laser", "gpu", "plain"]
        .map(|name| (name, bench.hear::<LaserScan>(&format!("/{name}"))));
    let ranges = ["nearest", "range"].map(|name| bench.hear::<Range>(&format!("/{name}")));
    let clouds = ["old_points", "block"].map(|name| bench.hear::<PointCloud>(&format!("/{name}")));
    let points = bench.hear::<PointCloud2>("/points");
    let rings = bench.hear::<PointCloud2>("/plain/points");
    bench.run(0.05);
    for (name, heard) in scans {
        let scan = heard.latest().unwrap_or_else(|| panic!("{name}"));
        assert!((scan.ranges[1] - 2.8).abs() < 1e-5, "{name}: {scan:?}");
        let is_seen = matches!(name, "gpu" | "plain");
        assert_eq!(scan.intensities[1], if is_seen { 70.0 } else { 50.0 }, "{name}");
        if name != "plain" {
            assert_eq!(scan.header.frame_id, "front", "{name}");
        }
    }
    for heard in ranges {
        assert!((heard.latest().unwrap().range - 2.8).abs() < 1e-5);
    }
    for heard in clouds {
        assert_eq!(heard.latest().unwrap().points.len(), 3);
    }
    assert_eq!(points.latest().unwrap().point_step, 16);
    assert_eq!(rings.latest().unwrap().point_step, 32);
}
