//! Checks of silent and useless sensors.

use periplus_diagnostics::{Diagnostic, Diagnostics};

use super::SystemObservation;
use super::observation::{ScanFacts, TopicStatistics};

/// Fraction of the expected rate below which a sensor is slow.
const MIN_RATE_FRACTION: f64 = 0.7;

/// Minimum number of readings before a scanner is judged.
const MIN_READINGS: usize = 20;

pub(super) fn examine(observation: &SystemObservation, found: &mut Diagnostics) {
    for (topic, heard) in &observation.heard {
        if heard.count == 0 {
            if !is_derived(observation, topic) {
                found.push(silent(observation, topic));
            }
            continue;
        }
        if let Some(finding) =
            heard.scans.and_then(|scans| useless(topic, &scans, observation.is_alone))
        {
            found.push(finding);
        }
        if let Some(finding) = slow(topic, heard) {
            found.push(finding);
        }
    }
}

/// Returns true for a topic of a node that itself subscribes to sensor data, such as a filter or a
/// mapper, which publishes only with input. If it is silent by mistake, its sensor is silent too.
fn is_derived(observation: &SystemObservation, topic: &str) -> bool {
    let publishers = observation.seen.topic(topic).map_or(&[][..], |topic| &topic.publishers);
    let mut nodes = publishers.iter().filter_map(|end| end.node.as_deref());
    let subscribes = |node: &str| {
        let inputs = observation
            .seen
            .topics
            .iter()
            .filter(|other| other.name != topic && observation.heard.contains_key(&other.name));
        inputs.flat_map(|input| &input.subscriptions).any(|end| end.node.as_deref() == Some(node))
    };
    nodes.any(subscribes)
}

fn silent(observation: &SystemObservation, topic: &str) -> Diagnostic {
    let endpoints = observation.seen.topic(topic).map_or(&[][..], |topic| &topic.publishers);
    let node = endpoints.first().and_then(|end| end.node.as_deref()).unwrap_or("somebody");
    let finding = Diagnostic::warning(
        "sensor-silent",
        format!(
            "`{node}` has a publisher on `{topic}`, and no message was received in {:.1} s",
            observation.time.as_secs_f64()
        ),
    );
    if observation.clock.is_none() && observation.simulated.values().any(|simulated| *simulated) {
        return finding.help("simulated time does not advance: see the finding on `/clock`");
    }
    finding.help(
        "the sensor is off (`<always_on>`, `<update_rate>`), the simulation is paused, a driver waits \
         for its device, or packets are lost: large messages need `net.core.rmem_max`",
    )
}

fn useless(topic: &str, scans: &ScanFacts, is_alone: bool) -> Option<Diagnostic> {
    if scans.readings < MIN_READINGS || scans.good > 0 {
        return None;
    }
    let all = scans.readings;
    let (what, help) = if scans.nan + scans.zero == all {
        (
            "has NaN or 0 in every reading",
            "it measures nothing: a GPU lidar without a GPU, or a driver without its device; in a world \
             file `type=\"ray\"` instead of `gpu_ray`",
        )
    } else if scans.near + scans.nan + scans.zero == all {
        (
            "has only readings below its `range_min`",
            "it detects the robot itself, or is inside a shape: move the sensor's link out of the \
             collision shape, or set `range/min` above it",
        )
    } else if is_alone {
        return None;
    } else {
        (
            "has no reading within its `range_max`",
            "no surface is that near at its height: check the pose of the sensor, raise `range/max`, \
             or add obstacles to the world",
        )
    };
    let message = format!("`{topic}` {what} (all of {all} readings)");
    Some(Diagnostic::warning("scan-useless", message).help(help))
}

fn slow(topic: &str, heard: &TopicStatistics) -> Option<Diagnostic> {
    let (rate_hz, wanted_hz) = (heard.rate_hz()?, heard.wanted_hz?);
    (rate_hz < MIN_RATE_FRACTION * wanted_hz).then(|| {
        Diagnostic::warning(
            "sensor-slow",
            format!("`{topic}` has a rate of {rate_hz:.1} Hz instead of {wanted_hz:.1} Hz"),
        )
        .help(
            "the machine is too slow for `<update_rate>` (a lower one, fewer samples), the simulation runs \
             below real time, or messages are lost (reliability, `net.core.rmem_max`)",
        )
    })
}
