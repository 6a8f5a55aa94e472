//! Results of mapping as objects of Python.

use numpy::{PyArray1, PyArray2};
use periplus::geometry::Pose2;
use periplus::slam::{
    Closure, ConstraintKind, MapContradiction, Remark, RemarkKind, ScanOutcome, Slam, Update,
};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::arrays::moved;
use crate::poses::{PyPose, poses2_array};
use crate::transforms::seconds;

/// Result of processing a scan by ``Slam``.
///
/// >>> from periplus import LaserScanner, Slam
/// >>> slam = Slam(scanner=LaserScanner(-1.5, 0.1, range_max=10.0))
/// >>> update = slam.process([2.0] * 31, (0.0, 0.0, 0.0), time_s=0.0)
/// >>> update.outcome, update.is_keyframe
/// ('inserted', True)
#[pyclass(frozen, module = "periplus")]
pub(crate) struct SlamUpdate {
    outcome: &'static str,
    reason: Option<&'static str>,
    map_from_base: Pose2,
    map_from_odom: Pose2,
    is_map_revised: bool,
    remarks: Vec<SlamRemark>,
}

impl SlamUpdate {
    pub(super) fn of(update: &Update, remarks: Vec<SlamRemark>) -> Self {
        let (outcome, reason) = match update.outcome {
            ScanOutcome::Inserted => ("inserted", None),
            ScanOutcome::BelowMotionThreshold => ("below_motion_threshold", None),
            ScanOutcome::NoMatch => ("no_match", None),
            ScanOutcome::Rejected(reason) => ("rejected", Some(reason)),
        };
        Self {
            outcome,
            reason,
            map_from_base: update.map_from_base,
            map_from_odom: update.map_from_odom,
            is_map_revised: update.is_map_revised,
            remarks,
        }
    }

    pub(super) fn skipped(map_from_base: Pose2, map_from_odom: Pose2) -> Self {
        let (outcome, reason) = ("skipped", Some("only every Nth scan is used: `throttle_scans`"));
        let (is_map_revised, remarks) = (false, Vec::new());
        Self { outcome, reason, map_from_base, map_from_odom, is_map_revised, remarks }
    }
}

#[pymethods]
impl SlamUpdate {
    /// ``"inserted"`` as a keyframe, ``"below_motion_threshold"`` (matched, but too near to the last keyframe),
    /// ``"no_match"`` (the pose is the one predicted by odometry), ``"rejected"``, or ``"skipped"`` by
    /// ``throttle_scans``.
    #[getter]
    fn outcome(&self) -> &'static str {
        self.outcome
    }

    /// Reason of a rejected or skipped scan, or None.
    #[getter]
    fn reason(&self) -> Option<&'static str> {
        self.reason
    }

    /// True if the scan is part of the map.
    #[getter]
    fn is_keyframe(&self) -> bool {
        self.outcome == "inserted"
    }

    /// Pose of the robot in the map.
    #[getter]
    fn map_from_base(&self) -> PyPose {
        PyPose(self.map_from_base.into())
    }

    /// Correction of odometry, as published in ``/tf``; the identity without odometry.
    #[getter]
    fn map_from_odom(&self) -> PyPose {
        PyPose(self.map_from_odom.into())
    }

    /// True if poses of earlier keyframes have changed, as after a loop closure.
    #[getter]
    fn is_map_revised(&self) -> bool {
        self.is_map_revised
    }

    /// Warnings and notices since the update before.
    #[getter]
    fn remarks(&self) -> Vec<SlamRemark> {
        self.remarks.clone()
    }

    fn __repr__(&self) -> String {
        let Pose2 { x_m, y_m, yaw_rad } = self.map_from_base;
        format!("SlamUpdate({:?} at x={x_m:?}, y={y_m:?}, yaw={yaw_rad:?})", self.outcome)
    }
}

/// Warning or notice about a drive and its map.
///
/// >>> from periplus import LaserScanner, Slam
/// >>> slam = Slam(scanner=LaserScanner(-1.5, 0.1, range_max=10.0))
/// >>> for step in range(2):
/// ...     _ = slam.process([2.0] * 31, time_s=0.1 * step)
/// >>> slam.finish()
/// >>> [remark.kind for remark in slam.remarks]
/// ['no_odometry']
#[pyclass(frozen, module = "periplus", eq)]
#[derive(Clone, PartialEq)]
pub(crate) struct SlamRemark(pub(super) Remark);

