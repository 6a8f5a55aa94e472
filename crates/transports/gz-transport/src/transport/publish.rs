//! Publishers.

use std::collections::{BTreeMap, VecDeque};
use std::io::Write as _;
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Condvar, Mutex, PoisonError};

use periplus_gz_msgs::{DiscoveryPublisher, DiscoveryScope, MessagePublisher};
use periplus_transport::lock;

use super::shared::{Kind, Shared, thread};
use super::zmtp;
use crate::{MOST_NAME, Name};

/// Maximum number of queued messages per subscriber, as in Gazebo; newer ones are dropped.
const MOST_WAITING: usize = 1_000;

/// Maximum size of the queued messages, in addition to the first \[bytes\].
const MOST_WAITING_BYTES: usize = 64 << 20;

/// Maximum number of subscription filters per connection.
const MOST_FILTERS: usize = 10_000;

/// A topic that is advertised until this is dropped.
pub struct GzPublisher {
    shared: Arc<Shared>,
    name: Name,
    type_name: String,
    id: u64,
}

pub(super) fn advertise(shared: &Arc<Shared>, name: Name, type_name: &str) -> GzPublisher {
    let offer = DiscoveryPublisher {
        topic: name.full().to_owned(),
        address: shared.publishing.clone(),
        process_uuid: shared.process.clone(),
        node_uuid: shared.node.clone(),
        scope: DiscoveryScope::ALL,
        msg_pub: Some(MessagePublisher {
            msg_type: type_name.to_owned(),
            msgs_per_sec: u64::MAX,
            ..MessagePublisher::default()
        }),
        srv_pub: None,
    };
    let id = shared.offer(Kind::Topics, offer);
    GzPublisher { shared: shared.clone(), name, type_name: type_name.to_owned(), id }
}

impl GzPublisher {
    /// Sends a message to all subscribers. It never blocks on a slow one.
    pub fn publish(&self, message: impl AsRef<[u8]>) {
        let hearers = self.shared.hearers.of(&self.name);
        if hearers.is_empty() {
            return;
        }
        let bytes: Arc<[u8]> = zmtp::message(&[
            self.name.full().as_bytes(),
            self.shared.publishing.as_bytes(),
            message.as_ref(),
            self.type_name.as_bytes(),
        ])
        .into();
        for hearer in hearers {
            hearer.push(&bytes);
        }
    }

    /// True if there is a subscriber.
    #[must_use]
    pub fn is_heard(&self) -> bool {
        !self.shared.hearers.of(&self.name).is_empty()
    }

    /// Name of the topic.
    #[must_use]
    pub fn topic(&self) -> &str {
        self.name.topic()
    }
}

impl Drop for GzPublisher {
    fn drop(&mut self) {
        self.shared.withdraw(Kind::Topics, self.id);
    }
}

impl std::fmt::Debug for GzPublisher {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Publisher").field(&self.name.topic()).finish()
    }
}

/// Connected subscribers.
#[derive(Default)]
pub(super) struct Hearers(Mutex<BTreeMap<u64, Arc<Hearer>>>);

impl Hearers {
    /// Subscribers of a topic; filters are prefixes of names.
    fn of(&self, name: &Name) -> Vec<Arc<Hearer>> {
        let hearers = lock(&self.0);
        hearers.values().filter(|hearer| hearer.wants(name)).cloned().collect()
    }
}

/// A connected subscriber.
#[derive(Default)]
struct Hearer {
    /// Its filters with their counts.
    filters: Mutex<BTreeMap<Vec<u8>, u32>>,
    queue: Mutex<Queue>,
    filled: Condvar,
}

#[derive(Default)]
struct Queue {
    messages: VecDeque<Arc<[u8]>>,
    bytes: usize,
    is_closed: bool,
}

impl Hearer {
    fn wants(&self, name: &Name) -> bool {
        lock(&self.filters).keys().any(|filter| name.full().as_bytes().starts_with(filter))
    }

    fn push(&self, message: &Arc<[u8]>) {
        let mut queue = lock(&self.queue);
        let bytes = queue.bytes + message.len();
        let is_full = queue.messages.len() >= MOST_WAITING
            || (bytes > MOST_WAITING_BYTES && !queue.messages.is_empty());
        if is_full || queue.is_closed {
            return;
        }
        queue.bytes = bytes;
        queue.messages.push_back(message.clone());
        drop(queue);
        self.filled.notify_one();
    }

