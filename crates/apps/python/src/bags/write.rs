//! Writing of bags.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use periplus::bags::files::{
    BagWriter, ChunkPacking, Packing, PackingMode, Storage, WriteSettings,
};
use periplus::bags::{
    BagTopic, Durability, History, Liveliness, QosProfile, Reliability, Stamp, Style, Target,
    TopicInformation, Translation,
};
use periplus::diagnostics::Diagnostics;
use periplus::msgs::Format;
use pyo3::exceptions::{PyResourceWarning, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList, PyString};

use super::bag_error;
use crate::messages::{Plan, encode_message, plan_of, plan_of_type};
use crate::work::{lock, with_locked};

/// Writes messages to a new recording.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     The suffix gives the format: ``.mcap``, ``.db3`` (sqlite3) or ``.bag`` (ROS 1) for a single file; any other
///     name makes a ``ros2 bag`` folder.
/// storage : {'mcap', 'sqlite3'}, optional
///     Format of a folder (default ``'mcap'``).
/// compression : {'zstd', 'lz4', 'bz2', 'none'}, optional
///     Compression of chunks: MCAP has zstd (default) and lz4, ROS 1 has lz4 and bz2; with ``compression_mode``
///     zstd or lz4.
/// compression_mode : {'file', 'message'}, optional
///     Compresses whole files or each message of a folder, as ``ros2 bag`` does, in place of chunks.
/// max_size_bytes : int, optional
///     Size above which a folder continues in a new file [bytes].
/// max_duration_s : float, optional
///     Duration after which a folder continues in a new file [s].
///
/// Use it in a ``with`` statement, or call :meth:`close`: only a closed bag is complete. A writer that is forgotten
/// is closed with a ``ResourceWarning``.
/// Raises ``FileExistsError`` if the path exists and ``ValueError`` for settings that the format does not have.
///
/// >>> import periplus, tempfile
/// >>> from periplus.msgs.std_msgs.msg import String
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     with periplus.BagWriter(f"{folder}/run.mcap", compression="lz4") as writer:
/// ...         writer.write("/chatter", String(data="hi"), 20_000_000)
/// ...     periplus.open_bag(f"{folder}/run.mcap").message_count
/// 1
#[pyclass(name = "BagWriter", module = "periplus", frozen)]
pub(crate) struct PyBagWriter {
    path: PathBuf,
    state: Mutex<State>,
}

struct State {
    /// None after the end.
    writer: Option<BagWriter>,
    storage: Storage,
    topics: HashMap<(String, String), OpenTopic>,
    messages: u64,
}

struct OpenTopic {
    id: usize,
    /// Conversion, for ROS 1 bags.
    translation: Option<Translation>,
}

/// Settings of a writer.
pub(super) fn settings(
    path: &Path,
    storage: Option<&str>,
    compression: Option<&str>,
    compression_mode: Option<&str>,
    max_size_bytes: Option<u64>,
    max_duration_s: Option<f64>,
) -> PyResult<WriteSettings> {
    let wrong = |name: &str, value: &str, known: &str| {
        PyValueError::new_err(format!("`{name}` must be one of {known}, not {value:?}"))
    };
    let named = match storage {
        None => None,
        Some("mcap") => Some(Storage::Mcap),
        Some("sqlite3") => Some(Storage::Sqlite),
        Some("rosbag") => Some(Storage::Ros1),
        Some(other) => return Err(wrong("storage", other, "'mcap', 'sqlite3'")),
    };
    let storage = named.or_else(|| Storage::of_path(path)).unwrap_or(Storage::Mcap);
    let mut settings = WriteSettings::new(storage);
    settings.threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    settings.max_bytes = max_size_bytes;
    settings.mode = match compression_mode {
        None => PackingMode::None,
        Some("file") => PackingMode::File,
        Some("message") => PackingMode::Message,
        Some(other) => return Err(wrong("compression_mode", other, "'file', 'message'")),
    };
    let chunks = match compression {
        None => settings.chunks,
        Some("none") => ChunkPacking::None,
        Some("zstd") => ChunkPacking::Zstd,
        Some("lz4") => ChunkPacking::Lz4,
        Some("bz2") => ChunkPacking::Bz2,
        Some(other) => return Err(wrong("compression", other, "'zstd', 'lz4', 'bz2', 'none'")),
    };
    settings.chunks = chunks;
    if settings.mode != PackingMode::None {
        settings.packing = match compression {
            None | Some("zstd") => Packing::Zstd,
            Some("lz4") => Packing::Lz4,
            Some(other) => {
                return Err(wrong("compression", other, "'zstd', 'lz4' with a compression_mode"));
            }
        };
        settings.chunks = ChunkPacking::None;
    }
    if let Some(seconds) = max_duration_s {
        if !seconds.is_finite() || seconds <= 0.0 {
            return Err(PyValueError::new_err("`max_duration_s` must be positive"));
        }
        #[allow(clippy::cast_possible_truncation, reason = "saturates at 292 years")]
        let span_ns = (seconds * 1e9) as i64;
        settings.max_span_ns = Some(span_ns);
    }
    Ok(settings)
}