#[pymethods]
impl SlamRemark {
    /// Subject, such as ``"contradiction"``, ``"scanner_yaw"``, ``"odometry_jumped"``.
    #[getter]
    fn kind(&self) -> &'static str {
        self.parts().0
    }

    /// Numbers of the subject by name; lengths end with ``_m``, angles with ``_rad``.
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let values = PyDict::new(py);
        for (name, value) in self.parts().1 {
            values.set_item(name, value)?;
        }
        Ok(values)
    }

    /// Position in the map (x, y) [m], or None if the remark has none.
    #[getter]
    fn position(&self) -> Option<(f64, f64)> {
        match self.0.kind {
            RemarkKind::Contradiction(x_m, y_m, _)
            | RemarkKind::DoubledWalls(x_m, y_m, _)
            | RemarkKind::AmbiguousClosure(x_m, y_m, _) => Some((x_m, y_m)),
            _ => None,
        }
    }

    /// Time of detection: that of a scan [s].
    #[getter]
    fn time_s(&self) -> f64 {
        seconds(self.0.time_ns)
    }

    /// Time of detection [ns].
    #[getter]
    fn time_ns(&self) -> i64 {
        self.0.time_ns
    }

    /// True if the map may be wrong; other remarks are notices.
    #[getter]
    fn is_warning(&self) -> bool {
        self.0.is_warning()
    }

    /// The remark as a sentence.
    #[getter]
    fn text(&self) -> String {
        self.0.to_string()
    }

    fn __str__(&self) -> String {
        self.0.to_string()
    }

    fn __repr__(&self) -> String {
        format!("SlamRemark({:?}, time_s={:?})", self.kind(), self.time_s())
    }
}

type Values = Vec<(&'static str, f64)>;

impl SlamRemark {
    fn parts(&self) -> (&'static str, Values) {
        let count = |count: usize| vec![("count", count as f64)];
        match self.0.kind {
            RemarkKind::DistanceScale(ratio) => ("distance_scale", vec![("ratio", ratio)]),
            RemarkKind::RotationScale(ratio, distance_ratio) => {
                ("rotation_scale", vec![("ratio", ratio), ("distance_ratio", distance_ratio)])
            }
            RemarkKind::ScannerYaw(yaw_rad) => ("scanner_yaw", vec![("yaw_rad", yaw_rad)]),
            RemarkKind::ScanMirrored => ("scan_mirrored", Vec::new()),
            RemarkKind::OdometryReversed => ("odometry_reversed", Vec::new()),
            RemarkKind::OdometryAxesSwapped => ("odometry_axes_swapped", Vec::new()),
            RemarkKind::OdometryXNegated => ("odometry_x_negated", Vec::new()),
            RemarkKind::OdometryYNegated => ("odometry_y_negated", Vec::new()),
            RemarkKind::OdometryInconsistent => ("odometry_inconsistent", Vec::new()),
            RemarkKind::Corridor(path_m) => ("corridor", vec![("path_m", path_m)]),
            RemarkKind::NoOdometry => ("no_odometry", Vec::new()),
            RemarkKind::OdometryStuck(path_m) => ("odometry_stuck", vec![("path_m", path_m)]),
            RemarkKind::OdometryJumped(distance_m) => {
                ("odometry_jumped", vec![("distance_m", distance_m)])
            }
            RemarkKind::UnmatchedScans(ratio) => ("unmatched_scans", vec![("ratio", ratio)]),
            RemarkKind::Kidnapped => ("kidnapped", Vec::new()),
            RemarkKind::Disconnected(components) => ("disconnected", count(components)),
            RemarkKind::Contradiction(x_m, y_m, agreeing_ratio) => (
                "contradiction",
                vec![("x_m", x_m), ("y_m", y_m), ("agreeing_ratio", agreeing_ratio)],
            ),
            RemarkKind::DoubledWalls(x_m, y_m, distance_m) => {
                ("doubled_walls", vec![("x_m", x_m), ("y_m", y_m), ("distance_m", distance_m)])
            }
            RemarkKind::AmbiguousClosure(x_m, y_m, distance_m) => {
                ("ambiguous_closure", vec![("x_m", x_m), ("y_m", y_m), ("distance_m", distance_m)])
            }
            RemarkKind::UnconfirmedPath(path_m, mapped_path_m) => {
                ("unconfirmed_path", vec![("path_m", path_m), ("mapped_path_m", mapped_path_m)])
            }
            RemarkKind::ParticlesReduced(maps) => ("particles_reduced", count(maps)),
            RemarkKind::GraphFollowed(constraints) => ("graph_followed", count(constraints)),
        }
    }
}

/// Keyframes and constraints of a map as arrays.
///
/// >>> from periplus import LaserScanner, Slam
/// >>> slam = Slam(scanner=LaserScanner(-1.5, 0.1, range_max=10.0))
/// >>> _ = slam.process([2.0] * 31, (0.0, 0.0, 0.0), time_s=0.0)
/// >>> graph = slam.graph()
/// >>> graph.poses.shape, graph.edges.shape
/// ((1, 3), (0, 2))
#[pyclass(frozen, module = "periplus")]
pub(crate) struct PoseGraph {
    poses: Vec<Pose2>,
    times_ns: Vec<i64>,
    edges: Vec<(usize, usize)>,
    kinds: Vec<&'static str>,
    residuals: Vec<[f64; 2]>,
    chi2: f64,
}

impl PoseGraph {
    pub(super) fn of(slam: &Slam) -> Self {
        let trajectory = slam.trajectory();
        let kept = slam.kept();
        let edges: Vec<_> = slam.edges().collect();
        Self {
            poses: slam.poses().to_vec(),
            times_ns: kept.iter().filter_map(|at| Some(trajectory.get(*at)?.0)).collect(),
            kinds: edges.iter().map(|it| kind(it.link)).collect(),
            residuals: edges.iter().map(|it| [it.residual_m, it.residual_rad]).collect(),
            edges: edges.into_iter().map(|it| it.keyframes).collect(),
            chi2: slam.chi2(),
        }
    }
}

const fn kind(link: ConstraintKind) -> &'static str {
    match link {
        ConstraintKind::Sequential => "sequential",
        ConstraintKind::Proximity => "proximity",
        ConstraintKind::LoopClosure => "loop_closure",
    }
}

