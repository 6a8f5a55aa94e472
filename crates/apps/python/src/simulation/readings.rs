//! Readings of sensors as arrays of numpy over the memory of the messages.

use std::collections::BTreeMap;
use std::sync::Arc;

use numpy::PyArray1;
use periplus::graph::{Mailbox, Qos, RawMailbox};
use periplus::images::{Layout, pack_png};
use periplus::msgs::Message;
use periplus::msgs::builtin_interfaces::Time;
use periplus::msgs::sensor_msgs::{Image, LaserScan, PointCloud2, PointField};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use super::PySimulation;
use crate::arrays::{shared, shared_bytes};
use crate::errors::runtime_error;
use crate::messages::to_python;
use crate::work::{lock, released};

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PySensor>()?;
    module.add_class::<PyScan>()?;
    module.add_class::<PyPointCloud>()?;
    module.add_class::<PyImage>()
}

/// Packages of messages that sensors publish.
const SENSOR_PACKAGES: [&str; 2] = ["sensor_msgs/", "gazebo_msgs/msg/ContactsState"];

/// A sensor of a simulation: the newest message of its topic.
///
/// It is computed while this object lives; sensors that no one reads cost nothing.
///
/// >>> from periplus import Simulation, World
/// >>> sim = Simulation(World.demo())
/// >>> lidar = sim.sensor("/scan")
/// >>> sim.run(0.5)
/// >>> lidar.read().ranges.dtype
/// dtype('float32')
#[pyclass(name = "Sensor", module = "periplus", frozen)]
pub(crate) struct PySensor {
    source: SensorSource,
    latest: std::sync::Mutex<Option<Py<PyAny>>>,
    #[pyo3(get)]
    /// Full name of the topic.
    topic: String,
    #[pyo3(get)]
    /// Type of its messages, such as ``sensor_msgs/msg/LaserScan``.
    type_name: String,
}

enum SensorSource {
    Scan(Mailbox<LaserScan>),
    Cloud(Mailbox<PointCloud2>),
    Image(Mailbox<Image>),
    Other(RawMailbox),
}

#[pymethods]
impl PySensor {
    /// The newest reading: a ``Scan``, ``PointCloud``, ``Image``, or a message of ``periplus.msgs`` for other
    /// sensors. None before the first. The same object is returned until there is a newer one.
    fn read<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let newest = match &self.source {
            SensorSource::Scan(mailbox) => {
                mailbox.latest().map(|it| Bound::new(py, PyScan(it)).map(Bound::into_any))
            }
            SensorSource::Cloud(mailbox) => {
                mailbox.latest().map(|it| Bound::new(py, PyPointCloud(it)).map(Bound::into_any))
            }
            SensorSource::Image(mailbox) => {
                mailbox.latest().map(|it| Bound::new(py, PyImage(it)).map(Bound::into_any))
            }
            SensorSource::Other(mailbox) => mailbox
                .drain()
                .pop()
                .map(|sample| to_python(py, &self.type_name, sample.cdr().map_err(runtime_error)?)),
        };
        let newest = newest.transpose()?;
        let mut latest = lock(&self.latest);
        if let Some(newest) = newest {
            let old = latest.replace(newest.clone().unbind());
            drop(latest);
            // Dropped after the lock: the end of an object of Python may run code of Python.
            drop(old);
            return Ok(Some(newest));
        }
        Ok(latest.as_ref().map(|it| it.bind(py).clone()))
    }

    fn __repr__(&self) -> String {
        format!("<periplus.Sensor of {} ({})>", self.topic, self.type_name)
    }
}

