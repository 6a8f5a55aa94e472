//! Any bytes as messages of a client to a hub with a recording, in JSON and binary. No panic, and all
//! responses are well formed.
#![no_main]

use std::sync::LazyLock;
use std::time::Duration;

use libfuzzer_sys::fuzz_target;
use periplus_graph::{Graph, NodeSettings, Publisher, Qos};
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_web::foxglove::{
    FrameKind, Hub, OutboxItem, RecordingSettings, Recordings, Settings,
};

/// A recording of two topics.
const RUN: &[u8] = include_bytes!("../seeds/bag/mcap_zstd.mcap");

/// A graph with a topic to subscribe to, and a hub in front of it.
struct Place {
    graph: Graph,
    maps: Publisher<OccupancyGrid>,
    hub: Hub,
}

static PLACE: LazyLock<Place> = LazyLock::new(|| {
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("mapper")).expect("a name");
    let maps = node.publisher("/map", Qos::latched(1)).expect("a topic");
    let hub = Hub::open(&graph, Settings::default()).expect("a name");
    let folder = std::env::temp_dir().join(format!("periplus-fuzz-live-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the folder for temporary files can be written");
    let run = folder.join("run.mcap");
    std::fs::write(&run, RUN).expect("the folder for temporary files can be written");
    let settings =
        RecordingSettings { upload_max_bytes: 1 << 16, ..RecordingSettings::new(&folder, &folder) };
    let recordings = Recordings::new(settings);
    recordings.open(&run).expect("a recording");
    hub.serve_recordings(recordings);
    Place { graph, maps, hub }
});

fuzz_target!(|bytes: &[u8]| {
    let place = &*PLACE;
    let Some(mut session) = place.hub.join() else { return };
    // Messages end with a byte that JSON does not have.
    for said in bytes.split(|byte| *byte == 0xff).take(64) {
        match std::str::from_utf8(said) {
            Ok(text) if !text.starts_with(['\u{1}', '\u{2}', '\u{11}']) => session.text(text),
            _ => session.binary(said),
        }
    }
    let mut map = OccupancyGrid { data: vec![0; 4], ..OccupancyGrid::default() };
    (map.info.width, map.info.height) = (2, 2);
    place.maps.publish(map);
    place.graph.settle();
    while let OutboxItem::Frame(frame) = session.outbox().take(Duration::ZERO) {
        let whole = frame.parts().concat();
        match frame.kind() {
            FrameKind::Text => {
                let said: serde_json::Value = serde_json::from_slice(&whole).expect("JSON");
                assert!(said["op"].is_string());
            }
            FrameKind::Binary => assert!(matches!(whole[0], 1..=4 | 0x10)),
            FrameKind::Raw => {}
        }
    }
});
