//! Remarks: warnings and notices about a drive and its map.

/// A warning or notice.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// Time of detection: the stamp of a scan \[ns\].
    pub time_ns: i64,
    /// Subject.
    pub kind: RemarkKind,
}

/// Subject of a remark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RemarkKind {
    /// Ratio of the distance by odometry to the distance by scans.
    DistanceScale(f64),
    /// Ratio of the rotation by odometry to the rotation by scans, and the ratio of distances.
    RotationScale(f64, f64),
    /// Missing yaw of the scanner's transform, counterclockwise \[rad\].
    ScannerYaw(f64),
    /// Scans rotate opposite to odometry.
    ScanMirrored,
    /// Odometry translates and rotates opposite to the scans.
    OdometryReversed,
    /// `x` and `y` of odometry are swapped.
    OdometryAxesSwapped,
    /// `x` of odometry has the wrong sign.
    OdometryXNegated,
    /// `y` of odometry has the wrong sign.
    OdometryYNegated,
    /// Odometry and scans disagree for no reason above.
    OdometryInconsistent,
    /// Length of a corridor along which only odometry measures the distance \[m\].
    Corridor(f64),
    /// There is no odometry.
    NoOdometry,
    /// Odometry is constant while scans show this path \[m\].
    OdometryStuck(f64),
    /// Odometry jumped by this distance between two scans \[m\].
    OdometryJumped(f64),
    /// Fraction of the scans without a match.
    UnmatchedScans(f64),
    /// The robot was carried (kidnapped) or a part of the log is missing: a new map component begins.
    Kidnapped,
    /// Number of map components that no closure connects to the rest.
    Disconnected(usize),
    /// Two passes contradict each other around this position \[m\]; fraction of the points seen by both that
    /// agree.
    Contradiction(f64, f64, f64),
    /// Two passes show the same walls side by side around this position \[m\], this far apart \[m\].
    DoubledWalls(f64, f64, f64),
    /// The path around this position \[m\] fits two earlier positions equally well, this far apart \[m\].
    AmbiguousClosure(f64, f64, f64),
    /// Length of the path through mapped areas that no scan confirms, and of all such path \[m\].
    UnconfirmedPath(f64, f64),
    /// Number of distinct particle maps left after memory ran short.
    ParticlesReduced(usize),
    /// Number of consistent constraints of the graph that the best particle's map violates: all particles follow
    /// the graph's trajectory.
    GraphFollowed(usize),
}

impl Remark {
    /// True if the map may be wrong; other remarks are notices.
    #[must_use]
    pub const fn is_warning(&self) -> bool {
        match self.kind {
            RemarkKind::DistanceScale(_)
            | RemarkKind::RotationScale(..)
            | RemarkKind::Corridor(_)
            | RemarkKind::OdometryJumped(_)
            | RemarkKind::Kidnapped
            | RemarkKind::ParticlesReduced(_)
            | RemarkKind::GraphFollowed(_) => false,
            RemarkKind::ScannerYaw(_)
            | RemarkKind::ScanMirrored
            | RemarkKind::OdometryReversed
            | RemarkKind::OdometryAxesSwapped
            | RemarkKind::OdometryXNegated
            | RemarkKind::OdometryYNegated
            | RemarkKind::OdometryInconsistent
            | RemarkKind::NoOdometry
            | RemarkKind::OdometryStuck(_)
            | RemarkKind::UnmatchedScans(_)
            | RemarkKind::Disconnected(_)
            | RemarkKind::Contradiction(..)
            | RemarkKind::DoubledWalls(..)
            | RemarkKind::AmbiguousClosure(..)
            | RemarkKind::UnconfirmedPath(..) => true,
        }
    }
}

