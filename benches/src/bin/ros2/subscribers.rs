//! The real-time factor of a simulation beside subscribers that are stopped or read, and beside a client
//! of the page that does the same, against a run without them.

use std::fmt::Write as _;
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::time::{Duration, Instant};

use periplus_dds::{DdsTransport, Settings};
use periplus_graph::{Graph, Mailbox, NodeSettings, Qos};
use periplus_msgs::rosgraph_msgs::Clock;
use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest as _;
use tungstenite::{Message, WebSocket};

use crate::Setup;
use crate::process::{Running, command, median, quantile};

/// Turns of each variant, one after the other.
const TURNS: usize = 5;

/// Stopped subscribers may cost this share of the real-time factor.
const MAX_LOSS_RATIO: f64 = 0.05;

/// Programs start and receive their first message within this.
const PATIENCE: Duration = Duration::from_secs(60);

/// Subscribers that have received nothing within this are taken as broken ones.
const FIRST_MESSAGE: Duration = Duration::from_secs(15);

/// After the subscribers have stopped, before the measurement: the page disconnects clients that read
/// nothing for 10 s, so the measurement has both states.
const SETTLE: Duration = Duration::from_secs(2);

/// Topics of the robot that are measured in every variant, so that all runs do the same work.
const TOPICS: [&str; 3] = ["/scan", "/depth_camera/image_raw", "/depth_camera/points"];

/// Paces of the simulation, as `--rtf` has them.
const PACES: [&str; 2] = ["1", "max"];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Variant {
    Alone,
    Stopped,
    Reading,
}

impl Variant {
    const ALL: [Self; 3] = [Self::Alone, Self::Stopped, Self::Reading];

    fn name(self) -> &'static str {
        match self {
            Self::Alone => "none",
            Self::Stopped => "four stopped, and a client of the page that never reads",
            Self::Reading => "four that read, and a client of the page that reads",
        }
    }
}

/// A subscriber: the program is `rclpy` or `cyclone`.
const SUBSCRIBERS: [(&str, &str, &str); 4] = [
    ("rclpy", "scan", TOPICS[0]),
    ("rclpy", "image", TOPICS[1]),
    ("rclpy", "cloud", TOPICS[2]),
    ("cyclone", "cloud", TOPICS[2]),
];

/// One measurement.
#[derive(Clone, Copy)]
struct Figures {
    real_time_factor: f64,
    /// CPU time per second of the wall.
    cores: f64,
}

/// Runs all variants in alternating turns; returns a table in Markdown, and an error where stopped
/// subscribers cost a simulation at real time more than they may.
pub(crate) fn measure(setup: &Setup) -> Result<(String, Option<String>), String> {
    let (turns, window) =
        if setup.is_quick { (1, Duration::from_secs(3)) } else { (TURNS, Duration::from_secs(10)) };
    let mut table = String::from(
        "| `--rtf` | subscribers | real-time factor, median (least to most) | ratio to the control, median \
         (least to most) | cores of the simulation |\n|---|---|---|---|---|\n",
    );
    let mut fault = None;
    let mut domain_id = 10;
    for pace in PACES {
        let mut all: Vec<[Figures; 3]> = Vec::new();
        for turn in 0..turns {
            let mut row = [Figures { real_time_factor: f64::NAN, cores: f64::NAN }; 3];
            for step in 0..Variant::ALL.len() {
                // Each variant is first, second and last in turn.
                let at = (step + turn) % Variant::ALL.len();
                domain_id += 1;
                let figures = one(setup, pace, Variant::ALL[at], window, domain_id)?;
                eprintln!(
                    "--rtf {pace}, turn {turn}, {}: {:.3} x real time, {:.2} cores",
                    Variant::ALL[at].name(),
                    figures.real_time_factor,
                    figures.cores
                );
                row[at] = figures;
            }
            all.push(row);
        }
        for (at, variant) in Variant::ALL.into_iter().enumerate() {
            let of = |pick: fn(&[Figures; 3], usize) -> f64| -> Vec<f64> {
                all.iter().map(|row| pick(row, at)).collect()
            };
            let factors = of(|row, at| row[at].real_time_factor);
            let ratios = of(|row, at| row[at].real_time_factor / row[0].real_time_factor);
            let cores = of(|row, at| row[at].cores);
            let _ = writeln!(
                table,
                "| {pace} | {} | {} | {} | {:.2} |",
                variant.name(),
                spread(&factors),
                spread(&ratios),
                median(&cores),
            );
            if pace == "1" && variant == Variant::Stopped && median(&ratios) < 1.0 - MAX_LOSS_RATIO
            {
                fault = Some(format!(
                    "stopped subscribers cost the simulation {:.0} % of its real-time factor; at most \
                     {:.0} % are allowed on an idle machine",
                    (1.0 - median(&ratios)) * 100.0,
                    MAX_LOSS_RATIO * 100.0
                ));
            }
        }
    }
    Ok((table, fault))
}

