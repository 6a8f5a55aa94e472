//! Service calls.

use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::Duration;

use periplus_graph::{CallError, Node, RawClient, RawMessage};
use periplus_msgs::{Message, Service};
use periplus_os::{Stopwatch, sleep};

use crate::session::INTERRUPT_POLL_PERIOD;
use crate::{Failure, Outcome, Session};

/// Polling period for the response.
const POLL_PERIOD: Duration = Duration::from_millis(1);

/// Timeout of a response: a node that is busy starting may need some time.
pub(crate) const RESPONSE_TIMEOUT: Duration = Duration::from_secs(10);

/// Service client.
pub(crate) struct ServiceCaller {
    name: String,
    client: RawClient,
}

/// Pending request.
pub(crate) struct PendingRequest {
    name: String,
    answer: Receiver<Result<RawMessage, CallError>>,
}

impl ServiceCaller {
    /// Creates the client.
    pub(crate) fn new(
        node: &Node,
        name: &str,
        type_name: &str,
        type_hash: Option<&str>,
    ) -> Outcome<Self> {
        let client = node.raw_client(name, type_name, type_hash)?;
        Ok(Self { name: name.to_owned(), client })
    }

    /// Waits for a server, up to a timeout; returns true if there is one.
    pub(crate) fn wait(&self, session: &Session<'_>, timeout: Option<Duration>) -> Outcome<bool> {
        let clock = Stopwatch::start();
        while !self.client.is_ready() {
            session.check_interrupted()?;
            if timeout.is_some_and(|timeout| clock.elapsed() >= timeout) {
                return Ok(false);
            }
            let served = |seen: &crate::Seen| {
                seen.service(&self.name).is_some_and(|service| !service.servers.is_empty())
            };
            session.network.wait(INTERRUPT_POLL_PERIOD, &mut { served });
            sleep(POLL_PERIOD);
        }
        Ok(true)
    }

    /// Sends a request.
    pub(crate) fn ask(&self, cdr: Vec<u8>) -> PendingRequest {
        let (send, answer) = channel();
        self.client.call(cdr, move |result| {
            let _ = send.send(result);
        });
        PendingRequest { name: self.name.clone(), answer }
    }
}

impl PendingRequest {
    /// Returns the response if it has arrived.
    pub(crate) fn take(&self) -> Outcome<Option<Vec<u8>>> {
        match self.answer.try_recv() {
            Err(TryRecvError::Empty) => Ok(None),
            Err(TryRecvError::Disconnected) => {
                Err(Failure::failed(format!("the server of {} is gone", self.name)))
            }
            Ok(Err(error)) => Err(Failure::failed(error.to_string())),
            Ok(Ok(message)) => match message.cdr() {
                Ok(cdr) => Ok(Some(cdr.to_vec())),
                Err(error) => Err(Failure::failed(error.to_string())),
            },
        }
    }

    /// Waits for the response, up to a timeout.
    pub(crate) fn wait(
        &self,
        session: &Session<'_>,
        timeout: Option<Duration>,
    ) -> Outcome<Vec<u8>> {
        let clock = Stopwatch::start();
        loop {
            if let Some(answer) = self.take()? {
                return Ok(answer);
            }
            session.check_interrupted()?;
            if let Some(timeout) = timeout
                && clock.elapsed() >= timeout
            {
                let seconds = timeout.as_secs();
                let words = format!("{} did not answer within {seconds} s", self.name);
                return Err(Failure::failed(words));
            }
            sleep(POLL_PERIOD);
        }
    }
}

/// Calls a standard service of a node and waits for the response.
pub(crate) fn ask<S: Service>(
    session: &Session<'_>,
    node: &Node,
    name: &str,
    request: &S::Request,
) -> Outcome<S::Response> {
    let asker = ServiceCaller::new(node, name, S::TYPE_NAME, Some(S::TYPE_HASH))?;
    let time = session.found_within();
    if !asker.wait(session, Some(time))? {
        return Err(Failure::failed(format!("no server of {name} was found")));
    }
    let cdr = request.to_cdr().map_err(|error| Failure::failed(error.to_string()))?;
    let answer = asker.ask(cdr).wait(session, Some(RESPONSE_TIMEOUT))?;
    S::Response::decode_cdr(&answer).map_err(|error| {
        Failure::failed(format!("the response of {name} is not a {}: {error}", S::TYPE_NAME))
    })
}