#[pymethods]
impl PyBagWriter {
    #[new]
    #[pyo3(signature = (
        path, *, storage=None, compression=None, compression_mode=None, max_size_bytes=None,
        max_duration_s=None
    ))]
    fn new(
        py: Python<'_>,
        path: PathBuf,
        storage: Option<&str>,
        compression: Option<&str>,
        compression_mode: Option<&str>,
        max_size_bytes: Option<u64>,
        max_duration_s: Option<f64>,
    ) -> PyResult<Self> {
        let settings = settings(
            &path,
            storage,
            compression,
            compression_mode,
            max_size_bytes,
            max_duration_s,
        )?;
        let storage = settings.storage;
        let writer =
            BagWriter::create(&path, settings).map_err(|error| bag_error(py, &path, &error))?;
        let state = State { writer: Some(writer), storage, topics: HashMap::new(), messages: 0 };
        Ok(Self { path, state: Mutex::new(state) })
    }

    /// Writes a message.
    ///
    /// Parameters
    /// ----------
    /// topic : str
    ///     Full name, such as ``/scan``.
    /// message : Message or bytes
    ///     Message object, or serialized message (CDR) together with ``type``.
    /// time_ns : int
    ///     Time of recording [ns], not negative.
    /// type : type or str, optional
    ///     Type of a serialized message.
    /// qos : dict or list of dict, optional
    ///     QoS of the publishers, as in :attr:`BagTopic.qos`; only the first message of a topic uses it (default:
    ///     reliable, keep last 10).
    ///
    /// Raises ``TypeError`` or ``ValueError`` that names the field whose value does not fit, and ``ValueError`` after
    /// :meth:`close`.
    #[pyo3(signature = (topic, message, time_ns, *, r#type=None, qos=None))]
    fn write(
        &self,
        py: Python<'_>,
        topic: &str,
        message: &Bound<'_, PyAny>,
        time_ns: &Bound<'_, PyAny>,
        r#type: Option<&Bound<'_, PyAny>>,
        qos: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let time_ns = time_argument(time_ns)?;
        if !topic.starts_with('/') || topic.len() < 2 {
            return Err(PyValueError::new_err(format!(
                "`topic` must be a full name such as '/scan', not {topic:?}"
            )));
        }
        let mut data = Vec::new();
        let plan = match (message.cast::<PyBytes>(), r#type) {
            (Ok(bytes), Some(kind)) => {
                data.extend_from_slice(bytes.as_bytes());
                plan_of_type(kind)?
            }
            (Ok(_), None) => {
                return Err(PyTypeError::new_err("serialized bytes need their `type`"));
            }
            (Err(_), _) => {
                let plan = plan_of(message)?;
                encode_message(&plan, message, Format::CDR, &mut data)?;
                plan
            }
        };
        let qos = match qos {
            None => vec![QosProfile::reliable(10)],
            Some(qos) => qos_of(qos)?,
        };
        let written = with_locked(py, "writing the bag", &self.state, |state| {
            state.write(topic, &plan, &qos, time_ns, &data)
        })?;
        written.map_err(|fault| self.error(py, fault))
    }

    /// Completes the bag. Later calls do nothing.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        let done = with_locked(py, "closing the bag", &self.state, State::finish)?;
        done.map_err(|fault| self.error(py, fault))
    }

    /// Writes all messages so far to disk.
    fn flush(&self, py: Python<'_>) -> PyResult<()> {
        let done = with_locked(py, "writing the bag", &self.state, |state| {
            state.writer.as_mut().map_or(Ok(()), |writer| writer.flush().map_err(Fault::Bag))
        })?;
        done.map_err(|fault| self.error(py, fault))
    }

    /// Path of the bag.
    #[getter]
    fn path(&self) -> PathBuf {
        self.path.clone()
    }

    /// Number of messages written.
    #[getter]
    fn message_count(&self, py: Python<'_>) -> PyResult<u64> {
        with_locked(py, "writing the bag", &self.state, |state| state.messages)
    }

    /// True after :meth:`close`.
    #[getter]
    fn closed(&self, py: Python<'_>) -> PyResult<bool> {
        with_locked(py, "writing the bag", &self.state, |state| state.writer.is_none())
    }

    fn __enter__(this: PyRef<'_, Self>) -> PyRef<'_, Self> {
        this
    }

    #[pyo3(signature = (*_exception))]
    fn __exit__(
        &self,
        py: Python<'_>,
        _exception: &Bound<'_, pyo3::types::PyTuple>,
    ) -> PyResult<()> {
        self.close(py)
    }

    fn __repr__(&self) -> String {
        format!("BagWriter('{}')", self.path.display())
    }
}

