//! Checks of clocks and stamps.

use std::collections::BTreeSet;

use periplus_diagnostics::{Diagnostic, Diagnostics};

use super::SystemObservation;

/// Difference above which stamps come from different clocks \[ns\].
const OTHER_CLOCK_NS: i64 = 60_000_000_000;

pub(super) fn examine(observation: &SystemObservation, found: &mut Diagnostics) {
    let publishers = observation.seen.topic("/clock").map_or(&[][..], |topic| &topic.publishers);
    let tellers: Vec<&str> =
        publishers.iter().map(|end| end.node.as_deref().unwrap_or("somebody")).collect();
    // Nodes in the process that publishes the time have it without `/clock`, as plugins of Gazebo
    // do.
    let with_clock: BTreeSet<&str> =
        publishers.iter().filter_map(|end| participant(&end.gid)).collect();
    let has_clock = |node: &str| {
        let endpoints = observation
            .seen
            .topics
            .iter()
            .flat_map(|it| it.publishers.iter().chain(&it.subscriptions));
        let mut own = endpoints.filter(|end| end.node.as_deref() == Some(node));
        own.any(|end| participant(&end.gid).is_some_and(|one| with_clock.contains(one)))
    };
    let with = |wanted: bool| -> Vec<&str> {
        let nodes = observation.simulated.iter().filter(|(node, is_simulated)| {
            **is_simulated == wanted
                && !tellers.contains(&node.as_str())
                && (wanted || !has_clock(node))
        });
        nodes.map(|(node, _)| node.as_str()).collect()
    };
    let (simulated, real) = (with(true), with(false));
    if tellers.is_empty() && !simulated.is_empty() {
        found.push(
            Diagnostic::error(
                "no-clock",
                format!(
                    "`/clock` has no publisher, and {} wait for it: their time stays at 0",
                    list(&simulated)
                ),
            )
            .help(
                "start the simulation (or `periplus bag play BAG --clock`), or set `use_sim_time` of \
                 these nodes to false",
            ),
        );
    }
    if tellers.len() > 1 {
        found.push(
            Diagnostic::error(
                "two-clocks",
                format!("{} publish `/clock`, and time jumps between them", list(&tellers)),
            )
            .help("stop all but one of them, or give them separate domains (ROS_DOMAIN_ID)"),
        );
    } else if observation.clock_jumps > 0 {
        found.push(
            Diagnostic::warning(
                "clock-jumps",
                format!("the time on `/clock` went back {} times", observation.clock_jumps),
            )
            .help("a simulation was reset or a bag restarted: nodes clear their buffers then"),
        );
    }
    if !tellers.is_empty() && !real.is_empty() {
        found.push(
            Diagnostic::warning(
                "wall-time",
                format!(
                    "{} publishes simulated time on `/clock`, and {} use the wall clock",
                    list(&tellers),
                    list(&real)
                ),
            )
            .note("their stamps are decades away from those of the simulation, so transforms cannot be looked up")
            .help("set `use_sim_time` of these nodes to true: `-p use_sim_time:=true`"),
        );
    }
    if let Some((_, now_ns)) = observation.clock {
        for (topic, heard) in &observation.heard {
            if heard.count > 0 && (heard.stamp_ns - now_ns).abs() > OTHER_CLOCK_NS {
                let node = publisher(observation, topic);
                found.push(
                    Diagnostic::error(
                        "other-clock",
                        format!(
                            "stamps on `{topic}` are {:.0} s away from the time on `/clock`",
                            (heard.stamp_ns - now_ns).abs() as f64 * 1e-9
                        ),
                    )
                    .help(format!("set `use_sim_time` of `{node}` to true")),
                );
            }
        }
    }
}

/// Participant part of the GID of an endpoint: 12 of 16 bytes, written with dots.
fn participant(gid: &str) -> Option<&str> {
    const LENGTH: usize = 12 * 3 - 1;
    gid.get(..LENGTH)
}

fn publisher(observation: &SystemObservation, topic: &str) -> String {
    let topic = observation.seen.topic(topic);
    let first = topic.and_then(|topic| topic.publishers.first());
    first.and_then(|end| end.node.clone()).unwrap_or_else(|| "its publisher".into())
}

pub(super) fn list(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    names.join(", ")
}
