//! Any bytes from a process that has joined in step: its endpoints appear and go, and the graph goes on.
#![no_main]

use std::io::Write as _;
use std::os::unix::net::UnixStream;

use libfuzzer_sys::fuzz_target;
use periplus_graph::{Graph, NodeSettings, Qos};
use periplus_lockstep::LockstepHost;
use periplus_msgs::std_msgs::String as Text;

fuzz_target!(|bytes: &[u8]| {
    let graph = Graph::new();
    let host = LockstepHost::new(&graph).expect("a socket");
    let link = host.expect("process");
    let (address, token) = link.rsplit_once('#').expect("an address and a token");
    let hello = format!(r#"{{"Hello":{{"token":"{token}","pid":0}}}}"#);
    let length = u32::try_from(hello.len()).expect("a short text");
    let mut frames = length.to_le_bytes().to_vec();
    frames.push(b'Q');
    frames.extend_from_slice(hello.as_bytes());
    frames.extend_from_slice(bytes);
    let mut process = UnixStream::connect(address).expect("the socket");
    process.write_all(&frames).expect("the socket takes some kilobytes");
    process.shutdown(std::net::Shutdown::Write).expect("an open socket");
    host.admit(&mut |_| true);
    let node = graph.node(NodeSettings::new("talker")).expect("a free name");
    let publisher = node.publisher::<Text>("/chatter", Qos::reliable(1)).ok();
    for step in 1..10 {
        if let Some(publisher) = &publisher {
            publisher.publish(Text::default());
        }
        graph.advance_to(step * 1_000_000);
    }
    assert_eq!(graph.now_ns(), 9_000_000);
});
