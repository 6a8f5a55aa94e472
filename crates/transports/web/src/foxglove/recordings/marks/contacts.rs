//! Collisions, and stops of the collision monitor.

use periplus_bags::BagTopic;
use periplus_msgs::Message;
use periplus_msgs::gazebo_msgs::ContactsState;
use periplus_msgs::nav2_msgs::{CollisionDetectorState, CollisionMonitorState};
use periplus_msgs::ros_gz_interfaces::Contacts;

use super::{Mark, MarkKind};

/// Time without a contact after which the next one is a new collision \[ns\].
const QUIET_NS: i64 = 1_000_000_000;

/// Contacts of a topic.
pub(in super::super) struct ContactMarks {
    decode: fn(&[u8]) -> Option<String>,
    /// Time of the last contact.
    last_ns: Option<i64>,
}

impl ContactMarks {
    pub(super) fn new(topic: &BagTopic) -> Option<Self> {
        let decode: fn(&[u8]) -> Option<String> = match topic.type_name.as_str() {
            ContactsState::TYPE_NAME => classic,
            Contacts::TYPE_NAME => harmonic,
            CollisionMonitorState::TYPE_NAME => monitor,
            CollisionDetectorState::TYPE_NAME => detector,
            _ => return None,
        };
        Some(Self { decode, last_ns: None })
    }

    pub(super) fn detect(&mut self, time_ns: i64, data: &[u8]) -> Vec<Mark> {
        let Some(text) = (self.decode)(data) else { return Vec::new() };
        let last_ns = self.last_ns.replace(time_ns);
        let is_same = last_ns.is_some_and(|last_ns| time_ns.saturating_sub(last_ns) < QUIET_NS);
        if is_same { Vec::new() } else { vec![Mark::new(time_ns, MarkKind::Collision, text)] }
    }
}

fn classic(data: &[u8]) -> Option<String> {
    let message = ContactsState::decode_cdr(data).ok()?;
    let first = message.states.first()?;
    Some(format!("{} touches {}", first.collision1_name, first.collision2_name))
}

fn harmonic(data: &[u8]) -> Option<String> {
    let message = Contacts::decode_cdr(data).ok()?;
    let first = message.contacts.first()?;
    Some(format!("{} touches {}", first.collision1.name, first.collision2.name))
}

fn monitor(data: &[u8]) -> Option<String> {
    let message = CollisionMonitorState::decode_cdr(data).ok()?;
    let is_stopped = message.action_type == CollisionMonitorState::STOP;
    is_stopped.then(|| format!("collision monitor: stop by `{}`", message.polygon_name))
}

fn detector(data: &[u8]) -> Option<String> {
    let message = CollisionDetectorState::decode_cdr(data).ok()?;
    let pairs = message.polygons.iter().zip(message.detections);
    let hit = pairs.filter(|(_, is_hit)| *is_hit).map(|(name, _)| name).next()?;
    Some(format!("collision detector: something is in `{hit}`"))
}

#[cfg(test)]
mod tests {
    use periplus_msgs::ros_gz_interfaces::Contact;

    use super::*;

    #[test]
    fn a_contact_that_lasts_is_one_collision() {
        let touching = Contacts { contacts: vec![Contact::default()], ..Contacts::default() };
        let (touching, free) = (touching.to_cdr().unwrap(), Contacts::default().to_cdr().unwrap());
        let mut marks = ContactMarks { decode: harmonic, last_ns: None };
        let steps = [(0, &free, 0), (1, &touching, 1), (2, &touching, 0), (3, &free, 0)];
        for (tenths, data, expected) in steps {
            assert_eq!(marks.detect(tenths * QUIET_NS / 10, data).len(), expected, "{tenths}");
        }
        assert_eq!(marks.detect(QUIET_NS * 2, &touching).len(), 1);
    }

    #[test]
    fn only_stops_of_the_monitor_are_marks() {
        let slow = CollisionMonitorState {
            action_type: CollisionMonitorState::SLOWDOWN,
            ..Default::default()
        };
        let stop = CollisionMonitorState {
            action_type: CollisionMonitorState::STOP,
            ..Default::default()
        };
        assert_eq!(monitor(&slow.to_cdr().unwrap()), None);
        assert!(monitor(&stop.to_cdr().unwrap()).is_some());
    }
}
