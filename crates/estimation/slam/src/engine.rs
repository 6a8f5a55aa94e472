//! Graph SLAM: scans in, poses and a map out.
//!
//! [`Slam::add_scan`] runs one step; `work` does the rest in the background in slices of bounded time:
//! proximity constraints, graph optimization, loop search, pruning, audit.

mod component;
mod finish;
mod live_audit;
mod manual;
mod prune;
mod queries;
mod scan_match;
mod state;
mod trial;
mod work;

use periplus_geometry::{LaserScan2, Pose2};
use periplus_scan_matching::{PackedPlaces, Symmetric3};

use crate::graph::{Edge, Graph};
use crate::keyframe::{Keyframe, TrajectoryNode};
use crate::local::{apart, floored};
use crate::loops::Loops;
use crate::odometry_diagnostics::{OdometryDiagnostics, Step};
use crate::odometry_monitor::{OdometryMonitor, OdometryTrust};
use crate::odometry_noise::OdometryNoise;
use crate::remark::RemarkKind;
use crate::scan::{Ends, fault};
use crate::settings::Settings;

pub use crate::graph::ConstraintKind;
pub use live_audit::MapContradiction;

use component::UnmatchedRun;
use live_audit::LiveAudit;
use scan_match::{ScanMatch, per_second};
use work::Work;

/// Result of processing one scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScanOutcome {
    /// Inserted into the map as a keyframe.
    Inserted,
    /// Matched; the robot has not moved enough since the last keyframe to insert it.
    BelowMotionThreshold,
    /// No match with the scans before it; its pose is the one predicted by odometry.
    NoMatch,
    /// Not usable, for this reason.
    Rejected(&'static str),
}

/// Pose of the robot after a scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Update {
    /// Result of processing the scan.
    pub outcome: ScanOutcome,
    /// Pose of the robot.
    pub map_from_base: Pose2,
    /// Correction of odometry, as published in `/tf`; the identity without odometry.
    pub map_from_odom: Pose2,
    /// True if poses of earlier keyframes have changed.
    pub is_map_revised: bool,
}

/// Counters of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Scans received.
    pub scans: usize,
    /// Scans inserted as keyframes.
    pub kept: usize,
    /// Scans without a match, or with one at which they contradict the scans before them.
    pub lost: usize,
    /// Scans rejected as unusable.
    pub ignored: usize,
    /// Proximity constraints.
    pub proximity: usize,
    /// Loop searches.
    pub searches: usize,
    /// Slices of background work.
    pub slices: usize,
}

/// A constraint between two keyframes and its residual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstraintResidual {
    /// Keyframes: from, to.
    pub keyframes: (usize, usize),
    /// Origin of the constraint.
    pub link: ConstraintKind,
    /// Distance between the constrained and the optimized position of the second keyframe \[m\].
    pub residual_m: f64,
    /// Difference between the constrained and the optimized heading \[rad\].
    pub residual_rad: f64,
}

/// State after the last scan.
struct Last {
    time_ns: i64,
    odom_from_base: Option<Pose2>,
    keyframe: usize,
    keyframe_from_base: Pose2,
    /// Motion per second, if known.
    motion: Option<Pose2>,
    /// Covariance of the pose, along the axes of the keyframe.
    covariance: Symmetric3,
}

/// Graph SLAM with one laser scanner.
pub struct Slam {
    settings: Settings,
    keyframes: Vec<Keyframe>,
    nodes: Vec<TrajectoryNode>,
    graph: Graph,
    odometry_noise: OdometryNoise,
    last: Option<Last>,
    loops: Loops,
    work: Work,
    counts: Counts,
    diagnostics: OdometryDiagnostics,
    odometry_monitor: OdometryMonitor,
    unmatched: UnmatchedRun,
    live_audit: LiveAudit,
    /// True from [`Slam::finish`] to the next scan.
    is_finished: bool,
    /// First keyframe of the newest map component; the pose of earlier components relative to it is unknown.
    component: usize,
    /// Running mean of the inlier ratio: the fraction of the points of a scan that find partners.
    inlier_ratio: f64,
    /// Pose and covariance set from outside for the next scan.
    start: Option<(Pose2, Symmetric3)>,
}

