//! Layers written in Python.

use std::sync::{Arc, Mutex};

use numpy::{PyArray1, PyArray2, PyArrayMethods as _, PyUntypedArrayMethods as _};
use periplus::costmap::{CellWindow, Costmap, Explanation, Layer, UpdateBounds, UpdateContext};
use periplus::grid::{Cell, GridInfo};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::work::lock;

/// First exception of the layers of a costmap in an update.
pub(super) type Failure = Arc<Mutex<Option<PyErr>>>;

/// Area of an update in the global frame, which a layer enlarges in ``update_bounds``.
///
/// >>> import periplus
/// >>> class Everywhere:
/// ...     def update_bounds(self, robot_x, robot_y, robot_yaw, bounds):
/// ...         bounds.touch(0.0, 0.0)
/// ...         bounds.touch(1.0, 2.0)
/// ...     def update_costs(self, costs, min_i, min_j, max_i, max_j):
/// ...         costs[min_j:max_j, min_i:max_i] = 100
/// >>> costmap = periplus.Costmap(width=5, height=5, resolution=0.5, plugins=[Everywhere()])
/// >>> costmap.update()
/// (0, 0, 3, 5)
#[pyclass(name = "UpdateBounds", module = "periplus", frozen)]
pub(super) struct PyUpdateBounds(Mutex<UpdateBounds>);

#[pymethods]
impl PyUpdateBounds {
    /// Enlarges the area to contain a point [m].
    fn touch(&self, x: f64, y: f64) -> PyResult<()> {
        if !(x.is_finite() && y.is_finite()) {
            return Err(PyValueError::new_err("a point of the bounds must be finite"));
        }
        lock(&self.0).touch(x, y);
        Ok(())
    }

    /// Enlarges the area to the whole costmap.
    fn touch_all(&self) {
        *lock(&self.0) = UpdateBounds::ALL;
    }

    /// Lowest x [m]; the largest float while the area is empty.
    #[getter]
    fn min_x(&self) -> f64 {
        lock(&self.0).min_x
    }

    /// Lowest y [m].
    #[getter]
    fn min_y(&self) -> f64 {
        lock(&self.0).min_y
    }

    /// Highest x [m].
    #[getter]
    fn max_x(&self) -> f64 {
        lock(&self.0).max_x
    }

    /// Highest y [m].
    #[getter]
    fn max_y(&self) -> f64 {
        lock(&self.0).max_y
    }

    fn __repr__(&self) -> String {
        let UpdateBounds { min_x, min_y, max_x, max_y } = *lock(&self.0);
        format!("UpdateBounds(min_x={min_x}, min_y={min_y}, max_x={max_x}, max_y={max_y})")
    }
}

/// Layer that calls an object of Python.
pub(super) struct PythonLayer {
    name: String,
    object: Py<PyAny>,
    has_bounds: bool,
    is_enabled: bool,
    failure: Failure,
    /// Array that the object sees in an update of a part, of the size of the costmap. The cells are copied in and out,
    /// so that an array that the object keeps is never memory of the costmap.
    costs: Option<Py<PyArray2<u8>>>,
}

impl PythonLayer {
    /// Fails with `TypeError` for an object without `update_costs`.
    pub(super) fn new(object: &Bound<'_, PyAny>, failure: Failure) -> PyResult<Self> {
        let is_method = |name: &str| object.getattr(name).is_ok_and(|method| method.is_callable());
        if object.is_instance_of::<pyo3::types::PyType>() || !is_method("update_costs") {
            return Err(PyTypeError::new_err(format!(
                "a layer is an object with `update_costs(costs, min_i, min_j, max_i, max_j)`, not {}",
                object.repr()?
            )));
        }
        let own_name = object.getattr("name").ok().and_then(|name| name.extract::<String>().ok());
        let name = match own_name.filter(|name| !name.is_empty()) {
            Some(name) => name,
            None => object.get_type().name()?.to_string(),
        };
        Ok(Self {
            name,
            has_bounds: is_method("update_bounds"),
            object: object.clone().unbind(),
            is_enabled: true,
            failure,
            costs: None,
        })
    }

