//! Service calls, some of which go to remote servers that have to be discovered first.

use std::sync::Arc;
use std::time::Duration;

use periplus_graph::{CallError, RawClient, RawMessage};
use periplus_transport::Since;

use super::{Shared, State};

/// Time to wait for the server.
const PATIENCE: Duration = Duration::from_secs(3);

/// Callback for the response: CDR or an error text. It must not use the hub.
pub(crate) type Answered = Box<dyn FnOnce(Result<&[u8], String>) + Send>;

/// A call that waits for its server.
pub(super) struct Waiting {
    client: Arc<RawClient>,
    cdr: Vec<u8>,
    answered: Answered,
    since: Since,
}

impl State {
    /// Calls a service, now or once its server is found.
    pub(crate) fn call(&mut self, shared: &Shared, name: &str, cdr: Vec<u8>, answered: Answered) {
        let client = match self.client_of(shared, name) {
            Ok(client) => client,
            Err(why) => return answered(Err(why)),
        };
        if client.is_ready() || !self.is_remote(name) {
            send(&client, cdr, answered);
        } else {
            self.waiting.push(Waiting { client, cdr, answered, since: Since::now() });
        }
    }

    /// Sends the calls whose servers have been found.
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
