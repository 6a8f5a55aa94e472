//! Logs of nodes.
#![allow(clippy::unwrap_used, reason = "tests unwrap values that must exist")]

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{Arguments, Graph, Level, NodeSettings, ParameterFileError, Qos};
use periplus_msgs::rcl_interfaces::Log;

#[test]
fn who_listens_late_hears_the_last_ten_seconds() {
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("scan").namespace("/demo")).unwrap();
    node.log(Level::Info, "old");
    graph.advance_to(3_000_000_000);
    node.log(Level::Warn, format_args!("{} beams", 3));
    node.log(Level::Debug, "not asked for");
    graph.advance_to(11_000_000_000);
    let ear = graph.node(NodeSettings::new("ear")).unwrap();
    let log = ear.mailbox::<Log>("/rosout", Qos::rosout()).unwrap();
    let lines = log.drain();
    assert_eq!(lines.len(), 1);
    let Log { stamp, level, name, msg, file, line, .. } = &*lines[0];
    assert_eq!(
        (stamp.sec, *level, name.as_str(), msg.as_str()),
        (3, Log::WARN, "demo.scan", "3 beams")
    );
    assert!(file.ends_with("log.rs") && *line > 0, "{file}");

    node.set_log_level(Level::Debug);
    node.log(Level::Debug, "now");
    assert_eq!(log.latest().unwrap().msg, "now");
}

#[test]
fn what_is_not_logged_is_not_put_together() {
    struct Never;
    impl std::fmt::Display for Never {
        fn fmt(&self, _: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            panic!("this is below the log level");
        }
    }
    let read = |line: &str| {
        let words: Vec<String> = line.split(' ').map(str::to_owned).collect();
        let none = &mut |_: &std::path::Path| Err(ParameterFileError::Missing);
        Arguments::read(&words, &mut SourceMap::new(), &mut Diagnostics::new(), none)
    };
    let graph = Graph::new();
    graph.set_arguments(read("--log-level error --log-level b:=debug"));
    let [a, b] = ["a", "b"].map(|name| graph.node(NodeSettings::new(name)).unwrap());
    a.log(Level::Warn, Never);
    assert!(a.logs(Level::Error) && b.logs(Level::Debug));
    graph.set_arguments(read("--disable-rosout-logs"));
    let c = graph.node(NodeSettings::new("c")).unwrap();
    c.log(Level::Fatal, Never);
    graph.node(NodeSettings::new("d").bare()).unwrap().log(Level::Fatal, Never);
}

#[test]
fn levels_have_names_and_numbers() {
    for level in Level::ALL {
        assert_eq!(Level::named(&level.to_string()), Some(level));
        assert_eq!(Level::of_number(level.number()), level);
    }
    assert_eq!((Level::of_number(35), Level::of_number(0)), (Level::Warn, Level::Debug));
}
