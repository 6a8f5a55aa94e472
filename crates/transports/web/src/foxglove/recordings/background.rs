//! Pass over a recording in the background.

use std::ops::ControlFlow;
use std::sync::atomic::Ordering;
use std::time::Duration;

use periplus_bags::files::{BagError, ChunkUse, MessageLocation};
use periplus_msgs::Message as _;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_os::{Stopwatch, sleep};

use super::entry::Recording;
use super::marks::MarkDetector;
use super::transform_index::Reach;

/// Maximum number of messages that are located at once; between two pages the pass waits for
/// fetches.
const PAGE: usize = 256;

/// Maximum time for which a page waits for fetches, so that the pass ends while a client plays.
const MAX_WAIT: Duration = Duration::from_millis(300);

/// Period at which the pass checks whether fetches are running.
const WAIT_PERIOD: Duration = Duration::from_millis(2);

/// Period at which clients get new marks.
const SEND_PERIOD: Duration = Duration::from_secs(1);

/// Indexes all transforms and markers and finds marks, until the recording is closed.
pub(super) fn run(recording: &Recording) {
    if let Err(error) = read(recording) {
        // Transforms are then found by reading.
        recording.note(error.to_string());
    }
    recording.marks.send(true);
}

fn read(recording: &Recording) -> Result<(), BagError> {
    let bag = &recording.bag;
    let mut detectors = MarkDetector::of_topics(bag.topics());
    let is_transforms = |topic: usize| recording.is_transforms.get(topic) == Some(&true);
    let markers = |topic: usize| recording.marker_topics.get(topic).copied().flatten();
    let topics: Vec<usize> = (0..bag.topics().len())
        .filter(|&topic| {
            is_transforms(topic) || markers(topic).is_some() || detectors[topic].is_some()
        })
        .collect();
    let mut is_full = false;
    let mut is_full_of_markers = false;
    let mut since = Stopwatch::start();
    let mut from_ns = Some(i64::MIN);
    while let Some(start_ns) = from_ns {
        let waiting = Stopwatch::start();
        while recording.fetches.load(Ordering::Relaxed) > 0 && waiting.elapsed() < MAX_WAIT {
            sleep(WAIT_PERIOD);
        }
        let page = bag.between(&topics, start_ns, i64::MAX, PAGE)?;
        let visit = &mut |location: &MessageLocation, data: &[u8]| {
            if recording.is_closed.load(Ordering::Relaxed) {
                return ControlFlow::Break(());
            }
            let (topic, time_ns) = (location.topic, location.time_ns);
            if !is_full
                && is_transforms(topic)
                && let Ok(message) = TFMessage::decode_cdr(data)
            {
                is_full = !recording.transforms.add(topic, time_ns, &message);
            }
            if !is_full_of_markers
                && let Some(markers) = markers(topic).and_then(|markers| markers.decode(data))
            {
                is_full_of_markers = !recording.markers.add(topic, time_ns, *location, &markers);
            }
            if let Some(Some(detector)) = detectors.get_mut(topic) {
                recording.marks.add(&bag.topics()[topic], detector.detect(time_ns, data));
            }
            ControlFlow::Continue(())
        };
        bag.read(&page.locations, ChunkUse::Once, visit)?;
        if recording.is_closed.load(Ordering::Relaxed) {
            return Ok(());
        }
        let reach = page.next_ns.map_or(Reach::All, |next_ns| Reach::Until(next_ns - 1));
        if !is_full {
            recording.transforms.set_reach(reach);
        }
        if !is_full_of_markers {
            recording.markers.set_reach(reach);
        }
        if since.elapsed() >= SEND_PERIOD {
            since = Stopwatch::start();
            recording.marks.send(false);
        }
        from_ns = page.next_ns;
    }
    Ok(())
}
