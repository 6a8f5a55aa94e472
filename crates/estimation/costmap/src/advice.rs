//! What becomes of the points of a source, and the parameter that decides it.

use std::any::Any;
use std::fmt;

use periplus_diagnostics::Severity;

use crate::{Counters, Layer, LayeredCostmap, Source};

/// Where points of a source go, and the parameter that sends them there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Advice {
    /// The source, as `layer.source`.
    pub source: String,
    /// How many points, or messages, it concerns.
    pub count: u64,
    /// Of how many.
    pub of: u64,
    /// What happened to them.
    pub what: &'static str,
    /// The parameter, with all that goes before its name.
    pub parameter: String,
    /// What to do.
    pub help: &'static str,
    /// A hint for what happens everywhere, an error when nothing is left to mark or clear with.
    pub severity: Severity,
}

impl LayeredCostmap {
    /// What to do about points that get lost, for all sources.
    #[must_use]
    pub fn advice(&self) -> Vec<Advice> {
        let of_layer = |layer: &dyn Layer| {
            let sources = layer.sources().iter();
            sources.flat_map(|source| advice(layer, source, &source.counters)).collect::<Vec<_>>()
        };
        self.all().flat_map(of_layer).collect()
    }

    /// The same for one source, for points that it got after its counters stood so.
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

/// How bad it is to lose a share of what comes.
enum Loss {
    /// Every sensor loses some so.
    Usual,
    /// Unless nothing is left.
    UsualInPart,
    /// Parameters and sensor do not fit when it is more than half.
    Doubtful,
    /// It should never happen.
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

/// What happened to the points of a source, the most first.
fn advice(layer: &dyn Layer, source: &Source, counters: &Counters) -> Vec<Advice> {
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
            "were above the source's greatest height, for marking and clearing",
            own("max_obstacle_height"),
            "it is measured in the global frame and is 0 unless set; set it to the robot's height",
        ),
        (
            counters.too_low,
            points,
            Loss::Doubtful,
            "were below the source's least height, for marking and clearing",
            own("min_obstacle_height"),
            "lower it a little if the floor is not level",
        ),
        (
            counters.layer_too_high,
            points,
            Loss::UsualInPart,
            "were above what the layer marks",
            above(if is_voxel { "z_voxels" } else { "max_obstacle_height" }),
            "raise `max_obstacle_height`, and for voxels `z_voxels` or `z_resolution`",
        ),
        (
            counters.layer_too_low,
            points,
            Loss::UsualInPart,
            "were below what the layer marks",
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
            "lower it if they are no part of the robot",
        ),
        (
            counters.outside,
            points,
            Loss::Usual,
            "were beside the costmap",
            "width".to_owned(),
            "enlarge the costmap if they should count",
        ),
        (
            counters.not_finite,
            points,
            Loss::UsualInPart,
            "were no numbers",
            own("topic"),
            "clouds have no points without a return; nothing is cleared there",
        ),
        (
            if source.settings.inf_is_valid { 0 } else { counters.without_return },
            points + counters.without_return,
            Loss::UsualInPart,
            "had no return, and cleared nothing",
            own("inf_is_valid"),
            "with `true`, infinite ranges clear up to the largest range",
        ),
        (
            counters.without_frame,
            messages,
            Loss::Wrong,
            "messages came in a frame that nobody connects to the global one",
            own("sensor_frame"),
            "start what publishes the frame (robot_state_publisher, a static transform, odometry)",
        ),
        (
            counters.out_of_time,
            messages,
            Loss::Wrong,
            "messages came from a time of which no transform is known",
            "use_sim_time".to_owned(),
            "check that all nodes use the same time, and that transforms come as often as messages",
        ),
        (
            counters.malformed,
            messages,
            Loss::Wrong,
            "messages could not be read",
            own("data_type"),
            "check that topic and `data_type` belong together",
        ),
        (
            counters.sensor_outside,
            counters.clouds,
            Loss::Wrong,
            "messages came from a sensor outside of the costmap",
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
