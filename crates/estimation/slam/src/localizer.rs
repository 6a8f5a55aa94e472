//! Localization on a stored pose graph.

use std::collections::{BTreeMap, VecDeque};

use periplus_geometry::{LaserScan2, Pose2};
use periplus_scan_matching::{Cloud, Placed, Symmetric3};

use crate::engine::{Counts, ScanOutcome, Slam, Update};
use crate::local::{Group, apart, match_locally};
use crate::map::{MapSnapshot, Plan};
use crate::method::{Mapper, Method};
use crate::odometry_noise::OdometryNoise;
use crate::scan::{Ends, fault};

/// Scans of the stored graph, and of the robot's own memory, that a new one is laid onto.
const STORED_SCANS: usize = 6;
const RECENT_SCANS: usize = 2;
/// Scans this near look at the same things \[m\].
const REACH_M: f64 = 5.0;
/// Less motion than this since the scan before needs no search \[m, rad\].
const SEARCH_M: f64 = 0.1;
const SEARCH_RAD: f64 = 0.05;
/// Clouds of fewer points cannot be laid onto others.
const LEAST_POINTS: usize = 12;
/// Odometry that goes farther in one step than this, and faster than that, has jumped \[m, m/s\].
const JUMP_M: f64 = 4.0;
const FASTEST_M_S: f64 = 5.0;
/// Gain of the running mean of the inlier ratio.
const INLIER_MEAN_GAIN_RATIO: f64 = 0.05;
/// Poses that are remembered.
const MAX_POSE_COUNT: usize = 10_000;
/// Minimum and maximum uncertainty of the pose; a lost robot is searched within the maximum. One standard
/// deviation \[m, rad\].
const MIN_SIGMAS_M_RAD: [f64; 2] = [0.02, 0.01];
const MAX_SIGMAS_M_RAD: [f64; 2] = [1.0, 0.5];
/// Default uncertainty of an initial pose \[m, rad\].
const INITIAL_SIGMAS_M_RAD: [f64; 2] = [0.5, 0.26];

/// Finds the robot on a stored graph. The graph stays as it is; of what the robot sees itself it keeps
/// only the last few scans, so that it is found where the world has changed, and its memory does not
/// grow.
pub struct Localizer {
    stored: Slam,
    /// Stored scans by the square of [`REACH_M`] that they are in.
    squares: BTreeMap<(i64, i64), Vec<usize>>,
    own: VecDeque<Own>,
    most_own: usize,
    odometry_noise: OdometryNoise,
    last: Option<Last>,
    start: (Pose2, Symmetric3),
    poses: VecDeque<(i64, Pose2)>,
    counts: Counts,
    inlier_ratio: f64,
}

/// A scan of the robot's own memory.
struct Own {
    cloud: Cloud,
    map_from_keyframe: Pose2,
}

struct Last {
    time_ns: i64,
    odom_from_base: Option<Pose2>,
    map_from_base: Pose2,
    /// Along the axes of the map.
    covariance: Symmetric3,
}

fn square(pose: Pose2) -> (i64, i64) {
    ((pose.x_m / REACH_M).floor() as i64, (pose.y_m / REACH_M).floor() as i64)
}

fn spread([shift_m, turn_rad]: [f64; 2]) -> Symmetric3 {
    Symmetric3::diagonal(shift_m * shift_m, shift_m * shift_m, turn_rad * turn_rad)
}

impl Localizer {
    /// Creates a localizer on a stored graph that keeps its last `most_own` scans. It starts at the
    /// origin of the graph unless [`Localizer::place`] sets another pose.
    #[must_use]
    pub fn new(stored: Slam, most_own: usize) -> Self {
        let mut squares: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
        for (keyframe, &pose) in stored.poses().iter().enumerate() {
            squares.entry(square(pose)).or_default().push(keyframe);
        }
        let first = stored.poses().first().copied().unwrap_or(Pose2::IDENTITY);
        Self {
            stored,
            squares,
            own: VecDeque::new(),
            most_own,
            odometry_noise: OdometryNoise::default(),
            last: None,
            start: (first, spread(INITIAL_SIGMAS_M_RAD)),
            poses: VecDeque::new(),
            counts: Counts::default(),
            inlier_ratio: 0.7,
        }
    }

