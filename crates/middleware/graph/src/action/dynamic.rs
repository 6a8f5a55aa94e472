//! Action clients for types that are known only by name.

use std::sync::{Arc, Mutex};

use periplus_msgs::action_msgs::{CancelGoal, CancelGoalRequest, GoalInfo};
use periplus_msgs::{DecodeError, DynamicMessage, Format, Layout, TypeRegistry};
use serde_json::{Value, json};

use super::client::Ids;
use super::goal::{GoalId, GoalState};
use super::{FEEDBACK_QOS, Names};
use crate::common::lock;
use crate::node::Node;
use crate::{CallError, Client, GraphError, Pending, RawClient, RawMailbox, RawMessage};

/// Sends goals of an action whose type is given by name, as command lines need.
pub struct DynamicActionClient {
    ids: Ids,
    types: Types,
    send: RawClient,
    result: Arc<RawClient>,
    cancel: Client<CancelGoal>,
    feedback: RawMailbox,
}

/// Types of the messages that are sent.
#[derive(Clone)]
struct Types {
    send_request: Arc<Layout>,
    send_response: Arc<Layout>,
    result_request: Arc<Layout>,
    result_response: Arc<Layout>,
    feedback: Arc<Layout>,
}

impl Node {
    /// Creates a client for an action type such as `nav2_msgs/action/NavigateToPose`.
    ///
    /// # Errors
    /// When the type is not known, the name is not valid, or a topic or service of it has another
    /// type.
    pub fn dynamic_action_client(
        &self,
        name: &str,
        type_name: &str,
        types: &TypeRegistry,
    ) -> Result<DynamicActionClient, GraphError> {
        let names = Names::new(self, name)?;
        let layout = |suffix: &str| {
            let wanted = format!("{type_name}_{suffix}");
            types.layout(&wanted).cloned().ok_or_else(|| unknown(type_name, types))
        };
        let client = |end: &str, suffix: &str| {
            let service = format!("{type_name}_{suffix}");
            self.raw_client(&names.end(end), &service, types.hash(&service).as_deref())
        };
        let own = Types {
            send_request: layout("SendGoal_Request")?,
            send_response: layout("SendGoal_Response")?,
            result_request: layout("GetResult_Request")?,
            result_response: layout("GetResult_Response")?,
            feedback: layout("FeedbackMessage")?,
        };
        let feedback = own.feedback.type_name();
        let hash = types.hash(feedback);
        Ok(DynamicActionClient {
            ids: Ids::new(self),
            send: client("send_goal", "SendGoal")?,
            result: Arc::new(client("get_result", "GetResult")?),
            cancel: self.client(&names.end("cancel_goal"))?,
            feedback: self.raw_mailbox(
                &names.end("feedback"),
                feedback,
                hash.as_deref(),
                FEEDBACK_QOS,
            )?,
            types: own,
        })
    }
}

fn unknown(type_name: &str, types: &TypeRegistry) -> GraphError {
    let known = types.type_names().filter_map(|name| name.strip_suffix("_SendGoal_Request"));
    let near = periplus_diagnostics::closest(type_name, known);
    let near = near.map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
    let reason = format!("the action type `{type_name}` is unknown{near}");
    GraphError::Value { reason }
}

impl DynamicActionClient {
    /// True if an action server is available.
    #[must_use]
    pub fn is_ready(&self) -> bool {
        self.send.is_ready() && self.result.is_ready() && self.cancel.is_ready()
    }

    /// Sends a goal, given as JSON; missing fields keep their defaults.
    ///
    /// # Errors
    /// When the JSON has fields that the type does not have, or values of another type.
    pub fn send(&self, goal: &Value) -> Result<DynamicGoal, DecodeError> {
        let id = self.ids.next();
        let request = json!({ "goal_id": { "uuid": id.0 }, "goal": goal });
        let cdr = encode(&self.types.send_request, &request)?;
        let stage = Arc::new(Mutex::new(Stage::Sent));
        let (shared, types, result) = (stage.clone(), self.types.clone(), self.result.clone());
        self.send.call(cdr, move |answer| {
            let accepted = answer.and_then(|answer| read(&types.send_response, &answer));
            let next = match accepted {
                Err(error) => Stage::Done(DynamicProgress::Failed(error)),
                Ok(answer) if answer.to_json()["accepted"] == json!(true) => Stage::Accepted,
                Ok(_) => Stage::Done(DynamicProgress::Rejected),
            };
            let is_accepted = matches!(next, Stage::Accepted);
            *lock(&shared) = next;
            let request = json!({ "goal_id": { "uuid": id.0 } });
            let Ok(cdr) = encode(&types.result_request, &request) else { return };
            if is_accepted {
                result.call(cdr, move |answer| {
                    let answer = answer.and_then(|answer| read(&types.result_response, &answer));
                    let over = answer.map_or_else(DynamicProgress::Failed, over);
                    *lock(&shared) = Stage::Done(over);
                });
            }
        });
        Ok(DynamicGoal { id, stage })
    }

