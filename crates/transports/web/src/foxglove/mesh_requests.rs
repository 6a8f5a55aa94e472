//! Requests of a client for the triangles of mesh files.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use periplus_meshes::{pack_file, sibling_uri};

use crate::foxglove::fetch_queue::FetchQueue;
use crate::foxglove::hub::Assets;
use crate::foxglove::outbox::{Outbox, Room};
use crate::foxglove::protocol::{self, AssetAnswer};
use crate::foxglove::session::NO_FILES;

/// Maximum size of responses that wait while another mesh is read \[bytes\]: with the largest mesh they stay
/// below the limit at which a client is disconnected.
const MAX_WAITING_BYTES: usize = 16 << 20;

/// Period at which a full queue is checked.
const ROOM_POLL: Duration = Duration::from_millis(200);

/// Mesh files of a client, read one after the other beside its other requests: a large file takes seconds.
pub(crate) struct MeshRequests {
    queue: FetchQueue,
    outbox: Arc<Outbox>,
    pending: Arc<AtomicUsize>,
    max_pending: usize,
}

impl MeshRequests {
    pub(crate) fn new(outbox: Arc<Outbox>, max_pending: usize) -> Self {
        Self { queue: FetchQueue::new("fetch-mesh"), outbox, pending: Arc::default(), max_pending }
    }

    /// Queues a request. Its answer has the form of a requested file.
    pub(crate) fn request(&mut self, uri: String, request_id: u32, assets: Option<Assets>) {
        let refuse = |why: &str| self.outbox.push(protocol::asset(request_id, &Err(why.into())));
        let Some(assets) = assets else { return refuse(NO_FILES) };
        if self.pending.load(Ordering::Relaxed) >= self.max_pending {
            return refuse("too many meshes are requested at one time; request it again later");
        }
        self.pending.fetch_add(1, Ordering::Relaxed);
        let (outbox, pending) = (self.outbox.clone(), self.pending.clone());
        let is_queued = self.queue.push(Box::new(move || {
            if is_ready(&outbox) {
                outbox.push(protocol::asset(request_id, &mesh(&uri, &assets)));
            }
            pending.fetch_sub(1, Ordering::Relaxed);
        }));
        if !is_queued {
            self.pending.fetch_sub(1, Ordering::Relaxed);
            self.outbox.push(protocol::asset(
                request_id,
                &Err("the system starts no thread for it; request it again later".into()),
            ));
        }
    }
}

/// Waits until a client has read its responses. False once it has left.
fn is_ready(outbox: &Outbox) -> bool {
    loop {
        match outbox.wait_for_room(MAX_WAITING_BYTES, ROOM_POLL) {
            Room::Free => return true,
            Room::Full => {}
            Room::Closed => return false,
        }
    }
}

/// Triangles of a mesh file. Files that it refers to follow the rules of requested files.
fn mesh(uri: &str, assets: &Assets) -> AssetAnswer {
    let file = uri.split('#').next().unwrap_or(uri);
    let bytes = assets(file)?;
    let mut side_files = |name: &str| assets(&sibling_uri(file, name)).ok();
    pack_file(file, &bytes, &mut side_files).map_err(|error| format!("`{file}`: {error}").into())
}