    /// Calls the object, unless a layer of this update has failed already.
    fn call(&mut self, work: impl FnOnce(&mut Self, Python<'_>) -> PyResult<()>) {
        if lock(&self.failure).is_some() {
            return;
        }
        Python::attach(|py| {
            if let Err(error) = work(self, py) {
                let note = format!("in layer `{}` of the costmap", self.name);
                // Python 3.10 has no notes; the traceback shows the method all the same.
                let _ = error.value(py).call_method1("add_note", (note,));
                lock(&self.failure).get_or_insert(error);
            }
        });
    }

    fn update_costs(
        &mut self,
        py: Python<'_>,
        master: &mut Costmap,
        window: CellWindow,
    ) -> PyResult<()> {
        let GridInfo { width, height, .. } = *master.info();
        let CellWindow { x0, y0, xn, yn } = window;
        if (x0, y0, xn, yn) == (0, 0, width, height) {
            return self.update_all(py, master);
        }
        let known = self.costs.as_ref().map(|array| array.bind(py).clone());
        let array = match known.filter(|array| array.shape() == [height, width]) {
            Some(array) => array,
            None => {
                let array = PyArray2::zeros(py, [height, width], false);
                self.costs = Some(array.clone().unbind());
                array
            }
        };
        array.try_readwrite()?.as_slice_mut()?.copy_from_slice(master.costs());
        self.object
            .bind(py)
            .call_method1(pyo3::intern!(py, "update_costs"), (&array, x0, y0, xn, yn))?;
        let changed = array.try_readonly()?;
        let changed = changed.as_slice()?;
        let costs = master.costs_mut();
        if x0 == 0 && xn == width {
            let rows = y0 * width..yn * width;
            costs[rows.clone()].copy_from_slice(&changed[rows]);
            return Ok(());
        }
        for span in window.spans(width) {
            costs[span.clone()].copy_from_slice(&changed[span]);
        }
        Ok(())
    }
}

impl PythonLayer {
    /// Updates all cells: the memory of the costmap becomes that of the array, and the costmap gets a copy of what the
    /// object has made of it.
    fn update_all(&mut self, py: Python<'_>, master: &mut Costmap) -> PyResult<()> {
        let GridInfo { width, height, .. } = *master.info();
        let mut called = Ok(());
        master.replace_costs(|costs| {
            let array = PyArray1::from_vec(py, costs);
            called = array.reshape([height, width]).and_then(|costs| {
                let name = pyo3::intern!(py, "update_costs");
                self.object.bind(py).call_method1(name, (costs, 0, 0, width, height)).map(drop)
            });
            array.try_readonly().ok().and_then(|it| it.to_vec().ok()).unwrap_or_default()
        });
        called
    }
}

impl Layer for PythonLayer {
    fn name(&self) -> &str {
        &self.name
    }

    fn bounds(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds) {
        self.call(|layer, py| {
            let object = layer.object.bind(py);
            layer.is_enabled = match object.getattr_opt(pyo3::intern!(py, "enabled"))? {
                Some(enabled) => enabled.is_truthy()?,
                None => true,
            };
            if !layer.is_enabled {
                return Ok(());
            }
            if !layer.has_bounds {
                bounds.include(&UpdateBounds::of(&moment.info));
                return Ok(());
            }
            let area = Bound::new(py, PyUpdateBounds(Mutex::new(*bounds)))?;
            let robot = moment.robot;
            object.call_method1(
                pyo3::intern!(py, "update_bounds"),
                (robot.x_m, robot.y_m, robot.yaw_rad, &area),
            )?;
            bounds.include(&lock(&area.get().0));
            Ok(())
        });
    }

    fn costs(&mut self, _moment: &UpdateContext<'_>, master: &mut Costmap, window: CellWindow) {
        if self.is_enabled && !window.is_empty() {
            self.call(|layer, py| layer.update_costs(py, master, window));
        }
    }

    fn reset(&mut self) {
        self.call(|layer, py| {
            match layer.object.bind(py).getattr_opt(pyo3::intern!(py, "reset"))? {
                Some(reset) if reset.is_callable() => reset.call0().map(drop),
                _ => Ok(()),
            }
        });
    }

    fn is_enabled(&self) -> bool {
        self.is_enabled
    }

    fn explain(&self, _master: &Costmap, _cell: Cell, _is_rolling: bool) -> Explanation {
        Explanation {
            reason: Some("a layer written in Python".to_owned()),
            ..Explanation::default()
        }
    }
}
