//! Pass over a recording in the background.

use std::ops::ControlFlow;
use std::sync::atomic::Ordering;

use periplus_bags::files::{BagError, ChunkUse, MessageLocation};
use periplus_msgs::Message as _;
use periplus_msgs::tf2_msgs::TFMessage;

use super::entry::Recording;
use super::transform_index::Reach;

/// Maximum number of messages that are located at once.
const PAGE: usize = 4096;

/// Reads all transforms, until the recording is closed.
pub(super) fn run(recording: &Recording) -> Result<(), BagError> {
    let of = |topic: &usize| recording.is_transforms.get(*topic) == Some(&true);
    let topics: Vec<usize> = (0..recording.bag.topics().len()).filter(of).collect();
    let mut is_full = false;
    let mut from_ns = Some(i64::MIN);
    while let Some(start_ns) = from_ns {
        let page = recording.bag.between(&topics, start_ns, i64::MAX, PAGE)?;
        let visit = &mut |location: &MessageLocation, data: &[u8]| {
            if recording.is_closed.load(Ordering::Relaxed) {
                return ControlFlow::Break(());
            }
            if let Ok(message) = TFMessage::decode_cdr(data) {
                is_full |= !recording.transforms.add(location.topic, location.time_ns, &message);
            }
            if is_full { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        recording.bag.read(&page.locations, ChunkUse::Once, visit)?;
        if is_full || recording.is_closed.load(Ordering::Relaxed) {
            return Ok(());
        }
        if let Some(next_ns) = page.next_ns {
            recording.transforms.set_reach(Reach::Until(next_ns - 1));
        }
        from_ns = page.next_ns;
    }
    recording.transforms.set_reach(Reach::All);
    Ok(())
}

/// Notes that the pass ended early: transforms are then looked up by reading.
pub(super) fn failed(recording: &Recording, error: &BagError) {
    recording.note(error.to_string());
}