    /// Sets the pose of the robot with its covariance along the axes of the map: the next scan is matched
    /// around it. The localizer's own scans are dropped.
    pub fn place(&mut self, map_from_base: Pose2, covariance: Symmetric3) {
        if map_from_base.is_finite() {
            self.own.clear();
            self.last = None;
            self.start = (map_from_base.normalized(), covariance);
        }
    }

    /// Forgets what the robot has seen itself.
    pub fn forget(&mut self) {
        self.own.clear();
    }

    /// The stored graph.
    #[must_use]
    pub fn stored(&self) -> &Slam {
        &self.stored
    }

    /// Returns a snapshot of the stored map.
    #[must_use]
    pub fn snapshot(&self) -> MapSnapshot {
        self.stored.snapshot()
    }

    /// Number of the localizer's own scans in memory.
    #[must_use]
    pub fn own_scans(&self) -> usize {
        self.own.len()
    }

    /// Covariance of the pose along the axes of the map \[m, rad\].
    #[must_use]
    pub fn covariance(&self) -> Symmetric3 {
        self.last.as_ref().map_or(self.start.1, |last| last.covariance)
    }

    fn take(&mut self, scan: &LaserScan2, odom_from_base: Option<Pose2>) -> ScanOutcome {
        let settings = self.stored.settings();
        let seconds = self
            .last
            .as_ref()
            .map_or(0.0, |last| (scan.time_ns.saturating_sub(last.time_ns)) as f64 * 1e-9);
        let told = self.last.as_ref().and_then(|last| {
            let motion = (last.odom_from_base?.inverse() * odom_from_base?).normalized();
            let most_m = JUMP_M + FASTEST_M_S * seconds.max(0.0);
            (libm::hypot(motion.x_m, motion.y_m) < most_m).then_some(motion)
        });
        let (expected, covariance) = match &self.last {
            None => self.start,
            Some(last) => {
                let motion = told.unwrap_or(Pose2::IDENTITY);
                let spread = told.map_or_else(OdometryNoise::blind, |motion| {
                    self.odometry_noise.covariance(motion, 0.0)
                });
                let grown = last.covariance + spread.turned(last.map_from_base.yaw_rad);
                ((last.map_from_base * motion).normalized(), bounded(&grown))
            }
        };
        let motion = told
            .filter(|_| seconds > 0.0 && seconds < 1.0)
            .map(|it| Pose2::new(it.x_m / seconds, it.y_m / seconds, it.yaw_rad / seconds));
        let cloud = Ends::new(scan, motion, settings.used_m()).cloud(&settings.cloud);
        let mut next =
            Last { time_ns: scan.time_ns, odom_from_base, map_from_base: expected, covariance };
        let near = self.near(expected);
        let own = || {
            self.own
                .iter()
                .rev()
                .take(RECENT_SCANS)
                .filter(|own| apart(own.map_from_keyframe, expected).0 < REACH_M)
        };
        // In the frame of one scan numbers are small.
        let frame = near.first().map(|&keyframe| self.stored.poses()[keyframe]);
        let frame = frame.or_else(|| own().next().map(|own| own.map_from_keyframe));
        let mut outcome = ScanOutcome::NoMatch;
        if let Some(map_from_frame) = frame.filter(|_| cloud.points().len() >= LEAST_POINTS) {
            let frame_from = |pose: Pose2| (map_from_frame.inverse() * pose).normalized();
            let stored = near.iter().map(|&keyframe| {
                (self.stored.cloud(keyframe), frame_from(self.stored.poses()[keyframe]))
            });
            let stored = Group::new(stored);
            let mut group = stored.placed();
            group.extend(own().map(|own| Placed {
                cloud: &own.cloud,
                group_from_cloud: frame_from(own.map_from_keyframe),
            }));
            let moved = told.map(|it| (libm::hypot(it.x_m, it.y_m), it.yaw_rad.abs()));
            let searches = moved.is_none_or(|(m, rad)| m > SEARCH_M || rad > SEARCH_RAD);
            let turned = covariance.turned(-map_from_frame.yaw_rad);
            let expected = frame_from(expected);
            let found = match_locally(
                &cloud,
                &group,
                expected,
                &turned,
                settings,
                searches,
                self.inlier_ratio,
            );
            if found.is_matched {
                next.map_from_base = (map_from_frame * found.fit.target_from_moving).normalized();
                let known = found.information.inverse().unwrap_or(turned);
                next.covariance = bounded(&known.turned(map_from_frame.yaw_rad));
                self.inlier_ratio +=
                    INLIER_MEAN_GAIN_RATIO * (found.fit.matched - self.inlier_ratio);
                outcome = ScanOutcome::BelowMotionThreshold;
            }
        }
        if outcome == ScanOutcome::BelowMotionThreshold {
            if let (Some(motion), Some(last)) = (told, &self.last) {
                let moved = (last.map_from_base.inverse() * next.map_from_base).normalized();
                self.odometry_noise.learn(motion, moved, false);
            }
            let is_new = self.own.back().is_none_or(|own| {
                let (metres, radians) = apart(own.map_from_keyframe, next.map_from_base);
                metres > settings.keyframe_distance_m || radians > settings.keyframe_rotation_rad
            });
            if is_new && self.most_own > 0 {
                outcome = ScanOutcome::Inserted;
                self.own.push_back(Own { cloud, map_from_keyframe: next.map_from_base });
                while self.own.len() > self.most_own {
                    self.own.pop_front();
                }
            }
        }
        self.last = Some(next);
        outcome
    }

