//! Measures speed and memory of writing, converting and playing large bags: `cargo run --release -p
//! periplus-bags --example file_speed -- [GIGABYTES] [FOLDER]`; for comparison `rosbags-convert`, if
//! `PERIPLUS_PYTHON` has PyPI's `rosbags`.
#![allow(clippy::disallowed_methods, clippy::print_stdout, reason = "an example is an edge")]

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use periplus_bags::files::{
    Bag, BagWriter, ChunkPacking, Conversion, PlaySettings, Player, Storage, WriteSettings, convert,
};
use periplus_bags::{BagTopic, Selection, Stamp};
use periplus_graph::{Graph, NodeSettings, Qos};
use periplus_msgs::Message;
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::sensor_msgs::{Image, LaserScan, PointCloud2, PointField};

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let gigabytes: f64 = std::env::args().nth(1).map_or(Ok(2.0), |word| word.parse())?;
    let folder = std::env::args().nth(2).map_or_else(std::env::temp_dir, PathBuf::from);
    let folder = folder.join(format!("periplus-speed-{}", std::process::id()));
    fs::create_dir_all(&folder)?;
    let outcome = measure(&folder, (gigabytes * 1e9) as u64);
    fs::remove_dir_all(&folder)?;
    outcome
}

fn measure(folder: &Path, bytes: u64) -> Outcome<()> {
    println!(
        "| work | MB/s of messages | s | MB/s of CPU time | size of the result [MB] |\n|---|---|---|---|---|"
    );
    let source = folder.join("source.mcap");
    let plain =
        |storage| WriteSettings { chunks: ChunkPacking::None, ..WriteSettings::new(storage) };
    let start = Start::now();
    let bytes = write(&source, WriteSettings::new(Storage::Mcap), bytes)?;
    tell("write MCAP, Zstandard", bytes, start, Some(&source));
    for (name, file, settings) in [
        ("MCAP to MCAP, Zstandard", "packed.mcap", WriteSettings::new(Storage::Mcap)),
        ("MCAP to sqlite3", "base.db3", plain(Storage::Sqlite)),
        ("MCAP to ROS 1", "one.bag", plain(Storage::Ros1)),
    ] {
        let path = folder.join(file);
        run(name, &source, &path, settings, bytes)?;
        if file != "one.bag" {
            fs::remove_file(&path)?;
        }
    }
    let bag = folder.join("one.bag");
    let again = folder.join("again.mcap");
    run("ROS 1 to MCAP, Zstandard", &bag, &again, WriteSettings::new(Storage::Mcap), bytes)?;
    fs::remove_file(&again)?;
    play("play MCAP to a subscription", &source, bytes)?;
    play("play ROS 1 to a subscription", &bag, bytes)?;
    println!("\nMost memory at any time: {:.0} MB.\n", peak_mb());
    peer(&bag, &folder.join("theirs"), bytes)
}

fn run(name: &str, from: &Path, to: &Path, write: WriteSettings, bytes: u64) -> Outcome<()> {
    let start = Start::now();
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let write = WriteSettings { threads, ..write };
    let conversion = Conversion { selection: Selection::default(), write };
    let report = convert(&[Bag::open(from)?], to, conversion, &mut |_| {})?;
    assert!(report.findings.is_empty(), "{:?}", report.findings);
    tell(name, bytes, start, Some(to));
    Ok(())
}

fn play(name: &str, path: &Path, bytes: u64) -> Outcome<()> {
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("listener"))?;
    let clouds = node.mailbox::<PointCloud2>("/points", Qos::reliable(5))?;
    let start = Start::now();
    // At maximum speed: everything is due at once.
    let settings = PlaySettings { rate: 1e9, ..PlaySettings::default() };
    let mut player = Player::new(Bag::open(path)?, &graph, settings)?;
    let mut wall_ns = 0;
    let mut heard = 0;
    while let Some(next_ns) = player.advance_to(wall_ns)? {
        wall_ns = next_ns;
        heard += clouds.drain().len();
    }
    heard += clouds.drain().len();
    assert!(heard > 0);
    tell(name, bytes, start, None);
    Ok(())
}

/// Start of a measurement.
struct Start {
    wall: Instant,
    cpu_s: f64,
}

impl Start {
    fn now() -> Self {
        Self { wall: Instant::now(), cpu_s: cpu_s() }
    }
}

/// CPU time of this process with all threads, and of its finished children \[s\].
fn cpu_s() -> f64 {
    let text = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> =
        text.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |at: usize| fields.get(at).and_then(|field| field.parse::<f64>().ok());
    (11..15).filter_map(ticks).sum::<f64>() / 100.0
}

fn tell(name: &str, bytes: u64, start: Start, file: Option<&Path>) {
    let (seconds, cpu_s) = (start.wall.elapsed().as_secs_f64(), cpu_s() - start.cpu_s);
    let size = file.and_then(|file| file.metadata().ok()).map_or(0, |about| about.len());
    let size = if size > 0 { format!("{:.0}", size as f64 / 1e6) } else { String::new() };
    let megabytes = bytes as f64 / 1e6;
    // CPU times below 0.1 s are too coarse.
    let of_cpu = if cpu_s < 0.1 { String::new() } else { format!("{:.0}", megabytes / cpu_s) };
    println!("| {name} | {:.0} | {seconds:.1} | {of_cpu} | {size} |", megabytes / seconds);
}