#[pymethods]
impl PySimulation {
    /// The sensor that publishes a topic.
    ///
    /// Raises ``KeyError`` for a topic that no one publishes.
    fn sensor(&self, py: Python<'_>, topic: &str) -> PyResult<PySensor> {
        let full = if topic.starts_with('/') { topic.to_owned() } else { format!("/{topic}") };
        let topics = self.published(py)?;
        let Some(type_name) = topics.get(&full).cloned() else {
            let near = periplus::diagnostics::closest(&full, topics.keys().map(String::as_str));
            let near = near.map(|near| format!("; did you mean {near:?}?")).unwrap_or_default();
            return Err(PyKeyError::new_err(format!("no publisher of {full:?}{near}")));
        };
        let source = self.with(py, |running| {
            let (node, qos) = (&running.node, Qos::best_effort(1));
            let source = match type_name.as_str() {
                LaserScan::TYPE_NAME => node.mailbox(&full, qos).map(SensorSource::Scan),
                PointCloud2::TYPE_NAME => node.mailbox(&full, qos).map(SensorSource::Cloud),
                Image::TYPE_NAME => node.mailbox(&full, qos).map(SensorSource::Image),
                _ => node.raw_mailbox(&full, &type_name, None, qos).map(SensorSource::Other),
            };
            source.map_err(|error| error.to_string())
        })?;
        let source = source.map_err(runtime_error)?;
        Ok(PySensor { source, latest: std::sync::Mutex::new(None), topic: full, type_name })
    }

    /// Topics of sensors with their types: those of ``sensor_msgs`` and contacts.
    #[getter]
    fn sensors(&self, py: Python<'_>) -> PyResult<BTreeMap<String, String>> {
        let mut topics = self.published(py)?;
        topics.retain(|_, type_name| SENSOR_PACKAGES.iter().any(|it| type_name.starts_with(it)));
        Ok(topics)
    }
}

impl PySimulation {
    fn published(&self, py: Python<'_>) -> PyResult<BTreeMap<String, String>> {
        self.with(py, |running| {
            let topics = running.graph().topics().into_iter();
            let published = topics.filter(|topic| !topic.publishers.is_empty());
            published.map(|topic| (topic.name, topic.type_name)).collect()
        })
    }
}

fn seconds(stamp: &Time) -> f64 {
    f64::from(stamp.sec) + f64::from(stamp.nanosec) * 1e-9
}

/// A scan of a planar lidar (``sensor_msgs/msg/LaserScan``).
#[pyclass(name = "Scan", module = "periplus", frozen)]
pub(crate) struct PyScan(pub(crate) Arc<LaserScan>);

