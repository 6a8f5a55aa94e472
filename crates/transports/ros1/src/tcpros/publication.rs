//! A published topic of a node: the connections of its subscribers, each with a queue and a thread.

use std::collections::{BTreeMap, VecDeque};
use std::io::{self, Write as _};
use std::net::TcpStream;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

use periplus_transport::lock;

use super::{Frame, Header, keep_alive};
use crate::names::Ros1Type;

/// Maximum size of the messages that wait for one subscriber; the newest is kept in any case.
const MAX_WAITING_BYTES: usize = 256 << 20;

/// Period at which a connection without messages is checked for its end.
const LOOK: Duration = Duration::from_secs(1);

/// Callback for changes of the number of subscribers.
pub(crate) type Wake = Box<dyn Fn() + Send + Sync>;

/// A published topic.
pub(crate) struct Publication {
    pub(crate) topic: String,
    pub(crate) of: Ros1Type,
    /// Name of the node.
    caller: String,
    is_latching: bool,
    /// Queue depth of a subscriber; the oldest message is dropped when it is exceeded.
    depth: usize,
    subscribers: AtomicUsize,
    /// True if messages of the graph come here.
    is_fed: AtomicBool,
    sent_bytes: AtomicU64,
    links: Mutex<Links>,
    wake: Wake,
}

#[derive(Default)]
struct Links {
    next_id: i32,
    open: BTreeMap<i32, Arc<Link>>,
    latched: Option<Frame>,
    is_closed: bool,
}

/// The connection of a subscriber.
struct Link {
    /// Name of the subscriber.
    peer: String,
    queue: Mutex<Queue>,
    filled: Condvar,
    sent: AtomicU64,
    sent_bytes: AtomicU64,
    dropped: AtomicU64,
    stream: TcpStream,
}

#[derive(Default)]
struct Queue {
    frames: VecDeque<Frame>,
    bytes: usize,
    /// True while the thread writes a message.
    is_sending: bool,
    is_closed: bool,
}

/// Counts of a connection, for `getBusInfo` and `getBusStats`.
pub(crate) struct LinkReport {
    pub(crate) id: i32,
    pub(crate) peer: String,
    pub(crate) sent: u64,
    pub(crate) sent_bytes: u64,
}

impl Publication {
    pub(crate) fn new(
        caller: &str,
        topic: &str,
        of: Ros1Type,
        is_latching: bool,
        depth: usize,
        wake: Wake,
    ) -> Arc<Self> {
        Arc::new(Self {
            topic: topic.to_owned(),
            of,
            caller: caller.to_owned(),
            is_latching,
            depth: depth.max(1),
            subscribers: AtomicUsize::new(0),
            is_fed: AtomicBool::new(false),
            sent_bytes: AtomicU64::new(0),
            links: Mutex::default(),
            wake,
        })
    }

    /// True if there is a subscriber, or the message is kept for later ones.
    pub(crate) fn is_wanted(&self) -> bool {
        self.is_latching || self.subscribers.load(Ordering::Relaxed) > 0
    }

    /// Notes whether messages of the graph come here.
    pub(crate) fn set_fed(&self, is_fed: bool) {
        self.is_fed.store(is_fed, Ordering::Release);
    }

    /// Names of the subscribers that get the next message.
    pub(crate) fn subscribers(&self) -> Vec<String> {
        if !self.is_fed.load(Ordering::Acquire) {
            return Vec::new();
        }
        lock(&self.links).open.values().map(|link| link.peer.clone()).collect()
    }

    /// Queues a message for all subscribers.
    pub(crate) fn send(&self, frame: &Frame) {
        let mut links = lock(&self.links);
        if self.is_latching {
            links.latched = Some(frame.clone());
        }
        for link in links.open.values() {
            link.push(frame, self.depth);
        }
    }

    /// Number of messages dropped because a subscriber was too slow.
    pub(crate) fn dropped(&self) -> u64 {
        lock(&self.links).open.values().map(|link| link.dropped.load(Ordering::Relaxed)).sum()
    }

    /// True if all queued messages are sent.
    pub(crate) fn is_idle(&self) -> bool {
        lock(&self.links).open.values().all(|link| {
            let queue = lock(&link.queue);
            queue.frames.is_empty() && !queue.is_sending
        })
    }

    /// Bytes sent so far, and the connections.
    pub(crate) fn report(&self) -> (u64, Vec<LinkReport>) {
        let links = lock(&self.links);
        let reports = links.open.iter().map(|(id, link)| LinkReport {
            id: *id,
            peer: link.peer.clone(),
            sent: link.sent.load(Ordering::Relaxed),
            sent_bytes: link.sent_bytes.load(Ordering::Relaxed),
        });
        (self.sent_bytes.load(Ordering::Relaxed), reports.collect())
    }