impl PyBagWriter {
    fn error(&self, py: Python<'_>, fault: Fault) -> PyErr {
        match fault {
            Fault::Bag(error) => match &error {
                periplus::bags::files::BagError::Write(
                    _,
                    periplus::bags::WriteError::NegativeTime(_),
                ) => PyValueError::new_err(error.to_string()),
                error => bag_error(py, &self.path, error),
            },
            Fault::Value(text) => PyValueError::new_err(text),
        }
    }
}

impl Drop for PyBagWriter {
    fn drop(&mut self) {
        let mut state = lock(&self.state);
        if state.writer.is_none() {
            return;
        }
        let finished = state.finish();
        drop(state);
        Python::attach(|py| {
            let mut text = format!(
                "the bag {} was not closed; use `with` or call close()",
                self.path.display()
            );
            if finished.is_err() {
                text.push_str("; it is not complete");
            }
            let text = std::ffi::CString::new(text).unwrap_or_default();
            if let Err(error) = PyErr::warn(py, &py.get_type::<PyResourceWarning>(), &text, 1) {
                error.write_unraisable(py, None);
            }
        });
    }
}

enum Fault {
    Bag(periplus::bags::files::BagError),
    Value(String),
}

impl State {
    fn write(
        &mut self,
        topic: &str,
        plan: &Plan,
        qos: &[QosProfile],
        time_ns: i64,
        data: &[u8],
    ) -> Result<(), Fault> {
        let Some(writer) = &mut self.writer else {
            return Err(Fault::Value("the bag is closed".into()));
        };
        let key = (topic.to_owned(), plan.type_name.clone());
        if !self.topics.contains_key(&key) {
            let mut description = describe(topic, plan, qos);
            let mut translation = None;
            if self.storage == Storage::Ros1 {
                let mut findings = Diagnostics::new();
                let made = Translation::new(&description, Target::Ros1, &mut findings);
                let why = findings.iter().map(|it| it.message.clone()).collect::<Vec<_>>();
                let made = made.ok_or_else(|| Fault::Value(why.join("; ")))?;
                description = made.topic().clone();
                translation = Some(made);
            }
            let id = writer.topic(&description).map_err(Fault::Bag)?;
            self.topics.insert(key.clone(), OpenTopic { id, translation });
        }
        let Some(open) = self.topics.get_mut(&key) else { return Ok(()) };
        let data = match &mut open.translation {
            None => data,
            Some(translation) => translation
                .translate(data)
                .map_err(|error| Fault::Value(format!("{}: {error}", plan.type_name)))?,
        };
        writer.write(open.id, Stamp::at(time_ns), data).map_err(Fault::Bag)?;
        self.messages += 1;
        Ok(())
    }

    fn finish(&mut self) -> Result<(), Fault> {
        self.writer.take().map_or(Ok(()), |writer| match writer.finish() {
            Ok(_) => Ok(()),
            Err(error) => Err(Fault::Bag(error)),
        })
    }
}

fn describe(topic: &str, plan: &Plan, qos: &[QosProfile]) -> BagTopic {
    let info = TopicInformation {
        name: topic.to_owned(),
        type_name: plan.type_name.clone(),
        type_hash: plan.hash.clone().unwrap_or_default(),
        encoding: "cdr".into(),
        qos: qos.to_vec(),
        messages: 0,
    };
    let metadata = [
        ("offered_qos_profiles".to_owned(), info.qos_text(Style::default())),
        ("topic_type_hash".to_owned(), info.type_hash.clone()),
    ];
    BagTopic {
        name: info.name,
        type_name: info.type_name,
        encoding: info.encoding,
        schema_encoding: "ros2msg".into(),
        schema: plan.schema.clone().into(),
        metadata: metadata.into(),
    }
}

fn time_argument(time_ns: &Bound<'_, PyAny>) -> PyResult<i64> {
    if time_ns.is_instance_of::<pyo3::types::PyFloat>() {
        return Err(PyTypeError::new_err(
            "`time_ns` must be an int [ns], not a float; seconds are int(seconds * 1e9)",
        ));
    }
    let time: i64 = time_ns.extract()?;
    if time < 0 {
        return Err(PyValueError::new_err(format!("`time_ns` must not be negative, is {time}")));
    }
    Ok(time)
}

