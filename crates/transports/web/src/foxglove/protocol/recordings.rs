//! Messages about recordings. Extension of Foxglove's protocol.

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Value, json};

use crate::foxglove::frame::WebSocketFrame;

/// A time in nanoseconds, as text: numbers of JSON lose digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TimeNs(pub i64);

impl<'de> Deserialize<'de> for TimeNs {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let wrong = |_| serde::de::Error::custom(format!("`{text}` is not a time in nanoseconds"));
        text.parse().map(Self).map_err(wrong)
    }
}

impl Serialize for TimeNs {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&self.0)
    }
}

/// A request about recordings.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "op", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum ReplayRequest {
    /// Subscribes to the list of recordings.
    SubscribeRecordings,
    /// Requests the messages that show a time.
    FetchState {
        /// Id of the response.
        request_id: u32,
        /// Recording.
        recording: u32,
        /// Time.
        time_ns: TimeNs,
        /// Topics with their history.
        topics: Vec<TopicNeed>,
    },
    /// Requests the messages of a span.
    FetchMessages {
        /// Id of the response.
        request_id: u32,
        /// Recording.
        recording: u32,
        /// Topic ids.
        topics: Vec<u32>,
        /// Time of the first messages.
        start_ns: TimeNs,
        /// Time after the last messages.
        end_ns: TimeNs,
        /// Size of the messages at which the answer ends \[bytes\].
        max_bytes: u64,
    },
    /// Ends requests, uploads and jobs.
    CancelFetch {
        /// Ids of the requests.
        request_ids: Vec<u32>,
    },
    /// Requests the number of messages over time.
    FetchDensity {
        /// Id of the response.
        request_id: u32,
        /// Recording.
        recording: u32,
        /// Number of equal bins.
        bins: u32,
    },
    /// Requests the marks.
    FetchMarks {
        /// Id of the response.
        request_id: u32,
        /// Recording.
        recording: u32,
    },
    /// Requests numbers of messages over time.
    FetchSeries {
        /// Id of the response.
        request_id: u32,
        /// Recording.
        recording: u32,
        /// Topic id.
        topic: u32,
        /// Paths of numbers in the messages.
        paths: Vec<String>,
        /// Time of the first message.
        start_ns: TimeNs,
        /// Time after the last message.
        end_ns: TimeNs,
        /// Maximum number of values per path.
        points: u32,
    },
    /// Opens an upload as a recording.
    OpenRecording {
        /// Id of the response.
        request_id: u32,
        /// Upload.
        upload: u32,
    },
    /// Closes a recording.
    CloseRecording {
        /// Id of the response.
        request_id: u32,
        /// Recording.
        recording: u32,
    },
    /// Announces the files of a recording.
    StartUpload {
        /// Id of the response, and of the upload.
        request_id: u32,
        /// Files in the order of their bytes.
        files: Vec<UploadFile>,
    },
    /// Requests the parameters of a kind of job.
    FetchJobParameters {
        /// Id of the response.
        request_id: u32,
        /// Kind of job.
        kind: String,
    },
    /// Runs an estimator over a recording.
    StartJob {
        /// Id of the response.
        request_id: u32,
        /// Kind of job.
        kind: String,
        /// Recording.
        recording: u32,
        /// Changed parameters.
        #[serde(default)]
        parameters: serde_json::Map<String, Value>,
    },
    /// Requests a report of one recording, or of two.
    FetchReport {
        /// Id of the response.
        request_id: u32,
        /// One or two recordings.
        recordings: Vec<u32>,
    },
    /// Requests the difference of two recordings.
    FetchDifference {
        /// Id of the response.
        request_id: u32,
        /// First recording.
        recording: u32,
        /// Second recording.
        other: u32,
    },
    /// Requests the file of a recording.
    FetchFile {
        /// Id of the response.
        request_id: u32,
        /// Recording.
        recording: u32,
    },
    /// Records the graph.
    StartRecording {
        /// Id of the response.
        request_id: u32,
    },
    /// Ends recording the graph.
    StopRecording {
        /// Id of the response.
        request_id: u32,
    },
}

/// A topic of a state, with its history.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct TopicNeed {
    /// Topic id.
    pub id: u32,
    /// Length of the history before the time.
    pub history_ns: TimeNs,
    /// Minimum number of messages.
    pub count: u32,
}

/// A file of an upload.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct UploadFile {
    /// Name.
    pub name: String,
    /// Size \[bytes\].
    pub bytes: u64,
}

impl ReplayRequest {
    /// Opcodes of the requests.
    pub(super) const OPS: [&str; 17] = [
        "subscribeRecordings",
        "fetchState",
        "fetchMessages",
        "cancelFetch",
        "fetchDensity",
        "fetchMarks",
        "fetchSeries",
        "openRecording",
        "closeRecording",
        "startUpload",
        "fetchJobParameters",
        "startJob",
        "fetchReport",
        "fetchDifference",
        "fetchFile",
        "startRecording",
        "stopRecording",
    ];

