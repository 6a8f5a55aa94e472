//! Speed of replaying a recording.
//!
//! `replay make PATH [BYTES]` writes a recording of a robot with a camera, a 3D lidar and the
//! topics of a navigation stack, 2 GB by default; `replay serve PATH ADDRESS` serves it. `replay measure ADDRESS PID` fetches the state of
//! all topics of the first recording of a server (`periplus view PATH --no-browser`) at 50 times,
//! and prints the times until the last byte and the memory of the process.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    clippy::indexing_slicing,
    clippy::missing_docs_in_private_items,
    reason = "a benchmark"
)]

use std::fs::File;
use std::io::BufWriter;
use std::sync::Arc;
use std::time::{Duration, Instant};

use periplus_bags::{QosProfile, Settings, Stamp, Topic, TopicId, Writer};
use periplus_graph::Graph;
use periplus_msgs::Message;
use periplus_msgs::action_msgs;
use periplus_msgs::geometry_msgs::TransformStamped;
use periplus_msgs::nav_msgs::{OccupancyGrid, Odometry};
use periplus_msgs::rcl_interfaces::Log;
use periplus_msgs::sensor_msgs::{Image, Imu, LaserScan, PointCloud2, PointField};
use periplus_msgs::std_msgs::{Header, String as Text};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_web::foxglove::{Hub, RecordingSettings, Recordings};
use periplus_web::server::{WebServer, WebServerSettings};
use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest as _;
use tungstenite::{Message as Frame, WebSocket};

const START_NS: i64 = 1_700_000_000_000_000_000;
const STEP_NS: i64 = 10_000_000;
const ROBOT: &str = r#"<robot name="bench">
  <link name="base_link"><visual><geometry><box size="0.5 0.4 0.2"/></geometry></visual></link>
  <link name="left_wheel"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
  <link name="right_wheel"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
  <joint name="left" type="continuous"><parent link="base_link"/><child link="left_wheel"/></joint>
  <joint name="right" type="continuous"><parent link="base_link"/><child link="right_wheel"/></joint>
</robot>"#;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["make", path] => make(path, 2_000_000_000),
        ["make", path, bytes] => make(path, bytes.parse().unwrap()),
        ["serve", path, address] => serve(path, address),
        ["measure", address, pid] => measure(address, pid),
        _ => println!(
            "usage: replay make PATH [BYTES] | replay serve PATH HOST:PORT | replay measure HOST:PORT PID"
        ),
    }
}

/// Serves a recording until the process is killed, as `periplus view PATH` does.
fn serve(path: &str, address: &str) {
    let hub = Hub::open(&Graph::live(), Default::default()).unwrap();
    let folder = std::env::temp_dir();
    let recordings = Recordings::new(RecordingSettings::new(&folder, &folder));
    recordings.open(path.as_ref()).unwrap();
    hub.serve_recordings(recordings);
    let settings = WebServerSettings { address: address.parse().unwrap(), token: None };
    let server = WebServer::open(Arc::new(hub), settings).unwrap();
    println!("{}", server.url());
    loop {
        std::thread::park();
    }
}

/// Reproducible noise.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A number from -1 to 1.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

struct Output {
    bag: Writer<BufWriter<File>>,
}

impl Output {
    fn topic<T: Message>(&mut self, name: &str, qos: QosProfile) -> TopicId {
        self.bag.topic(Topic::of::<T>(name, &[qos])).unwrap()
    }

    fn write<T: Message>(&mut self, topic: TopicId, time_ns: i64, message: &T) {
        self.bag.write(topic, Stamp::at(time_ns), &message.to_cdr().unwrap()).unwrap();
    }
}

