//! Bags.

mod carmen;
mod columns;
mod iterate;
mod prefetch;
mod source;
mod write;

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use periplus::bags::files::{Bag, BagError, Conversion, convert};
use periplus::diagnostics::SourceMap;
use pyo3::exceptions::{PyFileExistsError, PyOSError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString};

use crate::errors::{file_error, require_file};
use crate::robot_files::{PyFinding, findings_of};
use crate::work::released;
use iterate::PyBagMessages;
use source::{Source, TopicData, Wanted};

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyBag>()?;
    module.add_class::<PyBagTopic>()?;
    module.add_class::<PyBagMessages>()?;
    module.add_class::<write::PyBagWriter>()?;
    module.add_function(wrap_pyfunction!(open_bag, module)?)?;
    module.add_function(wrap_pyfunction!(check_bag, module)?)?;
    module.add_function(wrap_pyfunction!(convert_bag, module)?)?;
    Ok(())
}

/// Error of a bag as an exception.
fn bag_error(py: Python<'_>, path: &Path, error: &BagError) -> PyErr {
    match error {
        BagError::File(path, error) => match error.kind() {
            std::io::ErrorKind::NotFound => match require_file(path) {
                Err(error) => error,
                Ok(()) => PyOSError::new_err(format!("{}: {error}", path.display())),
            },
            _ => PyOSError::new_err(format!("{}: {error}", path.display())),
        },
        BagError::Exists(_) => PyFileExistsError::new_err(error.to_string()),
        BagError::Settings(_) => PyValueError::new_err(error.to_string()),
        _ => file_error(py, path, error),
    }
}

/// Recording of messages: an MCAP file, a ``ros2 bag`` folder (MCAP or sqlite3), a ROS 1 bag or a CARMEN log.
///
/// Made by :func:`open_bag`. Iteration gives ``(topic, message, time_ns)`` in the order of time; every loop starts
/// again at the first message. Damaged parts are skipped and reported in :attr:`findings` and :attr:`faults`.
///
/// >>> import periplus, tempfile
/// >>> from periplus.msgs.std_msgs.msg import String
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     with periplus.BagWriter(f"{folder}/run.mcap") as writer:
/// ...         writer.write("/chatter", String(data="hi"), 20_000_000)
/// ...     bag = periplus.open_bag(f"{folder}/run.mcap")
/// ...     [(topic.name, topic.type_name, topic.count) for topic in bag.topics]
/// [('/chatter', 'std_msgs/msg/String', 1)]
#[pyclass(name = "Bag", module = "periplus", frozen)]
pub(crate) struct PyBag {
    source: Arc<Source>,
    wanted: Wanted,
    raw: bool,
    faults: Arc<Mutex<Vec<String>>>,
}

/// Topic of a bag.
///
/// >>> import periplus, tempfile
/// >>> from periplus.msgs.std_msgs.msg import String
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     with periplus.BagWriter(f"{folder}/run.mcap") as writer:
/// ...         writer.write("/chatter", String(data="hi"), 0)
/// ...     periplus.open_bag(f"{folder}/run.mcap").topics
/// [BagTopic('/chatter', 'std_msgs/msg/String', count=1)]
#[pyclass(name = "BagTopic", module = "periplus", frozen)]
pub(crate) struct PyBagTopic(TopicData);

#[pymethods]
impl PyBagTopic {
    /// Full name.
    #[getter]
    fn name(&self) -> &str {
        &self.0.topic.name
    }

    /// Name of the type of its messages, such as ``sensor_msgs/msg/LaserScan``.
    #[getter]
    fn type_name(&self) -> &str {
        &self.0.topic.type_name
    }

    /// Number of messages in the bag.
    #[getter]
    fn count(&self) -> u64 {
        self.0.count
    }

    /// Encoding of the messages: ``cdr`` (ROS 2), ``ros1``, ``json`` and others.
    #[getter]
    fn encoding(&self) -> &str {
        &self.0.topic.encoding
    }

    /// Definition of the type; empty if the bag has none.
    #[getter]
    fn schema(&self) -> String {
        String::from_utf8_lossy(&self.0.topic.schema).into_owned()
    }