/// Minimum number of points of a scan that can be matched.
const MIN_POINTS_COUNT: usize = 12;
/// Without odometry, constant velocity is assumed below these speeds.
const MAX_STEADY_M_PER_S: f64 = 2.0;
const MAX_STEADY_RAD_PER_S: f64 = 2.5;
/// Minimum spacing of the beam ends stored for drawing, in cells.
const DRAWN_SPACING_RATIO: f32 = 0.6;
/// Gain of the running mean of the inlier ratio.
const INLIER_GAIN_RATIO: f64 = 0.05;
/// Initial inlier ratio.
const INITIAL_INLIER_RATIO: f64 = 0.7;
/// Path length equivalent of a rotation by one radian \[m\].
const ROTATION_ARM_M: f64 = 0.3;

/// Odometry of one step.
struct OdometryStep {
    seconds: f64,
    /// Motion since the last scan, if odometry is available and plausible.
    motion: Option<Pose2>,
    /// Distance of an implausible step, which is not used \[m\].
    jump_m: Option<f64>,
    trust: OdometryTrust,
}

impl Slam {
    /// Creates an empty map.
    #[must_use]
    pub fn new(settings: Settings) -> Self {
        Self {
            settings,
            keyframes: Vec::new(),
            nodes: Vec::new(),
            graph: Graph::default(),
            odometry_noise: OdometryNoise::default(),
            last: None,
            loops: Loops::default(),
            work: Work::default(),
            counts: Counts::default(),
            diagnostics: OdometryDiagnostics::default(),
            odometry_monitor: OdometryMonitor::default(),
            unmatched: UnmatchedRun::default(),
            live_audit: LiveAudit::default(),
            is_finished: false,
            component: 0,
            inlier_ratio: INITIAL_INLIER_RATIO,
            start: None,
        }
    }

    /// Adds a scan, with the odometry pose at its stamp if there is one, and returns the corrected pose.
    ///
    /// Runs at most [`Settings::slices_per_scan`] slices of background work.
    pub fn add_scan(&mut self, scan: &LaserScan2, odom_from_base: Option<Pose2>) -> Update {
        self.counts.scans += 1;
        if std::mem::take(&mut self.is_finished) && !self.settings.audits_live {
            self.live_audit = LiveAudit::default();
        }
        let odom_from_base = odom_from_base.filter(|pose| pose.is_finite());
        let revision = self.work.map_revision;
        let outcome = match fault(scan) {
            Some(reason) => ScanOutcome::Rejected(reason),
            None => self.process_scan(scan, odom_from_base),
        };
        match outcome {
            ScanOutcome::Inserted => self.counts.kept += 1,
            ScanOutcome::NoMatch => self.counts.lost += 1,
            ScanOutcome::Rejected(_) => self.counts.ignored += 1,
            ScanOutcome::BelowMotionThreshold => {}
        }
        self.work_slices(self.settings.slices_per_scan);
        let map_from_base = self.map_from_base();
        Update {
            outcome,
            map_from_base,
            map_from_odom: odom_from_base
                .map_or(Pose2::IDENTITY, |odom| (map_from_base * odom.inverse()).normalized()),
            is_map_revised: self.work.map_revision != revision,
        }
    }

    /// Processes a scan: predict, match, check for kidnapping, learn, decide on a keyframe, add constraints.
    fn process_scan(&mut self, scan: &LaserScan2, odom_from_base: Option<Pose2>) -> ScanOutcome {
        if let Some((pose, covariance)) = self.start.take() {
            return self.process_scan_at(scan, odom_from_base, pose, covariance);
        }
        if self.last.is_none() {
            return self.begin(scan, odom_from_base, odom_from_base.unwrap_or(Pose2::IDENTITY));
        }
        // 1. Predict the motion by odometry, unless odometry jumped or is stuck.
        let step = self.odometry_step(scan.time_ns, odom_from_base);
        // 2. Match the scan against the last keyframes, with odometry as the prior.
        let found = self.match_with_prior(scan, &step);
        // 3. A scan that matches nothing nearby begins a new component of the map.
        if self.is_kidnapped(&found, &step) {
            return self.begin_component(scan, odom_from_base, &found);
        }
        // 4. Learn the odometry noise and the usual inlier ratio.
        self.learn(scan.time_ns, &found);
        self.counts.lost += usize::from(found.is_matched && found.contradicts());
        // 5. After enough motion, insert a keyframe with a sequential constraint; queue the search for proximity
        //    constraints and loop closures.
        let is_keyframe = self.is_keyframe(&found);
        if is_keyframe {
            self.insert_keyframe(scan.time_ns, odom_from_base, &found);
        }
        self.record_pose(scan.time_ns, odom_from_base, &found, &step, is_keyframe);
        match (found.is_matched, is_keyframe) {
            (false, _) => ScanOutcome::NoMatch,
            (true, true) => ScanOutcome::Inserted,
            (true, false) => ScanOutcome::BelowMotionThreshold,
        }
    }

