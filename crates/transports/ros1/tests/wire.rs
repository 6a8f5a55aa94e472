//! Two graphs that meet through a master, over sockets of this machine.

mod common;

use std::sync::mpsc::channel;

use periplus_graph::{Graph, NodeSettings, Qos};
use periplus_msgs::std_srvs::{SetBool, SetBoolResponse};
use periplus_msgs::{nav_msgs, std_msgs};
use periplus_ros1::{Master, MasterUse, Ros1Transport, Settings};

use common::wait_for;

fn master() -> Master {
    Master::open([127, 0, 0, 1].into(), "localhost", 0).expect("a port")
}

fn settings(master: &Master) -> Settings {
    Settings { master_uri: master.uri().to_owned(), ..Settings::default() }
}

fn joined(settings: &Settings) -> (Graph, Ros1Transport) {
    let graph = Graph::live();
    let wire = Ros1Transport::open(settings, MasterUse::Join).expect("a master");
    wire.attach(&graph).expect("a graph");
    (graph, wire)
}

#[test]
fn a_message_goes_from_one_program_to_the_other() {
    let master = master();
    let settings = settings(&master);
    let ((here, _wire), (there, _other)) = (joined(&settings), joined(&settings));
    let talker = here.node(NodeSettings::new("talker").bare()).expect("a name");
    let listener = there.node(NodeSettings::new("listener").bare()).expect("a name");
    let heard =
        listener.mailbox::<std_msgs::String>("/chatter", Qos::reliable(10)).expect("a topic");
    let publisher = talker.publisher("/chatter", Qos::reliable(10)).expect("a topic");
    let text = wait_for(|| {
        publisher.publish(std_msgs::String { data: "hello".into() });
        heard.latest()
    });
    assert_eq!(text.data, "hello");
}

#[test]
fn a_late_subscriber_gets_the_latched_map() {
    let master = master();
    let settings = settings(&master);
    let (here, _wire) = joined(&settings);
    let server = here.node(NodeSettings::new("map_server").bare()).expect("a name");
    let publisher = server.publisher("/map", Qos::latched(1)).expect("a topic");
    let mut map = nav_msgs::OccupancyGrid { data: vec![7; 4_000_000], ..Default::default() };
    (map.info.width, map.info.height, map.header.frame_id) = (2000, 2000, "map".into());
    publisher.publish(map.clone());
    let (there, _other) = joined(&settings);
    let listener = there.node(NodeSettings::new("listener").bare()).expect("a name");
    let heard =
        listener.mailbox::<nav_msgs::OccupancyGrid>("/map", Qos::latched(1)).expect("a topic");
    let got = wait_for(|| heard.latest());
    assert_eq!(*got, map);
}

#[test]
fn a_service_is_called_in_another_program() {
    let master = master();
    let settings = settings(&master);
    let ((here, _wire), (there, _other)) = (joined(&settings), joined(&settings));
    let lamp = here.node(NodeSettings::new("lamp").bare()).expect("a name");
    let calls = lamp.server::<SetBool>("/lamp/switch").expect("a service");
    let hand = there.node(NodeSettings::new("hand").bare()).expect("a name");
    let client = hand.raw_client("/lamp/switch", "std_srvs/srv/SetBool", None).expect("a service");
    wait_for(|| client.is_ready().then_some(()));
    let (answered, answer) = channel();
    // The CDR of a request: four bytes of encapsulation, then the truth.
    client.call(vec![0, 1, 0, 0, 1], move |message| {
        let bytes = message.ok().and_then(|message| message.cdr().ok().map(<[u8]>::to_vec));
        let _ = answered.send(bytes);
    });
    let bytes = wait_for(|| {
        while let Some(call) = calls.take() {
            let message = if call.request.data { "on" } else { "off" };
            call.answer(SetBoolResponse { success: true, message: message.into() });
        }
        answer.try_recv().ok()
    });
    let response = periplus_msgs::decode::<SetBoolResponse>(
        periplus_msgs::Format::CDR,
        &bytes.expect("an answer"),
    );
    assert_eq!(response.expect("a response").message, "on");
}

#[test]
fn everything_is_registered_again_at_a_new_master() {
    let first = master();
    let settings = settings(&first);
    let (here, wire) = joined(&settings);
    let talker = here.node(NodeSettings::new("talker").bare()).expect("a name");
    let _publisher =
        talker.publisher::<std_msgs::String>("/chatter", Qos::reliable(10)).expect("a topic");
    let knows = || {
        let state = wire.client().system_state().ok()?;
        state.publishers.iter().any(|(topic, _)| topic == "/chatter").then_some(())
    };
    wait_for(knows);
    let port = settings.master().expect("an address").1;
    drop(first);
    let _second = wait_for(|| Master::open([127, 0, 0, 1].into(), "localhost", port).ok());
    wait_for(knows);
    let said = wire.take_findings().iter().any(|one| one.message.contains("was restarted"));
    assert!(said);
}
