//! Calls of services, some of which are answered elsewhere and need a moment to be found.

use std::sync::Arc;
use std::time::Duration;

use periplus_graph::{CallError, RawClient, RawMessage};
use periplus_transport::Since;

use super::{Shared, State};

/// So long who answers is waited for.
const PATIENCE: Duration = Duration::from_secs(3);

/// Gets the answer, as CDR or as words. It must not touch the hub.
pub(crate) type Answered = Box<dyn FnOnce(Result<&[u8], String>) + Send>;

/// A call that waits for who answers it.
pub(super) struct Waiting {
    client: Arc<RawClient>,
    cdr: Vec<u8>,
    answered: Answered,
    since: Since,
}

impl State {
    /// Calls a service, at once or as soon as who answers it is found.
    pub(crate) fn call(&mut self, shared: &Shared, name: &str, cdr: Vec<u8>, answered: Answered) {
        let client = match self.client_of(shared, name) {
            Ok(client) => client,
            Err(why) => return answered(Err(why)),
        };
        if client.is_ready() || !self.is_far(name) {
            send(&client, cdr, answered);
        } else {
            self.waiting.push(Waiting { client, cdr, answered, since: Since::now() });
        }
    }

    /// Calls what can be called by now.
    pub(super) fn go_on_calling(&mut self) {
        for one in std::mem::take(&mut self.waiting) {
            if one.client.is_ready() || one.since.elapsed() > PATIENCE {
                send(&one.client, one.cdr, one.answered);
            } else {
                self.waiting.push(one);
            }
        }
    }
}

fn send(client: &RawClient, cdr: Vec<u8>, answered: Answered) {
    let read = |answer: Result<RawMessage, CallError>| match &answer {
        Ok(message) => match message.cdr() {
            Ok(cdr) => answered(Ok(cdr)),
            Err(error) => answered(Err(error.to_string())),
        },
        Err(error) => answered(Err(error.to_string())),
    };
    client.call(cdr, read);
}
