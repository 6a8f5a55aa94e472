//! Recording of the graph, and jobs.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_graph::{Graph, NodeSettings, Qos};
use periplus_msgs::std_msgs::String as Words;
use periplus_web::foxglove::{Hub, JobError, JobRequest, Jobs, Settings};
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
        let path = job.out_folder.join("copy.mcap");
        std::fs::copy(&job.path, &path).map_err(|error| JobError::Failed(error.to_string()))?;
        Ok(path)
    }

    fn report(&self, paths: &[&Path]) -> Result<String, JobError> {
        let name =
            |path: &&Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(format!("<html>{}</html>", paths.iter().map(name).collect::<Vec<_>>().join("+")))
    }

    fn difference(
        &self,
        first: &Path,
        second: &Path,
        is_cancelled: &AtomicBool,
    ) -> Result<Value, JobError> {
        assert!(!is_cancelled.load(Ordering::Relaxed));
        Ok(json!({"isSame": first == second}))
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

#[test]
fn reports_and_differences_come_from_the_jobs() {
    let (server, mut client) = Server::with_run("summaries");
    client.say(&json!({"op": "fetchReport", "requestId": 1, "recordings": [1]}));
    assert!(client.failure().contains("no estimators"));
    server.recordings.set_jobs(Arc::new(Copy));
    client.say(&json!({"op": "fetchReport", "requestId": 1, "recordings": [1]}));
    assert_eq!(client.hears(&["report"])["html"], "<html>run.mcap</html>");
    client.say(&json!({"op": "fetchReport", "requestId": 2, "recordings": [1, 1]}));
    assert_eq!(client.hears(&["report"])["html"], "<html>run.mcap+run.mcap</html>");
    client.say(&json!({"op": "fetchReport", "requestId": 3, "recordings": []}));
    assert!(client.failure().contains("1 or 2 recordings, not 0"));
    client.say(&json!({"op": "fetchReport", "requestId": 4, "recordings": [7]}));
    assert!(client.failure().contains("no recording 7"));
    client.say(&json!({"op": "fetchDifference", "requestId": 5, "recording": 1, "other": 1}));
    assert_eq!(client.hears(&["difference"])["difference"], json!({"isSame": true}));
    client.say(&json!({"op": "fetchDifference", "requestId": 6, "recording": 1, "other": 9}));
    assert!(client.failure().contains("no recording 9"));
}

#[test]
fn the_file_of_a_recording_comes_in_parts() {
    let (server, mut client) = Server::with_run("file");
    let bytes = std::fs::read(server.folder.join("run.mcap")).unwrap();
    client.say(&json!({"op": "fetchFile", "requestId": 8, "recording": 1}));
    let head = client.hears(&["file"]);
    assert_eq!((&head["name"], &head["bytes"]), (&json!("run.mcap"), &json!(bytes.len())));
    assert!(client.file(8) == bytes, "other bytes");
    // A folder with several files is refused with what to do.
    let folder = server.folder.join("bag");
    std::fs::create_dir_all(&folder).unwrap();
    for name in ["bag_0.mcap", "bag_1.mcap"] {
        crate::run::write(&folder.join(name));
    }
    server.recordings.open(&folder).unwrap();
    client.list_when(|list| list["recordings"][1]["state"] == "ready");
    client.say(&json!({"op": "fetchFile", "requestId": 9, "recording": 2}));
    assert!(client.failure().contains("2 files"));
}

#[test]
fn the_result_of_a_job_is_removed_when_it_is_closed_and_at_the_end() {
    let (mut server, mut client) = Server::with_run("temporary");
    server.recordings.set_jobs(Arc::new(Copy));
    let uploads = server.folder.join("uploads");
    let folders = || std::fs::read_dir(&uploads).unwrap().count();
    let job = |id: u32| json!({"op": "startJob", "requestId": id, "kind": "slam", "recording": 1});
    for (number, id) in [(1, 1), (2, 2)] {
        client.say(&job(id));
        let list = client.list_when(|list| list["recordings"][number]["state"] == "ready");
        assert_eq!(list["recordings"][number]["isTemporary"], true);
        assert_eq!(list["recordings"][0]["isTemporary"], false);
    }
    assert_eq!(folders(), 2);
    client.say(&json!({"op": "closeRecording", "requestId": 3, "recording": 2}));
    client.list_when(|list| list["recordings"].as_array().unwrap().len() == 2);
    assert_eq!(folders(), 1);
    drop(client);
    drop(std::mem::replace(
        &mut server.hub,
        Hub::open(&Graph::new(), Settings::default()).unwrap(),
    ));
    assert_eq!(folders(), 0);
}