fn make(path: &str, bytes: u64) {
    let settings = Settings { threads: 2, ..Settings::new("big.mcap") };
    let file = BufWriter::new(File::create(path).unwrap());
    let mut out = Output { bag: Writer::new(file, settings).unwrap() };
    let (sensor, latched) = (QosProfile::sensor_data(), QosProfile::latched(1));
    let reliable = QosProfile::reliable(10);
    let camera = out.topic::<Image>("/camera/image_raw", sensor);
    let cloud = out.topic::<PointCloud2>("/points", sensor);
    let scan = out.topic::<LaserScan>("/scan", sensor);
    let imu = out.topic::<Imu>("/imu", sensor);
    let odom = out.topic::<Odometry>("/odom", reliable);
    let tf = out.topic::<TFMessage>("/tf", QosProfile::reliable(100));
    let tf_static = out.topic::<TFMessage>("/tf_static", QosProfile::latched(100));
    let robot = out.topic::<Text>("/robot_description", latched);
    let map = out.topic::<OccupancyGrid>("/map", latched);
    let global = out.topic::<OccupancyGrid>("/global_costmap/costmap", latched);
    let local = out.topic::<OccupancyGrid>("/local_costmap/costmap", latched);
    let rosout = out.topic::<Log>("/rosout", QosProfile::latched(1000));
    let goals =
        out.topic::<action_msgs::GoalStatusArray>("/navigate_to_pose/_action/status", latched);
    let mut noise = Noise(88_172_645_463_325_252);
    let mut step: i64 = 0;
    while std::fs::metadata(path).unwrap().len() < bytes {
        let time_ns = START_NS + step * STEP_NS;
        let time_s = step as f64 * 0.01;
        let (x_m, y_m, yaw_rad) =
            (4.0 * (0.1 * time_s).cos(), 4.0 * (0.1 * time_s).sin(), 0.1 * time_s);
        if step == 0 {
            out.write(robot, time_ns, &Text { data: ROBOT.to_owned() });
            let mounts = ["laser", "camera", "lidar3d", "imu"];
            let transforms =
                mounts.map(|child| transform(time_ns, "base_link", child, [0.1, 0.0, 0.3], 0.0));
            out.write(tf_static, time_ns, &TFMessage { transforms: transforms.to_vec() });
        }
        if step % 10 == 0 {
            out.write(camera, time_ns, &image(time_ns, time_s, &mut noise));
            out.write(cloud, time_ns + 1_000_000, &points(time_ns, time_s, &mut noise));
        }
        if step % 5 == 0 {
            out.write(scan, time_ns + 2_000_000, &laser(time_ns, time_s, &mut noise));
            let drift = transform(time_ns, "map", "odom", [0.01 * time_s, 0.0, 0.0], 0.0);
            out.write(tf, time_ns + 2_500_000, &TFMessage { transforms: vec![drift] });
        }
        if step % 2 == 0 {
            let base = transform(time_ns, "odom", "base_link", [x_m, y_m, 0.0], yaw_rad);
            let wheels = ["left_wheel", "right_wheel"]
                .map(|child| transform(time_ns, "base_link", child, [0.0, 0.2, 0.1], time_s));
            out.write(tf, time_ns + 3_000_000, &TFMessage { transforms: vec![base] });
            out.write(tf, time_ns + 3_100_000, &TFMessage { transforms: wheels.to_vec() });
            let mut odometry = Odometry {
                header: Header::at(time_ns, "odom"),
                child_frame_id: "base_link".into(),
                ..Default::default()
            };
            (odometry.pose.pose.position.x, odometry.pose.pose.position.y) = (x_m, y_m);
            (odometry.pose.pose.orientation.z, odometry.pose.pose.orientation.w) =
                (yaw_rad / 2.0).sin_cos();
            odometry.twist.twist.linear.x = 0.4 + 0.02 * noise.unit();
            out.write(odom, time_ns + 3_200_000, &odometry);
        }
        let mut reading = Imu { header: Header::at(time_ns, "imu"), ..Default::default() };
        reading.angular_velocity.z = 0.1 + 0.01 * noise.unit();
        out.write(imu, time_ns + 4_000_000, &reading);
        if step % 500 == 0 {
            out.write(map, time_ns + 5_000_000, &grid(time_ns, "map", 400, time_s, &mut noise));
        }
        if step % 100 == 0 {
            out.write(global, time_ns + 5_100_000, &grid(time_ns, "map", 400, time_s, &mut noise));
            let level = if step % 3000 == 1500 {
                Log::ERROR
            } else if step % 700 == 0 {
                Log::WARN
            } else {
                Log::INFO
            };
            let line = Log {
                level,
                name: "controller_server".into(),
                msg: format!("step {step}"),
                ..Default::default()
            };
            out.write(rosout, time_ns + 6_000_000, &line);
        }
        if step % 50 == 0 {
            out.write(local, time_ns + 5_200_000, &grid(time_ns, "odom", 100, time_s, &mut noise));
        }
        if step % 1000 == 0 {
            let mut status = action_msgs::GoalStatus {
                status: if step % 2000 == 0 { 2 } else { 4 },
                ..Default::default()
            };
            status.goal_info.goal_id.uuid[0] = (step / 2000) as u8;
            out.write(
                goals,
                time_ns + 7_000_000,
                &action_msgs::GoalStatusArray { status_list: vec![status] },
            );
        }
        step += 1;
    }
    let (_, info) = out.bag.finish().unwrap();
    println!("{path}: {} messages in {:.0} s", info.messages(), step as f64 * 0.01);
}

