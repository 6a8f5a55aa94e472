//! Planners that are classes of Python.

use std::sync::Arc;

use periplus::nav_nodes::navigation_plugins::NavigationPlugins;
use periplus::params::ParamValue;
use periplus::planners::{
    ParameterRejected, PlanError, PlanErrorKind, PlanRequest, PlannedPath, Planner,
};
use pyo3::prelude::*;

use super::costmap_view::PyCostmapView;
use super::plugin::{Factory, Raised, call, create, poses, tuple};

/// Exception with which a planner reports that there is no path.
const NO_VALID_PATH: &str = "NoValidPath";

/// Registers a class of planners.
pub(super) fn add(
    plugins: NavigationPlugins,
    class: &str,
    factory: &Factory,
    raised: &Raised,
) -> NavigationPlugins {
    let (factory, raised) = (Arc::clone(factory), raised.clone());
    plugins.planner(class, move |setup, diagnostics| {
        let object = create(&factory, setup, "plan", &raised, diagnostics)?;
        Some(Box::new(PythonPlanner { object, raised: raised.clone() }))
    })
}

struct PythonPlanner {
    object: Py<PyAny>,
    raised: Raised,
}

impl Planner for PythonPlanner {
    fn plan(&mut self, request: PlanRequest<'_>) -> Result<PlannedPath, PlanError> {
        let planned = call(&self.raised, |py| {
            let costmap = PyCostmapView::new(py, &request.costmap)?;
            let arguments = (costmap, tuple(request.start), tuple(request.goal));
            poses(&self.object.bind(py).call_method1("plan", arguments)?, "path")
        });
        let poses = planned.map_err(|error| {
            if error.class == NO_VALID_PATH {
                return PlanError::new(PlanErrorKind::NoValidPath, error.text);
            }
            PlanError::new(PlanErrorKind::Unknown, error.to_string())
        })?;
        Ok(PlannedPath { poses, ..PlannedPath::default() })
    }

    fn set_parameter(&mut self, name: &str, _: &ParamValue) -> Result<(), ParameterRejected> {
        Err(ParameterRejected::Unknown(name.to_owned(), None))
    }
}