impl std::fmt::Display for Remark {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let more = |ratio: f64| {
            let percent = 100.0 * (ratio - 1.0).abs();
            format!("{percent:.1} % {}", if ratio > 1.0 { "more" } else { "less" })
        };
        match self.kind {
            RemarkKind::DistanceScale(ratio) => write!(
                f,
                "odometry reports {} distance than the scans: the wheel radius is about {:.3} times the value \
                 that the drive assumes",
                more(ratio),
                1.0 / ratio
            ),
            RemarkKind::RotationScale(ratio, distance) => write!(
                f,
                "odometry reports {} rotation than the scans: the wheel separation is about {:.3} times the \
                 value that the drive assumes",
                more(ratio),
                ratio / distance
            ),
            RemarkKind::ScannerYaw(yaw_rad) => write!(
                f,
                "the robot moves {:.0} degrees off the scanner's forward axis: the scanner's transform needs a \
                 yaw of {:+.0} degrees more, or odometry's x axis is not forward",
                yaw_rad.abs().to_degrees(),
                yaw_rad.to_degrees()
            ),
            RemarkKind::ScanMirrored => f.write_str(
                "scans rotate left when odometry rotates right: the scan is mirrored (the scanner is mounted \
                 upside down and its transform lacks the roll of 180 degrees), or odometry rotates with the \
                 wrong sign (left and right wheels swapped)",
            ),
            RemarkKind::OdometryReversed => f.write_str(
                "odometry moves backward when the scans move forward, and rotates the other way: both wheels \
                 have the wrong sign",
            ),
            RemarkKind::OdometryAxesSwapped => f.write_str("x and y of odometry are swapped"),
            RemarkKind::OdometryXNegated => f.write_str("x of odometry has the wrong sign"),
            RemarkKind::OdometryYNegated => f.write_str("y of odometry has the wrong sign"),
            RemarkKind::OdometryInconsistent => f.write_str(
                "odometry and scans disagree over a long path, and neither the wheel size nor the mounting of \
                 the scanner explains it: check for wheel slip, wrong time stamps, or constant odometry",
            ),
            RemarkKind::NoOdometry => f.write_str(
                "there is no odometry: the motion is estimated from scans alone, so that fast rotations, bare \
                 corridors and gaps in the log may be mapped wrongly",
            ),
            RemarkKind::OdometryStuck(path_m) => write!(
                f,
                "odometry is constant while scans show a path of {path_m:.1} m: it is ignored until it changes; \
                 check for a drive that does not publish, or a wrong topic"
            ),
            RemarkKind::OdometryJumped(distance_m) => write!(
                f,
                "odometry jumped by {distance_m:.1} m between two scans: this step is ignored"
            ),
            RemarkKind::UnmatchedScans(ratio) => write!(
                f,
                "{:.0} % of the scans match nothing in the map: do not rely on the map; check the scanner's \
                 transform, the time stamps, and spurious readings",
                100.0 * ratio
            ),
            RemarkKind::Kidnapped => f.write_str(
                "scans suddenly match nothing in the map: the robot was carried, or a part of the log is \
                 missing; a separate map component begins here, until a loop closure connects it to the rest",
            ),
            RemarkKind::Disconnected(1) => f.write_str(
                "no loop closure connects a component of the map to the rest: its pose is unknown",
            ),
            RemarkKind::Disconnected(count) => write!(
                f,
                "no loop closure connects {count} components of the map to the rest: their poses are unknown"
            ),
            RemarkKind::Contradiction(x_m, y_m, ratio) => write!(
                f,
                "two passes contradict each other around ({x_m:.1}, {y_m:.1}) in the map: only {:.0} % of the \
                 points seen by both agree; something has moved there, or the map is wrong",
                100.0 * ratio
            ),
            RemarkKind::DoubledWalls(x_m, y_m, shift_m) => write!(
                f,
                "two passes show the same walls {shift_m:.2} m apart around ({x_m:.1}, {y_m:.1}) in the map, and \
                 no reliable constraint joins them: walls are doubled there, and the map is off by as much"
            ),
            RemarkKind::AmbiguousClosure(x_m, y_m, apart_m) => write!(
                f,
                "the path around ({x_m:.1}, {y_m:.1}) in the map matches two earlier positions {apart_m:.1} m \
                 apart equally well, so that no loop is closed there: the map may be off by as much; drive past \
                 a feature that exists only once"
            ),
            RemarkKind::UnconfirmedPath(open_m, whole_m) => write!(
                f,
                "of {whole_m:.0} m of path through mapped areas, scans confirm nothing for {open_m:.0} m: the \
                 map may be off there; more beams, a longer range, lower speed, or driving there in the same \
                 direction give more evidence"
            ),
            RemarkKind::Corridor(path_m) => write!(
                f,
                "for {path_m:.0} m the walls look the same all along: only odometry measures the distance there"
            ),
            RemarkKind::ParticlesReduced(count) => write!(
                f,
                "the maps of all particles would need too much memory: the best {count} of them continue, each \
                 duplicated; fewer particles, a coarser `delta` or a shorter `maxUrange` need less"
            ),
            RemarkKind::GraphFollowed(count) => write!(
                f,
                "the best particle's map violates {count} loop constraints of the graph, and no two passes \
                 contradict each other in the graph's map: all particles follow the graph's trajectory; \
                 more `particles` may close these loops by themselves"
            ),
        }
    }
}
