//! `action send_goal`.

use std::hash::{BuildHasher as _, Hasher as _, RandomState};
use std::sync::Arc;
use std::time::Duration;

use periplus_graph::{Node, Qos, RawMailbox};
use periplus_msgs::action_msgs::{CancelGoal, CancelGoalRequest, GoalStatus};
use periplus_msgs::{DynamicMessage, Format, Layout, Number, Value, YamlStyle};
use periplus_os::{Stopwatch, sleep};
use periplus_rosidl::InterfaceKind;
use serde_json::json;

use crate::ask::{PendingRequest, RESPONSE_TIMEOUT, ServiceCaller, ask};
use crate::session::full_name;
use crate::types::full_type;
use crate::{Failure, NodeRefusal, Outcome, Ros2Line, Session, Values, clock};

/// Polling period for feedback and the result.
const POLL_PERIOD: Duration = Duration::from_millis(2);

/// Sends a goal, waits for its result and prints it; with `feedback` also prints the feedback. An
/// interrupt cancels the goal.
///
/// # Errors
/// When the type or a value is unusable, the goal is rejected, or the output cannot be written.
pub fn send_goal(
    session: &mut Session<'_>,
    name: &str,
    type_name: &str,
    values: &str,
    feedback: bool,
) -> Outcome {
    let type_name = full_type(type_name, InterfaceKind::Action)?;
    let (_, goal_layout) = session.types.action(&type_name, "Goal")?;
    let values = Values::read(values)?;
    let goal = values.message(goal_layout, clock::unix_ns())?;
    let name = full_name(name);
    let node = session.node(None)?;
    let action = Action { session, node: &node, name: &name, type_name: &type_name };
    action.run(&goal, feedback)
}

struct Action<'a, 's> {
    session: &'a mut Session<'s>,
    node: &'a Node,
    name: &'a str,
    type_name: &'a str,
}

impl Action<'_, '_> {
    fn run(mut self, goal: &DynamicMessage, feedback: bool) -> Outcome {
        let sending = self.asker("send_goal", "SendGoal")?;
        self.print("Waiting for an action server to become available...\n", "", "")?;
        sending.wait(self.session, None)?;
        // Subscribed before the goal is sent, so that no feedback is missed.
        let results = self.asker("get_result", "GetResult")?;
        let mailbox = if feedback { Some(self.feedback()?) } else { None };
        self.print("Sending goal:\n     ", &goal.to_yaml(&YamlStyle::default()), "\n")?;
        let id = uuid();
        let request = json!({ "goal_id": { "uuid": id }, "goal": goal.to_json() });
        let question = self.ask(&sending, "SendGoal_Request", &request)?;
        let answer = question.wait(self.session, Some(RESPONSE_TIMEOUT))?;
        let accepted = self.decode("SendGoal_Response", &answer)?;
        if accepted.get("accepted") != Some(Value::Number(Number::Bool(true))) {
            let message = "Goal was rejected.".to_owned();
            let ros2 = Ros2Line::Stdout(message.clone());
            return Err(Failure::Refused(NodeRefusal { message, ros2 }));
        }
        let hex: String = id.iter().map(|byte| format!("{byte:02x}")).collect();
        self.print("Goal accepted with ID: ", &hex, "\n\n")?;
        if self.session.json {
            self.session.put(&json!({ "accepted": true, "goal_id": hex }))?;
        }
        let request = json!({ "goal_id": { "uuid": id } });
        results.wait(self.session, Some(RESPONSE_TIMEOUT))?;
        let question = self.ask(&results, "GetResult_Request", &request)?;
        match self.follow(&question, mailbox.as_ref(), id) {
            Err(Failure::Interrupted) => self.cancel(id),
            outcome => outcome,
        }
    }

    /// Prints feedback until the result arrives, and then the result.
    fn follow(
        &mut self,
        result: &PendingRequest,
        feedback: Option<&(RawMailbox, Arc<Layout>)>,
        id: [u8; 16],
    ) -> Outcome {
        loop {
            if let Some((mailbox, layout)) = feedback {
                for sample in mailbox.drain() {
                    let Ok(cdr) = sample.cdr() else { continue };
                    let Ok(message) = DynamicMessage::decode(layout, Format::CDR, cdr) else {
                        continue;
                    };
                    self.show_feedback(&message, id)?;
                }
            }
            if let Some(answer) = result.take()? {
                return self.finish(&self.decode("GetResult_Response", &answer)?);
            }
            self.session.check_interrupted()?;
            sleep(POLL_PERIOD);
        }
    }

    fn show_feedback(&mut self, message: &DynamicMessage, id: [u8; 16]) -> Outcome {
        let json = message.to_json();
        // Other clients may have goals on the same server.
        if json["goal_id"]["uuid"] != json!(id) {
            return Ok(());
        }
        if self.session.json {
            return self.session.put(&json!({ "feedback": json["feedback"] }));
        }
        let part = message.part("feedback").map(|part| part.to_yaml(&YamlStyle::default()));
        self.print("Feedback:\n    ", &part.unwrap_or_default(), "\n")
    }

