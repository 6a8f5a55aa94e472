//! A drive through a world, recorded, and where the robot really was.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use periplus_geometry::Pose2;
use periplus_graph::{NodeSettings, Qos};
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_sim::script::{DriveScript, Goal};
use periplus_sim::{Composition, Driver, Options, PhysicsMode, Simulation, SimulationRecorder};

use crate::stage::{LASER_M, Stage};

/// A drive that takes longer than this is stuck \[s, simulated time\].
const LONGEST_S: f64 = 2000.0;

/// Drive of a robot through a world: true poses with the times of the scans \[ns\], and a log.
pub(crate) struct Drive {
    pub(crate) truth: Vec<(i64, Pose2)>,
    /// The same drive as a log of CARMEN.
    log: String,
}

impl Drive {
    pub(crate) fn way_m(&self) -> f64 {
        let steps = self.truth.windows(2);
        steps.map(|it| (it[1].1.x_m - it[0].1.x_m).hypot(it[1].1.y_m - it[0].1.y_m)).sum()
    }

    /// Writes `raw.clf` and `truth.txt`, which `--example logs` of `periplus-slam` reads.
    pub(crate) fn write(&self, folder: &Path) -> std::io::Result<()> {
        let mut truth = String::new();
        for (time_ns, pose) in &self.truth {
            let time_s = *time_ns as f64 * 1e-9;
            let _ = writeln!(truth, "{time_s:.6} {} {} {}", pose.x_m, pose.y_m, pose.yaw_rad);
        }
        std::fs::write(folder.join("truth.txt"), truth)?;
        std::fs::write(folder.join("raw.clf"), &self.log)
    }
}

/// Drives to all goals of a stage, and records what `periplus slam` wants to know.
pub(crate) fn drive(stage: &Stage, seed: u64, bag: &Path) -> Result<Drive, String> {
    let mut composition = Composition {
        world: stage.composition.world.clone(),
        members: stage.composition.members.clone(),
        files: stage.composition.files.clone(),
        is_default_world: stage.composition.is_default_world,
    };
    let options = Options { seed, mode: PhysicsMode::Rigid, ..Options::default() };
    let mut simulation = Simulation::new(&mut composition, stage.files.clone(), options);
    let goals = stage.way.iter().map(|&to| Goal { tolerance_m: 0.15, ..Goal::at(to) });
    let mut driver = Driver::new(DriveScript {
        goals: goals.collect(),
        goal_topic: Some("/kbot/base_controller/cmd_vel".into()),
        ..DriveScript::default()
    });
    driver.join(&simulation).map_err(|why| why.to_string())?;
    let node = simulation.graph().node(NodeSettings::new("bench")).map_err(|it| it.to_string())?;
    let scans = node
        .mailbox::<LaserScan>("/kbot/sensor_laser/scan", Qos::sensor_data())
        .map_err(|why| why.to_string())?;
    let wanted = |name: &str| name.ends_with("/scan") || name.contains("tf");
    let odometry = node
        .mailbox::<Odometry>("/kbot/base_controller/odom", Qos::reliable(10))
        .map_err(|why| why.to_string())?;
    let mut odom_from_base = Pose2::IDENTITY;
    let mut log = String::new();
    let recorder = SimulationRecorder::start(&simulation, bag, Box::new(wanted), BTreeMap::new())
        .map_err(|it| it.to_string())?;
    let mut truth: Vec<(i64, Pose2)> = Vec::new();
    // A little standing still at the end.
    let mut left_ns = 300_000_000;
    let mut recent: Vec<(i64, Pose2)> = Vec::new();
    while left_ns > 0 {
        driver.play(&simulation);
        if driver.next_ns().is_none() {
            left_ns -= simulation.step_ns();
        }
        simulation.step().map_err(|why| why.to_string())?;
        let pose = simulation.robot_pose().ok_or("the robot is gone")?;
        recent.push((simulation.time_ns(), Pose2::from(pose)));
        if let Some(told) = odometry.latest() {
            let (place, turn) = (&told.pose.pose.position, &told.pose.pose.orientation);
            odom_from_base = Pose2::new(place.x, place.y, 2.0 * turn.z.atan2(turn.w));
        }
        for scan in scans.drain() {
            let stamp = &scan.header.stamp;
            let stamp_ns = i64::from(stamp.sec) * 1_000_000_000 + i64::from(stamp.nanosec);
            let then = recent.iter().find(|it| it.0 == stamp_ns);
            let (_, pose) = then.ok_or_else(|| format!("no pose at the scan's time {stamp_ns}"))?;
            truth.push((stamp_ns, *pose));
            line(&mut log, &scan, stamp_ns, odom_from_base);
        }
        if recent.len() > 1000 {
            recent.drain(..500);
        }
        if simulation.time_ns() as f64 * 1e-9 > LONGEST_S {
            return Err(format!("stuck at {pose:?} after {} scans", truth.len()));
        }
    }
    recorder.finish(&mut simulation).map_err(|why| why.to_string())?;
    Ok(Drive { truth, log })
}

/// A scan as `ROBOTLASER1` of CARMEN.
fn line(log: &mut String, scan: &LaserScan, stamp_ns: i64, odom_from_base: Pose2) {
    let (start, step) = (scan.angle_min, scan.angle_increment);
    let _ = write!(log, "ROBOTLASER1 0 {start} {} {step} ", scan.angle_max - start);
    let _ = write!(log, "{} 0.01 0 {}", scan.range_max, scan.ranges.len());
    for range in &scan.ranges {
        let _ = write!(log, " {:.4}", range.min(scan.range_max));
    }
    let pose = |it: Pose2| format!("{} {} {}", it.x_m, it.y_m, it.yaw_rad);
    let laser = odom_from_base * Pose2::new(LASER_M[0], 0.0, 0.0);
    let time_s = stamp_ns as f64 * 1e-9;
    let (laser, base) = (pose(laser), pose(odom_from_base));
    let _ = writeln!(log, " 0 {laser} {base} 0 0 0.1 0.1 1000 {time_s:.6} sim {time_s:.6}");
}
