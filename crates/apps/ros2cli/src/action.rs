//! `action`.

mod goal;

use periplus_rosidl::InterfaceKind;
use serde_json::json;

use crate::session::{advice, full_name, titled};
use crate::types::full_type;
use crate::{Failure, Outcome, SeenService, Session};

pub use goal::send_goal;

/// Lists all actions.
///
/// # Errors
/// When the output cannot be written.
pub fn list(session: &mut Session<'_>, show_types: bool, count: bool) -> Outcome {
    let actions = session.look().actions();
    if session.json {
        let all = actions.iter().map(SeenService::to_json).collect::<Vec<_>>();
        return session.put(&json!({ "actions": all }));
    }
    let titles = actions.iter().map(|one| titled(&one.name, &one.types, show_types));
    session.put_list("action", &titles.collect::<Vec<_>>(), count)
}

/// Looks up an action by name.
fn look_up(session: &mut Session<'_>, name: &str) -> Outcome<SeenService> {
    let name = full_name(name);
    let service = format!("{name}/_action/send_goal");
    let (seen, is_there) = session.look_for(|seen| seen.service(&service).is_some());
    session.check_interrupted()?;
    let seen = if is_there { session.look() } else { seen };
    let actions = seen.actions();
    let near = advice(&name, actions.iter().map(|action| action.name.as_str()));
    let found = actions.iter().find(|action| action.name == name).cloned();
    found.ok_or_else(|| Failure::failed(format!("Unknown action '{name}'{near}")))
}

/// Prints the types of an action.
///
/// # Errors
/// When there is no such action, or the output cannot be written.
pub fn type_of(session: &mut Session<'_>, name: &str) -> Outcome {
    let action = look_up(session, name)?;
    session.put_types(&action.name, &action.types)
}

/// Lists the actions of a type.
///
/// # Errors
/// When the output cannot be written.
pub fn find(session: &mut Session<'_>, type_name: &str, count: bool) -> Outcome {
    let type_name = full_type(type_name, InterfaceKind::Action)?;
    let actions = session.look().actions();
    let names = actions.iter().filter(|action| action.types.contains(&type_name));
    let names: Vec<&str> = names.map(|action| action.name.as_str()).collect();
    session.put_found(&type_name, "actions", &names, count)
}

/// Prints the servers and clients of an action.
///
/// # Errors
/// When there is no such action, or the output cannot be written.
pub fn info(session: &mut Session<'_>, name: &str, show_types: bool, count: bool) -> Outcome {
    let action = look_up(session, name)?;
    if session.json {
        return session.put(&action.to_json());
    }
    writeln!(session.out, "Action: {}", action.name)?;
    for (what, nodes) in [("clients", &action.clients), ("servers", &action.servers)] {
        writeln!(session.out, "Action {what}: {}", nodes.len())?;
        for node in nodes.iter().filter(|_| !count) {
            if show_types {
                writeln!(session.out, "    {node} [{}]", action.types.join(", "))?;
            } else {
                writeln!(session.out, "    {node}")?;
            }
        }
    }
    session.out.flush()?;
    Ok(())
}