fn spread(values: &[f64]) -> String {
    let at = |share| quantile(values, share);
    format!("{:.3} ({:.3} to {:.3})", at(0.5), at(0.0), at(1.0))
}

fn one(
    setup: &Setup,
    pace: &str,
    variant: Variant,
    window: Duration,
    domain_id: u32,
) -> Result<Figures, String> {
    let subscribers = match variant {
        Variant::Alone => Vec::new(),
        Variant::Stopped | Variant::Reading => SUBSCRIBERS
            .iter()
            .map(|(program, kind, topic)| subscriber(setup, program, kind, topic, domain_id))
            .collect::<Result<Vec<_>, _>>()?,
    };
    for subscriber in &subscribers {
        subscriber.expect("ready", PATIENCE)?;
    }
    let address = free_address()?;
    let page = format!("--page={address}");
    let heard = TOPICS.join("|");
    let words = [
        "sim",
        "worlds/closed_room.world",
        "--robot",
        "robots/sam_bot/urdf/sam_bot.urdf.xacro",
        "--rtf",
        pace,
        "--ros2",
        "loopback",
        "--compute",
        &heard,
        &page,
        "--no-browser",
        "--quiet",
    ];
    let mut run = command(&setup.periplus, domain_id, &words);
    let simulation = Running::start(run.current_dir(&setup.root))?;
    let clock = SimulationClock::join(domain_id)?;
    clock.wait()?;
    let deadline = Instant::now() + FIRST_MESSAGE;
    for (subscriber, (program, kind, _)) in subscribers.iter().zip(&SUBSCRIBERS) {
        let rest = deadline.saturating_duration_since(Instant::now());
        if subscriber.expect("first", rest).is_err() {
            // Fast DDS may hang in `rcl_take` with large clouds of Cyclone DDS: a broken subscriber, too.
            eprintln!(
                "{program} has received no {kind} within {:.0} s",
                FIRST_MESSAGE.as_secs_f64()
            );
        }
    }
    let client = match variant {
        Variant::Alone => None,
        Variant::Stopped | Variant::Reading => Some(page_client(&address)?),
    };
    let _client = match (variant, client) {
        (Variant::Reading, Some(mut socket)) => {
            std::thread::spawn(move || while socket.read().is_ok() {});
            None
        }
        (_, client) => client,
    };
    if variant == Variant::Stopped {
        subscribers.iter().try_for_each(|subscriber| subscriber.signal("-STOP"))?;
    }
    std::thread::sleep(SETTLE);
    let (start_s, start, cpu_s) = (clock.now_s()?, Instant::now(), simulation.cpu_s());
    std::thread::sleep(window);
    let (end_s, wall_s) = (clock.now_s()?, start.elapsed().as_secs_f64());
    Ok(Figures {
        real_time_factor: (end_s - start_s) / wall_s,
        cores: (simulation.cpu_s() - cpu_s) / wall_s,
    })
}

fn subscriber(
    setup: &Setup,
    program: &str,
    kind: &str,
    topic: &str,
    domain_id: u32,
) -> Result<Running, String> {
    if program == "rclpy" {
        let script = setup.script.to_string_lossy();
        let words = [&*script, "sub", kind, topic, "reliable"];
        return Running::start(&mut command(&setup.python, domain_id, &words));
    }
    let (script, domain) = (setup.cyclone_script.to_string_lossy(), domain_id.to_string());
    let topic = format!("rt{topic}");
    let words =
        [&*script, &domain, "sub", &topic, "sensor_msgs::msg::dds_::PointCloud2_", "5", "announce"];
    let mut cyclone = command(&setup.cyclone_python, domain_id, &words);
    Running::start(cyclone.env(
        "CYCLONEDDS_URI",
        "<General><Interfaces><NetworkInterface address=\"127.0.0.1\" multicast=\"true\"/></Interfaces>\
         </General>",
    ))
}