/// Point clouds at 10 Hz, images at 30 Hz, scans at 40 Hz, odometry at 1 kHz, with noise.
fn write(path: &Path, settings: WriteSettings, most: u64) -> Outcome<u64> {
    let mut bag = BagWriter::create(path, settings)?;
    let mut topic = |name: &str, type_name: &str, schema: &str, hash: &str| {
        bag.topic(&BagTopic {
            name: name.into(),
            type_name: type_name.into(),
            encoding: "cdr".into(),
            schema_encoding: "ros2msg".into(),
            schema: schema.into(),
            metadata: [("topic_type_hash".to_owned(), hash.to_owned())].into(),
        })
    };
    let clouds = topic(
        "/points",
        PointCloud2::TYPE_NAME,
        PointCloud2::schema_text(),
        PointCloud2::TYPE_HASH,
    )?;
    let pictures = topic("/image", Image::TYPE_NAME, Image::schema_text(), Image::TYPE_HASH)?;
    let scans =
        topic("/scan", LaserScan::TYPE_NAME, LaserScan::schema_text(), LaserScan::TYPE_HASH)?;
    let poses = topic("/odom", Odometry::TYPE_NAME, Odometry::schema_text(), Odometry::TYPE_HASH)?;
    let (cloud, picture, mut scan) = (cloud(), picture(), scan());
    let mut pose = Odometry { child_frame_id: "base_link".into(), ..Odometry::default() };
    let (cloud, picture) = (cloud.to_cdr()?, picture.to_cdr()?);
    let (mut bytes, mut data) = (0, Vec::new());
    for tick in 0.. {
        let time_ns = 1_700_000_000_000_000_000 + tick * 1_000_000;
        let mut put = |topic, data: &[u8]| {
            bytes += data.len() as u64;
            bag.write(topic, Stamp::at(time_ns), data)
        };
        if tick % 100 == 0 {
            put(clouds, &cloud)?;
        }
        if tick % 33 == 0 {
            put(pictures, &picture)?;
        }
        if tick % 25 == 0 {
            scan.ranges.rotate_left(1);
            data.clear();
            scan.encode_cdr(&mut data)?;
            put(scans, &data)?;
        }
        pose.pose.pose.position.x = tick as f64 * 1e-3;
        data.clear();
        pose.encode_cdr(&mut data)?;
        put(poses, &data)?;
        if bytes >= most {
            break;
        }
    }
    bag.finish()?;
    Ok(bytes)
}

/// 64 rings of 1024 points with noise, which compress badly.
fn cloud() -> PointCloud2 {
    let mut state = 1_u64;
    let mut noise = move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / 16_777_216.0
    };
    let field = |(name, offset): (&str, u32)| PointField {
        name: name.into(),
        offset,
        datatype: PointField::FLOAT32,
        count: 1,
    };
    let data: Vec<u8> = (0..65_536_u32)
        .flat_map(|index| {
            let angle = index as f32 * 1e-3;
            let range = 3.0 + angle.sin() + 0.02 * noise();
            [range * angle.cos(), range * angle.sin(), 0.3, noise()].map(f32::to_le_bytes).concat()
        })
        .collect();
    PointCloud2 {
        height: 64,
        width: 1024,
        fields: [("x", 0), ("y", 4), ("z", 8), ("intensity", 12)].map(field).into(),
        point_step: 16,
        row_step: 16_384,
        data,
        is_dense: true,
        ..PointCloud2::default()
    }
}

/// A full turn with a resolution of half a degree.
fn scan() -> LaserScan {
    let ranges = (0..720).map(|beam| 3.0 + (beam as f32 * 0.05).sin()).collect();
    LaserScan { ranges, ..LaserScan::default() }
}

/// 640 x 480 RGB: surfaces with some noise.
fn picture() -> Image {
    let mut state = 7_u64;
    let data = (0..640 * 480 * 3_u32)
        .map(|index| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (index / 1920 / 8 * 5 % 200) as u8 + (state >> 62) as u8
        })
        .collect();
    Image { height: 480, width: 640, encoding: "rgb8".into(), step: 1920, data, ..Image::default() }
}

/// Peak memory of this process \[MB\].
fn peak_mb() -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap_or_default();
    let number = line.split_whitespace().next().and_then(|word| word.parse::<f64>().ok());
    number.unwrap_or(0.0) * 1024.0 / 1e6
}

/// The same with PyPI's `rosbags`, from ROS 1 to sqlite3.
fn peer(from: &Path, to: &Path, bytes: u64) -> Outcome<()> {
    let Some(python) = std::env::var_os("PERIPLUS_PYTHON") else {
        println!("SKIPPED: PERIPLUS_PYTHON names no Python with `rosbags`");
        return Ok(());
    };
    let start = Start::now();
    let status = Command::new(python)
        .args(["-c", "from rosbags.convert.cli import main; main()"])
        .arg("--src")
        .arg(from)
        .arg("--dst")
        .arg(to)
        .status()?;
    if status.success() {
        tell("rosbags-convert: ROS 1 to ROS 2 (sqlite3)", bytes, start, None);
    } else {
        println!("SKIPPED: rosbags-convert ends with {status}");
    }
    Ok(())
}
