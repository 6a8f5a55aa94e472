//! Scripts as users write them, and the reports of their errors.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use std::io::Cursor;

use periplus_bags::{QosProfile, Reader, Settings, Stamp, Topic, Writer};
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_msgs::Message;
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::std_msgs::String as Text;
use periplus_sim::script::{CommandMessage, DriveScript, Goal, read, replay};
use proptest::prelude::*;

/// The script, and the findings as `line:column message`.
fn parse(text: &str) -> (DriveScript, Vec<String>) {
    let (mut sources, mut findings) = (SourceMap::new(), Diagnostics::new());
    let file = sources.add("drive.yaml", text);
    let script = read(file, &sources, &mut findings);
    let shown = findings.iter().map(|finding| {
        let (_, at) = sources.locate(finding.span.unwrap());
        let help = finding.help.join("; ");
        format!("{}:{} {} ({help})", at.line, at.column, finding.message)
    });
    (script, shown.collect())
}

/// Time, topic, forward, left.
fn sends(script: &DriveScript) -> Vec<(i64, &str, f64, f64)> {
    let row = |command: &'_ periplus_sim::script::VelocityCommand| {
        (command.time_ns, command.body.twist().linear.x, command.body.twist().angular.z)
    };
    let commands = script.commands.iter();
    commands
        .map(|one| (row(one).0, one.topic.as_deref().unwrap_or("own"), row(one).1, row(one).2))
        .collect()
}

#[test]
fn velocities_are_sent_at_their_times() {
    let (script, findings) = parse(
        "- {at: 2, linear: {x: 0.1}}\n\
         - at: 0.5\n  linear: [0.5, 0, 0]\n  angular: [0, 0, 0.2]\n\
         - {at: 1.0, until: 1.25, rate: 10, topic: /demo/cmd_vel, angular: -1}\n",
    );
    assert_eq!(findings, Vec::<String>::new());
    assert_eq!(
        sends(&script),
        [
            (500_000_000, "own", 0.5, 0.2),
            (1_000_000_000, "/demo/cmd_vel", 0.0, -1.0),
            (1_100_000_000, "/demo/cmd_vel", 0.0, -1.0),
            (1_200_000_000, "/demo/cmd_vel", 0.0, -1.0),
            (2_000_000_000, "own", 0.1, 0.0),
        ]
    );
}

#[test]
fn a_repetition_ends_before_the_next_begins() {
    let (script, _) = parse("- {at: 0, until: 1, linear: 1}\n- {at: 1, linear: 0}\n");
    let times: Vec<i64> = script.commands.iter().map(|command| command.time_ns).collect();
    assert_eq!(times.len(), 11);
    assert_eq!(times[9..], [900_000_000, 1_000_000_000]);
    // A rate that does not divide the second does not drift.
    let (script, _) = parse("- {at: 0, until: 100, rate: 3, linear: 1}");
    assert_eq!(script.commands.len(), 300);
    assert_eq!(script.commands[299].time_ns, 99_666_666_667);
}

#[test]
fn stamped_messages_carry_time_and_frame() {
    for text in [
        "- {at: 1.5, type: geometry_msgs/msg/TwistStamped, frame: base_link, linear: 1}",
        "- {at: 1.5, type: TwistStamped, frame: base_link, linear: 1}",
        "- {at: 1.5, frame: base_link, linear: 1}",
    ] {
        let (script, findings) = parse(text);
        assert_eq!(findings, Vec::<String>::new());
        let CommandMessage::TwistStamped(stamped) = &script.commands[0].body else {
            panic!("{text}")
        };
        assert_eq!(stamped.header.frame_id, "base_link");
        assert_eq!((stamped.header.stamp.sec, stamped.header.stamp.nanosec), (1, 500_000_000));
        let bytes = script.commands[0].body.to_cdr().unwrap();
        assert_eq!(TwistStamped::decode_cdr(&bytes).unwrap(), *stamped);
        assert_eq!(script.commands[0].body.type_name(), "geometry_msgs/msg/TwistStamped");
    }
}

#[test]
fn goals_are_kept_in_order() {
    let (script, findings) = parse(
        "- {goto: [2.0, 1], topic: /demo/cmd_vel}\n- {goto: [0, 0], speed: 0.3, turn: 0.5, at: 9}\n",
    );
    assert_eq!(findings, Vec::<String>::new());
    let second = Goal {
        speed_m_s: 0.3,
        turn_rad_s: 0.5,
        not_before_ns: 9_000_000_000,
        ..Goal::at([0.0, 0.0])
    };
    // The second names no topic: it means the usual one, or that of the first.
    assert_eq!(script.goals, [Goal::at([2.0, 1.0]), second]);
    assert_eq!(script.goal_topic.as_deref(), Some("/demo/cmd_vel"));
}

