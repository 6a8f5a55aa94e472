//! A map from a topic to files.

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

/// How often it is looked for the map.
const LOOK: Duration = Duration::from_millis(10);

/// What to save, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Save {
    /// The topic of the map.
    pub topic: String,
    /// How to save it.
    pub wish: Wish,
    /// As whose saver.
    pub distro: Distro,
    /// How long the map is waited for; without it until one comes.
    pub timeout: Option<Duration>,
}

/// Saves the next map of a topic. One that was published before counts, whether its publisher keeps
/// it reliably, for latecomers, or not.
///
/// # Errors
/// When the thresholds make no sense, no map comes in time, it is malformed, or the files cannot be
/// written.
pub fn save(session: &mut Session<'_>, save: &Save) -> Outcome {
    save_to(session, save, &Machine)
}

/// The same with another store for the files than the machine's.
///
/// # Errors
/// As [`save`].
pub fn save_to(session: &mut Session<'_>, save: &Save, store: &dyn Store) -> Outcome {
    let unix_s = unix_ns().div_euclid(1_000_000_000);
    let settled = save.wish.settle(save.distro, unix_s);
    // As the savers of ROS do: the words make sense, and the map is not saved.
    let (saving, said) = settled.map_err(|error| Failure::failed(error.to_string()))?;
    for words in said {
        session.say(&format!("WARNING: {words}"));
    }
    let message = wait(session, &full_name(&save.topic), save.timeout)?;
    let map = from_message(&message).map_err(|error| Failure::failed(error.to_string()))?;
    let lattice = map.lattice;
    session.say(&format!(
        "Received a {} X {} map @ {} m/pix",
        lattice.width, lattice.height, lattice.resolution_m
    ));
    write(session, &render(&map, &saving), store)
}

/// Writes both files of a map, the picture first: a YAML that is there names a picture that is there.
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
    // Whoever asks for kept messages does not hear a publisher that keeps none, and the other way
    // round gets only what comes later. So both are asked for.
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
        session.go_on()?;
        if let Some(timeout) = timeout.filter(|timeout| clock.elapsed() >= *timeout) {
            return Err(Failure::failed(missing(session, topic, timeout)));
        }
        sleep(LOOK);
    }
}

/// Why there is no map, as far as can be seen.
fn missing(session: &Session<'_>, topic: &str, timeout: Duration) -> String {
    let seen = session.network.seen();
    let waited = format!("no map came on `{topic}` in {} s", timeout.as_secs_f64());
    let found = seen.topic(topic).filter(|found| !found.publishers.is_empty());
    if let Some(found) = found {
        let other = found.types.iter().find(|name| *name != OccupancyGrid::TYPE_NAME);
        return match other {
            Some(other) => format!("{waited}: it carries {other}, which is no map"),
            None => format!(
                "{waited}, though it is published: its publisher keeps nothing for latecomers, and \
                 nothing new came; wait longer with `--timeout`"
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
        format!("{waited}: nobody publishes a map; is the map server or SLAM running?")
    } else {
        format!("{waited}: nobody publishes there; maps are on {}", maps.join(", "))
    }
}