fn transform(
    time_ns: i64,
    parent: &str,
    child: &str,
    at_m: [f64; 3],
    yaw_rad: f64,
) -> TransformStamped {
    let mut transform = TransformStamped {
        header: Header::at(time_ns, parent),
        child_frame_id: child.into(),
        ..Default::default()
    };
    let at = &mut transform.transform.translation;
    [at.x, at.y, at.z] = at_m;
    let turn = &mut transform.transform.rotation;
    (turn.z, turn.w) = (yaw_rad / 2.0).sin_cos();
    transform
}

fn image(time_ns: i64, time_s: f64, noise: &mut Noise) -> Image {
    let (width, height) = (640_u32, 480_u32);
    let mut data = Vec::with_capacity((width * height * 3) as usize);
    for row in 0..height {
        for column in 0..width {
            let grain = noise.next();
            let wave =
                ((f64::from(column) * 0.02 + time_s).sin() * 60.0 + f64::from(row) * 0.2) as i64;
            for channel in 0..3_i64 {
                data.push(
                    (100 + wave + channel * 20 + ((grain >> (8 * channel)) & 3) as i64) as u8,
                );
            }
        }
    }
    Image {
        header: Header::at(time_ns, "camera"),
        height,
        width,
        encoding: "rgb8".into(),
        step: width * 3,
        data,
        ..Default::default()
    }
}

fn points(time_ns: i64, time_s: f64, noise: &mut Noise) -> PointCloud2 {
    let count = 50_000_u32;
    let mut data = Vec::with_capacity(16 * count as usize);
    for index in 0..count {
        let turn = f64::from(index % 1000) * std::f64::consts::TAU / 1000.0;
        let range = 5.0 + (turn * 3.0 + time_s).sin() + 0.02 * noise.unit();
        let values =
            [range * turn.cos(), range * turn.sin(), f64::from(index / 1000) * 0.05, 100.0 * range];
        values.iter().for_each(|value| data.extend((*value as f32).to_le_bytes()));
    }
    let field = |(name, offset): (&str, u32)| PointField {
        name: name.into(),
        offset,
        datatype: PointField::FLOAT32,
        count: 1,
    };
    let fields = [("x", 0), ("y", 4), ("z", 8), ("intensity", 12)].map(field).to_vec();
    PointCloud2 {
        header: Header::at(time_ns, "lidar3d"),
        height: 1,
        width: count,
        fields,
        point_step: 16,
        row_step: 16 * count,
        data,
        is_dense: true,
        ..Default::default()
    }
}

fn laser(time_ns: i64, time_s: f64, noise: &mut Noise) -> LaserScan {
    let beams = 720;
    let increment = std::f32::consts::TAU / beams as f32;
    let range =
        |beam: i32| (4.0 + (f64::from(beam) * 0.05 + time_s).sin() + 0.01 * noise.unit()) as f32;
    let ranges = (0..beams).map(range).collect();
    LaserScan {
        header: Header::at(time_ns, "laser"),
        angle_min: -std::f32::consts::PI,
        angle_max: std::f32::consts::PI - increment,
        angle_increment: increment,
        range_min: 0.1,
        range_max: 20.0,
        ranges,
        ..Default::default()
    }
}

fn grid(time_ns: i64, frame: &str, cells: u32, time_s: f64, noise: &mut Noise) -> OccupancyGrid {
    let mut grid = OccupancyGrid { header: Header::at(time_ns, frame), ..Default::default() };
    (grid.info.resolution, grid.info.width, grid.info.height) = (0.05, cells, cells);
    let half_m = f64::from(cells) * 0.025;
    (grid.info.origin.position.x, grid.info.origin.position.y) = (-half_m, -half_m);
    let known = (time_s * 400.0) as u32;
    grid.data = (0..cells * cells)
        .map(|cell| match cell {
            cell if cell > known + 20_000 => -1,
            _ if noise.next().is_multiple_of(40) => 100,
            _ => 0,
        })
        .collect();
    grid
}

/// A client of the server.
struct Client {
    socket: WebSocket<std::net::TcpStream>,
    last_id: u32,
}

impl Client {
    fn text(&mut self, op: &str) -> Value {
        loop {
            if let Frame::Text(text) = self.socket.read().unwrap() {
                let value: Value = serde_json::from_str(&text).unwrap();
                assert_ne!(value["op"], "fetchFailure", "{value}");
                if value["op"] == op {
                    return value;
                }
            }
        }
    }

    fn send(&mut self, mut value: Value) -> u32 {
        self.last_id += 1;
        value["requestId"] = self.last_id.into();
        self.socket.send(Frame::text(value.to_string())).unwrap();
        self.last_id
    }

