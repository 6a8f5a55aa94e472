//! Transforms between frames over time, with the behaviour and the messages of tf2.

mod errors;
mod times;

use std::fmt::Write as _;
use std::sync::Mutex;

use numpy::PyUntypedArrayMethods as _;
use periplus::geometry::{DQuat, DVec3, Pose, Pose2};
use periplus::tf::{
    Buffer, FrameStatus, ResolvedTransform, StampedTransform, TransformKind, TransformLookup,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::arrays::{contiguous, moved, require_finite};
use crate::errors::value_error;
use crate::poses::{PyPose, pose_argument};
use crate::work::{guarded, lock, with_locked};
use errors::transform_error;

pub(crate) use times::{nanoseconds, seconds, time_argument, times_argument, whole_numbers};

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    errors::register(module)?;
    module.add_class::<TfBuffer>()
}

/// Number of lookups between two checks for Ctrl-C.
const LOOKUPS_PER_SLICE: usize = 4096;

/// Buffer of transforms between frames over time, as in tf2.
///
/// Parameters
/// ----------
/// cache_time_s : float
///     Time for which the samples of a frame are kept before its newest one [s].
///
/// Poses are ``parent_from_child``; a lookup returns ``target_from_source``, interpolated between the samples.
/// Times are seconds (``time_s``) or, exactly, nanoseconds (``time_ns``); a float holds a time of today to about
/// 0.2 us. As in tf2, time 0 is the latest common time of all frames in a chain. Safe to use from several threads.
///
/// >>> from periplus import TfBuffer
/// >>> buffer = TfBuffer()
/// >>> buffer.set_transform("odom", "base_link", (1.0, 0.0, 0.0), time_s=1.0)
/// >>> buffer.set_transform("odom", "base_link", (2.0, 0.0, 0.0), time_s=2.0)
/// >>> buffer.set_transform("base_link", "laser", (0.25, 0.0, 0.0), is_static=True)
/// >>> buffer.lookup("odom", "laser", time_s=1.5).x
/// 1.75
/// >>> print(buffer.tree(), end="")
/// odom
///   base_link
///     laser (static)
#[pyclass(frozen, module = "periplus")]
pub(crate) struct TfBuffer {
    buffer: Mutex<Buffer>,
    cache_ns: i64,
}

#[pymethods]
impl TfBuffer {
    #[new]
    #[pyo3(signature = (cache_time_s=10.0))]
    fn new(cache_time_s: f64) -> PyResult<Self> {
        let cache_ns = nanoseconds(cache_time_s, "cache_time_s")?;
        if cache_ns < 0 {
            return Err(PyValueError::new_err("`cache_time_s` must not be negative"));
        }
        Ok(Self { buffer: Mutex::new(Buffer::new(cache_ns)), cache_ns })
    }

    /// Time for which samples are kept [s].
    #[getter]
    fn cache_time_s(&self) -> f64 {
        seconds(self.cache_ns)
    }