    /// Other data of the topic, such as ``latching`` of ROS 1.
    #[getter]
    fn metadata(&self) -> std::collections::BTreeMap<String, String> {
        self.0.topic.metadata.clone()
    }

    /// QoS of each publisher: ``history``, ``depth``, ``reliability``, ``durability``, ``liveliness`` and, if
    /// limited, ``deadline_ns``, ``lifespan_ns``, ``lease_ns``.
    #[getter]
    fn qos<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        self.0.topic.offered_qos().iter().map(|qos| write::qos_dict(py, qos)).collect()
    }

    /// True if the messages can be decoded.
    #[getter]
    fn is_known(&self) -> bool {
        self.0.plan.is_ok()
    }

    fn __repr__(&self) -> String {
        let topic = &self.0.topic;
        format!("BagTopic('{}', '{}', count={})", topic.name, topic.type_name, self.0.count)
    }
}

#[pymethods]
impl PyBag {
    /// Path of the bag.
    #[getter]
    fn path(&self) -> PathBuf {
        self.source.path().to_owned()
    }

    /// Topics with their types, numbers of messages and QoS, sorted by name: a list of :class:`BagTopic`.
    #[getter]
    fn topics(&self) -> Vec<PyBagTopic> {
        let mut topics: Vec<&TopicData> = self.source.topics().iter().collect();
        topics.sort_by(|a, b| {
            (&a.topic.name, &a.topic.type_name).cmp(&(&b.topic.name, &b.topic.type_name))
        });
        topics.into_iter().map(|topic| PyBagTopic(topic.clone())).collect()
    }

    /// Time of the first message [ns]; None without messages.
    #[getter]
    fn start_ns(&self) -> Option<i64> {
        self.source.span_ns().map(|span| span.0)
    }

    /// Time of the last message [ns]; None without messages.
    #[getter]
    fn end_ns(&self) -> Option<i64> {
        self.source.span_ns().map(|span| span.1)
    }

    /// Time from the first message to the last [s].
    #[getter]
    fn duration_s(&self) -> f64 {
        let (start, end) = self.source.span_ns().unwrap_or_default();
        end.saturating_sub(start) as f64 * 1e-9
    }

    /// Number of all messages of the bag.
    #[getter]
    fn message_count(&self) -> u64 {
        self.source.topics().iter().map(|topic| topic.count).sum()
    }

    /// Size of the files [bytes].
    #[getter]
    fn size_bytes(&self) -> u64 {
        self.source.bytes()
    }