    fn finish(&mut self, answer: &DynamicMessage) -> Outcome {
        let status = match answer.get("status") {
            Some(Value::Number(Number::I8(status))) => status,
            _ => GoalStatus::STATUS_UNKNOWN,
        };
        let word = match status {
            GoalStatus::STATUS_ACCEPTED => "ACCEPTED",
            GoalStatus::STATUS_EXECUTING => "EXECUTING",
            GoalStatus::STATUS_CANCELING => "CANCELING",
            GoalStatus::STATUS_SUCCEEDED => "SUCCEEDED",
            GoalStatus::STATUS_CANCELED => "CANCELED",
            GoalStatus::STATUS_ABORTED => "ABORTED",
            _ => "UNKNOWN",
        };
        if self.session.json {
            let result = &answer.to_json()["result"];
            self.session.put(&json!({ "status": word, "result": result }))?;
        } else {
            let part = answer.part("result").map(|part| part.to_yaml(&YamlStyle::default()));
            self.print("Result:\n    ", &part.unwrap_or_default(), "\n")?;
            self.print("Goal finished with status: ", word, "\n")?;
        }
        match status {
            GoalStatus::STATUS_SUCCEEDED => Ok(()),
            _ => Err(Failure::Refused(NodeRefusal {
                message: format!("the goal of {} ended as {word}", self.name),
                ros2: Ros2Line::Nothing,
            })),
        }
    }

    /// Cancels the goal, because its result will not be awaited.
    fn cancel(&mut self, id: [u8; 16]) -> Outcome {
        self.session.say("Canceling goal...");
        let mut request = CancelGoalRequest::default();
        request.goal_info.goal_id.uuid = id;
        let service = format!("{}/_action/cancel_goal", self.name);
        // The interrupt flag is set already; the cancellation must still run.
        let check_interrupted = std::sync::atomic::AtomicBool::new(false);
        let (mut out, mut talk) = (std::io::sink(), std::io::sink());
        let session = Session {
            network: self.session.network,
            types: self.session.types,
            out: &mut out,
            talk: &mut talk,
            stop: &check_interrupted,
            json: false,
            spin_time: self.session.spin_time,
        };
        let answer = ask::<CancelGoal>(&session, self.node, &service, &request)?;
        if answer.goals_canceling.is_empty() {
            return Err(Failure::failed("Failed to cancel goal"));
        }
        self.session.say("Goal canceled.");
        Err(Failure::Interrupted)
    }

    fn asker(&self, service: &str, suffix: &str) -> Outcome<ServiceCaller> {
        let type_name = format!("{}_{suffix}", self.type_name);
        let hash = self.session.types.registry().hash(&type_name);
        let name = format!("{}/_action/{service}", self.name);
        ServiceCaller::new(self.node, &name, &type_name, hash.as_deref())
    }

    fn feedback(&self) -> Outcome<(RawMailbox, Arc<Layout>)> {
        let (_, layout) = self.session.types.action(self.type_name, "FeedbackMessage")?;
        let hash = self.session.types.registry().hash(layout.type_name());
        let topic = format!("{}/_action/feedback", self.name);
        let (name, qos) = (layout.type_name(), Qos::reliable(10));
        Ok((self.node.raw_mailbox(&topic, name, hash.as_deref(), qos)?, layout.clone()))
    }

    fn ask(
        &self,
        asker: &ServiceCaller,
        part: &str,
        json: &serde_json::Value,
    ) -> Outcome<PendingRequest> {
        let (_, layout) = self.session.types.action(self.type_name, part)?;
        let message = DynamicMessage::from_json(layout, json).map_err(|error| {
            Failure::failed(format!("the goal does not match its type: {error}"))
        })?;
        let mut cdr = Vec::new();
        message
            .encode(Format::CDR, &mut cdr)
            .map_err(|error| Failure::failed(format!("the goal cannot be sent: {error}")))?;
        Ok(asker.ask(cdr))
    }

    fn decode(&self, part: &str, cdr: &[u8]) -> Outcome<DynamicMessage> {
        let (_, layout) = self.session.types.action(self.type_name, part)?;
        DynamicMessage::decode(layout, Format::CDR, cdr)
            .map_err(|error| Failure::failed(format!("the response cannot be decoded: {error}")))
    }

    /// Prints text, except in JSON mode.
    fn print(&mut self, before: &str, text: &str, after: &str) -> Outcome {
        if !self.session.json {
            write!(self.session.out, "{before}{text}{after}")?;
            self.session.out.flush()?;
        }
        Ok(())
    }
}

/// Random UUID (RFC 4122, version 4). The keys of the hasher come from the system.
fn uuid() -> [u8; 16] {
    let clock = Stopwatch::start();
    let half = || {
        let mut hasher = RandomState::new().build_hasher();
        hasher.write_u128(clock.elapsed().as_nanos());
        hasher.finish().to_le_bytes()
    };
    let mut id = [0; 16];
    id[..8].copy_from_slice(&half());
    id[8..].copy_from_slice(&half());
    id[6] = id[6] & 0x0f | 0x40;
    id[8] = id[8] & 0x3f | 0x80;
    id
}