    /// Returns the feedback received since the last call, for the goals of all clients, as messages
    /// of the type `..._FeedbackMessage`, whose field `feedback` holds the content.
    #[must_use]
    pub fn feedback(&self) -> Vec<(GoalId, DynamicMessage)> {
        let samples = self.feedback.drain();
        let read = |sample: &crate::Sample| {
            let cdr = sample.cdr().ok()?;
            let message = DynamicMessage::decode(&self.types.feedback, Format::CDR, cdr).ok()?;
            Some((id_of(&message.to_json()["goal_id"]["uuid"])?, message))
        };
        samples.iter().filter_map(read).collect()
    }

    /// Requests cancellation of a goal; [`GoalId::NONE`] means all.
    #[must_use]
    pub fn cancel(&self, id: GoalId) -> Pending<CancelGoal> {
        let goal_info = GoalInfo { goal_id: id.into(), ..Default::default() };
        self.cancel.call(CancelGoalRequest { goal_info })
    }
}

fn encode(layout: &Arc<Layout>, json: &Value) -> Result<Vec<u8>, DecodeError> {
    let message = DynamicMessage::from_json(layout, json)?;
    let mut cdr = Vec::new();
    message.encode(Format::CDR, &mut cdr).map_err(|error| DecodeError {
        problem: periplus_msgs::Problem::Bound { count: error.count, limit: error.limit },
        path: error.field,
        offset: 0,
    })?;
    Ok(cdr)
}

fn read(layout: &Arc<Layout>, message: &RawMessage) -> Result<DynamicMessage, CallError> {
    let fail =
        |reason: String| CallError::Undecodable { service: layout.type_name().to_owned(), reason };
    let cdr = message.cdr().map_err(|error| fail(error.to_string()))?;
    DynamicMessage::decode(layout, Format::CDR, cdr).map_err(|error| fail(error.to_string()))
}

fn over(answer: DynamicMessage) -> DynamicProgress {
    let status = answer.to_json()["status"].as_i64().and_then(|status| i8::try_from(status).ok());
    DynamicProgress::Over(GoalState::of_number(status.unwrap_or_default()), answer)
}

fn id_of(uuid: &Value) -> Option<GoalId> {
    let bytes: Option<Vec<u8>> =
        uuid.as_array()?.iter().map(|byte| u8::try_from(byte.as_u64()?).ok()).collect();
    Some(GoalId(bytes?.try_into().ok()?))
}

/// Progress of a goal.
#[derive(Clone, Debug, PartialEq)]
pub enum DynamicProgress {
    /// Sent; not answered yet.
    Sent,
    /// Rejected by the server.
    Rejected,
    /// Accepted; the result is pending.
    Accepted,
    /// Finished: the final state, and the message of the type `..._GetResult_Response`, whose field
    /// `result` holds the result.
    Over(GoalState, DynamicMessage),
    /// The call failed.
    Failed(CallError),
}

/// A goal that was sent.
pub struct DynamicGoal {
    id: GoalId,
    stage: Arc<Mutex<Stage>>,
}

enum Stage {
    Sent,
    Accepted,
    Done(DynamicProgress),
}

impl DynamicGoal {
    /// Id of the goal.
    #[must_use]
    pub fn id(&self) -> GoalId {
        self.id
    }

    /// Returns the progress of the goal.
    #[must_use]
    pub fn look(&self) -> DynamicProgress {
        match &*lock(&self.stage) {
            Stage::Sent => DynamicProgress::Sent,
            Stage::Accepted => DynamicProgress::Accepted,
            Stage::Done(progress) => progress.clone(),
        }
    }
}
