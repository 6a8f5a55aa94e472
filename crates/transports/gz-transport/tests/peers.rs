//! Interoperability with Debian's `ignition-transport` 11, by its command line and by a program
//! compiled against it. A missing peer is skipped with a message.
//!
//! Each test has its own partition, so that all can run in parallel.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "tests with other programs wait and look for them")]

mod common;

use std::net::Ipv4Addr;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::time::Duration;

use periplus_gz_msgs::{Dialect, LaserScan, Message, StringMsg, Twist};
use periplus_gz_transport::{ServiceCallError, Settings, Transport};

use common::{Gazebo, LONG};

fn open(gazebo: &Gazebo) -> Transport {
    Transport::open(&Settings {
        partition: gazebo.partition().to_owned(),
        address: Some(Ipv4Addr::LOCALHOST),
        dialect: Dialect::Ignition,
        ..Settings::default()
    })
    .unwrap()
}

/// Repeats an action until this is dropped.
struct Again(Arc<AtomicBool>, Option<std::thread::JoinHandle<()>>);

impl Again {
    fn and_again(act: impl Fn() + Send + 'static) -> Self {
        let is_over = Arc::new(AtomicBool::new(false));
        let over = is_over.clone();
        let thread = std::thread::spawn(move || {
            while !over.load(Ordering::Relaxed) {
                act();
                std::thread::sleep(Duration::from_millis(50));
            }
        });
        Self(is_over, Some(thread))
    }
}

impl Drop for Again {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
        let _ = self.1.take().unwrap().join();
    }
}

fn scan() -> LaserScan {
    LaserScan {
        frame: "lidar".into(),
        count: 3,
        ranges: vec![1.5, f64::INFINITY, f64::NEG_INFINITY],
        ..LaserScan::default()
    }
}

const SCAN: &str = "ignition.msgs.LaserScan";

#[test]
fn a_scan_is_listed_described_and_echoed_with_its_infinities() {
    let Some(gazebo) = Gazebo::new("scan") else { return };
    let transport = open(&gazebo);
    let publisher = transport.advertise("/lidar", SCAN).unwrap();
    let _publishing = Again::and_again(move || publisher.publish(scan().encode()));
    gazebo.tool_until("topic", &["-l"], "/lidar");
    let told = gazebo.tool_until("topic", &["-i", "-t", "/lidar"], SCAN);
    assert!(told.contains("tcp://127.0.0.1:"), "{told}");
    let echo = gazebo.running_tool("topic", &["-e", "-t", "/lidar", "-n", "1"]);
    assert_eq!(echo.line_with("frame"), "frame: \"lidar\"");
    let ranges = [(); 3].map(|()| echo.line_with("ranges"));
    assert_eq!(ranges, ["ranges: 1.5", "ranges: inf", "ranges: -inf"]);
    // In the form of our own text format.
    assert!(scan().text().contains(&ranges.join("\n")));
    let heard = gazebo.peer(&["hear-scan", "/lidar"]);
    assert_eq!(heard.line(), "ready");
    assert_eq!(heard.line(), "lidar 3 1.5 inf -inf");
}

#[test]
fn what_gazebo_publishes_is_heard() {
    let Some(gazebo) = Gazebo::new("twist") else { return };
    let transport = open(&gazebo);
    let (send, came) = channel();
    let _ear = transport
        .subscribe("/cmd_vel", "ignition.msgs.Twist", move |arrival| {
            assert_eq!(arrival.type_name, "ignition.msgs.Twist");
            let twist = Twist::decode(arrival.bytes).unwrap();
            let _ = send.send(twist.linear.unwrap().x);
        })
        .unwrap();
    let saying = gazebo.peer(&["say-twist", "/cmd_vel", "0.25"]);
    assert_eq!(saying.line(), "ready");
    assert_eq!(came.recv_timeout(LONG), Ok(0.25));
    drop(saying);
    while came.recv_timeout(Duration::from_millis(500)).is_ok() {}
    // One invocation of the command line.
    let words = ["-t", "/cmd_vel", "-m", "ignition.msgs.Twist", "-p", "linear: {x: 0.75}"];
    let shots = (0..10).map(|_| {
        let _ = gazebo.tool("topic", &words);
        came.recv_timeout(Duration::from_secs(2)).ok()
    });
    // The command waits for subscribers only briefly; on a busy machine an invocation may miss.
    assert_eq!(shots.flatten().next(), Some(0.75));
}

#[test]
fn who_publishes_again_after_it_was_killed_is_heard_again() {
    let Some(gazebo) = Gazebo::new("kill") else { return };
    let transport = open(&gazebo);
    let (send, came) = channel();
    let _ear = transport
        .subscribe("/cmd_vel", "ignition.msgs.Twist", move |arrival| {
            let _ = send.send(Twist::decode(arrival.bytes).unwrap().linear.unwrap().x);
        })
        .unwrap();
    for x in [1.0, 2.0] {
        let _saying = gazebo.peer(&["say-twist", "/cmd_vel", &x.to_string()]);
        while came.recv_timeout(LONG).unwrap() != x {}
    }
}

#[test]
fn gazebo_calls_us_and_we_call_gazebo() {
    let Some(gazebo) = Gazebo::new("call") else { return };
    let transport = open(&gazebo);
    let text = "ignition.msgs.StringMsg";
    let _server = transport
        .serve("/ours", text, text, |call| {
            let asked = StringMsg::decode(&call.request).unwrap().data;
            call.answer.send(Some(&StringMsg::from(asked + "?").encode()));
        })
        .unwrap();
    gazebo.tool_until("service", &["-l"], "/ours");
    gazebo.tool_until("service", &["-i", "-s", "/ours"], "StringMsg");
    let words = [
        "-s",
        "/ours",
        "--reqtype",
        text,
        "--reptype",
        text,
        "--timeout",
        "5000",
        "--req",
        "data: \"hello\"",
    ];
    gazebo.tool_until("service", &words, "data: \"hello?\"");
    assert_eq!(gazebo.peer(&["ask", "/ours", "you"]).line(), "1 1 you?");

    let answering = gazebo.peer(&["answer", "/theirs"]);
    assert_eq!(answering.line(), "ready");
    let ask = |asked: &str| {
        let request = StringMsg::from(asked.to_owned()).encode();
        let answer = transport.call("/theirs", text, text, &request, LONG)?;
        Ok(StringMsg::decode(&answer).unwrap().data)
    };
    assert_eq!(ask("we"), Ok("we!".to_owned()));
    assert_eq!(ask("we again"), Ok("we again!".to_owned()));
    assert_eq!(ask("refuse"), Err(ServiceCallError::Refused));
}