    /// Returns the stored keyframes near a pose, nearest first; a rotation adds to the distance.
    fn near(&self, place: Pose2) -> Vec<usize> {
        let (column, row) = square(place);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (column + dx, row + dy)));
        let keyframes = around.filter_map(|square| self.squares.get(&square)).flatten();
        let mut near: Vec<(f64, usize)> = keyframes
            .filter_map(|&keyframe| {
                let (metres, radians) = apart(self.stored.poses()[keyframe], place);
                (metres < REACH_M).then_some((metres + 0.6 * radians, keyframe))
            })
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near.truncate(STORED_SCANS);
        near.into_iter().map(|it| it.1).collect()
    }
}

/// A covariance between the least and the most that is believed.
fn bounded(covariance: &Symmetric3) -> Symmetric3 {
    let sum = *covariance + spread(MIN_SIGMAS_M_RAD);
    let most = spread(MAX_SIGMAS_M_RAD);
    if sum.largest_shift() > most.xx || sum.tt > most.tt { most } else { sum }
}

impl Mapper for Localizer {
    fn method(&self) -> Method {
        Method::Graph
    }

    fn add_scan(&mut self, scan: &LaserScan2, odom_from_base: Option<Pose2>) -> Update {
        self.counts.scans += 1;
        let odom_from_base = odom_from_base.filter(|pose| pose.is_finite());
        let outcome = match fault(scan) {
            Some(reason) => ScanOutcome::Rejected(reason),
            None => self.take(scan, odom_from_base),
        };
        match outcome {
            ScanOutcome::Inserted => self.counts.kept += 1,
            ScanOutcome::NoMatch => self.counts.lost += 1,
            ScanOutcome::Rejected(_) => self.counts.ignored += 1,
            ScanOutcome::BelowMotionThreshold => {}
        }
        let map_from_base = self.map_from_base();
        if !matches!(outcome, ScanOutcome::Rejected(_)) {
            self.poses.push_back((scan.time_ns, map_from_base));
            if self.poses.len() > MAX_POSE_COUNT {
                self.poses.pop_front();
            }
        }
        Update {
            outcome,
            map_from_base,
            map_from_odom: odom_from_base
                .map_or(Pose2::IDENTITY, |odom| (map_from_base * odom.inverse()).normalized()),
            is_map_revised: false,
        }
    }

    fn finish(&mut self) {}

    fn map_from_base(&self) -> Pose2 {
        self.last.as_ref().map_or(self.start.0, |last| last.map_from_base)
    }

    /// The last ten thousand.
    fn trajectory(&self) -> Vec<(i64, Pose2)> {
        self.poses.iter().copied().collect()
    }

    fn plan(&self) -> Option<Box<dyn Plan + '_>> {
        Some(Box::new(self.stored.snapshot().plan()?))
    }

    fn counts(&self) -> Counts {
        self.counts
    }

    fn size(&self) -> usize {
        let own: usize = self.own.iter().map(|own| own.cloud.size()).sum();
        self.stored.size() + own + self.poses.len() * size_of::<(i64, Pose2)>()
    }
}