    fn close(&self) {
        lock(&self.queue).is_closed = true;
        self.filled.notify_one();
    }

    /// Waits for the next message; none when the connection is closed.
    fn next(&self) -> Option<Arc<[u8]>> {
        let queue = lock(&self.queue);
        let is_idle = |queue: &mut Queue| queue.messages.is_empty() && !queue.is_closed;
        let queue = self.filled.wait_while(queue, is_idle);
        let mut queue = queue.unwrap_or_else(PoisonError::into_inner);
        if queue.is_closed {
            return None;
        }
        let message = queue.messages.pop_front()?;
        queue.bytes -= message.len();
        Some(message)
    }

    fn ask(&self, is_wanted: bool, filter: Vec<u8>) {
        let mut filters = lock(&self.filters);
        if is_wanted {
            if filters.len() < MOST_FILTERS {
                *filters.entry(filter).or_default() += 1;
            }
        } else if let Some(count) = filters.get_mut(&filter) {
            *count -= 1;
            if *count == 0 {
                filters.remove(&filter);
            }
        }
    }
}

/// Serves a subscriber connection.
pub(super) fn meet(shared: &Arc<Shared>, mut stream: TcpStream) {
    let Ok(writing) = stream.try_clone() else { return };
    let hearer = Arc::new(Hearer::default());
    let id = shared.next_id();
    lock(&shared.hearers.0).insert(id, hearer.clone());
    let sending = hearer.clone();
    let writer = thread("gz-publish", move || send(&sending, writing));
    while let Ok(event) = zmtp::read(&mut stream, MOST_NAME) {
        match event {
            zmtp::Event::Subscribe(is_wanted, filter) => hearer.ask(is_wanted, filter),
            zmtp::Event::Message(parts) => {
                let Some((kind @ (0 | 1), filter)) = parts[0].split_first() else { continue };
                hearer.ask(*kind == 1, filter.to_vec());
            }
            // A reply would have to be inserted between messages; ZMTP 3.0 subscribers do not need
            // it.
            zmtp::Event::Ping(_) => continue,
        }
        shared.hearings.fetch_add(1, Ordering::AcqRel);
    }
    lock(&shared.hearers.0).remove(&id);
    hearer.close();
    let _ = stream.shutdown(Shutdown::Both);
    let _ = writer.join();
    shared.hearings.fetch_add(1, Ordering::AcqRel);
}

fn send(hearer: &Hearer, mut stream: TcpStream) {
    while let Some(message) = hearer.next() {
        if stream.write_all(&message).is_err() {
            break;
        }
    }
    hearer.close();
    let _ = stream.shutdown(Shutdown::Both);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_asks_twice_has_to_end_twice() {
        let hearer = Hearer::default();
        let name = Name::new("p", "/scan").expect("a name");
        assert!(!hearer.wants(&name));
        hearer.ask(true, b"@/p@/scan".to_vec());
        hearer.ask(true, b"@/p@/scan".to_vec());
        hearer.ask(false, b"@/p@/scan".to_vec());
        assert!(hearer.wants(&name));
        hearer.ask(false, b"@/p@/scan".to_vec());
        hearer.ask(false, b"@/p@/scan".to_vec());
        assert!(!hearer.wants(&name));
        hearer.ask(true, b"@/p@/scan/points".to_vec());
        assert!(!hearer.wants(&name));
        hearer.ask(true, b"@/p@/s".to_vec());
        assert!(hearer.wants(&name));
    }

    #[test]
    fn who_is_slow_loses_what_is_new() {
        let hearer = Hearer::default();
        let large: Arc<[u8]> = vec![0; MOST_WAITING_BYTES].into();
        hearer.push(&large);
        hearer.push(&large);
        assert_eq!(lock(&hearer.queue).messages.len(), 1);
        let small: Arc<[u8]> = vec![0; 1].into();
        for _ in 0..3 {
            hearer.push(&small);
        }
        assert_eq!(lock(&hearer.queue).messages.len(), 1);
        assert!(hearer.next().is_some());
        for _ in 0..MOST_WAITING + 3 {
            hearer.push(&small);
        }
        assert_eq!(lock(&hearer.queue).messages.len(), MOST_WAITING);
        hearer.close();
        assert!(hearer.next().is_none());
    }
}
