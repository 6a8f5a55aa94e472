//! A recording of ten seconds.

use std::fs::File;
use std::path::Path;

use periplus_bags::{QosProfile, Settings, Stamp, Topic, TopicId, Writer};
use periplus_msgs::Message;
use periplus_msgs::action_msgs;
use periplus_msgs::geometry_msgs::TransformStamped;
use periplus_msgs::map_msgs::OccupancyGridUpdate;
use periplus_msgs::nav_msgs::{OccupancyGrid, Odometry};
use periplus_msgs::rcl_interfaces::Log;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::visualization_msgs::Marker;

/// Ids of the topics, in the order in which they are added.
pub(crate) const ODOM: u32 = 1;
pub(crate) const TF: u32 = 2;
pub(crate) const COSTMAP: u32 = 3;
pub(crate) const UPDATES: u32 = 4;
pub(crate) const MARKERS: u32 = 7;

/// Tenths of a second of the only transform of the arm.
pub(crate) const ARM_TENTHS: i64 = 1;

struct Run(Writer<File>);

impl Run {
    fn put<T: Message>(&mut self, topic: TopicId, tenths: i64, message: &T) {
        let stamp = Stamp::at(tenths * 100_000_000);
        self.0.write(topic, stamp, &message.to_cdr().unwrap()).unwrap();
    }
}

pub(crate) fn transform(child: &str) -> TFMessage {
    let one = TransformStamped { child_frame_id: child.into(), ..TransformStamped::default() };
    TFMessage { transforms: vec![one] }
}

/// Odometry and a transform each 0.1 s, a latched costmap at 2 s with updates each second, an error
/// at 4 s, and a goal that is reached at 8 s. Markers.
pub(crate) fn write(path: &Path) {
    let file = File::create(path).unwrap();
    let mut run = Run(Writer::new(file, Settings::new("run.mcap")).unwrap());
    let reliable = QosProfile::reliable(10);
    let odom = run.0.topic(Topic::of::<Odometry>("/odom", &[reliable])).unwrap();
    let tf = run.0.topic(Topic::of::<TFMessage>("/tf", &[reliable])).unwrap();
    let latched = QosProfile::latched(1);
    let costmap = run.0.topic(Topic::of::<OccupancyGrid>("/costmap", &[latched])).unwrap();
    let updates = Topic::of::<OccupancyGridUpdate>("/costmap_updates", &[reliable]);
    let updates = run.0.topic(updates).unwrap();
    let rosout = run.0.topic(Topic::of::<Log>("/rosout", &[QosProfile::latched(1000)])).unwrap();
    let name = "/navigate_to_pose/_action/status";
    let status = run.0.topic(Topic::of::<action_msgs::GoalStatusArray>(name, &[latched])).unwrap();
    let markers = run.0.topic(Topic::of::<Marker>("/markers", &[reliable])).unwrap();
    for tenths in 0..=100 {
        let mut odometry =
            Odometry { header: Header::at(tenths * 100_000_000, "odom"), ..Default::default() };
        odometry.twist.twist.linear.x = tenths as f64;
        run.put(odom, tenths, &odometry);
        run.put(tf, tenths, &transform("base_link"));
        if tenths == ARM_TENTHS {
            run.put(tf, tenths, &transform("arm"));
        }
        if tenths == 20 {
            run.put(costmap, tenths, &OccupancyGrid::default());
        }
        if tenths % 10 == 5 {
            run.put(updates, tenths, &OccupancyGridUpdate::default());
        }
        // The first marker stays, the second one is deleted at 5 s, and the third one is published
        // each 0.1 s.
        match tenths {
            1 => run.put(markers, tenths, &Marker { id: 1, ..Marker::default() }),
            2 => run.put(markers, tenths, &Marker { id: 2, ..Marker::default() }),
            50 => run.put(markers, tenths, &Marker { id: 2, action: 2, ..Marker::default() }),
            _ => run.put(markers, tenths, &Marker { id: 3, ..Marker::default() }),
        }
        if tenths == 40 {
            run.put(
                rosout,
                tenths,
                &Log {
                    level: Log::ERROR,
                    name: "planner".into(),
                    msg: "no path".into(),
                    ..Default::default()
                },
            );
        }
        if tenths == 30 || tenths == 80 {
            let state = if tenths == 30 { 2 } else { 4 };
            let one = action_msgs::GoalStatus { status: state, ..Default::default() };
            run.put(status, tenths, &action_msgs::GoalStatusArray { status_list: vec![one] });
        }
    }
    run.0.finish().unwrap();
}
