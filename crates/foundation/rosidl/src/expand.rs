//! Types implied by services and actions.
//!
//! Names, fields and their order are those of `rosidl_generator_type_description` (checked in the
//! tests by the hashes that it publishes).

use periplus_diagnostics::Origin;

use crate::{ArrayShape, Definition, ElementType, Field, InterfaceKind, Scalar, Type, TypeName};

/// Content of one interface text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interface {
    /// Its full name.
    pub name: TypeName,
    /// Text of the comments at the top.
    pub doc: String,
    /// The message; or request and response; or goal, result and feedback. Their names are those of the
    /// implied types, such as `Trigger_Request`.
    pub parts: Vec<Definition>,
}

/// Returns all types that an interface defines: for a message the message itself; for a service its
/// request, response, event and the service as a whole; for an action these for both of its services, the
/// goal, result, feedback, the feedback's message, and the action as a whole.
#[must_use]
pub fn expand(interface: &Interface) -> Vec<Definition> {
    let mut all = interface.parts.clone();
    let name = &interface.name;
    match name.kind {
        InterfaceKind::Message => {}
        InterfaceKind::Service => all.extend(service(name, &interface.doc)),
        InterfaceKind::Action => {
            let uuid = || field("goal_id", message("unique_identifier_msgs", "UUID"));
            let own = |suffix: &str| ElementType::Nested(name.implied(suffix));
            let send = name.implied("SendGoal");
            all.push(implied(send.implied("Request"), vec![uuid(), field("goal", own("Goal"))]));
            let accepted = field("accepted", ElementType::Scalar(Scalar::Bool));
            let stamp = field("stamp", message("builtin_interfaces", "Time"));
            all.push(implied(send.implied("Response"), vec![accepted, stamp]));
            all.extend(service(&send, ""));
            let get = name.implied("GetResult");
            all.push(implied(get.implied("Request"), vec![uuid()]));
            let status = field("status", ElementType::Scalar(Scalar::I8));
            all.push(implied(
                get.implied("Response"),
                vec![status, field("result", own("Result"))],
            ));
            all.extend(service(&get, ""));
            let feedback = field("feedback", own("Feedback"));
            all.push(implied(name.implied("FeedbackMessage"), vec![uuid(), feedback]));
            let whole = [
                ("goal", "Goal"),
                ("result", "Result"),
                ("feedback", "Feedback"),
                ("send_goal_service", "SendGoal"),
                ("get_result_service", "GetResult"),
                ("feedback_message", "FeedbackMessage"),
            ];
            let fields = whole.map(|(name, suffix)| field(name, own(suffix)));
            all.push(implied(name.clone(), fields.into()));
        }
    }
    all
}

/// Event of a service, and the service as a whole.
fn service(name: &TypeName, doc: &str) -> [Definition; 2] {
    let own = |suffix: &str| ElementType::Nested(name.implied(suffix));
    let at_most_one = |name: &str, element| Field {
        r#type: Type { element, shape: ArrayShape::Bounded(1) },
        ..field(name, ElementType::Scalar(Scalar::Bool))
    };
    let event = vec![
        field("info", message("service_msgs", "ServiceEventInfo")),
        at_most_one("request", own("Request")),
        at_most_one("response", own("Response")),
    ];
    let whole = [
        ("request_message", "Request"),
        ("response_message", "Response"),
        ("event_message", "Event"),
    ];
    let whole = whole.map(|(name, suffix)| field(name, own(suffix)));
    let mut service = implied(name.clone(), whole.into());
    service.doc = doc.into();
    [implied(name.implied("Event"), event), service]
}

fn implied(name: TypeName, fields: Vec<Field>) -> Definition {
    Definition { name, fields, constants: Vec::new(), doc: String::new(), text: String::new() }
}

fn message(package: &str, name: &str) -> ElementType {
    ElementType::Nested(TypeName::message(package, name))
}

fn field(name: &str, element: ElementType) -> Field {
    Field {
        name: name.into(),
        r#type: Type { element, shape: ArrayShape::One },
        default: None,
        doc: String::new(),
        origin: Origin::default(),
    }
}