#[pymethods]
impl PyScan {
    /// Ranges [m], shape (N,), float32, read-only, in the memory of the message. Beams without a return are
    /// infinite (REP 117).
    #[getter]
    fn ranges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let values = &self.0.ranges;
        shared(py, Arc::clone(&self.0), (values.as_ptr(), values.len()), &[values.len()])
    }

    /// Intensities, shape (N,) or (0,), float32, read-only.
    #[getter]
    fn intensities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let values = &self.0.intensities;
        shared(py, Arc::clone(&self.0), (values.as_ptr(), values.len()), &[values.len()])
    }

    /// Angles of the beams in the frame of the lidar [rad], shape (N,), float64.
    #[getter]
    fn angles<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let (start, step) = (f64::from(self.0.angle_min), f64::from(self.0.angle_increment));
        PyArray1::from_iter(py, (0..self.0.ranges.len()).map(|beam| start + step * beam as f64))
    }

    /// Points of the beams with a valid range in the frame of the lidar [m], shape (M, 2), float64.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let scan = &self.0;
        let (start, step) = (f64::from(scan.angle_min), f64::from(scan.angle_increment));
        let mut points = Vec::with_capacity(2 * scan.ranges.len());
        for (beam, range) in scan.ranges.iter().enumerate() {
            if (scan.range_min..=scan.range_max).contains(range) {
                let (sine, cosine) = libm::sincos(start + step * beam as f64);
                points.extend([f64::from(*range) * cosine, f64::from(*range) * sine]);
            }
        }
        let count = points.len() / 2;
        Ok(crate::arrays::moved(py, points, &[count, 2])?.into_any())
    }

    /// Angle of the first beam [rad].
    #[getter]
    fn angle_min(&self) -> f64 {
        self.0.angle_min.into()
    }

    /// Angle of the last beam [rad].
    #[getter]
    fn angle_max(&self) -> f64 {
        self.0.angle_max.into()
    }

    /// Angle between beams [rad].
    #[getter]
    fn angle_increment(&self) -> f64 {
        self.0.angle_increment.into()
    }

    /// Time between beams [s].
    #[getter]
    fn time_increment(&self) -> f64 {
        self.0.time_increment.into()
    }

    /// Smallest valid range [m].
    #[getter]
    fn range_min(&self) -> f64 {
        self.0.range_min.into()
    }

    /// Largest valid range [m].
    #[getter]
    fn range_max(&self) -> f64 {
        self.0.range_max.into()
    }

    /// Time of the scan [ns].
    #[getter]
    fn time_ns(&self) -> i64 {
        let stamp = &self.0.header.stamp;
        i64::from(stamp.sec) * 1_000_000_000 + i64::from(stamp.nanosec)
    }

    /// Time of the scan [s].
    #[getter]
    fn time_s(&self) -> f64 {
        seconds(&self.0.header.stamp)
    }

    /// Frame of the lidar.
    #[getter]
    fn frame_id(&self) -> &str {
        &self.0.header.frame_id
    }

    /// Address of the ranges in memory, the same as that of the array.
    #[getter]
    fn address(&self) -> usize {
        self.0.ranges.as_ptr().addr()
    }

    /// Picture seen from above: x ahead is up, the lidar is in the middle.
    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        let scan = Arc::clone(&self.0);
        let png = released(py, "drawing a scan", move || scan_png(&scan))?;
        Ok(png.map(|png| PyBytes::new(py, &png)))
    }

    fn __len__(&self) -> usize {
        self.0.ranges.len()
    }

    fn __repr__(&self) -> String {
        format!("<periplus.Scan of {} beams at {} s>", self.0.ranges.len(), self.time_s())
    }
}

/// A cloud of points (``sensor_msgs/msg/PointCloud2``).
#[pyclass(name = "PointCloud", module = "periplus", frozen)]
pub(crate) struct PyPointCloud(pub(crate) Arc<PointCloud2>);

#[pymethods]
impl PyPointCloud {
    /// Points as a structured array with a field for each of the message (``points["x"]``), shape (N,), or (H, W)
    /// for an organized cloud; read-only, in the memory of the message.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let cloud = &self.0;
        let step = cloud.point_step as usize;
        self.check()?;
        let fields = structure(&cloud.fields, step, cloud.is_bigendian)?;
        let owner = Arc::clone(cloud);
        shared_bytes(py, owner, cloud.data.as_ptr(), &self.shape(), format!("|V{step}"), fields)
    }

    /// Coordinates x, y, z [m] in the frame of the cloud, shape (N, 3) or (H, W, 3), float32, read-only, in the
    /// memory of the message.
    ///
    /// Raises ``ValueError`` if x, y and z are not float32 values in a row.
    #[getter]
    fn xyz<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let cloud = &self.0;
        self.check()?;
        let offset_of = |name: &str| {
            let field = cloud.fields.iter().find(|field| field.name == name)?;
            (field.datatype == PointField::FLOAT32 && field.count <= 1).then_some(field.offset)
        };
        let offsets = ["x", "y", "z"].map(offset_of);
        let [Some(x), Some(y), Some(z)] = offsets else {
            return Err(PyValueError::new_err("the cloud has no float32 fields x, y and z"));
        };
        let (first, step) = (x as usize, cloud.point_step as usize);
        let is_regular = y == x + 4 && z == x + 8 && first % 4 == 0 && step % 4 == 0;
        if !is_regular || cloud.is_bigendian {
            return Err(PyValueError::new_err("x, y and z are not in a row; use `points`"));
        }
        let mut shape = self.shape();
        shape.push(step / 4);
        let owner = Arc::clone(cloud);
        let words = shared_bytes(py, owner, cloud.data.as_ptr(), &shape, "<f4".into(), Vec::new())?;
        let columns =
            pyo3::types::PySlice::new(py, (first / 4) as isize, (first / 4 + 3) as isize, 1);
        let every = py.Ellipsis();
        words.get_item((every, columns))
    }

    /// Time of the cloud [s].
    #[getter]
    fn time_s(&self) -> f64 {
        seconds(&self.0.header.stamp)
    }

    /// Frame of the cloud.
    #[getter]
    fn frame_id(&self) -> &str {
        &self.0.header.frame_id
    }

    /// Address of the points in memory, the same as that of the array.
    #[getter]
    fn address(&self) -> usize {
        self.0.data.as_ptr().addr()
    }

    fn __len__(&self) -> usize {
        self.0.width as usize * self.0.height as usize
    }

    fn __repr__(&self) -> String {
        format!("<periplus.PointCloud of {} points at {} s>", self.__len__(), self.time_s())
    }
}

