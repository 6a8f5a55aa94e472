//! `service`.

use std::time::Duration;

use periplus_msgs::{DynamicMessage, Format};
use periplus_os::{Stopwatch, sleep};
use periplus_rosidl::InterfaceKind;
use serde_json::json;

use crate::ask::ServiceCaller;
use crate::failure::endless;
use crate::session::{INTERRUPT_POLL_PERIOD, advice, full_name, titled};
use crate::types::full_type;
use crate::{Failure, Outcome, SeenService, Session, Values, clock, is_hidden, show};

/// Time without a server after which a warning is printed.
const REPORT_PERIOD: Duration = Duration::from_millis(1_000);

/// Lists all services.
///
/// # Errors
/// When the output cannot be written.
pub fn list(
    session: &mut Session<'_>,
    show_types: bool,
    count: bool,
    include_hidden: bool,
) -> Outcome {
    let seen = session.look();
    // Services without a server have a client, and are listed as well.
    let services = seen.services.iter().filter(|one| include_hidden || !is_hidden(&one.name));
    let services: Vec<&SeenService> = services.collect();
    if session.json {
        let all = services.iter().map(|one| one.to_json()).collect::<Vec<_>>();
        return session.put(&json!({ "services": all }));
    }
    let titles =
        services.iter().map(|one| titled(&one.name, &session.shown_types(&one.types), show_types));
    session.put_list("service", &titles.collect::<Vec<_>>(), count)
}

/// Looks up a service by name.
fn look_up(session: &mut Session<'_>, name: &str) -> Outcome<SeenService> {
    let name = full_name(name);
    let (seen, is_there) = session.look_for(|seen| seen.service(&name).is_some());
    session.check_interrupted()?;
    let seen = if is_there { session.look() } else { seen };
    seen.service(&name).cloned().ok_or_else(|| {
        let near = advice(&name, seen.services.iter().map(|one| one.name.as_str()));
        Failure::failed(format!("Unknown service '{name}'{near}"))
    })
}

/// Prints the types of a service.
///
/// # Errors
/// When there is no such service, or the output cannot be written.
pub fn type_of(session: &mut Session<'_>, name: &str) -> Outcome {
    let service = look_up(session, name)?;
    session.put_types(&service.name, &service.types)
}

/// Prints the numbers of servers and clients of a service.
///
/// # Errors
/// When there is no such service, or the output cannot be written.
pub fn info(session: &mut Session<'_>, name: &str, verbose: bool) -> Outcome {
    let service = look_up(session, name)?;
    if session.json {
        return session.put(&service.to_json());
    }
    let types = session.shown_types(&service.types).join(", ");
    writeln!(session.out, "Type: {types}")?;
    for (what, nodes) in [("Clients", &service.clients), ("Services", &service.servers)] {
        writeln!(session.out, "{what} count: {}", nodes.len())?;
        if verbose {
            for node in nodes {
                writeln!(session.out, "  {node}")?;
            }
        }
    }
    session.out.flush()?;
    Ok(())
}

/// Lists the services of a type.
///
/// # Errors
/// When the output cannot be written.
pub fn find(
    session: &mut Session<'_>,
    type_name: &str,
    count: bool,
    include_hidden: bool,
) -> Outcome {
    let type_name = full_type(type_name, InterfaceKind::Service)?;
    let seen = session.look();
    let services = seen.services.iter().filter(|one| one.types.contains(&type_name));
    let names = services.map(|one| one.name.as_str());
    let names: Vec<&str> = names.filter(|name| include_hidden || !is_hidden(name)).collect();
    session.put_found(&type_name, "services", &names, count)
}

/// Calls a service once or periodically. Without a type, that of the service is used.
///
/// # Errors
/// When the type or a value is unusable, there is no server, or the output cannot be written.
pub fn call(
    session: &mut Session<'_>,
    name: &str,
    type_name: &str,
    values: &str,
    rate_hz: Option<f64>,
) -> Outcome {
    let (type_name, request, response) = session.types.service(type_name)?;
    let (request, response) = (request.clone(), response.clone());
    let values = Values::read(values)?;
    values.message(&request, clock::unix_ns())?;
    let name = full_name(name);
    let node = session.node(None)?;
    let hash = session.types.registry().hash(&type_name);
    let asker = ServiceCaller::new(&node, &name, &type_name, hash.as_deref())?;
    if !asker.wait(session, Some(REPORT_PERIOD))? {
        session.say("waiting for service to become available...");
        asker.wait(session, None)?;
    }
    let repeat = |session: &mut Session<'_>| -> Outcome {
        loop {
            let clock = Stopwatch::start();
            let question = values.message(&request, crate::clock::unix_ns())?;
            if !session.json {
                writeln!(session.out, "requester: making request: {}\n", show::repr(&question))?;
                session.out.flush()?;
            }
            let mut cdr = Vec::new();
            question
                .encode(Format::CDR, &mut cdr)
                .map_err(|error| Failure::failed(format!("the request cannot be sent: {error}")))?;
            let answer = asker.ask(cdr).wait(session, None)?;
            let answer =
                DynamicMessage::decode(&response, Format::CDR, &answer).map_err(|error| {
                    Failure::failed(format!("the response cannot be decoded: {error}"))
                })?;
            if session.json {
                session.put(&answer.to_json())?;
            } else {
                writeln!(session.out, "response:\n{}\n", show::repr(&answer))?;
                session.out.flush()?;
            }
            let Some(rate_hz) = rate_hz else { return Ok(()) };
            let period = Duration::from_secs_f64(1.0 / rate_hz);
            while clock.elapsed() < period {
                session.check_interrupted()?;
                sleep((period - clock.elapsed().min(period)).min(INTERRUPT_POLL_PERIOD));
            }
        }
    };
    let outcome = repeat(session);
    if rate_hz.is_some() { endless(outcome) } else { outcome }
}