    /// Reads frames of messages until the last one; returns messages and bytes.
    fn stored(&mut self) -> (usize, usize) {
        let (mut messages, mut bytes) = (0, 0);
        loop {
            let Frame::Binary(frame) = self.socket.read().unwrap() else { continue };
            if frame[0] != 0x10 {
                continue;
            }
            bytes += frame.len();
            let mut at = 14;
            while at < frame.len() {
                let length = u32::from_le_bytes(frame[at + 12..at + 16].try_into().unwrap());
                at += 16 + length as usize;
                messages += 1;
            }
            if frame[5] & 1 == 1 {
                return (messages, bytes);
            }
        }
    }
}

fn memory_mb(pid: &str, key: &str) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{pid}/status")).unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with(key)).unwrap_or_default();
    let kilobytes = line.split_whitespace().nth(1).and_then(|word| word.parse::<u64>().ok());
    kilobytes.unwrap_or(0) / 1024
}

fn measure(address: &str, pid: &str) {
    let since = Instant::now();
    let mut request = format!("ws://{address}/").into_client_request().unwrap();
    let protocol = "foxglove.websocket.v1".parse().unwrap();
    request.headers_mut().insert("Sec-WebSocket-Protocol", protocol);
    let stream = std::net::TcpStream::connect(address).unwrap();
    stream.set_nodelay(true).unwrap();
    let (socket, _) = tungstenite::client::client(request, stream).unwrap();
    let mut client = Client { socket, last_id: 0 };
    client.socket.send(Frame::text(json!({"op": "subscribeRecordings"}).to_string())).unwrap();
    let recording = loop {
        let list = client.text("recordings");
        if list["recordings"][0]["state"] == "ready" {
            break list["recordings"][0].clone();
        }
    };
    let number = |key: &str| recording[key].as_str().unwrap().parse::<i64>().unwrap();
    let (start_ns, end_ns) = (number("startNs"), number("endNs"));
    println!(
        "ready {:.0} ms after the connection: {} messages, {} MB",
        ms(since.elapsed()),
        recording["messageCount"],
        recording["bytes"].as_u64().unwrap() / 1_000_000
    );
    let id = recording["id"].clone();
    let topics: Vec<Value> = recording["topics"]
        .as_array()
        .unwrap()
        .iter()
        .map(|topic| json!({"id": topic["id"], "historyNs": "0", "count": 1}))
        .collect();
    let mut noise = Noise(4_711);
    for (name, wait) in [("during the background pass", 0), ("after it", 20)] {
        std::thread::sleep(Duration::from_secs(wait));
        let mut times_ms = Vec::new();
        let mut size = (0, 0);
        for _ in 0..50 {
            let at = (noise.unit() + 1.0) / 2.0;
            let time_ns = start_ns + ((end_ns - start_ns) as f64 * at) as i64;
            let since = Instant::now();
            client.send(json!({"op": "fetchState", "recording": id, "timeNs": time_ns.to_string(), "topics": topics}));
            size = client.stored();
            times_ms.push(ms(since.elapsed()));
        }
        times_ms.sort_by(f64::total_cmp);
        println!(
            "state of all topics {name}: median {:.0} ms, 90 % {:.0} ms, worst {:.0} ms ({} messages, {} kB); memory {} MB, highest {} MB",
            times_ms[25],
            times_ms[45],
            times_ms[49],
            size.0,
            size.1 / 1000,
            memory_mb(pid, "VmRSS"),
            memory_mb(pid, "VmHWM")
        );
    }
    let since = Instant::now();
    client.send(json!({"op": "fetchDensity", "recording": id, "bins": 1000}));
    client.text("density");
    println!("density of all topics: {:.0} ms", ms(since.elapsed()));
    let all: Vec<Value> =
        recording["topics"].as_array().unwrap().iter().map(|topic| topic["id"].clone()).collect();
    let since = Instant::now();
    let (from, to) = (start_ns + 10_000_000_000, start_ns + 15_000_000_000);
    client.send(json!({"op": "fetchMessages", "recording": id, "topics": all, "startNs": from.to_string(), "endNs": to.to_string(), "maxBytes": 500_000_000}));
    let (messages, bytes) = client.stored();
    println!(
        "5 s of all topics: {:.0} ms ({messages} messages, {} MB); memory {} MB, highest {} MB",
        ms(since.elapsed()),
        bytes / 1_000_000,
        memory_mb(pid, "VmRSS"),
        memory_mb(pid, "VmHWM")
    );
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1000.0
}