    /// Format of the files: ``mcap``, ``sqlite3``, ``rosbag`` (ROS 1) or ``carmen``.
    #[getter]
    fn storage(&self) -> &'static str {
        self.source.storage()
    }

    /// Paths of the files.
    #[getter]
    fn files(&self) -> Vec<PathBuf> {
        self.source.files()
    }

    /// False if a file was not closed properly, for example after a crash of the program that recorded it.
    #[getter]
    fn is_complete(&self) -> bool {
        self.source.is_whole()
    }

    /// Problems found when the bag was opened: a list of :class:`Finding`.
    #[getter]
    fn findings(&self) -> Vec<PyFinding> {
        self.source.findings()
    }

    /// Descriptions of damaged parts and messages that loops over this bag have skipped so far.
    #[getter]
    fn faults(&self) -> Vec<String> {
        crate::work::lock(&self.faults).clone()
    }

    fn __iter__(&self, py: Python<'_>) -> PyResult<PyBagMessages> {
        self.start(py, self.wanted.clone(), self.raw)
    }

    /// Iterates over some of the messages.
    ///
    /// Parameters
    /// ----------
    /// topics : str or list of str, optional
    ///     Topics; default: those of :func:`open_bag`.
    /// start, end : int, optional
    ///     Times of the first and last message [ns].
    /// raw : bool, optional
    ///     True for the serialized bytes in place of messages.
    ///
    /// Raises ``ValueError`` for a topic that the bag does not have.
    #[pyo3(signature = (topics=None, *, start=None, end=None, raw=None))]
    fn messages(
        &self,
        py: Python<'_>,
        topics: Option<&Bound<'_, PyAny>>,
        start: Option<i64>,
        end: Option<i64>,
        raw: Option<bool>,
    ) -> PyResult<PyBagMessages> {
        let wanted = self.narrowed(topics, start, end)?;
        self.start(py, wanted, raw.unwrap_or(self.raw))
    }

    /// Fields of all messages of a topic as arrays over time.
    ///
    /// Parameters
    /// ----------
    /// topic : str
    ///     Topic.
    /// fields : list of str, optional
    ///     Paths of fields, such as ``pose.pose.position.x``, ``ranges``, ``ranges[0]`` or
    ///     ``transforms[0].transform.translation.x``. A path of a time, such as ``header.stamp``, gives
    ///     nanoseconds. Default: all fields that are not within lists of messages.
    ///
    /// Returns
    /// -------
    /// dict of str to numpy.ndarray
    ///     ``time_ns`` (time of recording [ns], int64) and one array for each field, of the type of the field.
    ///     Fields that are arrays are stacked to the shape (messages, length) if all have the same length;
    ///     otherwise the array contains one array for each message. Texts are arrays of objects.
    ///
    /// Raises ``ValueError`` for an unknown topic or field, or an index that a message does not have.
    ///
    /// >>> import periplus, tempfile
    /// >>> from periplus.msgs.geometry_msgs.msg import Point
    /// >>> with tempfile.TemporaryDirectory() as folder:
    /// ...     with periplus.BagWriter(f"{folder}/run.mcap") as writer:
    /// ...         for i in range(3):
    /// ...             writer.write("/point", Point(x=i), i * 1_000_000_000)
    /// ...     periplus.open_bag(f"{folder}/run.mcap").to_numpy("/point", ["x"])
    /// {'time_ns': array([         0, 1000000000, 2000000000]), 'x': array([0., 1., 2.])}
    #[pyo3(signature = (topic, fields=None))]
    fn to_numpy<'py>(
        &self,
        py: Python<'py>,
        topic: &Bound<'py, PyString>,
        fields: Option<Vec<String>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let wanted = self.narrowed(Some(topic.as_any()), None, None)?;
        columns::to_numpy(py, self.source.clone(), wanted, topic.to_str()?, fields)
    }

    /// Fields of all messages of a topic as a pandas DataFrame, as for :meth:`to_numpy`.
    ///
    /// Raises ``ImportError`` if pandas is not installed.
    #[pyo3(signature = (topic, fields=None))]
    fn to_pandas<'py>(
        &self,
        py: Python<'py>,
        topic: &Bound<'py, PyString>,
        fields: Option<Vec<String>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let tables = py.import("periplus._tables")?;
        tables.call_method0("require_pandas")?;
        tables.call_method1("to_pandas", (self.to_numpy(py, topic, fields)?,))
    }

    /// Fields of all messages of a topic as a polars DataFrame, as for :meth:`to_numpy`.
    ///
    /// Raises ``ImportError`` if polars is not installed.
    #[pyo3(signature = (topic, fields=None))]
    fn to_polars<'py>(
        &self,
        py: Python<'py>,
        topic: &Bound<'py, PyString>,
        fields: Option<Vec<String>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let tables = py.import("periplus._tables")?;
        tables.call_method0("require_polars")?;
        tables.call_method1("to_polars", (self.to_numpy(py, topic, fields)?,))
    }

    fn __repr__(&self) -> String {
        format!(
            "Bag('{}', {} messages, {:.3} s)",
            self.source.path().display(),
            self.message_count(),
            self.duration_s()
        )
    }
}

impl PyBag {
    fn start(&self, py: Python<'_>, wanted: Wanted, raw: bool) -> PyResult<PyBagMessages> {
        PyBagMessages::new(py, self.source.clone(), &wanted, raw, self.faults.clone())
    }

