//! Checks of incompatible endpoints.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::Policy;

use super::SystemObservation;

pub(super) fn examine(observation: &SystemObservation, found: &mut Diagnostics) {
    for topic in &observation.seen.topics {
        let name = &topic.name;
        if topic.types.len() > 1 {
            found.push(
                Diagnostic::error(
                    "topic-types",
                    format!(
                        "`{name}` has endpoints of different types: {}",
                        topic.types.join(", ")
                    ),
                )
                .note("endpoints of different types do not match")
                .help(format!("remap one of them: `-r {name}:={name}_other`")),
            );
        }
        for publisher in &topic.publishers {
            for subscription in &topic.subscriptions {
                if publisher.type_name != subscription.type_name {
                    continue;
                }
                for policy in publisher.qos.incompatible_policies(&subscription.qos) {
                    let by = publisher.node.as_deref().unwrap_or("somebody");
                    let to = subscription.node.as_deref().unwrap_or("somebody");
                    found.push(misfit(
                        name,
                        by,
                        to,
                        policy,
                        &publisher.qos.policy_value(policy),
                        &subscription.qos.policy_value(policy),
                    ));
                }
            }
        }
    }
}

fn misfit(
    topic: &str,
    by: &str,
    to: &str,
    policy: Policy,
    offered: &str,
    asked: &str,
) -> Diagnostic {
    let word = match policy {
        Policy::Reliability => "reliability",
        Policy::Durability => "durability",
        Policy::Deadline => "deadline",
        Policy::Liveliness => "liveliness",
        Policy::Lease => "liveliness_lease_duration",
    };
    Diagnostic::error(
        "qos-mismatch",
        format!(
            "`{to}` receives nothing on `{topic}`: it requests {word} {asked}, and `{by}` offers {offered}"
        ),
    )
    .help(format!(
        "set {word} of the subscription to {offered}: parameter \
         `qos_overrides.{topic}.subscription.{word}` of `{to}`, in RViz the display's \
         {} Policy; or `qos_overrides.{topic}.publisher.{word}` of `{by}` to {asked}",
        match policy {
            Policy::Durability => "Durability",
            _ => "Reliability",
        }
    ))
}