    /// Id of the response; none for requests without one.
    #[must_use]
    pub fn request_id(&self) -> Option<u32> {
        match self {
            Self::SubscribeRecordings | Self::CancelFetch { .. } => None,
            Self::FetchState { request_id, .. }
            | Self::FetchMessages { request_id, .. }
            | Self::FetchDensity { request_id, .. }
            | Self::FetchMarks { request_id, .. }
            | Self::FetchSeries { request_id, .. }
            | Self::OpenRecording { request_id, .. }
            | Self::CloseRecording { request_id, .. }
            | Self::StartUpload { request_id, .. }
            | Self::FetchJobParameters { request_id, .. }
            | Self::StartJob { request_id, .. }
            | Self::FetchReport { request_id, .. }
            | Self::FetchDifference { request_id, .. }
            | Self::FetchFile { request_id, .. }
            | Self::StartRecording { request_id }
            | Self::StopRecording { request_id } => Some(*request_id),
        }
    }
}

/// A recording in the list.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct RecordingText {
    /// Id.
    pub id: u32,
    /// Name.
    pub name: String,
    /// Format: `mcap`, `rosbag2`, `ros1` or `carmen`; empty while unknown.
    pub kind: &'static str,
    /// `opening`, `ready` or `failed`.
    pub state: &'static str,
    /// Progress of opening, 0 to 1.
    pub progress: f64,
    /// Reason of a failure.
    pub error: Option<String>,
    /// Time of the first message.
    pub start_ns: TimeNs,
    /// Time of the last message.
    pub end_ns: TimeNs,
    /// Size \[bytes\].
    pub bytes: u64,
    /// Number of messages.
    pub message_count: u64,
    /// Damage.
    pub findings: Vec<String>,
    /// Job that made it.
    pub origin: Option<OriginText>,
    /// True if its file is removed when it is closed: an upload, or the result of a job.
    pub is_temporary: bool,
    /// Facts that the recorder wrote, by name.
    pub custom_data: BTreeMap<String, String>,
    /// Topics.
    pub topics: Vec<TopicText>,
}

/// Job that made a recording.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OriginText {
    /// Recording that the job read.
    pub recording: u32,
    /// Kind of job.
    pub kind: String,
    /// Changed parameters.
    pub parameters: serde_json::Map<String, Value>,
}

/// A topic of a recording.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct TopicText {
    /// Id in the recording.
    pub id: u32,
    /// Name.
    pub topic: String,
    /// Message encoding.
    pub encoding: String,
    /// Message type.
    pub schema_name: String,
    /// Encoding of the schema.
    pub schema_encoding: String,
    /// Definition of the type with all types that it refers to.
    pub schema: String,
    /// Number of messages.
    pub count: u64,
    /// True if late subscribers get earlier messages.
    pub is_latched: bool,
}

/// An event worth finding.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct MarkText {
    /// Time.
    pub time_ns: TimeNs,
    /// Kind.
    pub kind: &'static str,
    /// Topic on which it was published.
    pub topic: String,
    /// Description.
    pub text: String,
}

fn text(value: &Value) -> WebSocketFrame {
    WebSocketFrame::text(value.to_string())
}

/// The list of recordings.
#[must_use]
pub(crate) fn recordings(recordings: &[RecordingText], is_recording: bool) -> WebSocketFrame {
    text(&json!({"op": "recordings", "isRecording": is_recording, "recordings": recordings}))
}

/// A failed request, with the reason.
#[must_use]
pub(crate) fn fetch_failure(request_id: u32, why: &str) -> WebSocketFrame {
    text(&json!({"op": "fetchFailure", "requestId": request_id, "message": why}))
}

/// Message counts by topic id.
#[must_use]
pub(crate) fn density(request_id: u32, topics: &BTreeMap<u32, Vec<u64>>) -> WebSocketFrame {
    text(&json!({"op": "density", "requestId": request_id, "topics": topics}))
}

/// The marks found so far.
#[must_use]
pub(crate) fn marks(request_id: u32, marks: &[MarkText], is_complete: bool) -> WebSocketFrame {
    let marks = json!(marks);
    text(&json!({
        "op": "marks", "requestId": request_id, "marks": marks, "isComplete": is_complete,
    }))
}

/// Numbers over time, a list per path.
#[must_use]
pub(crate) fn series(
    request_id: u32,
    times_ns: &[TimeNs],
    values: &[Vec<f64>],
    is_reduced: bool,
) -> WebSocketFrame {
    // JSON has neither NaN nor infinities; serde_json writes null.
    text(&json!({
        "op": "series", "requestId": request_id, "timesNs": times_ns, "values": values,
        "isReduced": is_reduced,
    }))
}

/// An upload may begin.
#[must_use]
pub(crate) fn upload_started(request_id: u32) -> WebSocketFrame {
    text(&json!({"op": "uploadStarted", "requestId": request_id, "upload": request_id}))
}

/// Bytes of an upload that were received.
#[must_use]
pub(crate) fn upload_progress(upload: u32, bytes: u64) -> WebSocketFrame {
    text(&json!({"op": "uploadProgress", "upload": upload, "bytes": bytes}))
}