    fn narrowed(
        &self,
        topics: Option<&Bound<'_, PyAny>>,
        start: Option<i64>,
        end: Option<i64>,
    ) -> PyResult<Wanted> {
        let mut wanted = Wanted::new(&self.source, topics, start, end)?;
        if topics.is_none() {
            wanted.topics.clone_from(&self.wanted.topics);
        }
        wanted.start_ns = wanted.start_ns.max(self.wanted.start_ns);
        wanted.end_ns = wanted.end_ns.min(self.wanted.end_ns);
        Ok(wanted)
    }
}

/// Opens a recording of any kind: MCAP, ``ros2 bag`` folders (MCAP, sqlite3), ROS 1 bags, CARMEN logs; also
/// compressed, split or damaged ones.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     File or folder.
/// topics : str or list of str, optional
///     Topics to read; default: all.
/// start, end : int, optional
///     Times of the first and last message to read [ns]; default: all.
/// raw : bool, optional
///     True for the serialized bytes in place of messages (default False).
///
/// Returns
/// -------
/// Bag
///     Iteration gives ``(topic, message, time_ns)``: name of the topic, message object, and time of recording
///     as an integer [ns], in the order of time.
///
/// Raises ``FileNotFoundError`` if there is no such file, ``FileError`` if it is no recording, and ``ValueError``
/// for a topic that the bag does not have.
///
/// >>> import periplus, tempfile
/// >>> from periplus.msgs.std_msgs.msg import String
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     with periplus.BagWriter(f"{folder}/run.mcap") as writer:
/// ...         writer.write("/chatter", String(data="hi"), 20_000_000)
/// ...     for topic, message, time_ns in periplus.open_bag(f"{folder}/run.mcap"):
/// ...         print(topic, message.data, time_ns)
/// /chatter hi 20000000
#[pyfunction]
#[pyo3(signature = (path, topics=None, start=None, end=None, *, raw=false))]
fn open_bag(
    py: Python<'_>,
    path: PathBuf,
    topics: Option<&Bound<'_, PyAny>>,
    start: Option<i64>,
    end: Option<i64>,
    raw: bool,
) -> PyResult<PyBag> {
    let source = Arc::new(open(py, &path)?);
    let wanted = Wanted::new(&source, topics, start, end)?;
    Ok(PyBag { source, wanted, raw, faults: Arc::new(Mutex::new(Vec::new())) })
}

fn open(py: Python<'_>, path: &Path) -> PyResult<Source> {
    require_file(path)?;
    released(py, "opening the bag", || Source::open(path))?
        .map_err(|error| bag_error(py, path, &error))
}

/// Checks a recording: checksums, indexes and metadata, and decodes every message.
///
/// Returns a list of :class:`Finding`, which is empty for a sound bag. Raises ``FileNotFoundError`` if there is no
/// such file and ``FileError`` if it is no recording.
///
/// >>> import periplus, tempfile
/// >>> from periplus.msgs.std_msgs.msg import String
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     with periplus.BagWriter(f"{folder}/run.mcap") as writer:
/// ...         writer.write("/chatter", String(data="hi"), 0)
/// ...     periplus.check_bag(f"{folder}/run.mcap")
/// []
#[pyfunction]
fn check_bag(py: Python<'_>, path: PathBuf) -> PyResult<Vec<PyFinding>> {
    let source = open(py, &path)?;
    let mut findings = source.findings();
    let Some(bag) = source.bag() else { return Ok(findings) };
    let checked = interruptible(py, "checking the bag", |progress| {
        periplus::bags::files::check(bag, progress)
    })?;
    let (_, found) = checked.map_err(|error| bag_error(py, &path, &error))?;
    let found = findings_of(&found, &SourceMap::new());
    findings.extend(found.into_iter().filter(|one| !findings.contains(one)).collect::<Vec<_>>());
    Ok(findings)
}

