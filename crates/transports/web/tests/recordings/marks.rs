//! Marks.

use serde_json::json;

use crate::client::Server;

#[test]
fn errors_and_goals_are_marked() {
    let (_server, mut client) = Server::with_run("marks");
    client.say(&json!({"op": "fetchMarks", "requestId": 1, "recording": 1}));
    let marks = loop {
        let answer = client.hears(&["marks"]);
        if answer["isComplete"] == true {
            break answer["marks"].clone();
        }
    };
    let action = "/navigate_to_pose/_action/status";
    assert_eq!(
        marks,
        json!([
            {"timeNs": "3000000000", "kind": "goal", "topic": action, "text": "navigate_to_pose: accepted"},
            {"timeNs": "4000000000", "kind": "error", "topic": "/rosout", "text": "planner: no path"},
            {"timeNs": "8000000000", "kind": "goalReached", "topic": action, "text": "navigate_to_pose: reached"},
        ])
    );
    // The request is over, so that its id is free.
    client.say(&json!({"op": "fetchMarks", "requestId": 1, "recording": 1}));
    assert_eq!(client.hears(&["marks", "fetchFailure"])["op"], "marks");
}
