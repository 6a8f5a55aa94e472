//! Handle of the Gazebo transport: discovery, topics and services.

mod calls;
mod discovery;
mod listener;
mod packet;
mod publish;
mod remote;
mod replies;
mod shared;
mod sockets;
mod subscribe;
mod uuid;
mod zmtp;

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread::JoinHandle;
use std::time::Duration;

pub use calls::{GzService, ServiceReply, ServiceRequest};
pub use packet::fuzz as fuzz_discovery;
pub use publish::GzPublisher;
pub use remote::Advertisement;
pub use subscribe::{GzSubscription, ReceivedMessage};
pub use zmtp::fuzz as fuzz_frames;

use crate::{GzTransportError, Name, ServiceCallError, Settings};
use shared::{Kind, Shared};

/// A participant of the Gazebo network. It leaves the network when this is dropped.
pub struct Transport {
    shared: Arc<Shared>,
    threads: Vec<JoinHandle<()>>,
}

impl Transport {
    /// Joins the network.
    ///
    /// # Errors
    /// When the address is not one of this machine, or a port cannot be bound.
    pub fn open(settings: &Settings) -> Result<Self, GzTransportError> {
        let (shared, threads) = shared::open(settings)?;
        Ok(Self { shared, threads })
    }

    /// Advertises a topic until the publisher is dropped.
    ///
    /// # Errors
    /// When Gazebo does not allow the name.
    pub fn advertise(&self, topic: &str, type_name: &str) -> Result<GzPublisher, GzTransportError> {
        let name = self.name(topic)?;
        Ok(publish::advertise(&self.shared, name, type_name))
    }

    /// Subscribes to a topic of all publishers. `take` is called by threads of the transport, one
    /// for each publisher; it must return quickly.
    ///
    /// # Errors
    /// When Gazebo does not allow the name.
    pub fn subscribe(
        &self,
        topic: &str,
        type_name: &str,
        take: impl Fn(ReceivedMessage<'_>) + Send + Sync + 'static,
    ) -> Result<GzSubscription, GzTransportError> {
        let name = self.name(topic)?;
        Ok(subscribe::subscribe(&self.shared, name, type_name, Box::new(take)))
    }

    /// Advertises a service. `take` is called by threads of the transport; the response may be sent
    /// later.
    ///
    /// # Errors
    /// When Gazebo does not allow the name.
    pub fn serve(
        &self,
        service: &str,
        request_type: &str,
        response_type: &str,
        take: impl Fn(ServiceRequest) + Send + Sync + 'static,
    ) -> Result<GzService, GzTransportError> {
        let name = self.name(service)?;
        Ok(calls::serve(&self.shared, name, request_type, response_type, Box::new(take)))
    }

    /// Calls a service and waits for the response, including discovery of the server, at most for
    /// the timeout.
    ///
    /// # Errors
    /// When there is no response.
    pub fn call(
        &self,
        service: &str,
        request_type: &str,
        response_type: &str,
        request: &[u8],
        timeout: Duration,
    ) -> Result<Vec<u8>, ServiceCallError> {
        let name = self.name(service).map_err(|_| ServiceCallError::Nobody)?;
        calls::call(&self.shared, &name, [request_type, response_type], request, timeout)
    }

    /// Topics of other programs with their publishers, sorted by name.
    #[must_use]
    pub fn topics(&self) -> Vec<Advertisement> {
        self.shared.remote(Kind::Topics).offered()
    }

    /// Services of other programs, sorted by name.
    #[must_use]
    pub fn services(&self) -> Vec<Advertisement> {
        self.shared.remote(Kind::Services).offered()
    }

    /// Counter that changes when a remote subscriber of a local topic is added or removed.
    #[must_use]
    pub fn hearings(&self) -> u64 {
        self.shared.hearings.load(Ordering::Acquire)
    }

    /// Network settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.shared.settings
    }

    fn name(&self, topic: &str) -> Result<Name, GzTransportError> {
        Name::new(&self.shared.settings.partition, topic)
    }
}

impl Drop for Transport {
    fn drop(&mut self) {
        self.shared.close();
        for thread in self.threads.drain(..) {
            let _ = thread.join();
        }
    }
}

impl std::fmt::Debug for Transport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Transport").field("settings", &self.shared.settings).finish_non_exhaustive()
    }
}
