//! Maps: occupancy grids, their files, comparison, and inflation.

mod comparison;
mod inflation;

use std::path::PathBuf;
use std::sync::Arc;

use numpy::{PyArrayDyn, PyUntypedArrayMethods as _};
use periplus::geometry::Pose2;
use periplus::grid::{Grid, GridInfo, NO_SITE_CELLS, OccupancyGrid, squared_distances};
use periplus::maps::{
    CompareOptions, Distro, Format, Loaded, Mode, Wish, compare, load, load_image, render,
};
use periplus::os::{Machine, unix_ns};
use periplus::resources::Store as _;
use periplus_session::picture;
use pyo3::exceptions::{PyOSError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arrays::{contiguous, input, moved, shared};
use crate::errors::{file_error, require_file, require_no_errors, value_error};
use crate::poses::pose2_argument;
use crate::work::released;
use comparison::PyMapComparison;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyOccupancyGrid>()?;
    module.add_class::<PyMapComparison>()?;
    module.add_function(wrap_pyfunction!(inflation::inflate, module)?)
}

/// Occupancy grid map, as in ``nav_msgs/OccupancyGrid``. Immutable.
///
/// Parameters
/// ----------
/// cells : array_like of int, shape (height, width)
///     -1 unknown, 0 free to 100 occupied. Row 0 has the lowest y, column 0 the lowest x.
/// resolution_m : float
///     Side length of a cell [m].
/// origin : (x, y, yaw) or Pose
///     Pose of the lower left corner of cell (0, 0) in the map frame [m, rad].
///
/// Raises ``ValueError`` for values beyond int8, and for a wrong resolution, origin or size.
///
/// >>> import periplus
/// >>> grid = periplus.OccupancyGrid([[0, 0, 100], [-1, 0, 100]], 0.5)
/// >>> grid.cells.shape, grid.cells[0, 2].item()
/// ((2, 3), 100)
/// >>> grid.distances()[1].tolist()
/// [1.0, 0.5, 0.0]
#[pyclass(name = "OccupancyGrid", module = "periplus", frozen, eq)]
#[derive(PartialEq)]
pub(crate) struct PyOccupancyGrid(pub(crate) Arc<OccupancyGrid>);

#[pymethods]
impl PyOccupancyGrid {
    #[new]
    #[pyo3(signature = (cells, resolution_m, origin=None))]
    fn new(
        cells: &Bound<'_, PyAny>,
        resolution_m: f64,
        origin: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let origin =
            origin.map_or(Ok(Pose2::IDENTITY), |origin| pose2_argument(origin, "origin"))?;
        let cells = small_integers::<i8>(cells, "cells", -128, 127)?;
        let cells = input::<i8>(&cells, "cells", &[None, None])?;
        let (height, width) = (cells.shape()[0], cells.shape()[1]);
        let info = GridInfo::new(resolution_m, width, height, origin).map_err(value_error)?;
        Ok(Self(Arc::new(Grid { info, cells: cells.as_slice()?.to_vec() })))
    }

    /// Loads a map: the YAML file of a map of ROS 1 or ROS 2, or an image with ``resolution_m``.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     YAML file, or an image (PGM, PNG, BMP, JPEG).
    /// distro : str
    ///     ROS distribution whose map server interprets the pixels, such as "noetic", "humble", "jazzy".
    /// resolution_m : float, optional
    ///     Side length of a cell of an image without YAML file [m].
    ///
    /// Raises ``FileNotFoundError``, or ``FileError`` with file, line and column.
    ///
    /// >>> import pathlib, tempfile
    /// >>> import periplus
    /// >>> folder = pathlib.Path(tempfile.mkdtemp())
    /// >>> file = periplus.OccupancyGrid([[0, 100]], 0.5, (1, 2, 0)).save(folder / "room")
    /// >>> periplus.OccupancyGrid.load(file)
    /// OccupancyGrid(1 x 2 cells of 0.5 m, origin (1.0, 2.0, 0.0))
    #[staticmethod]
    #[pyo3(signature = (path, distro="jazzy", resolution_m=None))]
    fn load(
        py: Python<'_>,
        path: PathBuf,
        distro: &str,
        resolution_m: Option<f64>,
    ) -> PyResult<Self> {
        let distro = distro_named(distro)?;
        require_file(&path)?;
        let Some(text) = path.to_str() else {
            return Err(PyValueError::new_err("the path is not Unicode"));
        };
        let loaded: Loaded = released(py, "loading a map", || match resolution_m {
            None => load(text, distro, &Machine),
            Some(resolution_m) => load_image(text, resolution_m, distro, &Machine),
        })?;
        require_no_errors(py, &loaded.diagnostics, &loaded.sources)?;
        let map = loaded.map.ok_or_else(|| file_error(py, &path, "the map cannot be read"))?;
        Ok(Self(Arc::new(map.grid)))
    }

