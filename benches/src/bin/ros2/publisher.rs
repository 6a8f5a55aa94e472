//! Periplus as a publisher of the messages that `benches/oracles/wire_rclpy.py` publishes, with the same words.

use std::f32::consts::{PI, TAU};
use std::time::{Duration, Instant};

use periplus_dds::{DdsTransport, Settings};
use periplus_graph::{Graph, NodeSettings, Qos};
use periplus_msgs::Message;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::sensor_msgs::{CameraInfo, Image, LaserScan, PointCloud2, PointField};
use periplus_msgs::std_msgs::Header;
use periplus_os::unix_ns;

use crate::process::await_end;

const POINT_STEP: usize = 16;

/// A message with a header.
trait Stamped: Message + Clone {
    fn header(&mut self) -> &mut Header;
}

macro_rules! stamped {
    ($($name:ty),*) => {$(
        impl Stamped for $name {
            fn header(&mut self) -> &mut Header {
                &mut self.header
            }
        }
    )*};
}

stamped!(CameraInfo, Image, LaserScan, PointCloud2);

/// `DOMAIN KIND SIZE RELIABILITY HZ COUNT`
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let [domain, kind, size, reliability, rate, count] = words else {
        return Err("usage: ros2 pub DOMAIN KIND SIZE RELIABILITY HZ COUNT".to_owned());
    };
    let number =
        |word: &String| word.parse::<u32>().map_err(|_| format!("`{word}` is not a number"));
    let settings = Settings { domain_id: number(domain)?, ..Settings::default() };
    let size = number(size)?;
    let plan = Plan {
        settings,
        qos: match reliability.as_str() {
            "reliable" => Qos::reliable(10),
            "best_effort" => Qos::best_effort(10),
            other => return Err(format!("`{other}` is neither reliable nor best_effort")),
        },
        period: Duration::from_secs_f64(1.0 / f64::from(number(rate)?.max(1))),
        count: number(count)?,
    };
    let points = size as usize / POINT_STEP;
    match kind.as_str() {
        "scan" => plan.publish(LaserScan {
            angle_min: -PI,
            angle_max: PI,
            angle_increment: TAU / size as f32,
            range_min: 0.1,
            range_max: 30.0,
            ranges: vec![1.0; size as usize],
            ..LaserScan::default()
        }),
        "image" => plan.publish(Image {
            width: size,
            height: size * 3 / 4,
            step: size * 3,
            encoding: "rgb8".to_owned(),
            data: vec![0; (size * size * 9 / 4) as usize],
            ..Image::default()
        }),
        "camera_info" => plan.publish(CameraInfo {
            width: size,
            height: size * 3 / 4,
            distortion_model: "plumb_bob".to_owned(),
            d: vec![0.0; 5],
            ..CameraInfo::default()
        }),
        "cloud" => plan.publish(PointCloud2 {
            width: points as u32,
            height: 1,
            fields: [("x", 0), ("y", 4), ("z", 8), ("intensity", 12)]
                .map(|(name, offset)| PointField {
                    name: name.to_owned(),
                    offset,
                    datatype: PointField::FLOAT32,
                    count: 1,
                })
                .to_vec(),
            point_step: POINT_STEP as u32,
            row_step: (points * POINT_STEP) as u32,
            is_dense: true,
            data: vec![0; points * POINT_STEP],
            ..PointCloud2::default()
        }),
        other => Err(format!("there is no load `{other}`")),
    }
}

struct Plan {
    settings: Settings,
    qos: Qos,
    period: Duration,
    count: u32,
}

impl Plan {
    fn publish<T: Stamped>(&self, mut message: T) -> Result<(), String> {
        let wire = DdsTransport::open(&self.settings).map_err(|error| error.to_string())?;
        let graph = Graph::live();
        wire.attach(&graph).map_err(|error| error.to_string())?;
        let failed = |error: periplus_graph::GraphError| error.to_string();
        let node = graph.node(NodeSettings::new("publisher")).map_err(failed)?;
        let publisher = node.publisher::<T>("/measured", self.qos).map_err(failed)?;
        while !publisher.is_heard() {
            std::thread::sleep(Duration::from_millis(5));
        }
        // The subscriber may find the publisher later than it was found.
        std::thread::sleep(Duration::from_millis(700));
        println!("begin");
        let start = Instant::now();
        let (mut due, mut last) = (start, start);
        for number in 0..self.count {
            let header = message.header();
            header.stamp = Time::of_ns(unix_ns());
            header.frame_id = number.to_string();
            publisher.publish(message.clone());
            last = Instant::now();
            due += self.period;
            std::thread::sleep(due.saturating_duration_since(last));
        }
        println!("done {} {}", self.count, (last - start).as_secs_f64());
        await_end();
        Ok(())
    }
}