#[test]
fn mistakes_are_shown_where_they_are() {
    let check = |text: &str, expected: &str| {
        let (_, findings) = parse(text);
        assert!(findings.len() == 1 && findings[0].contains(expected), "{text}: {findings:?}");
    };
    check(
        "- {at: 0, linaer: [1, 0, 0]}",
        "1:11 a command has no key `linaer` (did you mean `linear`?)",
    );
    check("- {linear: [1, 0, 0]}", "1:3 a command has no time");
    check("- {at: 0, linear: [1, 0]}", "1:19 `linear` is not three numbers");
    check("- {at: 0, linear: [1, 0, .nan]}", "1:19 `linear` is not three numbers");
    check("- {at: -1, linear: 1}", "1:8 this is not a time");
    check("- {at: .inf, linear: 1}", "1:8 this is not a time");
    check("- {at: 5, until: 5, linear: 1}", "1:18 a command ends before it begins");
    check("- {at: 5, rate: 5, linear: 1}", "1:17 a command repeats without end");
    check("- {at: 5, until: 6, rate: 0}", "1:27 `rate` is not a number above zero");
    check("- {at: 0, until: 1e9, rate: 1e9}", "1:3 the script has more than 1000000 commands");
    check("- {at: 0, until: 1e9, rate: 1e300}", "1:3 the script has more than 1000000 commands");
    check("- {at: 0, at: 1}", "1:11 the key `at` occurs twice");
    check(
        "- {at: 0, type: std_msgs/msg/String}",
        "1:17 a script cannot send `std_msgs/msg/String`",
    );
    check("- {goto: [1]}", "1:10 a goal is two numbers");
    check("- {goto: [1, 2], speed: -1}", "1:25 `speed` is not a number above zero");
    check("- 7", "1:3 a command is a mapping, not a number");
    check("at: 0", "1:1 a script is a list of commands, not a mapping");
    check("- {at: 0", "this is not YAML");
    check("- {at: 0, topic: [a]}", "1:18 `topic` is a list, not a text");
    assert_eq!(parse("").1, Vec::<String>::new());
}

#[test]
fn what_is_wrong_is_left_out_and_the_rest_is_driven() {
    let (script, findings) = parse("- {at: 0, linear: 1}\n- {at: x}\n- {at: 2, linear: 3}\n");
    assert_eq!((script.commands.len(), findings.len()), (2, 1));
}

fn twist(forward: f64) -> Twist {
    let mut twist = Twist::default();
    twist.linear.x = forward;
    twist
}

fn bag(start_ns: i64) -> Vec<u8> {
    let mut bag = Writer::new(Vec::new(), Settings::new("run.mcap")).unwrap();
    let qos = [QosProfile::reliable(10)];
    let text = bag.topic(Topic::of::<Text>("/chatter", &qos)).unwrap();
    let plain = bag.topic(Topic::of::<Twist>("/a/cmd_vel", &qos)).unwrap();
    let stamped = bag.topic(Topic::of::<TwistStamped>("/b/cmd_vel", &qos)).unwrap();
    bag.write(text, Stamp::at(start_ns), &Text::default().to_cdr().unwrap()).unwrap();
    let one = TwistStamped { twist: twist(2.0), ..TwistStamped::default() };
    bag.write(stamped, Stamp::at(start_ns + 2_000), &one.to_cdr().unwrap()).unwrap();
    bag.write(plain, Stamp::at(start_ns + 1_000), &twist(1.0).to_cdr().unwrap()).unwrap();
    bag.write(plain, Stamp::at(start_ns + 3_000), b"broken").unwrap();
    bag.finish().unwrap().0
}

#[test]
fn a_recording_is_driven_again() {
    // Simulated times are kept; those of a clock are counted from the beginning.
    for (start_ns, shift_ns) in [(5_000_000, 5_000_000), (1_700_000_000_000_000_000, 0)] {
        let bytes = bag(start_ns);
        let mut reader = Reader::open(Cursor::new(&*bytes)).unwrap();
        let mut findings = Diagnostics::new();
        let commands = replay(&mut reader, &mut findings).unwrap();
        let script = DriveScript { commands, ..DriveScript::default() };
        assert_eq!(
            sends(&script),
            [
                (shift_ns + 1_000, "/a/cmd_vel", 1.0, 0.0),
                (shift_ns + 2_000, "/b/cmd_vel", 2.0, 0.0)
            ]
        );
        assert_eq!(findings.iter().count(), 1);
    }
}

#[test]
fn a_recording_without_velocities_is_told() {
    let bag = Writer::new(Vec::new(), Settings::new("run.mcap")).unwrap();
    let bytes = bag.finish().unwrap().0;
    let mut findings = Diagnostics::new();
    let mut reader = Reader::open(Cursor::new(&*bytes)).unwrap();
    assert_eq!(replay(&mut reader, &mut findings).unwrap(), []);
    assert!(findings.has_errors());
}

proptest! {
    #[test]
    fn no_script_is_too_strange(
        text in "(- \\{?(at|until|rate|goto|linear|type)?: ?[0-9.e\\[\\], {}~x-]{0,12}\n?){1,4}",
    ) {
        let (script, _) = parse(&text);
        prop_assert!(script.commands.is_sorted_by_key(|command| command.time_ns));
    }
}
