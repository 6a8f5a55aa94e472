//! Uploads.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::client::{Client, Server};

fn start(client: &mut Client, id: u32, files: &[(&str, usize)]) {
    let files: Vec<Value> =
        files.iter().map(|(name, bytes)| json!({"name": name, "bytes": bytes})).collect();
    client.say(&json!({"op": "startUpload", "requestId": id, "files": files}));
}

fn send(client: &mut Client, id: u32, bytes: &[u8]) {
    let mut frame = vec![0x11];
    frame.extend(id.to_le_bytes());
    frame.extend(bytes);
    client.0.binary(&frame);
}

fn entries(folder: &Path) -> usize {
    fs::read_dir(folder.join("uploads")).unwrap().count()
}

#[test]
fn an_upload_becomes_a_recording_and_is_removed_with_it() {
    let server = Server::open("upload");
    let mut client = server.join();
    let path = server.folder.join("run.mcap");
    crate::run::write(&path);
    let bytes = fs::read(&path).unwrap();
    start(&mut client, 7, &[("../drive.mcap", bytes.len())]);
    assert_eq!(client.hears(&["uploadStarted", "fetchFailure"])["upload"], 7);
    let (first, second) = bytes.split_at(1000);
    send(&mut client, 7, first);
    assert_eq!(client.hears(&["uploadProgress"])["bytes"], 1000);
    client.say(&json!({"op": "openRecording", "requestId": 8, "upload": 7}));
    assert!(client.failure().contains("not complete"));
    send(&mut client, 7, second);
    let list = client.list_when(|list| list["recordings"][0]["state"] == "ready");
    assert_eq!(list["recordings"][0]["name"], "drive");
    client.say(&json!({"op": "openRecording", "requestId": 9, "upload": 7}));
    assert_eq!(
        client.state(10, 5, &[json!({"id": 1, "historyNs": "0", "count": 1})]).messages.len(),
        1
    );
    assert_eq!(entries(&server.folder), 1);
    client.say(&json!({"op": "closeRecording", "requestId": 11, "recording": 1}));
    client.list_when(|list| list["recordings"] == json!([]));
    assert_eq!(entries(&server.folder), 0);
}

#[test]
fn what_is_no_recording_is_refused_with_the_reason() {
    let server = Server::open("no_recording");
    let mut client = server.join();
    start(&mut client, 1, &[("notes.txt", 5)]);
    send(&mut client, 1, b"hello");
    let list = client.list_when(|list| list["recordings"][0]["state"] == "failed");
    let why = list["recordings"][0]["error"].as_str().unwrap().to_owned();
    assert!(why.contains("neither MCAP"), "{why}");
}

#[test]
fn unfinished_uploads_leave_nothing() {
    let server = Server::open("truncated");
    let mut client = server.join();
    start(&mut client, 1, &[("a.mcap", 10)]);
    send(&mut client, 1, b"abc");
    start(&mut client, 2, &[("b.mcap", 10)]);
    assert_eq!(entries(&server.folder), 2);
    client.say(&json!({"op": "cancelFetch", "requestIds": [1]}));
    assert!(client.failure().contains("cancelled"));
    assert_eq!(entries(&server.folder), 1);
    // Bytes of an upload that has ended are ignored.
    send(&mut client, 1, b"def");
    drop(client);
    assert_eq!(entries(&server.folder), 0);
}

#[test]
fn uploads_have_limits() {
    let server = Server::open("upload_limits");
    let mut client = server.join();
    start(&mut client, 1, &[("a.mcap", 2 << 20)]);
    assert!(client.failure().contains("more than the 1048576"));
    start(&mut client, 1, &[]);
    assert!(client.failure().contains("1 to 1000 files"));
    start(&mut client, 1, &[("a.mcap", 4)]);
    send(&mut client, 1, b"abcdef");
    assert!(client.failure().contains("more bytes"));
    for id in 10..14 {
        start(&mut client, id, &[("a.mcap", 4)]);
    }
    start(&mut client, 14, &[("a.mcap", 4)]);
    assert!(client.failure().contains("too many uploads"));
    start(&mut client, 10, &[("a.mcap", 4)]);
    assert!(client.failure().contains("too many uploads"));
}