    /// Adds a transform.
    ///
    /// Parameters
    /// ----------
    /// parent, child : str
    ///     Frames.
    /// pose : Pose
    ///     ``parent_from_child``; also (x, y, yaw) or (x, y, z, roll, pitch, yaw) [m, rad].
    /// time_s : float, optional
    ///     Time [s], 0 if not given; or ``time_ns`` [ns].
    /// is_static : bool
    ///     Valid at all times, as from ``/tf_static``.
    /// authority : str
    ///     Name of the publisher, for ``frames_yaml``.
    ///
    /// Raises ``ValueError`` with the name that tf2 logs, such as ``TF_SELF_TRANSFORM``, or ``TF_OLD_DATA`` for a
    /// time before all samples that are kept.
    #[pyo3(signature = (parent, child, pose, time_s=None, *, time_ns=None, is_static=false, authority="python"))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn set_transform(
        &self,
        parent: &str,
        child: &str,
        pose: &Bound<'_, PyAny>,
        time_s: Option<f64>,
        time_ns: Option<i64>,
        is_static: bool,
        authority: &str,
    ) -> PyResult<()> {
        let pose = pose_argument(pose, "pose")?;
        let stamp_ns = time_argument(time_s, time_ns)?.unwrap_or(0);
        let kind = if is_static { TransformKind::Fixed } else { TransformKind::Moving };
        let transform = StampedTransform::new(parent, child, stamp_ns, pose);
        guarded("TfBuffer.set_transform", || lock(&self.buffer).set(&transform, authority, kind))?
            .map_err(value_error)
    }

    /// Adds the transforms of a frame at several times.
    ///
    /// Parameters
    /// ----------
    /// parent, child : str
    ///     Frames.
    /// poses : array of shape (N, 7) or (N, 3)
    ///     ``parent_from_child``: x, y, z [m] and a unit quaternion (x, y, z, w); or x, y [m], yaw [rad].
    /// times_s : array of shape (N,), optional
    ///     Times [s]; or ``times_ns`` [ns], whole numbers.
    ///
    /// >>> import numpy as np
    /// >>> from periplus import TfBuffer
    /// >>> buffer = TfBuffer()
    /// >>> buffer.set_transforms("odom", "base", np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]), [1.0, 2.0])
    /// >>> buffer.lookup_many("odom", "base", [1.0, 1.25, 1.5])[:, 0].tolist()
    /// [0.0, 0.25, 0.5]
    ///
    /// Raises ``ValueError`` with the row that is rejected; the rows before it are in the buffer.
    #[pyo3(signature = (parent, child, poses, times_s=None, *, times_ns=None, authority="python"))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn set_transforms(
        &self,
        py: Python<'_>,
        parent: &str,
        child: &str,
        poses: &Bound<'_, PyAny>,
        times_s: Option<&Bound<'_, PyAny>>,
        times_ns: Option<&Bound<'_, PyAny>>,
        authority: &str,
    ) -> PyResult<()> {
        let times_ns = times_argument(times_s, times_ns)?;
        let array = contiguous::<f64>(poses, "poses")?;
        let width = match array.shape() {
            [_, width @ (3 | 7)] => *width,
            shape => {
                return Err(PyValueError::new_err(format!(
                    "`poses` must have the shape (N, 7) or (N, 3), not {shape:?}"
                )));
            }
        };
        let values = array.as_slice()?.to_vec();
        require_finite(&values, "poses")?;
        if values.len() != width * times_ns.len() {
            return Err(PyValueError::new_err(format!(
                "there are {} poses and {} times",
                values.len() / width,
                times_ns.len()
            )));
        }
        let result = with_locked(py, "TfBuffer.set_transforms", &self.buffer, |buffer| {
            for (row, (pose, stamp_ns)) in values.chunks_exact(width).zip(&times_ns).enumerate() {
                let pose = match *pose {
                    [x, y, yaw] => Pose::from(Pose2::new(x, y, yaw)),
                    // The quaternion stays as it is: the buffer rejects one that is not of unit length.
                    _ => Pose {
                        translation: DVec3::new(pose[0], pose[1], pose[2]),
                        rotation: DQuat::from_xyzw(pose[3], pose[4], pose[5], pose[6]),
                    },
                };
                let transform = StampedTransform::new(parent, child, *stamp_ns, pose);
                buffer
                    .set(&transform, authority, TransformKind::Moving)
                    .map_err(|error| format!("row {row}: {error}"))?;
            }
            Ok::<(), String>(())
        })?;
        result.map_err(value_error)
    }

    /// Returns ``target_from_source`` at a time.
    ///
    /// Parameters
    /// ----------
    /// target, source : str
    ///     Frames.
    /// time_s : float, optional
    ///     Time [s]; or ``time_ns`` [ns]. Without a time, or at 0: the latest common time.
    ///
    /// Raises a subclass of ``TransformError``: ``TransformLookupError`` for an unknown frame,
    /// ``TransformConnectivityError`` for frames in different trees, ``TransformExtrapolationError`` for a time
    /// without samples.
    #[pyo3(signature = (target, source, time_s=None, *, time_ns=None))]
    fn lookup(
        &self,
        target: &str,
        source: &str,
        time_s: Option<f64>,
        time_ns: Option<i64>,
    ) -> PyResult<PyPose> {
        let time_ns = time_argument(time_s, time_ns)?.unwrap_or(0);
        self.find(target, source, time_ns).map(|found| PyPose(found.target_from_source))
    }

    /// Returns ``target_from_source`` at many times.
    ///
    /// Parameters
    /// ----------
    /// target, source : str
    ///     Frames.
    /// times_s : array of shape (N,), optional
    ///     Times [s]; or ``times_ns`` [ns], whole numbers.
    /// missing : {"raise", "nan"}
    ///     Raise the error of the first time without a transform, or return a row of NaN for it. Unknown frames
    ///     raise in both cases.
    ///
    /// Returns
    /// -------
    /// array of shape (N, 7)
    ///     x, y, z [m] and the quaternion (x, y, z, w).
    #[pyo3(signature = (target, source, times_s=None, *, times_ns=None, missing="raise"))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn lookup_many<'py>(
        &self,
        py: Python<'py>,
        target: &str,
        source: &str,
        times_s: Option<&Bound<'py, PyAny>>,
        times_ns: Option<&Bound<'py, PyAny>>,
        missing: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let times_ns = times_argument(times_s, times_ns)?;
        let raises = match missing {
            "raise" => true,
            "nan" => false,
            other => {
                return Err(PyValueError::new_err(format!(
                    "`missing` must be \"raise\" or \"nan\", not {other:?}"
                )));
            }
        };
        let mut rows: Vec<f64> = Vec::with_capacity(7 * times_ns.len());
        for times_ns in times_ns.chunks(LOOKUPS_PER_SLICE) {
            let found = with_locked(py, "TfBuffer.lookup_many", &self.buffer, |buffer| {
                for &time_ns in times_ns {
                    match buffer.lookup(target, source, time_ns) {
                        Ok(found) => {
                            let Pose { translation, rotation } = found.target_from_source;
                            rows.extend(translation.to_array());
                            rows.extend(rotation.to_array());
                        }
                        Err(error) if raises || !error.kind.is_extrapolation() => {
                            return Err(error);
                        }
                        Err(_) => rows.extend([f64::NAN; 7]),
                    }
                }
                Ok(())
            })?;
            found.map_err(|error| transform_error(&error))?;
            py.check_signals()?;
        }
        let count = rows.len() / 7;
        Ok(moved(py, rows, &[count, 7])?.into_any())
    }

    /// Returns the pose of the source frame at one time in the target frame at another, through a frame that does
    /// not move in between. Times in seconds; 0 is the latest. Raises as ``lookup``.
    ///
    /// >>> from periplus import TfBuffer
    /// >>> buffer = TfBuffer()
    /// >>> buffer.set_transforms("odom", "base", [[1, 0, 0], [3, 0, 0]], [1.0, 2.0])
    /// >>> buffer.lookup_across("base", 2.0, "base", 1.0, "odom").x
    /// -2.0
    fn lookup_across(
        &self,
        target: &str,
        target_time_s: f64,
        source: &str,
        source_time_s: f64,
        fixed: &str,
    ) -> PyResult<PyPose> {
        let lookup = TransformLookup {
            target,
            target_time_ns: nanoseconds(target_time_s, "target_time_s")?,
            source,
            source_time_ns: nanoseconds(source_time_s, "source_time_s")?,
            fixed,
        };
        let found = guarded("TfBuffer.lookup_across", || lock(&self.buffer).lookup_across(lookup))?;
        found.map(|found| PyPose(found.target_from_source)).map_err(|error| transform_error(&error))
    }

    /// Returns the latest time at which ``lookup`` has data for all frames in the chain [s]; 0 if all are static.
    /// Raises as ``lookup``.
    fn latest_time(&self, target: &str, source: &str) -> PyResult<f64> {
        self.find(target, source, 0).map(|found| seconds(found.time_ns))
    }

    /// Returns the latest common time as ``latest_time``, in nanoseconds.
    fn latest_time_ns(&self, target: &str, source: &str) -> PyResult<i64> {
        self.find(target, source, 0).map(|found| found.time_ns)
    }

    /// Returns True if ``lookup`` would succeed.
    #[pyo3(signature = (target, source, time_s=None, *, time_ns=None))]
    fn can_transform(
        &self,
        target: &str,
        source: &str,
        time_s: Option<f64>,
        time_ns: Option<i64>,
    ) -> PyResult<bool> {
        let time_ns = time_argument(time_s, time_ns)?.unwrap_or(0);
        guarded("TfBuffer.can_transform", || {
            lock(&self.buffer).can_transform(target, source, time_ns).is_ok()
        })
    }

    /// Returns the names of all frames, in the order in which they were first named.
    fn frames(&self) -> Vec<String> {
        lock(&self.buffer).frames().map(str::to_owned).collect()
    }

    /// Returns the parent of a frame in its newest sample, or None.
    fn parent(&self, frame: &str) -> Option<String> {
        lock(&self.buffer).parent_of(frame).map(str::to_owned)
    }

    /// Returns the frames from the source up to the common ancestor and down to the target, or None if they are not
    /// connected.
    fn chain(&self, target: &str, source: &str) -> Option<Vec<String>> {
        let buffer = lock(&self.buffer);
        let chain = buffer.chain(target, source)?;
        Some(chain.into_iter().map(str::to_owned).collect())
    }

    /// Returns what is known of each frame with a parent: a list of dictionaries with ``frame``, ``parent``,
    /// ``authority``, ``is_static``, ``sample_count``, ``oldest_time_s``, ``newest_time_s`` and ``rate_hz``.
    fn frame_status<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        // Collected first: objects of Python are not made under the lock.
        let frames: Vec<_> = {
            let buffer = lock(&self.buffer);
            let owned = |it: FrameStatus<'_>| {
                let names = [it.name, it.parent, it.authority].map(str::to_owned);
                let is_static = it.kind == TransformKind::Fixed;
                (names, is_static, it.count, [it.oldest_ns, it.newest_ns], it.rate_hz())
            };
            buffer.kept_frames().map(owned).collect()
        };
        let rows = PyList::empty(py);
        for ([frame, parent, authority], is_static, count, times_ns, rate_hz) in frames {
            let row = PyDict::new(py);
            row.set_item("frame", frame)?;
            row.set_item("parent", parent)?;
            row.set_item("authority", authority)?;
            row.set_item("is_static", is_static)?;
            row.set_item("sample_count", count)?;
            row.set_item("oldest_time_s", seconds(times_ns[0]))?;
            row.set_item("newest_time_s", seconds(times_ns[1]))?;
            row.set_item("rate_hz", rate_hz)?;
            rows.append(row)?;
        }
        Ok(rows)
    }

    /// Returns the tree of frames as text: a line for each frame, indented below its parent.
    fn tree(&self) -> String {
        let buffer = lock(&self.buffer);
        let statics: Vec<&str> = buffer
            .kept_frames()
            .filter(|frame| frame.kind == TransformKind::Fixed)
            .map(|frame| frame.name)
            .collect();
        let names: Vec<&str> = buffer.frames().collect();
        let mut text = String::new();
        let mut written: Vec<&str> = Vec::new();
        // Frames of a loop have no root: they follow at the end.
        let roots = names.iter().filter(|name| buffer.parent_of(name).is_none());
        for start in roots.chain(&names) {
            let mut open = vec![(*start, 0)];
            while let Some((name, depth)) = open.pop() {
                if written.contains(&name) {
                    continue;
                }
                written.push(name);
                let kind = if statics.contains(&name) { " (static)" } else { "" };
                // Writing to a `String` cannot fail.
                let _ = writeln!(text, "{:1$}{name}{kind}", "", 2 * depth);
                let children =
                    names.iter().rev().filter(|child| buffer.parent_of(child) == Some(name));
                open.extend(children.map(|child| (*child, depth + 1)));
            }
        }
        text
    }

    /// Returns the answer of the service ``tf2_frames`` (``allFramesAsYAML`` of tf2).
    fn frames_yaml(&self) -> String {
        lock(&self.buffer).frames_yaml(None)
    }

    /// Drops all samples except static ones; the frames stay known.
    fn clear(&self) {
        lock(&self.buffer).clear();
    }

    fn __repr__(&self) -> String {
        let count = lock(&self.buffer).frames().count();
        format!("TfBuffer(cache_time_s={:?}) with {count} frames", seconds(self.cache_ns))
    }
}

impl TfBuffer {
    fn find(&self, target: &str, source: &str, time_ns: i64) -> PyResult<ResolvedTransform> {
        guarded("TfBuffer.lookup", || lock(&self.buffer).lookup(target, source, time_ns))?
            .map_err(|error| transform_error(&error))
    }
}