    /// Saves the map as ``<path>.yaml`` and an image beside it, byte for byte like the map saver of a distribution,
    /// and returns the path of the YAML file.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     Path without extension; a given ``.yaml`` is dropped.
    /// distro : str
    ///     ROS distribution whose map saver is reproduced.
    /// mode : {"trinary", "scale", "raw"}
    ///     Meaning of the pixels. Trinary keeps only occupied, free and unknown.
    /// image_format : {"pgm", "png", "bmp"}
    ///     Format of the image; default: that of the map saver for the mode.
    /// occupied_thresh, free_thresh : float, optional
    ///     Thresholds, 0 to 1; default: those of the map saver.
    ///
    /// >>> import pathlib, tempfile
    /// >>> import periplus
    /// >>> folder = pathlib.Path(tempfile.mkdtemp())
    /// >>> periplus.OccupancyGrid([[0, 100]], 0.5).save(folder / "room", image_format="png").name
    /// 'room.yaml'
    #[pyo3(signature = (path, distro="jazzy", mode="trinary", image_format=None, occupied_thresh=None,
                        free_thresh=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn save(
        &self,
        py: Python<'_>,
        path: PathBuf,
        distro: &str,
        mode: &str,
        image_format: Option<&str>,
        occupied_thresh: Option<f64>,
        free_thresh: Option<f64>,
    ) -> PyResult<Py<PyAny>> {
        let distro = distro_named(distro)?;
        let words = |all: &[&str]| all.join(", ");
        if Mode::from_name(mode).is_none() {
            let names = Mode::ALL.map(Mode::name);
            let known = words(&names);
            return Err(PyValueError::new_err(format!(
                "`mode` must be one of {known}, not {mode:?}"
            )));
        }
        if let Some(format) = image_format.filter(|name| Format::from_name(name).is_none()) {
            return Err(PyValueError::new_err(format!(
                "`image_format` must be one of pgm, png, bmp, not {format:?}"
            )));
        }
        let path = match path.extension().and_then(|it| it.to_str()) {
            Some("yaml" | "yml") => path.with_extension(""),
            _ => path,
        };
        let name = path.to_str().filter(|name| !name.is_empty());
        let name = name.ok_or_else(|| PyValueError::new_err("`path` is empty or not Unicode"))?;
        let wish = Wish {
            name: name.to_owned(),
            image_format: image_format.unwrap_or_default().to_owned(),
            mode: mode.to_owned(),
            occupied_thresh: occupied_thresh.unwrap_or_default(),
            free_thresh: free_thresh.unwrap_or_default(),
        };
        let (saving, _) = wish.settle(distro, unix_ns() / 1_000_000_000).map_err(value_error)?;
        let written = released(py, "saving a map", || {
            let files = render(&self.0, &saving);
            let write = |path: &str, bytes: &[u8]| {
                Machine.replace(path.as_ref(), bytes).map_err(|error| format!("{path}: {error}"))
            };
            write(&files.image_path, &files.image)?;
            write(&files.yaml_path, files.yaml.as_bytes())?;
            Ok::<_, String>(files.yaml_path)
        })?;
        let yaml_path = written.map_err(PyOSError::new_err)?;
        Ok(py.import("pathlib")?.getattr("Path")?.call1((yaml_path,))?.unbind())
    }

