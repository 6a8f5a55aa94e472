//! Recording of the graph, and jobs.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_graph::{NodeSettings, Qos};
use periplus_msgs::std_msgs::String as Words;
use periplus_web::foxglove::{JobError, JobRequest, Jobs};
use serde_json::{Value, json};

use crate::client::Server;

#[test]
fn what_is_recorded_can_be_replayed() {
    let server = Server::open("live");
    let node = server.graph.node(NodeSettings::new("talker")).unwrap();
    let words = node.publisher::<Words>("/words", Qos::reliable(10)).unwrap();
    let mut client = server.join();
    client.say(&json!({"op": "stopRecording", "requestId": 1}));
    assert!(client.failure().contains("nothing is being recorded"));
    client.say(&json!({"op": "startRecording", "requestId": 2}));
    client.list_when(|list| list["isRecording"] == true);
    client.say(&json!({"op": "startRecording", "requestId": 3}));
    assert!(client.failure().contains("recorded already"));
    words.publish(Words { data: "yes".into() });
    server.graph.settle();
    client.say(&json!({"op": "stopRecording", "requestId": 4}));
    let list = client.list_when(|list| list["recordings"][0]["state"] == "ready");
    assert_eq!(list["isRecording"], false);
    let run = &list["recordings"][0];
    assert!(run["name"].as_str().unwrap().starts_with("rosbag2_"), "{run}");
    let topics = run["topics"].as_array().unwrap();
    let words = topics.iter().find(|topic| topic["topic"] == "/words").expect("the topic");
    assert_eq!(words["count"], 1);
}

/// Copies the recording.
struct Copy;

impl Jobs for Copy {
    fn parameters(&self, kind: &str) -> Result<Value, JobError> {
        if kind == "slam" {
            Ok(json!([{"name": "resolution"}]))
        } else {
            Err(JobError::Failed(format!("no `{kind}`")))
        }
    }

    fn run(
        &self,
        job: &JobRequest,
        progress: &dyn Fn(f32),
        is_cancelled: &AtomicBool,
    ) -> Result<PathBuf, JobError> {
        progress(0.5);
        if job.parameters.contains_key("wait") {
            while !is_cancelled.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(1));
            }
            return Err(JobError::Cancelled);
        }
        let path = job.path.with_extension("copy.mcap");
        std::fs::copy(&job.path, &path).map_err(|error| JobError::Failed(error.to_string()))?;
        Ok(path)
    }
}

#[test]
fn a_job_makes_a_recording() {
    let (server, mut client) = Server::with_run("job");
    client.say(&json!({"op": "fetchJobParameters", "requestId": 1, "kind": "slam"}));
    assert!(client.failure().contains("no estimators"));
    server.recordings.set_jobs(Arc::new(Copy));
    client.say(&json!({"op": "fetchJobParameters", "requestId": 1, "kind": "slam"}));
    assert_eq!(client.hears(&["jobParameters"])["parameters"], json!([{"name": "resolution"}]));
    client.say(&json!({"op": "fetchJobParameters", "requestId": 2, "kind": "dance"}));
    assert!(client.failure().contains("no `dance`"));
    let job = |id: u32, parameters: Value| json!({"op": "startJob", "requestId": id, "kind": "slam", "recording": 1, "parameters": parameters});
    client.say(&job(3, json!({"resolution": 0.1})));
    let list = client.list_when(|list| list["recordings"][1]["state"] == "ready");
    let made = &list["recordings"][1];
    let origin = json!({"recording": 1, "kind": "slam", "parameters": {"resolution": 0.1}});
    assert_eq!((&made["name"], &made["origin"]), (&json!("run (slam)"), &origin));
    client.say(&job(4, json!({"wait": true})));
    client.list_when(|list| list["recordings"][2]["progress"] == 0.5);
    client.say(&json!({"op": "cancelFetch", "requestIds": [4]}));
    client.list_when(|list| list["recordings"].as_array().unwrap().len() == 2);
}