    /// Answers the header of a subscriber and sends messages until the connection ends.
    pub(crate) fn serve(&self, header: &Header, stream: TcpStream) -> io::Result<()> {
        if let Some(why) = self.mismatch(header) {
            return (&stream).write_all(&Header::new(&[("error", &why)]).write());
        }
        let latching = if self.is_latching { "1" } else { "0" };
        let answer = Header::new(&[
            ("callerid", &self.caller),
            ("latching", latching),
            ("md5sum", &self.of.md5),
            ("message_definition", &self.of.definition),
            ("topic", &self.topic),
            ("type", &self.of.name),
        ]);
        (&stream).write_all(&answer.write())?;
        // A slow subscriber may take as long as it wants: its messages are dropped, not the connection.
        stream.set_write_timeout(None)?;
        stream.set_read_timeout(Some(Duration::from_millis(1)))?;
        keep_alive(&stream)?;
        let link = Arc::new(Link {
            peer: header.get("callerid").to_owned(),
            queue: Mutex::default(),
            filled: Condvar::new(),
            sent: AtomicU64::new(0),
            sent_bytes: AtomicU64::new(0),
            dropped: AtomicU64::new(0),
            stream,
        });
        let id = {
            let mut links = lock(&self.links);
            if links.is_closed {
                return Ok(());
            }
            if let Some(latched) = links.latched.clone() {
                link.push(&latched, self.depth);
            }
            let id = links.next_id;
            links.next_id += 1;
            links.open.insert(id, link.clone());
            self.subscribers.store(links.open.len(), Ordering::Relaxed);
            id
        };
        (self.wake)();
        let ended = link.run(&self.sent_bytes);
        let mut links = lock(&self.links);
        links.open.remove(&id);
        self.subscribers.store(links.open.len(), Ordering::Relaxed);
        drop(links);
        (self.wake)();
        ended
    }

    /// Reason for which a subscriber is refused.
    fn mismatch(&self, header: &Header) -> Option<String> {
        let (md5, of) = (header.get("md5sum"), header.get("type"));
        let topic = &self.topic;
        if md5.is_empty() {
            return Some(format!("the header for the topic [{topic}] has no field `md5sum`"));
        }
        let is_same = md5 == "*" || md5 == self.of.md5;
        (!is_same).then(|| {
            format!(
                "the topic [{topic}] has the type {} with the MD5 sum {}; {} asks for {of} with {md5}",
                self.of.name,
                self.of.md5,
                header.get("callerid")
            )
        })
    }

    /// Closes all connections.
    pub(crate) fn close(&self) {
        let mut links = lock(&self.links);
        links.is_closed = true;
        for link in links.open.values() {
            link.close();
        }
    }
}

impl Link {
    fn push(&self, frame: &Frame, depth: usize) {
        let mut queue = lock(&self.queue);
        queue.frames.push_back(frame.clone());
        queue.bytes += frame.len();
        while queue.frames.len() > 1
            && (queue.frames.len() > depth || queue.bytes > MAX_WAITING_BYTES)
        {
            if let Some(old) = queue.frames.pop_front() {
                queue.bytes -= old.len();
                self.dropped.fetch_add(1, Ordering::Relaxed);
            }
        }
        drop(queue);
        self.filled.notify_one();
    }

    fn run(&self, sent_bytes: &AtomicU64) -> io::Result<()> {
        while let Some(frame) = self.next()? {
            (&self.stream).write_all(&frame)?;
            let bytes = frame.len() as u64;
            self.sent.fetch_add(1, Ordering::Relaxed);
            self.sent_bytes.fetch_add(bytes, Ordering::Relaxed);
            sent_bytes.fetch_add(bytes, Ordering::Relaxed);
        }
        Ok(())
    }

    /// Waits for a message; none when the connection ends.
    fn next(&self) -> io::Result<Option<Frame>> {
        let mut queue = lock(&self.queue);
        queue.is_sending = false;
        loop {
            if queue.is_closed {
                return Ok(None);
            }
            if let Some(frame) = queue.frames.pop_front() {
                queue.bytes -= frame.len();
                queue.is_sending = true;
                return Ok(Some(frame));
            }
            let waited = self.filled.wait_timeout(queue, LOOK);
            let (back, timeout) = waited.unwrap_or_else(PoisonError::into_inner);
            queue = back;
            if timeout.timed_out() && queue.frames.is_empty() && !queue.is_closed {
                drop(queue);
                // A subscriber sends nothing; its end is an empty read.
                match self.stream.peek(&mut [0]) {
                    Ok(0) => return Ok(None),
                    Ok(_) => {}
                    Err(error) if is_timeout(&error) => {}
                    Err(error) => return Err(error),
                }
                queue = lock(&self.queue);
            }
        }
    }

    fn close(&self) {
        lock(&self.queue).is_closed = true;
        self.filled.notify_one();
        let _ = self.stream.shutdown(std::net::Shutdown::Both);
    }
}

fn is_timeout(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut)
}
