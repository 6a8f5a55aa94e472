//! Writes a bag, reads it, and reads what is left of it after damage.
#![allow(clippy::print_stdout, reason = "an example")]

use std::error::Error;
use std::io::Cursor;

use periplus::bags::{QosProfile, Reader, Selection, Settings, Stamp, Topic, Writer};
use periplus::msgs::{Message, geometry_msgs::Twist};

/// Messages that are written.
const MESSAGE_COUNT: i64 = 1000;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    // `ros2 bag`, Foxglove and Lichtblick open such a file.
    let mut bag = Writer::new(Vec::new(), Settings::new("run.mcap"))?;
    let topic = bag.topic(Topic::of::<Twist>("/cmd_vel", &[QosProfile::reliable(10)]))?;
    for index in 0..MESSAGE_COUNT {
        let mut twist = Twist::default();
        twist.linear.x = 1e-3 * index as f64;
        bag.write(topic, Stamp::at(index * 20_000_000), &twist.to_cdr()?)?;
    }
    let (bytes, info) = bag.finish()?;
    println!("{} messages in {} bytes", info.messages(), bytes.len());

    let mut reader = Reader::open(Cursor::new(&bytes[..]))?;
    let mut count = 0;
    let mut messages = reader.messages(Selection::default());
    while let Some(message) = messages.next()? {
        let twist = Twist::decode_cdr(message.data)?;
        assert_eq!(twist.linear.x, 1e-3 * f64::from(count));
        count += 1;
    }
    assert_eq!(i64::from(count), MESSAGE_COUNT);

    // A recorder that was killed leaves a file without its end.
    let mut reader = Reader::open(Cursor::new(&bytes[..bytes.len() / 2]))?;
    let mut left = 0;
    let mut messages = reader.messages(Selection::default());
    while messages.next()?.is_some() {
        left += 1;
    }
    println!("{left} messages in the first half, {} faults", reader.faults().len());
    assert!(!reader.faults().is_empty(), "the damage is reported");
    Ok(())
}
