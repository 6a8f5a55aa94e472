//! Messages, services and actions.

use std::fmt::Debug;

use crate::builtin_interfaces::Time;
use crate::unique_identifier_msgs::UUID;
use crate::{Codec, DecodeError, EncodeError, Format, TypeRegistry};

/// Message type.
pub trait Message: Codec + Clone + Debug + Default + PartialEq + Send + Sync + 'static {
    /// Full name of the type, such as `sensor_msgs/msg/LaserScan`.
    const TYPE_NAME: &'static str;
    /// Type hash, such as `RIHS01_64c19139...`.
    const TYPE_HASH: &'static str;

    /// Appends its form in little endian CDR to `out`, with the four bytes of the encapsulation header.
    ///
    /// # Errors
    /// If a string or list is longer than its type allows.
    fn encode_cdr(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        crate::encode(self, Format::CDR, out)
    }

    /// As [`Message::encode_cdr`], into a new vector.
    ///
    /// # Errors
    /// As [`Message::encode_cdr`].
    fn to_cdr(&self) -> Result<Vec<u8>, EncodeError> {
        let mut out = Vec::new();
        self.encode_cdr(&mut out)?;
        Ok(out)
    }

    /// Decodes CDR of either byte order.
    ///
    /// # Errors
    /// If the bytes are not such a message.
    fn decode_cdr(bytes: &[u8]) -> Result<Self, DecodeError> {
        crate::decode(Format::CDR, bytes)
    }

    /// Appends its form in ROS 1 to `out`.
    ///
    /// # Errors
    /// If a string or list is longer than its type allows.
    fn encode_ros1(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        crate::encode(self, Format::Ros1, out)
    }

    /// Decodes the form of ROS 1. The sequence number of headers is dropped.
    ///
    /// # Errors
    /// If the bytes are not such a message.
    fn decode_ros1(bytes: &[u8]) -> Result<Self, DecodeError> {
        crate::decode(Format::Ros1, bytes)
    }

    /// JSON form; see [`crate::to_json`].
    fn to_json(&self) -> serde_json::Value {
        crate::to_json(self)
    }

    /// Parses JSON; missing fields have their default values.
    ///
    /// # Errors
    /// If the JSON does not match the type.
    fn from_json(json: &serde_json::Value) -> Result<Self, DecodeError> {
        crate::from_json(json)
    }

    /// Texts that define it, for MCAP's `ros2msg`.
    #[must_use]
    fn schema_text() -> &'static str {
        TypeRegistry::builtin().schema_text(Self::TYPE_NAME).unwrap_or_default()
    }
}

/// Service type.
pub trait Service: Send + Sync + 'static {
    /// Request message.
    type Request: Message;
    /// Response message.
    type Response: Message;
    /// Full name of the type, such as `std_srvs/srv/Trigger`.
    const TYPE_NAME: &'static str;
    /// Its type hash.
    const TYPE_HASH: &'static str;
}

/// Request of a service.
type Request<S> = <S as Service>::Request;

/// Response of a service.
type Response<S> = <S as Service>::Response;

/// Action type.
pub trait Action: Send + Sync + 'static {
    /// Goal message.
    type Goal: Message;
    /// Result message.
    type Result: Message;
    /// Feedback message.
    type Feedback: Message;
    /// Service that sends a goal.
    type SendGoal: Service;
    /// Service that waits for the result.
    type GetResult: Service;
    /// Feedback message with the goal id.
    type FeedbackMessage: Message;
    /// Full name of the type, such as `nav2_msgs/action/Wait`.
    const TYPE_NAME: &'static str;
    /// Its type hash.
    const TYPE_HASH: &'static str;

    /// Creates a request that sends a goal.
    fn send_goal_request(goal_id: UUID, goal: Self::Goal) -> Request<Self::SendGoal>;
    /// Goal id and goal of a request.
    fn goal_of_request(request: &Request<Self::SendGoal>) -> (&UUID, &Self::Goal);
    /// Creates the response to a goal: accepted or not, and when.
    fn send_goal_response(accepted: bool, stamp: Time) -> Response<Self::SendGoal>;
    /// Acceptance and its time, of a response.
    fn acceptance_of_response(response: &Response<Self::SendGoal>) -> (bool, &Time);
    /// Creates a request for the result of a goal.
    fn get_result_request(goal_id: UUID) -> Request<Self::GetResult>;
    /// Goal id of a request for a result.
    fn goal_id_of_request(request: &Request<Self::GetResult>) -> &UUID;
    /// Creates the response with the status (`action_msgs/msg/GoalStatus`) and the result of a goal.
    fn get_result_response(status: i8, result: Self::Result) -> Response<Self::GetResult>;
    /// Status and result of a response.
    fn result_of_response(response: &Response<Self::GetResult>) -> (i8, &Self::Result);
    /// Creates a feedback message.
    fn feedback_message(goal_id: UUID, feedback: Self::Feedback) -> Self::FeedbackMessage;
    /// Goal id and feedback of a feedback message.
    fn feedback_of_message(message: &Self::FeedbackMessage) -> (&UUID, &Self::Feedback);
}