/// Writes the messages of recordings to a new one, in the order of time, and converts between ROS 1 and ROS 2.
///
/// Parameters
/// ----------
/// source : path or list of paths
///     Recordings of any kind but CARMEN logs.
/// target : str or os.PathLike
///     New bag; its suffix gives the format, as for :class:`BagWriter`.
/// topics : str or list of str, optional
///     Topics to copy; default: all.
/// start, end : int, optional
///     Times of the first and last message to copy [ns]; default: all.
/// storage, compression, compression_mode, max_size_bytes, max_duration_s : optional
///     As for :class:`BagWriter`.
///
/// Returns
/// -------
/// list of Finding
///     Damaged parts, and topics and messages that were left out, with the reasons.
///
/// Raises ``FileNotFoundError``, ``FileExistsError`` if the target exists, and ``FileError``.
///
/// >>> import periplus, tempfile
/// >>> from periplus.msgs.std_msgs.msg import String
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     with periplus.BagWriter(f"{folder}/run.mcap") as writer:
/// ...         writer.write("/chatter", String(data="hi"), 0)
/// ...     periplus.convert_bag(f"{folder}/run.mcap", f"{folder}/run.bag")
/// ...     periplus.open_bag(f"{folder}/run.bag").storage
/// []
/// 'rosbag'
#[pyfunction]
#[pyo3(signature = (
    source, target, *, topics=None, start=None, end=None, storage=None, compression=None,
    compression_mode=None, max_size_bytes=None, max_duration_s=None
))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
fn convert_bag(
    py: Python<'_>,
    source: &Bound<'_, PyAny>,
    target: PathBuf,
    topics: Option<&Bound<'_, PyAny>>,
    start: Option<i64>,
    end: Option<i64>,
    storage: Option<&str>,
    compression: Option<&str>,
    compression_mode: Option<&str>,
    max_size_bytes: Option<u64>,
    max_duration_s: Option<f64>,
) -> PyResult<Vec<PyFinding>> {
    let paths: Vec<PathBuf> = match source.cast::<PyList>() {
        Ok(list) => list.extract()?,
        Err(_) => vec![source.extract()?],
    };
    let settings = write::settings(
        &target,
        storage,
        compression,
        compression_mode,
        max_size_bytes,
        max_duration_s,
    )?;
    let mut bags: Vec<Bag> = Vec::new();
    let mut selection = periplus::bags::Selection::default();
    let mut findings = Vec::new();
    for path in &paths {
        let source = open(py, path)?;
        selection = Wanted::new(&source, topics, start, end)?.selection();
        findings.extend(source.findings());
        match source.into_bag() {
            Some(bag) => bags.push(bag),
            None => {
                let why = "a CARMEN log cannot be converted; write its messages with BagWriter";
                return Err(PyValueError::new_err(format!("{}: {why}", path.display())));
            }
        }
    }
    if bags.is_empty() {
        return Err(PyTypeError::new_err("`source` has no path"));
    }
    let conversion = Conversion { selection, write: settings };
    let report = interruptible(py, "converting the bag", |progress| {
        convert(&bags, &target, conversion, progress)
    })?
    .map_err(|error| bag_error(py, &target, &error))?;
    findings.extend(findings_of(&report.findings, &SourceMap::new()));
    Ok(findings)
}

/// Runs work that reports progress, and ends it by an unwinding if the user presses Ctrl-C.
#[allow(clippy::disallowed_methods, reason = "only limits how often signals are checked")]
fn interruptible<T: Send>(
    py: Python<'_>,
    what: &str,
    work: impl FnOnce(&mut dyn FnMut(u64)) -> T + Send,
) -> PyResult<T> {
    /// Marks the unwinding of interrupted work.
    struct Interrupted;

    let mut stopped: Option<PyErr> = None;
    let mut checked = std::time::Instant::now();
    let done = py.detach(|| {
        std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            let mut progress = |_: u64| {
                if checked.elapsed().as_millis() < 50 {
                    return;
                }
                checked = std::time::Instant::now();
                if let Err(error) = Python::attach(|py| py.check_signals()) {
                    stopped = Some(error);
                    std::panic::resume_unwind(Box::new(Interrupted));
                }
            };
            work(&mut progress)
        }))
    });
    match (done, stopped) {
        (_, Some(error)) => Err(error),
        (Ok(done), None) => Ok(done),
        (Err(panic), None) => released(py, what, || std::panic::resume_unwind(panic)),
    }
}
