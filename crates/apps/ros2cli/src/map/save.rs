//! Saving a map from a topic.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use periplus_graph::{Durability, Mailbox, Qos, Reliability};
use periplus_maps::{Distro, MapFiles, Wish, from_message, render};
use periplus_msgs::Message as _;
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_os::{Machine, Stopwatch, sleep, unix_ns};
use periplus_resources::Store;

use crate::session::full_name;
use crate::{Failure, Outcome, Session};

/// Polling period for the map.
const POLL_PERIOD: Duration = Duration::from_millis(10);

/// Options of saving a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Save {
    /// Topic of the map.
    pub topic: String,
    /// Output settings.
    pub wish: Wish,
    /// Distribution of the map saver to follow.
    pub distro: Distro,
    /// Timeout for the map; unlimited if `None`.
    pub timeout: Option<Duration>,
}

/// Saves the next map of a topic, including a latched one. Works with any durability of the
/// publisher.
///
/// # Errors
/// When the thresholds are invalid, no map arrives in time, it is malformed, or the files cannot be
/// written.
pub fn save(session: &mut Session<'_>, save: &Save) -> Outcome {
    save_to(session, save, &Machine)
}

/// Saves a map to another file store than that of the machine.
///
/// # Errors
/// As [`save`].
pub fn save_to(session: &mut Session<'_>, save: &Save, store: &dyn Store) -> Outcome {
    let unix_s = unix_ns().div_euclid(1_000_000_000);
    let settled = save.wish.settle(save.distro, unix_s);
    // As the map savers of ROS do: arguments are checked before the map is received.
    let (saving, said) = settled.map_err(|error| Failure::failed(error.to_string()))?;
    for words in said {
        session.say(&format!("WARNING: {words}"));
    }
    let message = wait(session, &full_name(&save.topic), save.timeout)?;
    let map = from_message(&message).map_err(|error| Failure::failed(error.to_string()))?;
    let info = map.info;
    session.say(&format!(
        "Received a {} X {} map @ {} m/pix",
        info.width, info.height, info.resolution_m
    ));
    write(session, &render(&map, &saving), store)
}

/// Writes both files of a map, the image first, so that a YAML file never refers to a missing
/// image.
pub(super) fn write(session: &mut Session<'_>, files: &MapFiles, store: &dyn Store) -> Outcome {
    for (path, content) in
        [(&files.image_path, files.image.as_slice()), (&files.yaml_path, files.yaml.as_bytes())]
    {
        store
            .replace(Path::new(path), content)
            .map_err(|words| Failure::failed(format!("cannot write `{path}`: {words}")))?;
    }
    if session.json {
        return session
            .put(&serde_json::json!({ "yaml": files.yaml_path, "image": files.image_path }));
    }
    session.say(&format!("Map saved to {} and {}", files.image_path, files.yaml_path));
    Ok(())
}

fn wait(
    session: &mut Session<'_>,
    topic: &str,
    timeout: Option<Duration>,
) -> Outcome<Arc<OccupancyGrid>> {
    let node = session.node(None)?;
    // A transient-local subscription does not match volatile publishers, and a volatile one
    // receives only later messages. So both are created.
    let kept = Qos::latched(1);
    let passing = Qos {
        reliability: Reliability::BestEffort,
        durability: Durability::Volatile,
        ..Qos::reliable(1)
    };
    let mailboxes: Vec<Mailbox<OccupancyGrid>> = [kept, passing]
        .into_iter()
        .map(|qos| node.mailbox(topic, qos))
        .collect::<Result<_, _>>()?;
    let clock = Stopwatch::start();
    loop {
        if let Some(map) = mailboxes.iter().find_map(Mailbox::latest) {
            return Ok(map);
        }
        session.check_interrupted()?;
        if let Some(timeout) = timeout.filter(|timeout| clock.elapsed() >= *timeout) {
            return Err(Failure::failed(missing(session, topic, timeout)));
        }
        sleep(POLL_PERIOD);
    }
}

/// Reason why no map arrived, as far as known.
fn missing(session: &Session<'_>, topic: &str, timeout: Duration) -> String {
    let seen = session.network.seen();
    let waited = format!("no map received on `{topic}` within {} s", timeout.as_secs_f64());
    let found = seen.topic(topic).filter(|found| !found.publishers.is_empty());
    if let Some(found) = found {
        let other = found.types.iter().find(|name| *name != OccupancyGrid::TYPE_NAME);
        return match other {
            Some(other) => format!("{waited}: its type is {other}, which is not a map"),
            None => format!(
                "{waited}, though it is published: its publisher is volatile and \
                 published nothing new; wait longer with `--timeout`"
            ),
        };
    }
    let maps: Vec<&str> = seen
        .topics
        .iter()
        .filter(|topic| {
            let is_map = topic.types.iter().any(|name| name == OccupancyGrid::TYPE_NAME);
            is_map && !topic.publishers.is_empty()
        })
        .map(|topic| topic.name.as_str())
        .collect();
    if maps.is_empty() {
        format!("{waited}: no map is published; is the map server or SLAM running?")
    } else {
        format!("{waited}: the topic has no publisher; maps are published on {}", maps.join(", "))
    }
}
