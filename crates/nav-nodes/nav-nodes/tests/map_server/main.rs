//! Map server and map saver, as others see them.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use periplus_geometry::Pose2;
use periplus_graph::{
    Graph, LifecycleNode, LifecycleState, Mailbox, Node, NodeSettings, Qos, Transition,
};
use periplus_grid::{Grid, GridInfo};
use periplus_maps::{Distro, to_message};
use periplus_msgs::Service;
use periplus_msgs::nav_msgs::{GetMap, GetMapRequest, MapMetaData, OccupancyGrid};
use periplus_msgs::nav2_msgs::{LoadMap, LoadMapRequest, SaveMap, SaveMapRequest};
use periplus_nav_nodes::map_server::{MapSaver, MapServer, MapServerParams};
use periplus_resources::{EntryKind, FileReadError, FileWriteError, Host, MemoryHost, Store};

/// Files that are there, and files that are written.
struct Files {
    host: MemoryHost,
    written: Mutex<BTreeMap<PathBuf, Vec<u8>>>,
}

impl Files {
    fn new() -> Arc<Self> {
        let yaml = |image: &str| {
            format!(
                "image: {image}\nresolution: 0.5\norigin: [1, 2, 0]\nnegate: 0\n\
                 occupied_thresh: 0.65\nfree_thresh: 0.196\n"
            )
        };
        let host = MemoryHost::new()
            .with_file("/m/a.yaml", yaml("a.pgm"))
            .with_file("/m/a.pgm", b"P2 2 1 255  0 254")
            .with_file("/m/b.yaml", yaml("b.pgm"))
            .with_file("/m/b.pgm", b"P2 1 1 255  205")
            .with_file("/m/none.yaml", yaml("none.pgm"));
        Arc::new(Self { host, written: Mutex::default() })
    }
}

impl Host for Files {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileReadError> {
        self.host.read(path)
    }
    fn kind(&self, path: &Path) -> Option<EntryKind> {
        self.host.kind(path)
    }
    fn list(&self, folder: &Path) -> Vec<String> {
        self.host.list(folder)
    }
    fn canonical(&self, path: &Path) -> Option<PathBuf> {
        self.host.canonical(path)
    }
    fn variable(&self, name: &str) -> Option<String> {
        self.host.variable(name)
    }
}

impl Store for Files {
    fn replace(&self, path: &Path, content: &[u8]) -> Result<(), FileWriteError> {
        if path.starts_with("/full") {
            return Err(FileWriteError::Other("the disk is full".into()));
        }
        self.written.lock().unwrap().insert(path.to_owned(), content.to_vec());
        Ok(())
    }
}

struct Stage {
    graph: Graph,
    user: Node,
    maps: Mailbox<OccupancyGrid>,
}

impl Stage {
    fn new() -> Self {
        let graph = Graph::new();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let maps = user.mailbox("/map", Qos::latched(1)).unwrap();
        Self { graph, user, maps }
    }

    fn server(&self, yaml_filename: &str) -> LifecycleNode<MapServer> {
        self.server_of(yaml_filename, Distro::Jazzy)
    }

    fn server_of(&self, yaml_filename: &str, distro: Distro) -> LifecycleNode<MapServer> {
        let node = self.graph.node(NodeSettings::new("map_server")).unwrap();
        let params =
            MapServerParams { yaml_filename: yaml_filename.into(), ..MapServerParams::default() };
        MapServer::new(node, params, distro, Files::new()).unwrap()
    }

    fn ask<S: Service>(&self, name: &str, request: S::Request) -> Arc<S::Response> {
        let pending = self.user.client::<S>(name).unwrap().call(request);
        for _ in 0..100 {
            self.graph.advance_to(self.graph.now_ns() + 50_000_000);
            if let Some(answer) = pending.take() {
                return answer.unwrap();
            }
        }
        panic!("no answer from {name}");
    }

