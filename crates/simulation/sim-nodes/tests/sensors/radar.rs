//! Radars: returns and tracks with answers by hand.

use periplus_msgs::radar_msgs::{RadarReturn, RadarScan, RadarTrack, RadarTracks};
use periplus_physics::Twist;

use crate::bench::Bench;

/// Cells of 0.4 m, 0.02 rad and 0.1 m/s, 20 scans per second. At its height of 0.7 m the floor is seen from 35 m on, too
/// weakly to be reported.
const SETTINGS: &str =
    "<update_rate>20</update_rate><topic>radar</topic><gz_frame_id>radar</gz_frame_id>
  <gz:radar><horizontal_fov>1.0</horizontal_fov><vertical_fov>0.04</vertical_fov>
    <range><min>0.3</min><max>60</max><resolution>0.4</resolution></range>
    <azimuth_resolution>0.02</azimuth_resolution>
    <velocity><max>20</max><resolution>0.1</resolution></velocity></gz:radar>";

/// A box of 0.6 m beyond the back of the robot, its face at x = -25.3 m.
const TARGET: &str = "<model name='target'><pose>-25.6 0 0.7 0 0 0</pose><link name='l'>
  <collision name='c'><geometry><box><size>0.6 0.6 0.6</size></box></geometry></collision>
  </link></model>";

/// A radar at (-0.3, 0, 0.7) that looks back.
fn looking_back(more: &str) -> String {
    format!(
        "<sensor name='rear' type='custom' gz:type='radar'>
           <pose>-0.3 0 0.5 0 0 3.141592653589793</pose>{SETTINGS}{more}</sensor>"
    )
}

fn strongest(scan: &RadarScan) -> RadarReturn {
    let strongest = scan.returns.iter().max_by(|a, b| a.amplitude.total_cmp(&b.amplitude));
    strongest.expect("a return").clone()
}

fn seconds(stamp: &periplus_msgs::builtin_interfaces::Time) -> f64 {
    f64::from(stamp.sec) + f64::from(stamp.nanosec) * 1e-9
}

/// The box comes nearer with 3 m/s: range 25 - 3 t, azimuth 0, radial velocity -3.
#[test]
fn a_moving_box_within_half_a_cell() {
    let mut bench = Bench::still(TARGET, &looking_back(""));
    assert_eq!(bench.said, "");
    assert_eq!(
        bench.topics(),
        ["/radar/scan radar_msgs/msg/RadarScan", "/radar/tracks radar_msgs/msg/RadarTracks"]
    );
    let (scans, tracks) =
        (bench.hear::<RadarScan>("/radar/scan"), bench.hear::<RadarTracks>("/radar/tracks"));
    let target = bench.world.find_model("target").unwrap();
    assert!(bench.world.follow(target, Twist { x_m_s: 3.0, ..Twist::default() }));
    bench.run(3.0);
    let scans = scans.drain();
    assert_eq!(scans.len(), 61);
    // In the first step the velocity is applied.
    for scan in &scans[1..] {
        let best = strongest(scan);
        let range_m = 25.0 - 3.0 * seconds(&scan.header.stamp);
        assert!((f64::from(best.range) - range_m).abs() <= 0.2 + 0.01, "{best:?} {range_m}");
        assert!(best.azimuth.abs() <= 0.01 + 1e-6, "{best:?}");
        assert!((best.doppler_velocity + 3.0).abs() <= 0.05 + 1e-6, "{best:?}");
    }
    let all = tracks.drain();
    assert!(all[0].tracks.is_empty() && all[1].tracks.is_empty());
    let first = &all[2].tracks[0].uuid;
    for message in &all[20..] {
        let [track] = message.tracks.as_slice() else { panic!("{message:?}") };
        let range_m = 25.0 - 3.0 * seconds(&message.header.stamp);
        // The face is what is seen; a cell of azimuth is 0.5 m wide at 25 m.
        assert!((track.position.x - range_m).abs() < 0.4, "{track:?} {range_m}");
        assert!(track.position.y.abs() < 0.25 && (track.velocity.x + 3.0).abs() < 0.1, "{track:?}");
        assert_eq!(&track.uuid, first);
    }
    // Version 4 of RFC 9562.
    assert_eq!((first.uuid[6] >> 4, first.uuid[8] >> 6), (4, 2));
}

