//! Simple smoother: relaxation on a costmap.

use periplus_costmap::CostmapView;
use periplus_costmap::cost::{MAX_NON_OBSTACLE, UNKNOWN};
use periplus_geometry::Pose2;
use periplus_params::{ParamValue, ParamValues};

use super::relaxation::{Relaxation, Relaxed, relax};
use super::segments::{directional_segments, is_reversing, set_yaws_along};
use super::{SmoothError, SmoothRequest, Smoother, poses};
use crate::ParameterRejected;
use crate::parameters::{ChangeRules, ParameterStore};
use crate::tables::{SIMPLE_SMOOTHER, SimpleSmootherParams};

/// Minimum number of poses of a part that is smoothed.
const MIN_POSE_COUNT: usize = 5;

const RULES: ChangeRules = ChangeRules {
    fixed: &[
        "tolerance",
        "max_its",
        "w_data",
        "w_smooth",
        "do_refinement",
        "refinement_num",
        "enforce_path_inversion",
    ],
    allows_zero: true,
    unlimited: &[],
};

/// The smoother `nav2_smoother::SimpleSmoother`.
#[derive(Debug)]
pub struct SimpleSmoother {
    store: ParameterStore,
    params: SimpleSmootherParams,
}

impl Default for SimpleSmoother {
    fn default() -> Self {
        Self::new(ParamValues::defaults(&SIMPLE_SMOOTHER))
    }
}

impl SimpleSmoother {
    /// Creates a smoother with values of [`crate::tables::SIMPLE_SMOOTHER`].
    #[must_use]
    pub fn new(values: ParamValues) -> Self {
        let params = SimpleSmootherParams::from_values(&values);
        Self { store: ParameterStore::new(values, &RULES), params }
    }

    fn relaxation(&self) -> Relaxation {
        let SimpleSmootherParams { w_data, w_smooth, tolerance_m, max_its, .. } = self.params;
        let refinement_count =
            if self.params.do_refinement { self.params.refinement_num } else { 0 };
        Relaxation {
            data_weight: w_data,
            smooth_weight: w_smooth,
            tolerance_m,
            max_pass_count: max_its,
            refinement_count,
        }
    }
}

/// Returns true if no inner pose is in a collision; unknown cells and those outside the costmap are free.
fn is_free(costmap: Option<&CostmapView<'_>>, path: &[Pose2]) -> bool {
    let Some(costmap) = costmap else { return true };
    let inner = path.get(1..path.len().saturating_sub(1)).unwrap_or_default();
    inner.iter().all(|pose| {
        let cost = costmap.costs.cost_at(pose.x_m, pose.y_m);
        cost.is_none_or(|cost| cost <= MAX_NON_OBSTACLE || cost == UNKNOWN)
    })
}

impl Smoother for SimpleSmoother {
    fn smooth(&mut self, request: SmoothRequest<'_>) -> Result<Vec<Pose2>, SmoothError> {
        let mut path = poses(request.path)?.to_vec();
        let segments = if self.params.enforce_path_inversion {
            directional_segments(&path)
        } else {
            std::iter::once(0..path.len()).collect()
        };
        let how = self.relaxation();
        for segment in segments.into_iter().filter(|segment| segment.len() >= MIN_POSE_COUNT) {
            let part = &mut path[segment];
            let is_reversing = is_reversing(part, false);
            let mut is_admissible = |path: &[Pose2]| is_free(request.costmap.as_ref(), path);
            let end = relax(part, &how, &mut is_admissible, request.is_out_of_time);
            if end == Relaxed::OutOfTime {
                return Err(SmoothError::timeout());
            }
            set_yaws_along(part, is_reversing);
        }
        Ok(path)
    }

    fn set_parameter(&mut self, name: &str, value: &ParamValue) -> Result<(), ParameterRejected> {
        self.store.change(name, value)
    }
}
