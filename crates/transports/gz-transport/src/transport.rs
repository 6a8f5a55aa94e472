//! A place in the network of Gazebo: who else is there, topics, services.

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

pub use calls::{Answer, Call, Server};
pub use packet::fuzz as fuzz_discovery;
pub use publish::Publisher;
pub use remote::Offered;
pub use subscribe::{Arrival, Subscription};
pub use zmtp::fuzz as fuzz_frames;

use crate::{CallError, Name, Settings, WireError};
use shared::{Kind, Shared};

/// A place in the network. It is left when this is dropped.
pub struct Transport {
    shared: Arc<Shared>,
    threads: Vec<JoinHandle<()>>,
}

impl Transport {
    /// Joins the network.
    ///
    /// # Errors
    /// When an address is none of this machine, or a port cannot be had.
    pub fn open(settings: &Settings) -> Result<Self, WireError> {
        let (shared, threads) = shared::open(settings)?;
        Ok(Self { shared, threads })
    }

    /// Publishes a topic. It is seen as long as the publisher is there.
    ///
    /// # Errors
    /// When Gazebo does not allow the name.
    pub fn advertise(&self, topic: &str, type_name: &str) -> Result<Publisher, WireError> {
        let name = self.name(topic)?;
        Ok(publish::advertise(&self.shared, name, type_name))
    }

    /// Hears a topic, whoever publishes it. `take` is called by threads of the wire, one for each who
    /// publishes; it should not take long.
    ///
    /// # Errors
    /// When Gazebo does not allow the name.
    pub fn subscribe(
        &self,
        topic: &str,
        type_name: &str,
        take: impl Fn(Arrival<'_>) + Send + Sync + 'static,
    ) -> Result<Subscription, WireError> {
        let name = self.name(topic)?;
        Ok(subscribe::subscribe(&self.shared, name, type_name, Box::new(take)))
    }

    /// Answers a service. `take` is called by threads of the wire; the answer may come later.
    ///
    /// # Errors
    /// When Gazebo does not allow the name.
    pub fn serve(
        &self,
        service: &str,
        request_type: &str,
        response_type: &str,
        take: impl Fn(Call) + Send + Sync + 'static,
    ) -> Result<Server, WireError> {
        let name = self.name(service)?;
        Ok(calls::serve(&self.shared, name, request_type, response_type, Box::new(take)))
    }

    /// Calls a service and waits for the answer, at most so long, also for who answers it to be found.
    ///
    /// # Errors
    /// When there is none.
    pub fn call(
        &self,
        service: &str,
        request_type: &str,
        response_type: &str,
        request: &[u8],
        timeout: Duration,
    ) -> Result<Vec<u8>, CallError> {
        let name = self.name(service).map_err(|_| CallError::Nobody)?;
        calls::call(&self.shared, &name, [request_type, response_type], request, timeout)
    }

    /// Topics of others, and who publishes them, sorted by name.
    #[must_use]
    pub fn topics(&self) -> Vec<Offered> {
        self.shared.remote(Kind::Topics).offered()
    }

    /// Services of others, sorted by name.
    #[must_use]
    pub fn services(&self) -> Vec<Offered> {
        self.shared.remote(Kind::Services).offered()
    }

    /// Changes when somebody begins or ends to hear one of our topics.
    #[must_use]
    pub fn hearings(&self) -> u64 {
        self.shared.hearings.load(Ordering::Acquire)
    }

    /// In which network this is.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.shared.settings
    }

    fn name(&self, topic: &str) -> Result<Name, WireError> {
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