    /// Odometry since the last scan.
    fn odometry_step(&mut self, time_ns: i64, odom_from_base: Option<Pose2>) -> OdometryStep {
        let (last_ns, last_odom) =
            self.last.as_ref().map_or((time_ns, None), |last| (last.time_ns, last.odom_from_base));
        let seconds = time_ns.saturating_sub(last_ns) as f64 * 1e-9;
        let measured = match (last_odom, odom_from_base) {
            (Some(before), Some(now)) => Some((before.inverse() * now).normalized()),
            _ => None,
        };
        // Odometry that was reset or interrupted has no information about this step.
        let plausible = measured.filter(|step| self.odometry_noise.is_possible(*step, seconds));
        let jump = measured.filter(|_| plausible.is_none());
        let trust = self.odometry_monitor.update(odom_from_base);
        OdometryStep {
            seconds,
            motion: plausible.filter(|_| trust != OdometryTrust::None),
            jump_m: jump.map(|step| libm::hypot(step.x_m, step.y_m)),
            trust,
        }
    }

    /// Matches a scan with odometry as the prior; without it where odometry has never moved and the scan
    /// contradicts that.
    fn match_with_prior(&mut self, scan: &LaserScan2, step: &OdometryStep) -> ScanMatch {
        let mut found = self.match_scan(scan, step.motion, step.seconds);
        if step.trust == OdometryTrust::Unproved
            && step.motion.is_some()
            && !found.is_blank
            && OdometryMonitor::is_suspect(self.moved(&found), found.is_matched)
        {
            found = self.match_scan(scan, None, step.seconds);
        }
        if let Some(jump_m) = step.jump_m {
            self.diagnostics.remark(scan.time_ns, RemarkKind::OdometryJumped(jump_m));
        }
        found
    }

    /// Motion since the last scan as matched, in the frame of the base then.
    fn moved(&self, found: &ScanMatch) -> Pose2 {
        self.last.as_ref().map_or(Pose2::IDENTITY, |last| {
            (last.keyframe_from_base.inverse() * found.keyframe_from_base).normalized()
        })
    }

    fn learn(&mut self, time_ns: i64, found: &ScanMatch) {
        if !found.is_matched {
            return;
        }
        let moved = self.moved(found);
        self.inlier_ratio += INLIER_GAIN_RATIO * (found.matched - self.inlier_ratio);
        if let Some(kind) = self.odometry_monitor.observe(moved) {
            self.diagnostics.remark(time_ns, kind);
        }
        if found.odometry.is_some() && !found.is_still {
            self.odometry_noise.learn(found.motion, moved, found.is_doubted);
        }
    }

    /// True if the robot has moved enough for a keyframe and its pose is known by scans or odometry.
    fn is_keyframe(&self, found: &ScanMatch) -> bool {
        let (distance_m, rotation_rad) = apart(found.keyframe_from_base, Pose2::IDENTITY);
        !found.is_blank
            && (found.is_matched || found.odometry.is_some())
            && (distance_m > self.settings.keyframe_distance_m
                || rotation_rad > self.settings.keyframe_rotation_rad)
    }

    fn insert_keyframe(&mut self, time_ns: i64, odom_from_base: Option<Pose2>, found: &ScanMatch) {
        let Some(last) = self.last.as_ref().map(|last| last.keyframe) else { return };
        let keyframe_from_base = found.keyframe_from_base;
        let (distance_m, rotation_rad) = apart(keyframe_from_base, Pose2::IDENTITY);
        let path_m = distance_m + ROTATION_ARM_M * rotation_rad;
        let travel_m = self.keyframes[last].travel_m + path_m;
        let map_from_last = self.graph.poses[last];
        self.diagnostics.update(&Step {
            time_ns,
            // Odometry that was not used is no evidence against the scans.
            odom_from_base: odom_from_base.filter(|_| found.odometry.is_some()),
            keyframe_from_base,
            heading_rad: map_from_last.yaw_rad,
            is_matched: found.is_matched,
            firmness: found.firmness,
        });
        let new = self.graph.add_pose((map_from_last * keyframe_from_base).normalized());
        let drawn = drawn_ends(&found.ends, &self.settings);
        self.keyframes.push(Keyframe::new(&found.cloud, drawn, travel_m));
        let information = floored(&found.information);
        let sequential = ConstraintKind::Sequential;
        let edge = Edge::new((last, new), keyframe_from_base, information, sequential);
        self.graph.add_edge(edge.doubting(&floored(&found.doubted)));
        self.work.proximity.push_back(new);
        if self.settings.closes_loops {
            let is_torn = self.component > 0 && !self.disconnected().is_empty();
            self.loops.add_keyframe(&self.keyframes, &self.graph, self.work.proximity_m, is_torn);
        }
    }

