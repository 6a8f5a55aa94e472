//! `lifecycle`: state machines of lifecycle nodes.

use periplus_graph::Node;
use periplus_msgs::lifecycle_msgs::{
    ChangeState, ChangeStateRequest, GetAvailableTransitions, GetAvailableTransitionsRequest,
    GetState, GetStateRequest, State, Transition, TransitionDescription,
};
use serde_json::json;

use crate::ask::ask;
use crate::session::{advice, full_name};
use crate::{Failure, Outcome, Seen, Session, is_hidden};

/// Names of the lifecycle nodes.
fn managed(seen: &Seen, include_hidden: bool) -> Vec<String> {
    let states = seen.services.iter().filter(|service| {
        !service.servers.is_empty()
            && service.types.iter().any(|name| name == "lifecycle_msgs/srv/GetState")
    });
    let names = states.filter_map(|service| service.name.strip_suffix("/get_state"));
    names.filter(|name| include_hidden || !is_hidden(name)).map(str::to_owned).collect()
}

/// Lists the lifecycle nodes.
///
/// # Errors
/// When the output cannot be written.
pub fn nodes(session: &mut Session<'_>, all: bool, count: bool) -> Outcome {
    let names = managed(&session.look(), all);
    if session.json {
        return session.put(&json!({ "nodes": names }));
    }
    session.put_list("managed node", &names, count)
}

/// Looks up a lifecycle node by name.
fn look_up(session: &Session<'_>, name: &str) -> Outcome<String> {
    let name = full_name(name);
    let is_managed = |seen: &Seen| managed(seen, true).contains(&name);
    let (seen, is_there) = session.look_for(is_managed);
    session.check_interrupted()?;
    if is_there {
        return Ok(name);
    }
    let known = managed(&seen, true);
    let near = advice(&name, known.iter().map(String::as_str));
    Err(Failure::failed(if seen.count_nodes(&name) > 0 {
        format!("the node '{name}' is not a lifecycle node")
    } else {
        format!("Node not found: '{name}'{near}")
    }))
}

/// Prints the state of a node, or of all lifecycle nodes.
///
/// # Errors
/// When there is no such node, it does not respond, or the output cannot be written.
pub fn get(session: &mut Session<'_>, name: Option<&str>) -> Outcome {
    let names = match name {
        Some(name) => vec![look_up(session, name)?],
        None => managed(&session.look(), false),
    };
    let node = session.node(None)?;
    for one in names {
        let service = format!("{one}/get_state");
        let state = ask::<GetState>(session, &node, &service, &GetStateRequest::default())?;
        let State { id, label } = state.current_state;
        if session.json {
            session.put(&json!({ "node": one, "state": label, "id": id }))?;
        } else if name.is_some() {
            writeln!(session.out, "{label} [{id}]")?;
        } else {
            writeln!(session.out, "{one}: {label} [{id}]")?;
        }
    }
    session.out.flush()?;
    Ok(())
}

fn transitions(
    session: &Session<'_>,
    node: &Node,
    name: &str,
    all: bool,
) -> Outcome<Vec<TransitionDescription>> {
    let which = if all { "get_transition_graph" } else { "get_available_transitions" };
    let request = GetAvailableTransitionsRequest::default();
    let service = format!("{name}/{which}");
    let answer = ask::<GetAvailableTransitions>(session, node, &service, &request)?;
    Ok(answer.available_transitions)
}

/// Prints the transitions that a node can make now, or all of its state machine.
///
/// # Errors
/// When there is no such node, it does not respond, or the output cannot be written.
pub fn list(session: &mut Session<'_>, name: &str, all: bool) -> Outcome {
    let name = look_up(session, name)?;
    let node = session.node(None)?;
    for one in transitions(session, &node, &name, all)? {
        let TransitionDescription { transition, start_state, goal_state } = one;
        if session.json {
            session.put(&json!({
                "transition": transition.label,
                "id": transition.id,
                "start": start_state.label,
                "goal": goal_state.label,
            }))?;
        } else {
            writeln!(
                session.out,
                "- {} [{}]\n\tStart: {}\n\tGoal: {}",
                transition.label, transition.id, start_state.label, goal_state.label
            )?;
        }
    }
    session.out.flush()?;
    Ok(())
}

/// Triggers a transition of a node, by name or number.
///
/// # Errors
/// When there is no such node or transition, it fails, or the output cannot be written.
pub fn set(session: &mut Session<'_>, name: &str, transition: &str) -> Outcome {
    let name = look_up(session, name)?;
    let node = session.node(None)?;
    let known = transitions(session, &node, &name, false)?;
    let wanted = known
        .iter()
        .map(|one| &one.transition)
        .find(|one| one.label == transition || transition.parse() == Ok(one.id));
    let Some(wanted) = wanted else {
        let lines = known.iter().map(|one| {
            let Transition { id, label } = &one.transition;
            format!("\n- {label} [{id}]")
        });
        let lines: String = lines.collect();
        let near = advice(transition, known.iter().map(|one| one.transition.label.as_str()));
        return Err(Failure::failed(format!(
            "Unknown transition requested, `{transition}`{near} Available ones are:{lines}"
        )));
    };
    let request = ChangeStateRequest { transition: wanted.clone() };
    let service = format!("{name}/change_state");
    let is_done = ask::<ChangeState>(session, &node, &service, &request)?.success;
    if session.json {
        session.put(&json!({ "node": name, "transition": wanted.label, "success": is_done }))?;
    } else if is_done {
        writeln!(session.out, "Transitioning successful")?;
    }
    session.out.flush()?;
    match is_done {
        true => Ok(()),
        false => Err(Failure::failed("Transitioning failed")),
    }
}