impl PyPointCloud {
    fn shape(&self) -> Vec<usize> {
        let (width, height) = (self.0.width as usize, self.0.height as usize);
        if height == 1 { vec![width] } else { vec![height, width] }
    }

    /// Fails unless the data has the size that the other fields say, with rows that follow each other.
    fn check(&self) -> PyResult<()> {
        let cloud = &self.0;
        let expected = self.__len__().checked_mul(cloud.point_step as usize);
        let row_step = u64::from(cloud.point_step) * u64::from(cloud.width);
        if expected != Some(cloud.data.len())
            || (cloud.height > 1 && u64::from(cloud.row_step) != row_step)
        {
            return Err(PyValueError::new_err(format!(
                "{} bytes are not a cloud of {} x {} points of {} bytes",
                cloud.data.len(),
                cloud.width,
                cloud.height,
                cloud.point_step
            )));
        }
        Ok(())
    }
}

/// Fields of a point with their types, and padding between them.
fn structure(
    fields: &[PointField],
    step: usize,
    is_bigendian: bool,
) -> PyResult<Vec<(String, String)>> {
    let order = if is_bigendian { '>' } else { '<' };
    let mut sorted: Vec<&PointField> = fields.iter().collect();
    sorted.sort_by_key(|field| field.offset);
    let mut structure = Vec::new();
    let mut end = 0;
    for field in sorted {
        let (kind, size) = match field.datatype {
            PointField::INT8 => ("i1", 1),
            PointField::UINT8 => ("u1", 1),
            PointField::INT16 => ("i2", 2),
            PointField::UINT16 => ("u2", 2),
            PointField::INT32 => ("i4", 4),
            PointField::UINT32 => ("u4", 4),
            PointField::FLOAT32 => ("f4", 4),
            PointField::FLOAT64 => ("f8", 8),
            other => {
                return Err(PyValueError::new_err(format!(
                    "the field `{}` has the unknown type {other}",
                    field.name
                )));
            }
        };
        let (offset, count) = (field.offset as usize, (field.count as usize).max(1));
        if offset < end || offset + size * count > step {
            return Err(PyValueError::new_err(format!(
                "the field `{}` overlaps another or the end of a point",
                field.name
            )));
        }
        if offset > end {
            structure.push((String::new(), format!("|V{}", offset - end)));
        }
        // An array within a point is a run of bytes for numpy's description.
        let kind = match count {
            1 => format!("{order}{kind}"),
            _ => format!("|V{}", size * count),
        };
        structure.push((field.name.clone(), kind));
        end = offset + size * count;
    }
    if end < step {
        structure.push((String::new(), format!("|V{}", step - end)));
    }
    Ok(structure)
}

/// An image of a camera, a depth camera or a segmentation camera (``sensor_msgs/msg/Image``).
#[pyclass(name = "Image", module = "periplus", frozen)]
pub(crate) struct PyImage(pub(crate) Arc<Image>);