#[pymethods]
impl PoseGraph {
    /// Poses of the keyframes in the map, shape (K, 3): x, y [m], yaw [rad].
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        poses2_array(py, &self.poses)
    }

    /// Times of the keyframes, shape (K,) [s].
    #[getter]
    fn times_s<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.times_ns.iter().map(|it| seconds(*it)))
    }

    /// Constraints between keyframes, shape (E, 2), int64: from, to.
    #[getter]
    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let flat: Vec<i64> =
            self.edges.iter().flat_map(|(from, to)| [*from as i64, *to as i64]).collect();
        Ok(moved(py, flat, &[self.edges.len(), 2])?.into_any())
    }

    /// Origin of each constraint: ``"sequential"``, ``"proximity"`` or ``"loop_closure"``.
    #[getter]
    fn kinds(&self) -> Vec<&'static str> {
        self.kinds.clone()
    }

    /// Difference between the constrained and the optimized pose of the second keyframe, shape (E, 2): distance [m],
    /// angle [rad].
    #[getter]
    fn residuals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(moved(py, self.residuals.concat(), &[self.residuals.len(), 2])?.into_any())
    }

    /// Sum of the squared Mahalanobis distances of the constraints.
    #[getter]
    fn chi2(&self) -> f64 {
        self.chi2
    }

    fn __repr__(&self) -> String {
        format!("PoseGraph({} keyframes, {} edges)", self.poses.len(), self.edges.len())
    }
}

pub(super) fn contradictions<'py>(
    py: Python<'py>,
    found: &[MapContradiction],
) -> PyResult<Bound<'py, PyList>> {
    let rows = PyList::empty(py);
    for it in found {
        let row = PyDict::new(py);
        let times_s = |(first, last): (i64, i64)| (seconds(first), seconds(last));
        row.set_item("position", (it.map_from_base.x_m, it.map_from_base.y_m))?;
        row.set_item("agreeing_ratio", it.agreeing_ratio)?;
        row.set_item("keyframes", it.keyframes)?;
        row.set_item("times_s", times_s(it.times_ns))?;
        row.set_item("earlier_keyframes", it.earlier_keyframes)?;
        row.set_item("earlier_times_s", times_s(it.earlier_times_ns))?;
        rows.append(row)?;
    }
    Ok(rows)
}

pub(super) fn closures<'py>(py: Python<'py>, found: &[Closure]) -> PyResult<Bound<'py, PyList>> {
    let rows = PyList::empty(py);
    for it in found {
        let row = PyDict::new(py);
        row.set_item("keyframes", it.keyframes)?;
        row.set_item("old_from_new", PyPose(it.old_from_new.into()))?;
        row.set_item("is_accepted", it.is_accepted)?;
        row.set_item("region_m", it.region_m)?;
        row.set_item("agreeing_ratio", it.agreeing)?;
        row.set_item("reason", &it.reason)?;
        rows.append(row)?;
    }
    Ok(rows)
}
