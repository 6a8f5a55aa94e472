//! Messages, services and actions.

use std::fmt::Debug;

use crate::builtin_interfaces::Time;
use crate::unique_identifier_msgs::UUID;
use crate::{Codec, DecodeError, EncodeError, Format, TypeRegistry};

/// A type that is sent as a whole.
pub trait Message: Codec + Clone + Debug + Default + PartialEq + Send + Sync + 'static {
    /// Its full name, such as `sensor_msgs/msg/LaserScan`.
    const TYPE_NAME: &'static str;
    /// Its type hash, such as `RIHS01_64c19139...`.
    const TYPE_HASH: &'static str;

    /// Appends it to `out` as little endian CDR with the four bytes in front that say so.
    ///
    /// # Errors
    /// When a string or list is longer than its type allows.
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

    /// Reads CDR of either endianness.
    ///
    /// # Errors
    /// When the bytes are no such message.
    fn decode_cdr(bytes: &[u8]) -> Result<Self, DecodeError> {
        crate::decode(Format::CDR, bytes)
    }

    /// Appends it to `out` as ROS 1 would send it.
    ///
    /// # Errors
    /// When a string or list is longer than its type allows.
    fn encode_ros1(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        crate::encode(self, Format::Ros1, out)
    }

    /// Reads what ROS 1 sent. The counter of its headers is left out.
    ///
    /// # Errors
    /// When the bytes are no such message.
    fn decode_ros1(bytes: &[u8]) -> Result<Self, DecodeError> {
        crate::decode(Format::Ros1, bytes)
    }

    /// As JSON; see [`crate::to_json`].
    fn to_json(&self) -> serde_json::Value {
        crate::to_json(self)
    }

    /// From JSON; fields that are not given keep their defaults.
    ///
    /// # Errors
    /// When something else is there than the type has.
    fn from_json(json: &serde_json::Value) -> Result<Self, DecodeError> {
        crate::from_json(json)
    }

    /// The texts that define it, as MCAP's `ros2msg` wants them.
    #[must_use]
    fn schema_text() -> &'static str {
        TypeRegistry::builtin().schema_text(Self::TYPE_NAME).unwrap_or_default()
    }
}

/// A question and its answer.
pub trait Service: Send + Sync + 'static {
    /// The question.
    type Request: Message;
    /// The answer.
    type Response: Message;
    /// Its full name, such as `std_srvs/srv/Trigger`.
    const TYPE_NAME: &'static str;
    /// Its type hash.
    const TYPE_HASH: &'static str;
}

/// The question of a service.
type Request<S> = <S as Service>::Request;

/// The answer of a service.
type Response<S> = <S as Service>::Response;

/// A task that takes time, tells how far it is, and can be stopped.
pub trait Action: Send + Sync + 'static {
    /// What to do.
    type Goal: Message;
    /// What came of it.
    type Result: Message;
    /// How far it is.
    type Feedback: Message;
    /// Begins a task.
    type SendGoal: Service;
    /// Waits for its end.
    type GetResult: Service;
    /// How far it is, with the name of the task.
    type FeedbackMessage: Message;
    /// Its full name, such as `nav2_msgs/action/Wait`.
    const TYPE_NAME: &'static str;
    /// Its type hash.
    const TYPE_HASH: &'static str;

    /// Asks to begin a task.
    fn send_goal(goal_id: UUID, goal: Self::Goal) -> Request<Self::SendGoal>;
    /// Which task is to begin, and what is to be done.
    fn sent_goal(request: &Request<Self::SendGoal>) -> (&UUID, &Self::Goal);
    /// Whether it begins, and when.
    fn accept_goal(accepted: bool, stamp: Time) -> Response<Self::SendGoal>;
    /// Whether it began, and when.
    fn accepted_goal(response: &Response<Self::SendGoal>) -> (bool, &Time);
    /// Asks for the end of a task.
    fn get_result(goal_id: UUID) -> Request<Self::GetResult>;
    /// Whose end is asked for.
    fn asked_result(request: &Request<Self::GetResult>) -> &UUID;
    /// How a task ended, by `action_msgs/msg/GoalStatus`, and what came of it.
    fn give_result(status: i8, result: Self::Result) -> Response<Self::GetResult>;
    /// As [`Action::give_result`], read.
    fn given_result(response: &Response<Self::GetResult>) -> (i8, &Self::Result);
    /// How far a task is.
    fn tell_feedback(goal_id: UUID, feedback: Self::Feedback) -> Self::FeedbackMessage;
    /// As [`Action::tell_feedback`], read.
    fn told_feedback(message: &Self::FeedbackMessage) -> (&UUID, &Self::Feedback);
}