    /// Occupancy values: int8, shape (height, width), read-only, without a copy. -1 unknown, 0 free to 100 occupied.
    #[getter]
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let grid = Arc::clone(&self.0);
        let values = (grid.cells.as_ptr(), grid.cells.len());
        let shape = [grid.info.height, grid.info.width];
        shared(py, grid, values, &shape)
    }

    /// Side length of a cell [m].
    #[getter]
    fn resolution_m(&self) -> f64 {
        self.0.info.resolution_m
    }

    /// Pose of the lower left corner of cell (0, 0) in the map frame: x [m], y [m], yaw [rad].
    #[getter]
    fn origin(&self) -> (f64, f64, f64) {
        let Pose2 { x_m, y_m, yaw_rad } = self.0.info.origin;
        (x_m, y_m, yaw_rad)
    }

    /// Number of columns.
    #[getter]
    fn width(&self) -> usize {
        self.0.info.width
    }

    /// Number of rows.
    #[getter]
    fn height(&self) -> usize {
        self.0.info.height
    }

    /// The grid with cells free (0), occupied (100) and unknown (-1) only, by Nav2's thresholds of a probability.
    ///
    /// >>> import periplus
    /// >>> periplus.OccupancyGrid([[10, 40, 90, -1]], 0.5).trinary().cells.tolist()
    /// [[0, -1, 100, -1]]
    #[pyo3(signature = (*, occupied_thresh=0.65, free_thresh=0.25))]
    fn trinary(&self, occupied_thresh: f64, free_thresh: f64) -> PyResult<Self> {
        if !(0.0 <= free_thresh && free_thresh < occupied_thresh && occupied_thresh <= 1.0) {
            return Err(PyValueError::new_err(
                "the thresholds must be 0 <= `free_thresh` < `occupied_thresh` <= 1",
            ));
        }
        let mut grid = OccupancyGrid::clone(&self.0);
        for cell in &mut grid.cells {
            let probability = f64::from(*cell) / 100.0;
            *cell = match *cell {
                ..0 => -1,
                _ if probability >= occupied_thresh => 100,
                _ if probability <= free_thresh => 0,
                _ => -1,
            };
        }
        Ok(Self(Arc::new(grid)))
    }

    /// Centres of cells in the map frame [m]: shape (..., 2) of x, y for (..., 2) of column, row. Fractions and cells
    /// outside the grid are allowed.
    ///
    /// >>> import periplus
    /// >>> grid = periplus.OccupancyGrid([[0, 0]], 0.5, (10, 0, 0))
    /// >>> grid.world_from_cell([1, 0]).tolist()
    /// [10.75, 0.25]
    fn world_from_cell<'py>(&self, cells: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let array = pairs(cells, "cells")?;
        let info = self.0.info;
        let (cells_of, _) = array.as_slice()?.as_chunks::<2>();
        let point = |[column, row]: &[f64; 2]| {
            let (x_m, y_m) = info.point_at(column + 0.5, row + 0.5);
            [x_m, y_m]
        };
        let points: Vec<f64> = cells_of.iter().flat_map(point).collect();
        Ok(moved(cells.py(), points, array.shape())?.into_any())
    }

    /// Cells of points of the map frame [m]: int64, shape (..., 2) of column, row for (..., 2) of x, y; (-1, -1) for
    /// points outside the grid. Index with ``cells[row, column]``.
    ///
    /// >>> import periplus
    /// >>> grid = periplus.OccupancyGrid([[0, 0]], 0.5, (10, 0, 0))
    /// >>> grid.cell_from_world([[10.6, 0.1], [9.0, 0.0]]).tolist()
    /// [[1, 0], [-1, -1]]
    fn cell_from_world<'py>(&self, points: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let array = pairs(points, "points")?;
        let finder = self.0.info.finder();
        let (points_of, _) = array.as_slice()?.as_chunks::<2>();
        let whole = |count: usize| i64::try_from(count).unwrap_or(-1);
        let cell = |[x_m, y_m]: &[f64; 2]| match finder.cell_of(*x_m, *y_m) {
            Some((column, row)) => [whole(column), whole(row)],
            None => [-1, -1],
        };
        let cells: Vec<i64> = points_of.iter().flat_map(cell).collect();
        Ok(moved(points.py(), cells, array.shape())?.into_any())
    }

    /// Exact distances of the cell centres to the centre of the nearest occupied cell [m]: float64, shape (height,
    /// width); inf without any. ``occupied_thresh`` is the lowest occupancy of occupied cells, 0 to 1, as in map files.
    ///
    /// Source: Meijster, Roerdink, Hesselink, "A general algorithm for computing distance transforms in linear time",
    /// 2000.
    ///
    /// >>> import periplus
    /// >>> periplus.OccupancyGrid([[100, 0, 0]], 0.1).distances().round(3).tolist()
    /// [[0.0, 0.1, 0.2]]
    #[pyo3(signature = (occupied_thresh=0.65))]
    fn distances<'py>(&self, py: Python<'py>, occupied_thresh: f64) -> PyResult<Bound<'py, PyAny>> {
        if !(0.0..=1.0).contains(&occupied_thresh) {
            return Err(PyValueError::new_err("`occupied_thresh` must be from 0 to 1"));
        }
        let GridInfo { resolution_m, width, height, .. } = self.0.info;
        let distances = released(py, "the distances", || {
            let squares =
                squared_distances(&self.0, |cell| f64::from(*cell) >= 100.0 * occupied_thresh);
            let metres = |square: &u32| match *square {
                NO_SITE_CELLS => f64::INFINITY,
                square => f64::from(square).sqrt() * resolution_m,
            };
            squares.cells.iter().map(metres).collect()
        })?;
        Ok(moved::<f64>(py, distances, &[height, width])?.into_any())
    }

    /// Compares another map with this one.
    ///
    /// Parameters
    /// ----------
    /// other : OccupancyGrid
    ///     Map to compare, of any resolution.
    /// align : bool
    ///     Aligns the other map first; False uses the origins.
    /// window_m, window_rad : float, optional
    ///     Largest translation [m] and rotation [rad] of the alignment.
    ///
    /// >>> import numpy as np
    /// >>> import periplus
    /// >>> cells = np.zeros((20, 20), np.int8)
    /// >>> cells[5] = 100
    /// >>> room = periplus.OccupancyGrid(cells, 0.1)
    /// >>> room.diff(room, align=False).walls["iou"]
    /// 1.0
    #[pyo3(signature = (other, align=true, window_m=None, window_rad=None))]
    fn diff(
        &self,
        py: Python<'_>,
        other: &Self,
        align: bool,
        window_m: Option<f64>,
        window_rad: Option<f64>,
    ) -> PyResult<PyMapComparison> {
        let mut options = CompareOptions { align, ..CompareOptions::default() };
        options.window_m = window_m.unwrap_or(options.window_m);
        options.window_rad = window_rad.unwrap_or(options.window_rad);
        for (name, value) in [("window_m", options.window_m), ("window_rad", options.window_rad)] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(PyValueError::new_err(format!(
                    "`{name}` must be finite and at least 0"
                )));
            }
        }
        let (first, second) = (&self.0, &other.0);
        let found = released(py, "the comparison", || compare(first, second, options))?;
        Ok(PyMapComparison(found.map_err(value_error)?))
    }

    /// PNG for notebooks: white free, black occupied, grey unknown.
    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        if self.0.info.is_empty() {
            return Ok(None);
        }
        let png = released(py, "the picture", || picture::draw(&self.0, &[], &[]))?;
        Ok(Some(PyBytes::new(py, &png)))
    }

    /// Picture and size for notebooks.
    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let GridInfo { resolution_m, .. } = self.0.info;
        let (width_m, height_m) = self.0.info.size_m();
        let text = format!("{width_m:.2} m x {height_m:.2} m, cells of {resolution_m} m");
        html_picture(py, self._repr_png_(py)?, &text)
    }

    fn __repr__(&self) -> String {
        let GridInfo { resolution_m, width, height, origin } = self.0.info;
        let Pose2 { x_m, y_m, yaw_rad } = origin;
        format!(
            "OccupancyGrid({height} x {width} cells of {resolution_m} m, origin ({x_m:?}, {y_m:?}, {yaw_rad:?}))"
        )
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let (py, own) = (slf.py(), slf.get());
        let cells = own.cells(py)?.call_method0("copy")?;
        let state = (cells, own.resolution_m(), own.origin()).into_pyobject(py)?.into_any();
        Ok((slf.get_type().into_any(), state))
    }
}

