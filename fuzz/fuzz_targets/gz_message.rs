//! Messages of Gazebo: protobuf and its text, and what they are in ROS and back. Any bytes are survived.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_gz_msgs::{
    AsRos, EntityFactory, Image, LaserScan, Message, Pairs, PointCloudPacked, Scene, each_pair,
};

struct Read<'a>(&'a [u8]);

impl Pairs for Read<'_> {
    fn pair<R: periplus_msgs::Message, G: AsRos<R>>(&mut self) {
        let Ok(message) = G::decode(self.0) else { return };
        if let Some(ros) = message.to_ros() {
            let _ = G::from_ros(&ros);
        }
    }
}

fuzz_target!(|bytes: &[u8]| {
    each_pair(&mut Read(bytes));
    for name in ["Scene", "LaserScan", "Image", "PointCloudPacked"] {
        let _ = periplus_gz_msgs::text_of(&format!("gz.msgs.{name}"), bytes);
    }
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    // What was read from a text can be printed and read again, and is then the same text.
    let again = |printed: String, read: Option<String>| assert_eq!(read, Some(printed));
    if let Ok(message) = LaserScan::from_text(text) {
        again(message.text(), LaserScan::from_text(&message.text()).ok().map(|it| it.text()));
    }
    if let Ok(message) = EntityFactory::from_text(text) {
        again(message.text(), EntityFactory::from_text(&message.text()).ok().map(|it| it.text()));
    }
    let _ = (Scene::from_text(text), Image::from_text(text), PointCloudPacked::from_text(text));
});