/// QoS profile as a dictionary.
pub(super) fn qos_dict<'py>(py: Python<'py>, qos: &QosProfile) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item(
        "history",
        match qos.history {
            History::SystemDefault => "system_default",
            History::KeepLast => "keep_last",
            History::KeepAll => "keep_all",
            History::Unknown => "unknown",
        },
    )?;
    dict.set_item("depth", qos.depth)?;
    dict.set_item(
        "reliability",
        match qos.reliability {
            Reliability::SystemDefault => "system_default",
            Reliability::Reliable => "reliable",
            Reliability::BestEffort => "best_effort",
            Reliability::Unknown => "unknown",
            Reliability::BestAvailable => "best_available",
        },
    )?;
    dict.set_item(
        "durability",
        match qos.durability {
            Durability::SystemDefault => "system_default",
            Durability::TransientLocal => "transient_local",
            Durability::Volatile => "volatile",
            Durability::Unknown => "unknown",
            Durability::BestAvailable => "best_available",
        },
    )?;
    dict.set_item(
        "liveliness",
        match qos.liveliness {
            Liveliness::SystemDefault => "system_default",
            Liveliness::Automatic => "automatic",
            Liveliness::ManualByNode => "manual_by_node",
            Liveliness::ManualByTopic => "manual_by_topic",
            Liveliness::Unknown => "unknown",
            Liveliness::BestAvailable => "best_available",
        },
    )?;
    let limits = [
        ("deadline_ns", qos.deadline_ns),
        ("lifespan_ns", qos.lifespan_ns),
        ("lease_ns", qos.lease_ns),
    ];
    for (name, limit) in limits {
        if let Some(limit) = limit {
            dict.set_item(name, limit)?;
        }
    }
    Ok(dict)
}

fn qos_of(value: &Bound<'_, PyAny>) -> PyResult<Vec<QosProfile>> {
    if let Ok(list) = value.cast::<PyList>() {
        let profiles: PyResult<Vec<Vec<_>>> = list.iter().map(|one| qos_of(&one)).collect();
        return Ok(profiles?.into_iter().flatten().collect());
    }
    let dict = value
        .cast::<PyDict>()
        .map_err(|_| PyTypeError::new_err("`qos` must be a dict or a list of dicts"))?;
    let mut qos = QosProfile::reliable(10);
    for (key, value) in dict {
        let key: String = key.extract()?;
        let word = || -> PyResult<String> { Ok(value.cast::<PyString>()?.to_str()?.to_owned()) };
        let unknown = |word: &str| {
            PyValueError::new_err(format!("`qos` has {word:?} as {key}, which is not known"))
        };
        match key.as_str() {
            "depth" => qos.depth = value.extract()?,
            "deadline_ns" => qos.deadline_ns = value.extract()?,
            "lifespan_ns" => qos.lifespan_ns = value.extract()?,
            "lease_ns" => qos.lease_ns = value.extract()?,
            "history" => {
                let word = word()?;
                qos.history = match word.as_str() {
                    "system_default" => History::SystemDefault,
                    "keep_last" => History::KeepLast,
                    "keep_all" => History::KeepAll,
                    "unknown" => History::Unknown,
                    _ => return Err(unknown(&word)),
                };
            }
            "reliability" => {
                let word = word()?;
                qos.reliability = match word.as_str() {
                    "system_default" => Reliability::SystemDefault,
                    "reliable" => Reliability::Reliable,
                    "best_effort" => Reliability::BestEffort,
                    "unknown" => Reliability::Unknown,
                    "best_available" => Reliability::BestAvailable,
                    _ => return Err(unknown(&word)),
                };
            }
            "durability" => {
                let word = word()?;
                qos.durability = match word.as_str() {
                    "system_default" => Durability::SystemDefault,
                    "transient_local" => Durability::TransientLocal,
                    "volatile" => Durability::Volatile,
                    "unknown" => Durability::Unknown,
                    "best_available" => Durability::BestAvailable,
                    _ => return Err(unknown(&word)),
                };
            }
            "liveliness" => {
                let word = word()?;
                qos.liveliness = match word.as_str() {
                    "system_default" => Liveliness::SystemDefault,
                    "automatic" => Liveliness::Automatic,
                    "manual_by_node" => Liveliness::ManualByNode,
                    "manual_by_topic" => Liveliness::ManualByTopic,
                    "unknown" => Liveliness::Unknown,
                    "best_available" => Liveliness::BestAvailable,
                    _ => return Err(unknown(&word)),
                };
            }
            _ => {
                let known = ["history", "depth", "reliability", "durability", "liveliness"];
                let near = periplus::diagnostics::closest(&key, known);
                let near = near.map_or(String::new(), |near| format!(", did you mean `{near}`?"));
                return Err(PyTypeError::new_err(format!("`qos` has no policy `{key}`{near}")));
            }
        }
    }
    Ok(vec![qos])
}