/// Tag with a picture that shows its cells, and a line of text.
pub(crate) fn html_picture(
    py: Python<'_>,
    png: Option<Bound<'_, PyBytes>>,
    text: &str,
) -> PyResult<String> {
    let Some(png) = png else { return Ok(format!("<div>{text}</div>")) };
    let encoded = py.import("base64")?.call_method1("b64encode", (png,))?;
    let encoded: String = encoded.call_method1("decode", ("ascii",))?.extract()?;
    Ok(format!(
        "<div><img src=\"data:image/png;base64,{encoded}\" style=\"image-rendering: pixelated; \
         min-width: 300px; max-width: 100%\"/><br/>{text}</div>"
    ))
}

/// Argument as an array of small integers, of which none is cut off.
pub(crate) fn small_integers<'py, T: numpy::Element>(
    argument: &Bound<'py, PyAny>,
    name: &str,
    min: i64,
    max: i64,
) -> PyResult<Bound<'py, PyAny>> {
    if argument.cast::<PyArrayDyn<T>>().is_ok() {
        return Ok(argument.clone());
    }
    let numpy = argument.py().import(pyo3::intern!(argument.py(), "numpy"))?;
    let array = numpy.getattr("asarray")?.call1((argument,))?;
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
    let size: usize = array.getattr("size")?.extract()?;
    if size == 0 {
        return Ok(array);
    }
    if !matches!(kind.as_str(), "i" | "u") {
        let kind = array.getattr("dtype")?;
        return Err(PyTypeError::new_err(format!("`{name}` must be integers, not {kind}")));
    }
    let low: i128 = array.call_method0("min")?.extract()?;
    let high: i128 = array.call_method0("max")?.extract()?;
    if low < i128::from(min) || high > i128::from(max) {
        return Err(PyValueError::new_err(format!(
            "`{name}` must be from {min} to {max}; it has {}",
            if low < i128::from(min) { low } else { high }
        )));
    }
    Ok(array)
}

fn pairs<'py>(
    argument: &Bound<'py, PyAny>,
    name: &str,
) -> PyResult<numpy::PyReadonlyArrayDyn<'py, f64>> {
    let array = contiguous::<f64>(argument, name)?;
    if array.shape().last() == Some(&2) {
        return Ok(array);
    }
    Err(PyValueError::new_err(format!(
        "`{name}` must have the shape (..., 2), not {:?}",
        array.shape()
    )))
}

fn distro_named(name: &str) -> PyResult<Distro> {
    Distro::from_name(name).ok_or_else(|| {
        PyValueError::new_err(format!(
            "`distro` must be a ROS distribution such as noetic, humble or jazzy, not {name:?}"
        ))
    })
}

/// Entries of a dictionary of numbers.
fn dictionary<'py, const N: usize>(
    py: Python<'py>,
    entries: [(&str, f64); N],
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    for (name, value) in entries {
        found.set_item(name, value)?;
    }
    Ok(found)
}
