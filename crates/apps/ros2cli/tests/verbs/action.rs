//! `action`.

use std::time::Duration;

use expect_test::expect;
use periplus_graph::{Actor, Publisher, Qos};
use periplus_msgs::action_msgs::{CancelGoal, CancelGoalResponse, GoalStatus};
use periplus_msgs::tf2_msgs::{
    LookupTransformFeedbackMessage, LookupTransformGetResult, LookupTransformGetResultResponse,
    LookupTransformResult, LookupTransformSendGoal, LookupTransformSendGoalResponse,
};
use periplus_msgs::unique_identifier_msgs::UUID;
use periplus_ros2cli::action;

use crate::bench::Bench;

/// Action server that looks up transforms, unless the frame is empty. Every goal ends at once.
fn looker(bench: &Bench) -> Actor<Publisher<LookupTransformFeedbackMessage>> {
    let node = bench.node("tf");
    let feedback = node.publisher("/look/_action/feedback", Qos::reliable(10)).unwrap();
    let mut looker = node.actor(feedback);
    looker
        .serve::<LookupTransformSendGoal>("/look/_action/send_goal", |feedback, request, _| {
            for goal_id in [request.goal_id.clone(), UUID::default()] {
                feedback.publish(LookupTransformFeedbackMessage { goal_id, ..Default::default() });
            }
            let accepted = !request.goal.target_frame.is_empty();
            LookupTransformSendGoalResponse { accepted, ..Default::default() }
        })
        .unwrap();
    looker
        .serve::<LookupTransformGetResult>("/look/_action/get_result", |_, _, _| {
            let mut result = LookupTransformResult::default();
            result.transform.child_frame_id = "base_link".into();
            LookupTransformGetResultResponse { status: GoalStatus::STATUS_SUCCEEDED, result }
        })
        .unwrap();
    looker
}

/// Goal IDs are random.
fn send(bench: &Bench, values: &str, feedback: bool) -> String {
    let text = bench.run(|session| {
        action::send_goal(session, "/look", "tf2_msgs/action/LookupTransform", values, feedback)
    });
    let is_name = |word: &str| word.len() == 32 && word.bytes().all(|b| b.is_ascii_hexdigit());
    let name = text.split([' ', '\n', '"']).find(|word| is_name(word)).map(str::to_owned);
    name.map_or(text.clone(), |name| text.replace(&name, "NAME"))
}

#[test]
fn actions_are_listed_and_described() {
    let bench = Bench::new();
    let _looker = looker(&bench);
    bench.check(
        |session| action::list(session, true, false),
        expect![[r#"
        /look [tf2_msgs/action/LookupTransform]
    "#]],
    );
    bench.check(
        |session| action::list(session, false, true),
        expect![[r#"
        1
    "#]],
    );
    bench.check(
        |session| action::info(session, "/look", true, false),
        expect![[r#"
        Action: /look
        Action clients: 0
        Action servers: 1
            /tf [tf2_msgs/action/LookupTransform]
    "#]],
    );
    bench.check(
        |session| action::info(session, "/loook", true, false),
        expect![[r#"
        ! Unknown action '/loook'; did you mean `/look`?
    "#]],
    );
    bench.check(
        |session| action::type_of(session, "/look"),
        expect![[r#"
        tf2_msgs/action/LookupTransform
    "#]],
    );
    bench.check(
        |session| action::find(session, "tf2_msgs/LookupTransform", false),
        expect![[r#"
        /look
    "#]],
    );
}

#[test]
fn goals_are_sent() {
    let bench = Bench::new();
    let _looker = looker(&bench);
    expect![[r#"
        Waiting for an action server to become available...
        Sending goal:
             target_frame: map
        source_frame: ''
        source_time:
          sec: 0
          nanosec: 0
        timeout:
          sec: 0
          nanosec: 0
        target_time:
          sec: 0
          nanosec: 0
        fixed_frame: ''
        advanced: false

        Goal accepted with ID: NAME

        Feedback:
            {}

        Result:
            transform:
          header:
            stamp:
              sec: 0
              nanosec: 0
            frame_id: ''
          child_frame_id: base_link
          transform:
            translation:
              x: 0.0
              y: 0.0
              z: 0.0
            rotation:
              x: 0.0
              y: 0.0
              z: 0.0
              w: 1.0
        error:
          error: 0
          error_string: ''

        Goal finished with status: SUCCEEDED
    "#]]
    .assert_eq(&send(&bench, "{target_frame: map}", true));
    expect![[r#"
        Waiting for an action server to become available...
        Sending goal:
             target_frame: ''
        source_frame: map
        source_time:
          sec: 0
          nanosec: 0
        timeout:
          sec: 0
          nanosec: 0
        target_time:
          sec: 0
          nanosec: 0
        fixed_frame: ''
        advanced: false

        ! Goal was rejected.
    "#]]
    .assert_eq(&send(&bench, "{source_frame: map}", false));
    expect![[r#"
        ! the values do not match tf2_msgs/action/LookupTransform_Goal: there is no field `target_fram`, did you mean `target_frame`?
    "#]].assert_eq(&send(&bench, "{target_fram: map}", false));
    let json = Bench { json: true, ..bench };
    expect![[r#"
        {"accepted":true,"goal_id":"NAME"}
        {"feedback":{}}
        {"result":{"error":{"error":0,"error_string":""},"transform":{"child_frame_id":"base_link","header":{"frame_id":"","stamp":{"nanosec":0,"sec":0}},"transform":{"rotation":{"w":1.0,"x":0.0,"y":0.0,"z":0.0},"translation":{"x":0.0,"y":0.0,"z":0.0}}}},"status":"SUCCEEDED"}
    "#]].assert_eq(&send(&json, "{target_frame: map}", true));
}

#[test]
fn a_goal_is_cancelled_when_it_is_given_up() {
    let bench = Bench::new();
    let node = bench.node("slow");
    let _results = node.server::<LookupTransformGetResult>("/look/_action/get_result").unwrap();
    let mut slow = node.actor(());
    slow.serve::<LookupTransformSendGoal>("/look/_action/send_goal", |(), _, _| {
        LookupTransformSendGoalResponse { accepted: true, ..Default::default() }
    })
    .unwrap();
    slow.serve::<CancelGoal>("/look/_action/cancel_goal", |(), request, _| CancelGoalResponse {
        goals_canceling: vec![request.goal_info.clone()],
        ..Default::default()
    })
    .unwrap();
    let bench = Bench { stop_after: Some(Duration::from_millis(300)), ..bench };
    let text = send(&bench, "{target_frame: map}", false);
    expect![[r#"
        Waiting for an action server to become available...
        Sending goal:
             target_frame: map
        source_frame: ''
        source_time:
          sec: 0
          nanosec: 0
        timeout:
          sec: 0
          nanosec: 0
        target_time:
          sec: 0
          nanosec: 0
        fixed_frame: ''
        advanced: false

        Goal accepted with ID: NAME

        | Canceling goal...
        | Goal canceled.
        ! interrupted
    "#]]
    .assert_eq(&text);
}
