//! A server with recordings, and a client that reads its messages.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use periplus_graph::Graph;
use periplus_web::foxglove::{
    ClientSession, FrameKind, Hub, OutboxItem, RecordingSettings, Recordings, Settings,
};
use serde_json::{Value, json};

/// Generous timeout for messages that must arrive.
const SOON: Duration = Duration::from_secs(20);

/// Temporary folder of a test, and a server with recordings in it.
pub(crate) struct Server {
    pub(crate) graph: Graph,
    pub(crate) hub: Hub,
    pub(crate) recordings: Arc<Recordings>,
    pub(crate) folder: PathBuf,
}

impl Server {
    pub(crate) fn open(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("recordings_{name}"));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(folder.join("uploads")).unwrap();
        let graph = Graph::new();
        let hub = Hub::open(&graph, Settings::default()).unwrap();
        let settings = RecordingSettings {
            upload_max_bytes: 1 << 20,
            ..RecordingSettings::new(&folder, folder.join("uploads"))
        };
        let recordings = Recordings::new(settings);
        hub.serve_recordings(recordings.clone());
        Self { graph, hub, recordings, folder }
    }

    /// A server with the recording that [`crate::run`] writes, and a client that has its list.
    pub(crate) fn with_run(name: &str) -> (Self, Client) {
        let server = Self::open(name);
        let path = server.folder.join("run.mcap");
        crate::run::write(&path);
        server.recordings.open(&path).unwrap();
        let client = server.join();
        client.list_when(|list| list["recordings"][0]["state"] == "ready");
        (server, client)
    }

    pub(crate) fn join(&self) -> Client {
        let mut client = Client(self.hub.join().unwrap());
        client.say(&json!({"op": "subscribeRecordings"}));
        client
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

/// A message of a recording: topic id, time, bytes.
pub(crate) type Stored = (u32, u64, Vec<u8>);

/// An answer of messages.
#[derive(Debug, Default)]
pub(crate) struct Answer {
    pub(crate) messages: Vec<Stored>,
    pub(crate) reached_ns: u64,
    pub(crate) has_more: bool,
}

impl Answer {
    /// Topic ids and times.
    pub(crate) fn times(&self) -> Vec<(u32, u64)> {
        self.messages.iter().map(|(topic, time_ns, _)| (*topic, *time_ns)).collect()
    }
}

pub(crate) struct Client(pub(crate) ClientSession);

impl Client {
    pub(crate) fn say(&mut self, text: &Value) {
        self.0.text(&text.to_string());
    }

    /// The next JSON message with one of these opcodes; others are skipped.
    #[track_caller]
    pub(crate) fn hears(&self, ops: &[&str]) -> Value {
        loop {
            match self.0.outbox().take(SOON) {
                OutboxItem::Frame(frame) if frame.kind() == FrameKind::Text => {
                    let said: Value = serde_json::from_slice(&frame.parts().concat()).unwrap();
                    if ops.iter().any(|op| said["op"] == *op) {
                        return said;
                    }
                }
                OutboxItem::Frame(_) => {}
                other => panic!("no {ops:?} came: {other:?}"),
            }
        }
    }

    #[track_caller]
    pub(crate) fn list_when(&self, holds: impl Fn(&Value) -> bool) -> Value {
        loop {
            let list = self.hears(&["recordings"]);
            if holds(&list) {
                return list;
            }
        }
    }

    /// The reason of the next failure.
    #[track_caller]
    pub(crate) fn failure(&self) -> String {
        self.hears(&["fetchFailure"])["message"].as_str().unwrap().to_owned()
    }

    /// The parts of a file, joined.
    #[track_caller]
    pub(crate) fn file(&self, request_id: u32) -> Vec<u8> {
        let mut file = Vec::new();
        loop {
            let OutboxItem::Frame(frame) = self.0.outbox().take(SOON) else {
                panic!("no part came")
            };
            let bytes = frame.parts().concat();
            if frame.kind() == FrameKind::Text || bytes[0] != 0x12 {
                continue;
            }
            assert_eq!(u32_at(&bytes, 1), request_id);
            file.extend_from_slice(&bytes[6..]);
            if bytes[5] & 1 == 1 {
                return file;
            }
        }
    }

    /// The messages of an answer.
    #[track_caller]
    pub(crate) fn answer(&self, request_id: u32) -> Answer {
        let mut answer = Answer::default();
        loop {
            let OutboxItem::Frame(frame) = self.0.outbox().take(SOON) else {
                panic!("no answer came")
            };
            let bytes = frame.parts().concat();
            if frame.kind() == FrameKind::Text {
                let said: Value = serde_json::from_slice(&bytes).unwrap();
                assert_ne!(said["op"], "fetchFailure", "{said}");
                continue;
            }
            if bytes[0] != 0x10 {
                continue;
            }
            assert_eq!(u32_at(&bytes, 1), request_id);
            let mut rest = &bytes[14..];
            while !rest.is_empty() {
                let length = u32_at(rest, 12) as usize;
                let (message, after) = rest.split_at(16 + length);
                answer.messages.push((
                    u32_at(message, 0),
                    u64_at(message, 4),
                    message[16..].to_vec(),
                ));
                rest = after;
            }
            if bytes[5] & 1 == 1 {
                (answer.reached_ns, answer.has_more) = (u64_at(&bytes, 6), bytes[5] & 2 == 2);
                return answer;
            }
        }
    }

    /// The state of topics at a time in tenths of a second.
    pub(crate) fn state(&mut self, id: u32, tenths: i64, topics: &[Value]) -> Answer {
        self.say(&json!({"op": "fetchState", "requestId": id, "recording": 1,
            "timeNs": (tenths * 100_000_000).to_string(), "topics": topics}));
        self.answer(id)
    }

    /// Messages of a span in tenths of a second.
    pub(crate) fn messages(
        &mut self,
        id: u32,
        topics: &[u32],
        span: [i64; 2],
        max_bytes: u64,
    ) -> Answer {
        let [start, end] = span.map(|tenths| (tenths * 100_000_000).to_string());
        self.say(&json!({"op": "fetchMessages", "requestId": id, "recording": 1, "topics": topics,
            "startNs": start, "endNs": end, "maxBytes": max_bytes}));
        self.answer(id)
    }
}

fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

fn u64_at(bytes: &[u8], at: usize) -> u64 {
    u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap())
}