#[pymethods]
impl PyImage {
    /// Pixels, read-only, in the memory of the message: (H, W, 3) uint8 for colours, (H, W) float32 for depth
    /// [m], (H, W) uint8 or uint16 for grey and labels. Colours are in the order of ``encoding``.
    #[getter]
    fn pixels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let image = &self.0;
        let Some((kind, size, channels)) = pixel(&image.encoding) else {
            return Err(PyValueError::new_err(format!("unknown encoding {:?}", image.encoding)));
        };
        let (width, height) = (image.width as usize, image.height as usize);
        let row = width * size * channels;
        if image.step as usize != row || image.data.len() != row * height {
            return Err(PyValueError::new_err(format!(
                "{} bytes with rows of {} are not an image of {width} x {height} pixels of {:?}",
                image.data.len(),
                image.step,
                image.encoding
            )));
        }
        let mut shape = vec![height, width];
        if channels > 1 {
            shape.push(channels);
        }
        let order = if image.is_bigendian != 0 { '>' } else { '<' };
        let order = if size == 1 { '|' } else { order };
        let kind = format!("{order}{kind}");
        shared_bytes(py, Arc::clone(image), image.data.as_ptr(), &shape, kind, Vec::new())
    }

    /// Colours in the order red, green, blue, shape (H, W, 3), uint8, read-only, in the memory of the message.
    ///
    /// Raises ``ValueError`` for an image without colours.
    #[getter]
    fn rgb<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let pixels = self.pixels(py)?;
        let every = py.Ellipsis();
        let slice = |start: isize, stop: Option<isize>, step: isize| {
            let slice = py.import("builtins")?.getattr("slice")?;
            slice.call1((start, stop, step))
        };
        match self.0.encoding.as_str() {
            "rgb8" | "8UC3" => Ok(pixels),
            "rgba8" => pixels.get_item((every, slice(0, Some(3), 1)?)),
            "bgr8" => pixels.get_item((every, slice(2, None, -1)?)),
            "bgra8" => pixels.get_item((every, slice(2, None, -1)?)),
            other => Err(PyValueError::new_err(format!("an image of {other:?} has no colours"))),
        }
    }

    /// Encoding, such as ``rgb8`` or ``32FC1``.
    #[getter]
    fn encoding(&self) -> &str {
        &self.0.encoding
    }

    /// Width [px].
    #[getter]
    fn width(&self) -> u32 {
        self.0.width
    }

    /// Height [px].
    #[getter]
    fn height(&self) -> u32 {
        self.0.height
    }

    /// Time of the image [s].
    #[getter]
    fn time_s(&self) -> f64 {
        seconds(&self.0.header.stamp)
    }

    /// Frame of the camera.
    #[getter]
    fn frame_id(&self) -> &str {
        &self.0.header.frame_id
    }

    /// Address of the pixels in memory, the same as that of the array.
    #[getter]
    fn address(&self) -> usize {
        self.0.data.as_ptr().addr()
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        let image = Arc::clone(&self.0);
        let png = released(py, "encoding an image", move || png(&image))?;
        Ok(png.map(|png| PyBytes::new(py, &png)))
    }

    fn __repr__(&self) -> String {
        let Image { width, height, encoding, .. } = &*self.0;
        format!("<periplus.Image of {width} x {height} pixels, {encoding}, at {} s>", self.time_s())
    }
}

/// Type of numpy, bytes of a sample, and samples of a pixel of an encoding.
fn pixel(encoding: &str) -> Option<(&'static str, usize, usize)> {
    Some(match encoding {
        "rgb8" | "bgr8" | "8UC3" => ("u1", 1, 3),
        "rgba8" | "bgra8" | "8UC4" => ("u1", 1, 4),
        "mono8" | "8UC1" | "bayer_rggb8" | "bayer_bggr8" | "bayer_gbrg8" | "bayer_grbg8" => {
            ("u1", 1, 1)
        }
        "8UC2" => ("u1", 1, 2),
        "8SC1" => ("i1", 1, 1),
        "mono16" | "16UC1" => ("u2", 2, 1),
        "16UC3" | "rgb16" | "bgr16" => ("u2", 2, 3),
        "16SC1" => ("i2", 2, 1),
        "32SC1" => ("i4", 4, 1),
        "32FC1" => ("f4", 4, 1),
        "32FC3" => ("f4", 4, 3),
        "64FC1" => ("f8", 8, 1),
        _ => return None,
    })
}

