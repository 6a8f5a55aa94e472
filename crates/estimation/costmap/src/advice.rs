//! Statistics about dropped points of a source, with the parameter responsible.

use std::any::Any;
use std::fmt;

use periplus_diagnostics::Severity;

use crate::{Counters, Layer, LayeredCostmap, ObservationSource};

/// Number of points of a source with one result, and the parameter that causes it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Advice {
    /// Source, as `layer.source`.
    pub source: String,
    /// Number of points or messages with this result.
    pub count: u64,
    /// Total number of points or messages.
    pub of: u64,
    /// Result, such as "were too near to mark".
    pub what: &'static str,
    /// Full name of the parameter.
    pub parameter: String,
    /// Suggested remedy.
    pub help: &'static str,
    /// A hint for what is normal, an error when no point is left for marking or clearing.
    pub severity: Severity,
}

impl LayeredCostmap {
    /// Returns advice about dropped points for all sources.
    #[must_use]
    pub fn advice(&self) -> Vec<Advice> {
        let of_layer = |layer: &dyn Layer| {
            let sources = layer.sources().iter();
            sources.flat_map(|source| advice(layer, source, &source.counters)).collect::<Vec<_>>()
        };
        self.all().flat_map(of_layer).collect()
    }

    /// Returns advice for one source, for the points after `before`.
    #[must_use]
    pub fn advice_since(&self, layer: &str, source: &str, before: &Counters) -> Vec<Advice> {
        let layer = self.all().find(|found| found.name() == layer);
        let found = layer.and_then(|layer| {
            let source = layer.sources().iter().find(|found| found.name == source)?;
            Some(advice(layer, source, &source.counters.since(before)))
        });
        found.unwrap_or_default()
    }
}

/// Severity of losing a share of the points.
enum Loss {
    /// Normal for every sensor.
    Usual,
    /// Normal unless no point is left.
    UsualInPart,
    /// Parameters and sensor do not match when it concerns more than half of the points.
    Doubtful,
    /// Always an error.
    Wrong,
}

impl Loss {
    fn severity(&self, count: u64, of: u64) -> Severity {
        let is_all = count >= of;
        match self {
            Self::Usual => Severity::Hint,
            Self::UsualInPart if is_all => Severity::Warning,
            Self::UsualInPart => Severity::Hint,
            Self::Doubtful | Self::Wrong if is_all => Severity::Error,
            Self::Doubtful if count <= of / 2 => Severity::Hint,
            Self::Doubtful | Self::Wrong => Severity::Warning,
        }
    }
}

/// Returns the results for the points of a source, most frequent first.
fn advice(layer: &dyn Layer, source: &ObservationSource, counters: &Counters) -> Vec<Advice> {
    let is_voxel = (layer as &dyn Any).is::<crate::layers::VoxelLayer>();
    let own = |name: &str| format!("{}.{}.{name}", layer.name(), source.name);
    let above = |name: &str| format!("{}.{name}", layer.name());
    let points = counters.points;
    let messages = counters.messages();
    let rows = [
        (
            counters.too_high,
            points,
            Loss::Doubtful,
            "were above `max_obstacle_height` of the source, for marking and clearing",
            own("max_obstacle_height"),
            "it is measured in the global frame and is 0 unless set; set it to the robot's height",
        ),
        (
            counters.too_low,
            points,
            Loss::Doubtful,
            "were below `min_obstacle_height` of the source, for marking and clearing",
            own("min_obstacle_height"),
            "lower it a little if the floor is not level",
        ),
        (
            counters.layer_too_high,
            points,
            Loss::UsualInPart,
            "were above the heights that the layer marks",
            above(if is_voxel { "z_voxels" } else { "max_obstacle_height" }),
            "raise `max_obstacle_height`, and for voxels `z_voxels` or `z_resolution`",
        ),
        (
            counters.layer_too_low,
            points,
            Loss::UsualInPart,
            "were below the heights that the layer marks",
            above("min_obstacle_height"),
            "lower it a little if the floor is not level",
        ),
        (
            counters.too_far,
            points,
            Loss::Usual,
            "were too far away to mark",
            own("obstacle_max_range"),
            "raise it, and `raytrace_max_range` beyond it",
        ),
        (
            counters.too_near,
            points,
            Loss::UsualInPart,
            "were too near to mark",
            own("obstacle_min_range"),
            "lower it if they are not part of the robot",
        ),
        (
            counters.outside,
            points,
            Loss::Usual,
            "were outside the costmap",
            "width".to_owned(),
            "enlarge the costmap to use them",
        ),
        (
            counters.not_finite,
            points,
            Loss::UsualInPart,
            "were NaN or infinite",
            own("topic"),
            "clouds have no points without a return; nothing is cleared there",
        ),
        (
            if source.settings.inf_is_valid { 0 } else { counters.without_return },
            points + counters.without_return,
            Loss::UsualInPart,
            "had no return and cleared nothing",
            own("inf_is_valid"),
            "with `true`, infinite ranges clear up to `raytrace_max_range`",
        ),
        (
            counters.without_frame,
            messages,
            Loss::Wrong,
            "messages had a frame without a transform to the global frame",
            own("sensor_frame"),
            "start what publishes the frame (robot_state_publisher, a static transform, odometry)",
        ),
        (
            counters.out_of_time,
            messages,
            Loss::Wrong,
            "messages had a stamp without a transform",
            "use_sim_time".to_owned(),
            "check that all nodes use the same clock, and that transforms are published at the rate of the messages",
        ),
        (
            counters.malformed,
            messages,
            Loss::Wrong,
            "messages were malformed",
            own("data_type"),
            "check that the topic has the type in `data_type`",
        ),
        (
            counters.sensor_outside,
            counters.clouds,
            Loss::Wrong,
            "messages were from a sensor outside the costmap",
            if is_voxel { above("origin_z") } else { own("sensor_frame") },
            "a sensor above or beside the grid clears nothing",
        ),
    ];
    let mut found: Vec<Advice> = rows
        .into_iter()
        .filter(|row| row.0 > 0)
        .map(|(count, of, loss, what, parameter, help)| Advice {
            source: format!("{}.{}", layer.name(), source.name),
            count,
            of,
            what,
            parameter,
            help,
            severity: loss.severity(count, of),
        })
        .collect();
    found.sort_by_key(|advice| std::cmp::Reverse(advice.count));
    found
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { source, count, of, what, parameter, help, .. } = self;
        write!(f, "{source}: {count} of {of} {what} (`{parameter}`): {help}")
    }
}
