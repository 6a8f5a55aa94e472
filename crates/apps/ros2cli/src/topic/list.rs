//! `topic list`, `info`, `type` and `find`.

use periplus_rosidl::InterfaceKind;
use serde_json::json;

use crate::session::{advice, full_name, titled};
use crate::types::full_type;
use crate::{Failure, Outcome, SeenTopic, Session, TopicEndpoint, is_hidden, qos};

/// Options of `topic list`.
#[derive(Clone, Copy, Debug, Default)]
pub struct TopicListOptions {
    /// `-t`.
    pub show_types: bool,
    /// `-c`.
    pub count: bool,
    /// `-a`.
    pub include_hidden: bool,
    /// `-v`.
    pub verbose: bool,
}

/// Lists all topics.
///
/// # Errors
/// When the output cannot be written.
pub fn list(session: &mut Session<'_>, options: TopicListOptions) -> Outcome {
    let seen = session.look();
    let topics = seen.topics.iter();
    let topics: Vec<&SeenTopic> =
        topics.filter(|topic| options.include_hidden || !is_hidden(&topic.name)).collect();
    if session.json {
        let one = |topic: &&SeenTopic| {
            json!({
                "name": topic.name,
                "types": topic.types,
                "publishers": topic.publishers.len(),
                "subscriptions": topic.subscriptions.len(),
            })
        };
        return session.put(&json!({ "topics": topics.iter().map(one).collect::<Vec<_>>() }));
    }
    if options.verbose && !options.count && !topics.is_empty() {
        let ends = |kind: &str, one: &str, count: &dyn Fn(&SeenTopic) -> usize| {
            let lines = topics.iter().map(|topic| (topic, count(topic)));
            let lines = lines.filter(|(_, count)| *count > 0).map(|(topic, count)| {
                let more = if count > 1 { "s" } else { "" };
                let types = session.shown_types(&topic.types).join(", ");
                format!(" * {} [{types}] {count} {one}{more}\n", topic.name)
            });
            format!("{kind} topics:\n{}\n", lines.collect::<String>())
        };
        let published = ends("Published", "publisher", &|topic| topic.publishers.len());
        let subscribed = ends("Subscribed", "subscriber", &|topic| topic.subscriptions.len());
        write!(session.out, "{published}{subscribed}")?;
        session.out.flush()?;
        return Ok(());
    }
    let titles = topics
        .iter()
        .map(|one| titled(&one.name, &session.shown_types(&one.types), options.show_types));
    session.put_list("topic", &titles.collect::<Vec<_>>(), options.count)
}

/// Looks up a topic by name.
fn look_up(session: &mut Session<'_>, name: &str) -> Outcome<SeenTopic> {
    let name = full_name(name);
    let (mut seen, is_there) = session.look_for(|seen| seen.topic(&name).is_some());
    if is_there {
        // Other endpoints may be discovered a little later.
        seen = session.look();
    }
    session.check_interrupted()?;
    seen.topic(&name).cloned().ok_or_else(|| {
        let near = advice(&name, seen.topics.iter().map(|topic| topic.name.as_str()));
        Failure::failed(format!("Unknown topic '{name}'{near}"))
    })
}

/// Prints the publishers and subscribers of a topic.
///
/// # Errors
/// When there is no such topic, or the output cannot be written.
pub fn info(session: &mut Session<'_>, name: &str, verbose: bool) -> Outcome {
    let topic = look_up(session, name)?;
    if session.json {
        let ends = |ends: &[TopicEndpoint]| ends.iter().map(end_to_json).collect::<Vec<_>>();
        return session.put(&json!({
            "name": topic.name,
            "types": topic.types,
            "publishers": ends(&topic.publishers),
            "subscriptions": ends(&topic.subscriptions),
        }));
    }
    let end = if verbose { "\n\n" } else { "\n" };
    let types = match session.shown_types(&topic.types).as_slice() {
        [one] => one.clone(),
        types => {
            let quoted = types.iter().map(|name| format!("'{name}'"));
            format!("[{}]", quoted.collect::<Vec<_>>().join(", "))
        }
    };
    write!(session.out, "Type: {types}{end}")?;
    let sides = [
        ("Publisher", "PUBLISHER", &topic.publishers),
        ("Subscription", "SUBSCRIPTION", &topic.subscriptions),
    ];
    for (name, kind, ends) in sides {
        write!(session.out, "{name} count: {}{end}", ends.len())?;
        if verbose {
            for end in ends {
                writeln!(session.out, "{}", describe(end, kind))?;
            }
        }
    }
    session.out.flush()?;
    Ok(())
}

fn describe(end: &TopicEndpoint, kind: &str) -> String {
    let (namespace, name) = split_name(end.node.as_deref());
    // Only endpoints on a network have a GID.
    let gid = if end.gid.is_empty() { String::new() } else { format!("GID: {}\n", end.gid) };
    format!(
        "Node name: {name}\nNode namespace: {namespace}\nTopic type: {}\nTopic type hash: {}\n\
         Endpoint type: {kind}\n{gid}QoS profile:\n{}",
        end.type_name,
        end.type_hash.as_deref().unwrap_or("INVALID"),
        qos::describe(&end.qos)
    )
}

/// Namespace and name; programs without ROS have neither.
fn split_name(node: Option<&str>) -> (&str, &str) {
    match node.and_then(|node| node.rsplit_once('/')) {
        Some(("", name)) => ("/", name),
        Some(parts) => parts,
        None => ("_NODE_NAMESPACE_UNKNOWN_", "_NODE_NAME_UNKNOWN_"),
    }
}

fn end_to_json(end: &TopicEndpoint) -> serde_json::Value {
    json!({
        "node": end.node,
        "type": end.type_name,
        "type_hash": end.type_hash,
        "gid": end.gid,
        "qos": qos::to_json(&end.qos),
    })
}

/// Prints the types of a topic.
///
/// # Errors
/// When there is no such topic, or the output cannot be written.
pub fn type_of(session: &mut Session<'_>, name: &str) -> Outcome {
    let name = full_name(name);
    let (seen, _) = session.look_for(|seen| seen.topic(&name).is_some());
    let Some(topic) = seen.topic(&name) else {
        let near = advice(&name, seen.topics.iter().map(|topic| topic.name.as_str()));
        return Err(Failure::failed(format!("Unknown topic '{name}'{near}")));
    };
    session.put_types(&name, &topic.types)
}

/// Lists the topics of a type.
///
/// # Errors
/// When the output cannot be written.
pub fn find(
    session: &mut Session<'_>,
    type_name: &str,
    count: bool,
    include_hidden: bool,
) -> Outcome {
    let type_name = full_type(type_name, InterfaceKind::Message)?;
    let seen = session.look();
    let topics = seen.topics.iter().filter(|topic| topic.types.contains(&type_name));
    let topics = topics.map(|topic| topic.name.as_str());
    let topics: Vec<&str> = topics.filter(|name| include_hidden || !is_hidden(name)).collect();
    session.put_found(&type_name, "topics", &topics, count)
}
