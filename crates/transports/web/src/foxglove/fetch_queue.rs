//! Thread of a client that works off its fetches.

use std::sync::mpsc::{Sender, channel};

/// Work for the thread.
pub(crate) type Task = Box<dyn FnOnce() + Send>;

/// Fetches of a client in the order of its requests. The thread starts with the first one and ends
/// with the client.
pub(crate) struct FetchQueue {
    name: &'static str,
    sender: Option<Sender<Task>>,
}

impl FetchQueue {
    pub(crate) fn new(name: &'static str) -> Self {
        Self { name, sender: None }
    }

    /// Queues a task. False if the system starts no thread.
    pub(crate) fn push(&mut self, task: Task) -> bool {
        if cfg!(target_family = "wasm") {
            // There are no threads.
            task();
            return true;
        }
        let Some(sender) = &self.sender else {
            let (sender, tasks) = channel::<Task>();
            let builder = std::thread::Builder::new().name(self.name.to_owned());
            if builder.spawn(move || tasks.iter().for_each(|task| task())).is_err() {
                return false;
            }
            let is_sent = sender.send(task).is_ok();
            self.sender = Some(sender);
            return is_sent;
        };
        sender.send(task).is_ok()
    }
}