/// Address on which no program listens.
fn free_address() -> Result<String, String> {
    let listener = TcpListener::bind("127.0.0.1:0").map_err(|error| error.to_string())?;
    listener.local_addr().map(|address| address.to_string()).map_err(|error| error.to_string())
}

/// The time of the simulation, as `/clock` has it.
struct SimulationClock {
    clock: Mailbox<Clock>,
    // In this order: the wire leaves before its graph.
    _wire: DdsTransport,
    _graph: Graph,
}

impl SimulationClock {
    fn join(domain_id: u32) -> Result<Self, String> {
        let settings = Settings { domain_id, ..Settings::default() };
        let wire = DdsTransport::open(&settings).map_err(|error| error.to_string())?;
        let graph = Graph::live();
        wire.attach(&graph).map_err(|error| error.to_string())?;
        let failed = |error: periplus_graph::GraphError| error.to_string();
        let node = graph.node(NodeSettings::new("clock").bare()).map_err(failed)?;
        let clock = node.mailbox("/clock", Qos::clock()).map_err(failed)?;
        Ok(Self { clock, _wire: wire, _graph: graph })
    }

    fn wait(&self) -> Result<(), String> {
        let end = Instant::now() + PATIENCE;
        while self.clock.latest().is_none() {
            if Instant::now() > end {
                return Err("the simulation publishes no /clock".to_owned());
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        Ok(())
    }

    /// The newest time \[s\]; waits for the next one, so that it is not an old one.
    fn now_s(&self) -> Result<f64, String> {
        drop(self.clock.drain());
        let end = Instant::now() + PATIENCE;
        loop {
            if let Some(message) = self.clock.latest() {
                return Ok(message.clock.ns() as f64 * 1e-9);
            }
            if Instant::now() > end {
                return Err("/clock has stopped".to_owned());
            }
            std::thread::sleep(Duration::from_micros(500));
        }
    }
}

/// A client of the page that has subscribed to the topics of the robot.
fn page_client(address: &str) -> Result<WebSocket<TcpStream>, String> {
    let failed = |error: tungstenite::Error| format!("the page at {address}: {error}");
    let stream = TcpStream::connect(address).map_err(|error| format!("{address}: {error}"))?;
    let reading = stream.set_read_timeout(Some(PATIENCE));
    reading.map_err(|error| format!("{address}: {error}"))?;
    let mut request = format!("ws://{address}/").into_client_request().map_err(failed)?;
    let subprotocol = tungstenite::http::HeaderValue::from_static("foxglove.websocket.v1");
    request.headers_mut().insert("Sec-WebSocket-Protocol", subprotocol);
    let (mut socket, _) =
        tungstenite::client(request, stream).map_err(|error| format!("{address}: {error}"))?;
    let mut subscriptions = Vec::new();
    while subscriptions.len() < TOPICS.len() {
        let Message::Text(text) = socket.read().map_err(failed)? else { continue };
        let message: Value = serde_json::from_str(&text).unwrap_or_default();
        let channels = message["channels"].as_array().map(Vec::as_slice).unwrap_or_default();
        for channel in channels {
            if TOPICS.iter().any(|topic| channel["topic"] == **topic) {
                subscriptions
                    .push(json!({ "id": subscriptions.len(), "channelId": channel["id"] }));
            }
        }
    }
    let subscribe = json!({ "op": "subscribe", "subscriptions": subscriptions });
    socket.send(Message::text(subscribe.to_string())).map_err(failed)?;
    Ok(socket)
}

/// Checks that the Python bindings of Cyclone DDS are installed.
///
/// # Errors
/// When they are missing.
pub(crate) fn has_cyclone(python: &Path) -> Result<(), String> {
    let mut asked = std::process::Command::new(python);
    asked.args(["-c", "import cyclonedds"]).stderr(std::process::Stdio::null());
    if asked.status().is_ok_and(|status| status.success()) {
        return Ok(());
    }
    Err("there is no Cyclone DDS for Python: pip install cyclonedds==11.0.1, and name the interpreter in \
         PERIPLUS_PYTHON"
        .to_owned())
}