    /// Stores the pose of the scan relative to the last keyframe, which may be the scan itself.
    fn record_pose(
        &mut self,
        time_ns: i64,
        odom_from_base: Option<Pose2>,
        found: &ScanMatch,
        step: &OdometryStep,
        is_keyframe: bool,
    ) {
        let Some(last) = self.last.as_ref() else { return };
        let motion = per_second(self.moved(found), step.seconds).filter(|it| {
            found.is_matched
                && libm::hypot(it.x_m, it.y_m) < MAX_STEADY_M_PER_S
                && it.yaw_rad.abs() < MAX_STEADY_RAD_PER_S
        });
        let (keyframe, keyframe_from_base) = if is_keyframe {
            (self.keyframes.len() - 1, Pose2::IDENTITY)
        } else {
            (last.keyframe, found.keyframe_from_base)
        };
        self.push_node(TrajectoryNode { time_ns, keyframe, keyframe_from_base });
        self.last = Some(Last {
            time_ns,
            odom_from_base,
            keyframe,
            keyframe_from_base,
            covariance: found.information.inverse().unwrap_or(found.covariance),
            motion,
        });
    }

    /// Appends a pose to the trajectory; replaces the last one where only the newest is asked for.
    fn push_node(&mut self, node: TrajectoryNode) {
        if let [.., before, last] = self.nodes.as_mut_slice()
            && !self.settings.keeps_each_pose
            && before.keyframe == last.keyframe
            && last.keyframe == node.keyframe
        {
            *last = node;
            return;
        }
        self.nodes.push(node);
    }

    /// Inserts the first scan: the map starts at the odometry pose, or at the pose set from outside.
    fn begin(
        &mut self,
        scan: &LaserScan2,
        odom_from_base: Option<Pose2>,
        start: Pose2,
    ) -> ScanOutcome {
        let ends = Ends::new(scan, None, self.settings.used_m());
        let cloud = ends.cloud(&self.settings.cloud);
        self.graph.add_pose(start.normalized());
        self.diagnostics.begin(odom_from_base);
        self.keyframes.push(Keyframe::new(&cloud, drawn_ends(&ends, &self.settings), 0.0));
        let keyframe_from_base = Pose2::IDENTITY;
        self.nodes.push(TrajectoryNode { time_ns: scan.time_ns, keyframe: 0, keyframe_from_base });
        self.last = Some(Last {
            time_ns: scan.time_ns,
            odom_from_base,
            keyframe: 0,
            keyframe_from_base,
            motion: None,
            covariance: Symmetric3::ZERO,
        });
        ScanOutcome::Inserted
    }
}

/// Beam ends stored for drawing, thinned to about one per cell; `None` where the cloud, whose points are as
/// dense, has all of them.
fn drawn_ends(ends: &Ends, settings: &Settings) -> Option<PackedPlaces> {
    let spacing_m = DRAWN_SPACING_RATIO * settings.resolution_m as f32;
    let count = ends.ends.iter().flatten().count();
    if count <= settings.cloud.most_points && settings.cloud.spacing_m <= spacing_m {
        return None;
    }
    let every = count.div_ceil(settings.drawn_beams.max(1)).max(1);
    let mut drawn: Vec<[f32; 2]> = Vec::new();
    for end in ends.ends.iter().flatten().step_by(every) {
        let is_near =
            |last: &[f32; 2]| libm::hypotf(end[0] - last[0], end[1] - last[1]) < spacing_m;
        if !drawn.last().is_some_and(is_near) {
            drawn.push(*end);
        }
    }
    Some(PackedPlaces::new(&drawn, ends.origin))
}