    fn load(&self, path: &str) -> u8 {
        let request = LoadMapRequest { map_url: path.into() };
        self.ask::<LoadMap>("/map_server/load_map", request).result
    }
}

#[test]
fn a_map_is_served() {
    let stage = Stage::new();
    let server = stage.server("/m/a.yaml");
    stage.graph.settle();
    assert!(stage.maps.latest().is_none(), "nobody has started it");
    assert_eq!(stage.load("/m/a.yaml"), 255);
    server.start();
    stage.graph.settle();
    let map = stage.maps.latest().unwrap();
    assert_eq!((map.data.as_slice(), map.header.frame_id.as_str()), (&[100, 0][..], "map"));
    assert_eq!((map.info.resolution, map.info.origin.position.y), (0.5, 2.0));
    let late = stage.user.mailbox::<MapMetaData>("/map_metadata", Qos::latched(1)).unwrap();
    assert_eq!(late.latest().unwrap().width, 2, "what was said before is kept");
    let answer = stage.ask::<GetMap>("/map_server/map", GetMapRequest::default());
    assert_eq!(answer.map.data, [100, 0]);

    assert_eq!(stage.load("/m/none.yaml"), 2);
    assert_eq!(stage.load("/m/nobody.yaml"), 3);
    assert_eq!(stage.load(""), 1);
    assert!(stage.maps.latest().is_none(), "the map stays");
    assert_eq!(stage.load("/m/b.yaml"), 0);
    assert_eq!(stage.maps.latest().unwrap().data, [-1]);
    server.lifecycle().change(Transition::Deactivate);
    stage.graph.settle();
    assert!(stage.ask::<GetMap>("/map_server/map", GetMapRequest::default()).map.data.is_empty());
}

#[test]
fn the_server_of_ros_1_has_its_service() {
    let stage = Stage::new();
    let server = stage.server_of("/m/a.yaml", Distro::Noetic);
    server.start();
    stage.graph.settle();
    let answer = stage.ask::<GetMap>("/static_map", GetMapRequest::default());
    assert_eq!(answer.map.data, [100, 0]);
}

#[test]
fn a_server_without_its_map_is_not_configured() {
    let stage = Stage::new();
    let server = stage.server("/m/none.yaml");
    server.start();
    stage.graph.settle();
    assert_eq!(server.lifecycle().state(), LifecycleState::Unconfigured);
    drop(server);
    let server = stage.server("");
    server.start();
    stage.graph.settle();
    assert!(server.lifecycle().is_active(), "it waits for a map");
    assert_eq!(stage.load("file:///m/a.yaml"), 0);
    assert!(stage.maps.latest().is_some());
}

#[test]
fn a_map_is_saved() {
    let stage = Stage::new();
    let files = Files::new();
    let node = stage.graph.node(NodeSettings::new("map_saver")).unwrap();
    let saver = MapSaver::new(node, Distro::Jazzy, files.clone()).unwrap();
    let info = GridInfo::new(0.05, 2, 1, Pose2::IDENTITY).unwrap();
    let map = to_message(&Grid { info, cells: vec![-1, 100] }, "map", Default::default());
    let publisher = stage.user.publisher("/map", Qos::latched(1)).unwrap();
    publisher.publish(map);
    let save = |url: &str, topic: &str| {
        let request = SaveMapRequest {
            map_url: url.into(),
            map_topic: topic.into(),
            ..SaveMapRequest::default()
        };
        stage.ask::<SaveMap>("/map_saver/save_map", request).result
    };
    assert!(!save("/s/a", ""), "it is not active");
    saver.start();
    assert!(save("/s/a", ""));
    assert!(!save("/s/b", "nobody"), "no map comes");
    assert!(!save("/full/a", "map"));
    let written = files.written.lock().unwrap();
    assert_eq!(written.keys().collect::<Vec<_>>(), [Path::new("/s/a.pgm"), Path::new("/s/a.yaml")]);
    assert_eq!(written[Path::new("/s/a.pgm")], b"P5\n2 1\n255\n\xcd\x00");
}
