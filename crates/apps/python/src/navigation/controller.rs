//! Controllers that are classes of Python.

use std::sync::Arc;

use periplus::controllers::{ControlError, ControlInput, Controller};
use periplus::geometry::{Pose2, Twist2};
use periplus::nav_nodes::navigation_plugins::NavigationPlugins;
use pyo3::prelude::*;

use super::costmap_view::PyCostmapView;
use super::plugin::{Factory, PluginError, Raised, call, create, pose_array, tuple, velocity};

/// Exception with which a controller reports that no velocity is valid in this cycle.
const NO_VALID_CONTROL: &str = "NoValidControl";

/// Registers a class of controllers.
pub(super) fn add(
    plugins: NavigationPlugins,
    class: &str,
    factory: &Factory,
    raised: &Raised,
) -> NavigationPlugins {
    let (factory, raised) = (Arc::clone(factory), raised.clone());
    plugins.controller(class, move |setup, diagnostics| {
        let object = create(&factory, setup, "compute", &raised, diagnostics)?;
        Some(Box::new(PythonController { object, failure: None, raised: raised.clone() }))
    })
}

struct PythonController {
    object: Py<PyAny>,
    /// Exception of a method other than `compute`, which the next cycle reports.
    failure: Option<PluginError>,
    raised: Raised,
}

impl PythonController {
    /// Calls a method if the object has it.
    fn notify(
        &mut self,
        work: impl for<'py> FnOnce(Python<'py>, &Bound<'py, PyAny>) -> PyResult<()>,
    ) {
        let called = call(&self.raised, |py| work(py, self.object.bind(py)));
        if let Err(error) = called {
            self.failure.get_or_insert(error);
        }
    }
}

impl Controller for PythonController {
    fn compute_velocity(&mut self, input: &ControlInput<'_>) -> Result<Twist2, ControlError> {
        if let Some(error) = self.failure.take() {
            return Err(ControlError::Unknown(error.to_string()));
        }
        let computed = call(&self.raised, |py| {
            let measured = input.velocity;
            let arguments = (
                PyCostmapView::new(py, &input.costmap)?,
                tuple(input.pose),
                (measured.vx_m_s, measured.vy_m_s, measured.wz_rad_s),
                pose_array(py, input.plan)?,
                tuple(input.goal),
            );
            velocity(&self.object.bind(py).call_method1("compute", arguments)?)
        });
        computed.map_err(|error| {
            if error.class == NO_VALID_CONTROL {
                return ControlError::NoValidControl(error.text);
            }
            ControlError::Unknown(error.to_string())
        })
    }

    fn set_plan(&mut self, plan: &[Pose2]) {
        self.notify(|py, object| match object.getattr_opt("set_plan")? {
            Some(method) => method.call1((pose_array(py, plan)?,)).map(drop),
            None => Ok(()),
        });
    }

    fn set_speed_limit(&mut self, limit: f64, is_percentage: bool) {
        self.notify(|_, object| match object.getattr_opt("set_speed_limit")? {
            Some(method) => method.call1((limit, is_percentage)).map(drop),
            None => Ok(()),
        });
    }

    fn reset(&mut self) {
        self.notify(|_, object| match object.getattr_opt("reset")? {
            Some(method) => method.call0().map(drop),
            None => Ok(()),
        });
    }
}
