//! Measures the speed of writing and reading bags: `cargo run --release -p periplus-bags --example
//! speed`
#![allow(clippy::disallowed_methods, clippy::print_stdout, reason = "an example is an edge")]

use std::error::Error;
use std::fs;
use std::io::Cursor;
use std::time::Instant;

use periplus_bags::{Compression, Reader, Selection, Settings, Stamp, Topic, Writer};
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::sensor_msgs::PointCloud2;
use periplus_msgs::{Message, TypeRegistry};

fn main() -> Result<(), Box<dyn Error>> {
    // Warm up lazily initialized data.
    let _ = TypeRegistry::builtin().schema_text(Odometry::TYPE_NAME);
    let small = odometry(100_000)?;
    let large = clouds(30);
    for threads in [0, 1, 2] {
        for compression in [Compression::None, Compression::Lz4, Compression::Zstd] {
            let name = format!("{compression:?}, {threads} threads");
            measure::<Odometry>(
                &format!("odometry 1 kHz, {name}"),
                &small,
                1_000_000,
                compression,
                threads,
            )?;
            measure::<PointCloud2>(
                &format!("clouds 9.8 MB, {name}"),
                &large,
                100_000_000,
                compression,
                threads,
            )?;
        }
    }
    Ok(())
}

/// A robot that drives a circle: 1 kHz, consecutive messages nearly equal.
fn odometry(count: u32) -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
    let mut message = Odometry::default();
    message.header.frame_id = "odom".into();
    message.child_frame_id = "base_footprint".into();
    let mut all = Vec::new();
    for index in 0..count {
        let angle = f64::from(index) * 2e-4;
        message.header.stamp.nanosec = index * 1_000_000 % 1_000_000_000;
        message.pose.pose.position.x = angle.sin();
        message.pose.pose.position.y = 1.0 - angle.cos();
        message.pose.pose.orientation.z = (angle / 2.0).sin();
        message.pose.pose.orientation.w = (angle / 2.0).cos();
        all.push(message.to_cdr()?);
    }
    Ok(all)
}

/// Points with noise, which compress badly.
fn clouds(count: u32) -> Vec<Vec<u8>> {
    let mut state = 1_u64;
    let mut noise = move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / 16_777_216.0
    };
    let cloud: Vec<u8> = (0..614_400_u32)
        .flat_map(|index| {
            let angle = index as f32 * 1e-3;
            let range = 3.0 + angle.sin() + 0.02 * noise();
            [range * angle.cos(), range * angle.sin(), 0.3, 1.0].map(f32::to_le_bytes).concat()
        })
        .collect();
    (0..count).map(|_| cloud.clone()).collect()
}

/// CPU time of this process, all threads \[s\].
fn cpu_s() -> f64 {
    let text = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> =
        text.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |at: usize| fields.get(at).and_then(|field| field.parse::<f64>().ok());
    (ticks(11).unwrap_or(0.0) + ticks(12).unwrap_or(0.0)) / 100.0
}

fn measure<T: Message>(
    name: &str,
    messages: &[Vec<u8>],
    period_ns: i64,
    compression: Compression,
    threads: usize,
) -> Result<(), Box<dyn Error>> {
    let bytes: usize = messages.iter().map(Vec::len).sum();
    let settings = Settings { compression, threads, ..Settings::new("speed.mcap") };
    let (cpu, wall) = (cpu_s(), Instant::now());
    let mut bag = Writer::new(Vec::with_capacity(bytes * 2), settings)?;
    let topic = bag.topic(Topic::of::<T>("/topic", &[]))?;
    for (time, message) in (0..).zip(messages) {
        bag.write(topic, Stamp::at(time * period_ns), message)?;
    }
    let caller_s = wall.elapsed().as_secs_f64();
    let (file, _) = bag.finish()?;
    let (wall_s, cpu_s_write) = (wall.elapsed().as_secs_f64(), cpu_s() - cpu);

    let wall = Instant::now();
    let mut reader = Reader::open(Cursor::new(&*file))?;
    let mut all = reader.messages(Selection::default());
    let mut count = 0;
    while all.next()?.is_some() {
        count += 1;
    }
    let read_s = wall.elapsed().as_secs_f64();
    assert_eq!(count, messages.len());
    let (many, megabytes) = (messages.len() as f64, bytes as f64 / 1e6);
    println!(
        "{name:28} write {:6.2} us/message caller, {:6.2} us CPU, {:6.0} MB/s; file {:5.1} %; read {:6.0} MB/s",
        caller_s / many * 1e6,
        cpu_s_write / many * 1e6,
        megabytes / wall_s,
        file.len() as f64 / bytes as f64 * 100.0,
        megabytes / read_s,
    );
    Ok(())
}
