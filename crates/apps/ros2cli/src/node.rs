//! `node`.

use serde_json::json;

use crate::session::{advice, full_name};
use crate::{Failure, Outcome, Seen, SeenService, Session, TopicEndpoint, is_hidden};

/// Lists all nodes.
///
/// # Errors
/// When the output cannot be written.
pub fn list(session: &mut Session<'_>, all: bool, count: bool) -> Outcome {
    let seen = session.look();
    let names = seen.node_names(all);
    if session.json {
        return session.put(&json!({ "nodes": names }));
    }
    session.put_list("node", &names, count)?;
    if !count && names.windows(2).any(|pair| pair[0] == pair[1]) {
        session.say(
            "WARNING: there are nodes of exactly the same name; calls to their services and \
             parameters reach an arbitrary one",
        );
    }
    Ok(())
}

/// Prints the publishers, subscribers, services and actions of a node.
///
/// # Errors
/// When there is no such node, or the output cannot be written.
pub fn info(session: &mut Session<'_>, name: &str, include_hidden: bool) -> Outcome {
    let name = full_name(name);
    let (seen, is_there) = session.look_for(|seen| seen.count_nodes(&name) > 0);
    session.check_interrupted()?;
    if !is_there {
        let near = advice(&name, seen.nodes.iter().map(|node| node.name.as_str()));
        return Err(Failure::failed(format!("Unable to find node '{name}'{near}")));
    }
    let seen = session.look();
    let count = seen.count_nodes(&name);
    if count > 1 {
        session
            .say(&format!("There are {count} nodes with the name '{name}'; all are shown as one"));
    }
    let parts = parts(&seen, &name, include_hidden);
    if session.json {
        let mut json = json!({ "name": name });
        for (_, key, uses) in parts {
            let one =
                |(name, types): (String, Vec<String>)| json!({ "name": name, "types": types });
            json[key] = uses.into_iter().map(one).collect();
        }
        return session.put(&json);
    }
    writeln!(session.out, "{name}")?;
    for (title, _, uses) in parts {
        writeln!(session.out, "  {title}:")?;
        if uses.is_empty() {
            // The format of `ros2 node info`.
            writeln!(session.out)?;
        }
        for (name, types) in uses {
            let types = session.shown_types(&types).join(", ");
            writeln!(session.out, "    {name}: {types}")?;
        }
    }
    session.out.flush()?;
    Ok(())
}

type Uses = Vec<(String, Vec<String>)>;

fn parts(seen: &Seen, node: &str, include_hidden: bool) -> [(&'static str, &'static str, Uses); 6] {
    let shown = |name: &str| include_hidden || !is_hidden(name);
    let topics = |ends: fn(&crate::SeenTopic) -> &Vec<TopicEndpoint>| -> Uses {
        let mine = |end: &TopicEndpoint| end.node.as_deref() == Some(node);
        let topics = seen.topics.iter().filter(|topic| shown(&topic.name));
        let topics = topics.filter(|topic| ends(topic).iter().any(mine));
        topics.map(|topic| (topic.name.clone(), topic.types.clone())).collect()
    };
    let services = |all: &[SeenService], ends: fn(&SeenService) -> &Vec<String>| -> Uses {
        let mine = all.iter().filter(|one| shown(&one.name));
        let mine = mine.filter(|one| ends(one).iter().any(|end| end == node));
        mine.map(|one| (one.name.clone(), one.types.clone())).collect()
    };
    let actions = seen.actions();
    [
        ("Subscribers", "subscribers", topics(|topic| &topic.subscriptions)),
        ("Publishers", "publishers", topics(|topic| &topic.publishers)),
        ("Service Servers", "service_servers", services(&seen.services, |one| &one.servers)),
        ("Service Clients", "service_clients", services(&seen.services, |one| &one.clients)),
        ("Action Servers", "action_servers", services(&actions, |one| &one.servers)),
        ("Action Clients", "action_clients", services(&actions, |one| &one.clients)),
    ]
}