/// Parameters of a kind of job.
#[must_use]
pub(crate) fn job_parameters(request_id: u32, kind: &str, parameters: &Value) -> WebSocketFrame {
    text(&json!({
        "op": "jobParameters", "requestId": request_id, "kind": kind, "parameters": parameters,
    }))
}

/// A report as an HTML document.
#[must_use]
pub(crate) fn report(request_id: u32, html: &str) -> WebSocketFrame {
    text(&json!({"op": "report", "requestId": request_id, "html": html}))
}

/// Difference of two recordings.
#[must_use]
pub(crate) fn difference(request_id: u32, difference: &Value) -> WebSocketFrame {
    text(&json!({"op": "difference", "requestId": request_id, "difference": difference}))
}

/// Name and size of a file that follows in parts.
#[must_use]
pub(crate) fn file_head(request_id: u32, name: &str, bytes: u64) -> WebSocketFrame {
    text(&json!({"op": "file", "requestId": request_id, "name": name, "bytes": bytes}))
}

/// Part of a file.
#[must_use]
pub(crate) fn file_part(request_id: u32, part: &[u8], is_last: bool) -> WebSocketFrame {
    let mut bytes = Vec::with_capacity(6 + part.len());
    bytes.push(0x12);
    bytes.extend(request_id.to_le_bytes());
    bytes.push(if is_last { IS_LAST } else { 0 });
    bytes.extend_from_slice(part);
    WebSocketFrame::binary(bytes)
}

/// Messages of a recording, encoded one after the other.
#[derive(Debug)]
pub struct StoredMessages {
    request_id: u32,
    bytes: Vec<u8>,
}

/// Size of the head of a frame of messages \[bytes\].
const HEAD_BYTES: usize = 14;

/// Flag of the last frame of an answer.
const IS_LAST: u8 = 1;

/// Flag of an answer after which more messages of the span follow.
const HAS_MORE: u8 = 2;

impl StoredMessages {
    /// Starts a frame.
    #[must_use]
    pub fn new(request_id: u32) -> Self {
        Self { request_id, bytes: vec![0; HEAD_BYTES] }
    }

    /// Appends a message.
    pub fn push(&mut self, topic_id: u32, time_ns: i64, data: &[u8]) {
        self.bytes.extend(topic_id.to_le_bytes());
        self.bytes.extend(u64::try_from(time_ns).unwrap_or(0).to_le_bytes());
        // Messages of recordings have 32-bit lengths.
        self.bytes.extend(u32::try_from(data.len()).unwrap_or(0).to_le_bytes());
        self.bytes.extend_from_slice(data);
    }

    /// Size of the frame so far \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.bytes.len()
    }

    /// Completes a frame after which others follow.
    #[must_use]
    pub fn finish(self, reached_ns: i64) -> WebSocketFrame {
        self.with_flags(0, reached_ns)
    }

    /// Completes the last frame of an answer.
    #[must_use]
    pub fn finish_last(self, reached_ns: i64, has_more: bool) -> WebSocketFrame {
        self.with_flags(IS_LAST | if has_more { HAS_MORE } else { 0 }, reached_ns)
    }

    fn with_flags(mut self, flags: u8, reached_ns: i64) -> WebSocketFrame {
        let mut head = [0; HEAD_BYTES];
        head[0] = 0x10;
        head[1..5].copy_from_slice(&self.request_id.to_le_bytes());
        head[5] = flags;
        head[6..].copy_from_slice(&u64::try_from(reached_ns).unwrap_or(0).to_le_bytes());
        self.bytes[..HEAD_BYTES].copy_from_slice(&head);
        WebSocketFrame::binary(self.bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_has_its_head_and_messages() {
        let mut frame = StoredMessages::new(7);
        frame.push(3, 5, &[9, 8]);
        let bytes = frame.finish_last(6, true).parts().concat();
        let mut expected = vec![0x10, 7, 0, 0, 0, 3, 6, 0, 0, 0, 0, 0, 0, 0];
        expected.extend([3, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 9, 8]);
        assert_eq!(bytes, expected);
    }

    #[test]
    fn a_part_of_a_file_has_its_request_and_flag() {
        assert_eq!(file_part(258, b"ab", false).parts().concat(), b"\x12\x02\x01\0\0\0ab");
        assert_eq!(file_part(1, b"", true).parts().concat(), b"\x12\x01\0\0\0\x01");
    }

    #[test]
    fn times_are_text() {
        assert_eq!(serde_json::from_str(r#""12""#).ok(), Some(TimeNs(12)));
        assert!(serde_json::from_str::<TimeNs>("12").is_err());
        assert!(serde_json::from_str::<TimeNs>(r#""1e3""#).is_err());
        assert_eq!(json!(TimeNs(i64::MAX)), "9223372036854775807");
    }

    #[test]
    fn numbers_that_are_none_are_null() {
        let frame = series(1, &[TimeNs(2)], &[vec![f64::NAN]], false);
        let text = String::from_utf8(frame.parts().concat()).unwrap();
        assert!(text.contains(r#""values":[[null]]"#), "{text}");
    }
}
