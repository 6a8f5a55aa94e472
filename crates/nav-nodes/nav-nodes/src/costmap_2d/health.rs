//! Health of a costmap on `/diagnostics`.

use std::any::Any;
use std::collections::BTreeMap;

use periplus_costmap::layers::{RangeCounters, RangeLayer, StaticLayer};
use periplus_costmap::{Advice, Counters, LayeredCostmap, ObservationSource};
use periplus_diagnostics::Severity;
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_msgs::diagnostic_msgs::{DiagnosticArray, DiagnosticStatus, KeyValue};
use periplus_msgs::std_msgs::Header;

use crate::costmap_2d::inputs::Inputs;

/// Publication period \[ns\].
pub(crate) const EVERY_NS: i64 = 1_000_000_000;

/// Time without messages after which a source without `expected_update_rate` is reported as silent
/// \[ns\].
const SILENCE_NS: i64 = 5_000_000_000;

/// Publisher of the health.
pub(crate) struct Health {
    diagnostics: Publisher<DiagnosticArray>,
    sources: BTreeMap<String, Heard>,
}

/// Last report about a source.
#[derive(Default)]
struct Heard {
    /// Counters at that time.
    counters: Counters,
    /// Advice at that time.
    advice: Vec<Advice>,
}

/// State of a costmap that is reported.
pub(crate) struct Patient<'a> {
    /// Full name of the node.
    pub(crate) node: &'a str,
    pub(crate) costmap: Option<&'a LayeredCostmap>,
    pub(crate) inputs: &'a Inputs,
    pub(crate) is_active: bool,
    pub(crate) updates: u64,
    /// Reason for which updates fail.
    pub(crate) trouble: Option<&'a str>,
}

impl Health {
    pub(crate) fn new(node: &Node) -> Result<Self, GraphError> {
        let diagnostics = node.publisher("/diagnostics", Qos::reliable(10))?;
        Ok(Self { diagnostics, sources: BTreeMap::new() })
    }

    pub(crate) fn publish(&mut self, patient: &Patient<'_>, now_ns: i64) {
        let mut status = vec![whole(patient, now_ns)];
        if let Some(costmap) = patient.costmap.filter(|_| patient.is_active) {
            for (layer, name, topic) in patient.inputs.topics() {
                let layers = costmap.all().filter(|found| found.name() == layer);
                let found = layers.flat_map(|found| found.sources()).find(|it| it.name == name);
                let Some(source) = found else { continue };
                let whole_name = format!("{layer}.{name}");
                let heard = self.sources.entry(whole_name.clone()).or_default();
                heard.listen(costmap, layer, source);
                let (level, message) = heard.verdict(source, &whole_name, topic, now_ns);
                let values = values(source, topic, &heard.advice, now_ns);
                status.push(patient.status(&whole_name, level, message, values));
            }
            status.extend(ranges(patient, costmap));
        } else {
            self.sources.clear();
        }
        let array = DiagnosticArray { header: Header::at(now_ns, ""), status };
        self.diagnostics.publish(array);
    }
}

impl Patient<'_> {
    fn status(
        &self,
        what: &str,
        level: u8,
        message: String,
        values: Vec<KeyValue>,
    ) -> DiagnosticStatus {
        DiagnosticStatus {
            level,
            name: format!("{}: {what}", self.node.trim_start_matches('/')),
            message,
            hardware_id: String::new(),
            values,
        }
    }
}

/// Returns the status of the costmap as a whole.
fn whole(patient: &Patient<'_>, now_ns: i64) -> DiagnosticStatus {
    let mut values = vec![pair("updates", patient.updates)];
    let Some(costmap) = patient.costmap.filter(|_| patient.is_active) else {
        let message = "waits until a client configures and activates it".to_owned();
        return patient.status("costmap", DiagnosticStatus::WARN, message, values);
    };
    let info = costmap.costmap().info();
    values.push(pair("cells", format!("{} x {}", info.width, info.height)));
    values.push(pair("resolution [m]", info.resolution_m));
    values.push(pair("frame", &costmap.frame().global_frame));
    let mut waiting: Vec<String> = Vec::new();
    for layer in costmap.all().filter(|it| it.is_enabled() && !it.is_current(now_ns)) {
        let name = layer.name();
        let lacks_map =
            (layer as &dyn Any).downcast_ref().is_some_and(|it: &StaticLayer| !it.has_map());
        let map = patient.inputs.maps().find(|(of, _)| *of == name).filter(|_| lacks_map);
        waiting.push(match map {
            Some((_, topic)) => format!("`{name}` waits for a map on {topic} (`{name}.map_topic`)"),
            None => format!("`{name}` is not current"),
        });
    }
    for (filter, topic) in patient.inputs.filters_without_mask() {
        let parameter = format!("`{filter}.filter_info_topic`");
        waiting.push(format!("`{filter}` has no mask: nothing came on {topic} ({parameter})"));
    }
    let (level, message) = match patient.trouble {
        Some(trouble) => (DiagnosticStatus::ERROR, format!("no update: {trouble}")),
        None if waiting.is_empty() => (DiagnosticStatus::OK, "up to date".to_owned()),
        None => (DiagnosticStatus::WARN, waiting.join("; ")),
    };
    patient.status("costmap", level, message, values)
}