/// The wall is 3 m ahead; the robot drives with 1.5 m/s. Off the axis the wall comes nearer by the cosine.
#[test]
fn a_wall_from_a_driving_robot() {
    let on_base = format!(
        "<sensor name='front' type='radar'><pose>0.25 0 0.5 0 0 0</pose>{}</sensor>",
        SETTINGS.replace("gz:radar", "radar").replace("<min>0.3", "<min>0.1")
    );
    let mut bench = Bench::still("", &on_base);
    assert_eq!(bench.said, "");
    let (scans, tracks) =
        (bench.hear::<RadarScan>("/radar/scan"), bench.hear::<RadarTracks>("/radar/tracks"));
    let robot = bench.world.find_model("robot").unwrap();
    assert!(bench.world.follow(robot, Twist { x_m_s: 1.5, ..Twist::default() }));
    bench.run(1.0);
    for scan in &scans.drain()[1..] {
        assert!(scan.returns.len() >= 50, "{}", scan.returns.len());
        let ahead_m = 2.75 - 1.5 * seconds(&scan.header.stamp);
        for seen in &scan.returns {
            let cosine = libm::cos(seen.azimuth.into());
            let range_m = ahead_m / cosine;
            // Within a cell of azimuth at 0.5 rad the range changes by 1.2 %.
            assert!((f64::from(seen.range) - range_m).abs() <= 0.2 + 0.05, "{seen:?} {range_m}");
            let doppler = f64::from(seen.doppler_velocity);
            assert!((doppler + 1.5 * cosine).abs() <= 0.05 + 0.01, "{seen:?}");
        }
    }
    let last = tracks.latest().unwrap();
    assert!(!last.tracks.is_empty());
    assert!(last.tracks.iter().all(|it| it.classification == RadarTrack::STATIC), "{last:?}");
}

/// The same seed gives the same noise, after a reset, too.
#[test]
fn noise_is_the_same_after_a_reset() {
    let noisy = looking_back("").replace(
        "</gz:radar>",
        "<noise><range_stddev>0.5</range_stddev><velocity_stddev>0.2</velocity_stddev>
           <azimuth_stddev>0.01</azimuth_stddev></noise></gz:radar>",
    );
    let mut bench = Bench::still(TARGET, &noisy);
    let (scans, tracks) =
        (bench.hear::<RadarScan>("/radar/scan"), bench.hear::<RadarTracks>("/radar/tracks"));
    let mut run = || {
        bench.run(0.5);
        let seen: Vec<RadarScan> = scans.drain().iter().map(|it| (**it).clone()).collect();
        let found: Vec<RadarTracks> = tracks.drain().iter().map(|it| (**it).clone()).collect();
        bench.reset();
        (seen, found)
    };
    let first = run();
    assert_eq!(first.0.len(), 11);
    let ranges: std::collections::BTreeSet<String> =
        first.0.iter().flat_map(|it| &it.returns).map(|it| it.range.to_string()).collect();
    assert!(ranges.len() > 1, "{ranges:?}");
    assert_eq!(first, run());
}

#[test]
fn an_impossible_radar_is_reported_with_its_line() {
    let bench = Bench::still("", &looking_back("").replace("<max>60", "<max>0.1"));
    assert!(bench.said.contains("cannot measure anything"), "{}", bench.said);
    assert!(bench.said.contains("hall.sdf:"), "{}", bench.said);
    assert_eq!(bench.topics(), Vec::<String>::new());
}
