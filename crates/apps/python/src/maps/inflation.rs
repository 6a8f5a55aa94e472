//! Inflation of a grid of costs.

use numpy::PyUntypedArrayMethods as _;
use periplus::costmap::inflation::{self, CostTable, InflationBuffers, InflationSettings};
use periplus::costmap::tables::InflationLayerParams;
use periplus::costmap::{CellWindow, Costmap, Nav2Release};
use periplus::geometry::Pose2;
use periplus::grid::GridInfo;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::small_integers;
use crate::arrays::{input, moved};
use crate::errors::value_error;
use crate::work::released;

/// Inflates costs as the inflation layer of Nav2 does, with exact Euclidean distances.
///
/// Parameters
/// ----------
/// costs : array_like of int, shape (height, width)
///     0 free to 252, 253 inscribed, 254 lethal, 255 unknown. Lethal cells are inflated.
/// resolution_m : float
///     Side length of a cell [m].
/// inscribed_radius_m : float
///     Radius of the largest circle inside the footprint [m]: cells that near get 253.
/// inflation_radius : float, optional
///     Distance up to which costs are set [m]; default: that of the layer.
/// cost_scaling_factor : float, optional
///     Exponential decay rate of the cost [1/m]; default: that of the layer.
/// inflate_unknown, inflate_around_unknown : bool
///     Sets costs in unknown cells; inflates unknown cells like obstacles.
///
/// Returns a new uint8 array of the same shape: the maximum of the costs and ``252 exp(-cost_scaling_factor (d -
/// inscribed_radius_m))`` at the distance d. Source: ``nav2_costmap_2d::InflationLayer``.
///
/// >>> import numpy as np
/// >>> import periplus
/// >>> costs = np.zeros((1, 5), np.uint8)
/// >>> costs[0, 0] = 254
/// >>> periplus.inflate(costs, 0.1, 0.1, inflation_radius=0.3, cost_scaling_factor=10.0).tolist()
/// [[254, 253, 92, 34, 0]]
#[pyfunction]
#[pyo3(signature = (costs, resolution_m, inscribed_radius_m, inflation_radius=None, cost_scaling_factor=None,
                    inflate_unknown=false, inflate_around_unknown=false))]
pub(super) fn inflate<'py>(
    costs: &Bound<'py, PyAny>,
    resolution_m: f64,
    inscribed_radius_m: f64,
    inflation_radius: Option<f64>,
    cost_scaling_factor: Option<f64>,
    inflate_unknown: bool,
    inflate_around_unknown: bool,
) -> PyResult<Bound<'py, PyAny>> {
    let py = costs.py();
    let defaults = InflationLayerParams::default();
    let radius_m = inflation_radius.unwrap_or(defaults.inflation_radius_m);
    let factor = cost_scaling_factor.unwrap_or(defaults.cost_scaling_factor);
    for (name, value) in [
        ("inscribed_radius_m", inscribed_radius_m),
        ("inflation_radius", radius_m),
        ("cost_scaling_factor", factor),
    ] {
        if !(value.is_finite() && value >= 0.0) {
            return Err(PyValueError::new_err(format!("`{name}` must be finite and at least 0")));
        }
    }
    let costs = small_integers::<u8>(costs, "costs", 0, 255)?;
    let costs = input::<u8>(&costs, "costs", &[None, None])?;
    let (height, width) = (costs.shape()[0], costs.shape()[1]);
    let info = GridInfo::new(resolution_m, width, height, Pose2::IDENTITY).map_err(value_error)?;
    let values = costs.as_slice()?;
    let inflated = released(py, "inflation", || {
        let mut costmap = Costmap::new(info, 0);
        costmap.costs_mut().copy_from_slice(values);
        let release = Nav2Release::default();
        let table = CostTable::new(resolution_m, radius_m, inscribed_radius_m, factor, release);
        let how = InflationSettings {
            into_unknown: inflate_unknown,
            around_unknown: inflate_around_unknown,
        };
        let window = CellWindow::all(&info);
        inflation::inflate(&mut costmap, &window, &table, how, &mut InflationBuffers::default());
        costmap.costs().to_vec()
    })?;
    Ok(moved(py, inflated, &[height, width])?.into_any())
}