impl Heard {
    /// Updates the report if new messages were received; otherwise the last one stays.
    fn listen(&mut self, costmap: &LayeredCostmap, layer: &str, source: &ObservationSource) {
        if source.counters.messages() != self.counters.messages() {
            self.advice = costmap.advice_since(layer, &source.name, &self.counters);
            self.counters = source.counters;
        }
    }

    /// Returns the severity and the most severe result as text.
    fn verdict(
        &self,
        source: &ObservationSource,
        name: &str,
        topic: &str,
        now_ns: i64,
    ) -> (u8, String) {
        if source.counters.messages() == 0 {
            let message = format!("no message came on {topic} (`{name}.topic`)");
            return (DiagnosticStatus::ERROR, message);
        }
        let expected_ns = source.settings.expected_every_ns;
        let patience_ns = if expected_ns > 0 { expected_ns } else { SILENCE_NS };
        let silence_ns = source.last_ns().map_or(0, |last_ns| now_ns - last_ns);
        let worst = self.advice.iter().max_by_key(|advice| advice.severity);
        let level = |advice: &Advice| match advice.severity {
            Severity::Hint => DiagnosticStatus::OK,
            Severity::Warning => DiagnosticStatus::WARN,
            Severity::Error => DiagnosticStatus::ERROR,
        };
        match worst.filter(|worst| worst.severity > Severity::Hint) {
            // Messages of which none is usable are worse than silence.
            Some(worst) if worst.severity == Severity::Error || silence_ns <= patience_ns => {
                let Advice { count, of, what, parameter, help, .. } = worst;
                (level(worst), format!("{count} of {of} {what} (`{parameter}`): {help}"))
            }
            _ if silence_ns > patience_ns => {
                let silence_s = silence_ns as f64 / 1e9;
                let message = format!("silent on {topic} for {silence_s:.1} s (`{name}.topic`)");
                (DiagnosticStatus::STALE, message)
            }
            _ => (DiagnosticStatus::OK, format!("{} points marked", source.counters.marked)),
        }
    }
}

/// Returns received messages, points by result, and the parameters responsible.
fn values(
    source: &ObservationSource,
    topic: &str,
    advice: &[Advice],
    now_ns: i64,
) -> Vec<KeyValue> {
    let counters = &source.counters;
    let mut values = vec![
        pair("topic", topic),
        pair("messages", counters.messages()),
        pair("messages dropped by frame", counters.without_frame),
        pair("messages dropped by time", counters.out_of_time),
        pair("messages that could not be read", counters.malformed),
        pair("messages from a sensor outside the costmap", counters.sensor_outside),
        pair("points", counters.points),
        pair("points dropped by height", counters.too_low + counters.too_high),
        pair(
            "points dropped by height of the layer",
            counters.layer_too_low + counters.layer_too_high,
        ),
        pair("points dropped by range", counters.too_near + counters.too_far),
        pair("points dropped by bounds", counters.outside),
        pair("points that were no numbers", counters.not_finite),
        pair("readings without return", counters.without_return),
        pair("points marked", counters.marked),
    ];
    if let Some(last_ns) = source.last_ns().filter(|_| counters.clouds > 0) {
        values
            .push(pair("last message [s ago]", format!("{:.2}", (now_ns - last_ns) as f64 / 1e9)));
    }
    for Advice { count, of, what, parameter, help, .. } in advice {
        values.push(pair(parameter, format!("{count} of {of} {what}: {help}")));
    }
    values
}

/// Returns the status of range sensor layers.
fn ranges(patient: &Patient<'_>, costmap: &LayeredCostmap) -> Vec<DiagnosticStatus> {
    let mut all = Vec::new();
    for name in patient.inputs.ranges() {
        let found = costmap.all().find(|layer| layer.name() == name);
        let Some(layer) = found.and_then(|layer| (layer as &dyn Any).downcast_ref::<RangeLayer>())
        else {
            continue;
        };
        let RangeCounters { taken, beyond_limits, without_frame, out_of_time } = layer.counters;
        let (level, message) = if without_frame + out_of_time > taken + beyond_limits {
            let message = "most readings are dropped: the pose of the sensor is unknown";
            (DiagnosticStatus::ERROR, message.to_owned())
        } else if taken + beyond_limits == 0 {
            (DiagnosticStatus::ERROR, format!("no reading received (`{name}.topics`)"))
        } else if taken == 0 {
            let message = format!(
                "no reading was within the limits of its sensor \
                 (`{name}.input_sensor_type`, `{name}.clear_on_max_reading`)"
            );
            (DiagnosticStatus::WARN, message)
        } else {
            (DiagnosticStatus::OK, format!("{taken} readings"))
        };
        let values = vec![
            pair("readings", taken + beyond_limits + without_frame + out_of_time),
            pair("readings dropped by limits of the sensor", beyond_limits),
            pair("readings dropped by frame", without_frame),
            pair("readings dropped by time", out_of_time),
        ];
        all.push(patient.status(name, level, message, values));
    }
    all
}

fn pair(key: &str, value: impl ToString) -> KeyValue {
    KeyValue { key: key.to_owned(), value: value.to_string() }
}