/// PNG of colours or grey; depth from near (white) to far (black). `None` for other encodings.
fn png(image: &Image) -> Option<Vec<u8>> {
    let (layout, samples): (Layout, Vec<u8>) = match image.encoding.as_str() {
        "rgb8" | "8UC3" => (Layout::Rgb, image.data.clone()),
        "bgr8" => {
            let pixels = image.data.chunks_exact(3);
            (Layout::Rgb, pixels.flat_map(|pixel| [pixel[2], pixel[1], pixel[0]]).collect())
        }
        "mono8" | "8UC1" => (Layout::Grey, image.data.clone()),
        "32FC1" => (Layout::Grey, depth_grey(&image.data)),
        _ => return None,
    };
    pack_png(image.width, image.height, layout, |out| out.write_all(&samples)).ok()
}

/// Side of the picture of a scan \[px\].
const SCAN_SIDE_PX: usize = 400;
/// Brightness of the background, of points, and of the lidar.
const BACKGROUND: u8 = 255;
const POINT: u8 = 0;
const LIDAR: u8 = 150;

/// PNG of a scan, scaled to its farthest valid point.
fn scan_png(scan: &LaserScan) -> Option<Vec<u8>> {
    let valid = |range: &f32| (scan.range_min..=scan.range_max).contains(range);
    let farthest = scan.ranges.iter().copied().filter(valid).fold(0.1, f32::max);
    let half = SCAN_SIDE_PX as f64 / 2.0;
    let pixels_per_m = 0.95 * half / f64::from(farthest);
    let mut pixels = vec![BACKGROUND; SCAN_SIDE_PX * SCAN_SIDE_PX];
    let mut dot = |x_m: f64, y_m: f64, radius_px: i32, brightness: u8| {
        let column = half - y_m * pixels_per_m;
        let row = half - x_m * pixels_per_m;
        for (dx, dy) in
            (-radius_px..=radius_px).flat_map(|dx| (-radius_px..=radius_px).map(move |dy| (dx, dy)))
        {
            let (column, row) = (column as i32 + dx, row as i32 + dy);
            if let (Ok(column), Ok(row)) = (usize::try_from(column), usize::try_from(row))
                && column < SCAN_SIDE_PX
                && row < SCAN_SIDE_PX
            {
                pixels[row * SCAN_SIDE_PX + column] = brightness;
            }
        }
    };
    dot(0.0, 0.0, 3, LIDAR);
    for (beam, range) in scan.ranges.iter().enumerate().filter(|(_, range)| valid(range)) {
        let angle = f64::from(scan.angle_min) + f64::from(scan.angle_increment) * beam as f64;
        let (sine, cosine) = libm::sincos(angle);
        dot(f64::from(*range) * cosine, f64::from(*range) * sine, 1, POINT);
    }
    let side = SCAN_SIDE_PX as u32;
    pack_png(side, side, Layout::Grey, |out| out.write_all(&pixels)).ok()
}

/// Brightness of depths: white at the nearest, black at the farthest and without a return.
fn depth_grey(bytes: &[u8]) -> Vec<u8> {
    let depth = |four: &[u8]| f32::from_le_bytes([four[0], four[1], four[2], four[3]]);
    let depths: Vec<f32> = bytes.chunks_exact(4).map(depth).collect();
    let finite = depths.iter().copied().filter(|depth| depth.is_finite());
    let (near, far) = finite.fold((f32::MAX, f32::MIN), |(a, b), it| (a.min(it), b.max(it)));
    let range = (far - near).max(1e-6);
    let grey = |depth: f32| {
        if depth.is_finite() { 255.0 * (1.0 - 0.9 * (depth - near) / range) } else { 0.0 }
    };
    depths.into_iter().map(|depth| grey(depth) as u8).collect()
}
