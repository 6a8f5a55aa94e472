//! One service under several names.

use periplus_graph::{Calls, GraphError, Node};
use periplus_msgs::Service;

/// A service under all the names that Gazebo's generations have for it.
pub(super) struct Offer<S>(Vec<Calls<S>>);

impl<S: Service> Offer<S> {
    /// A name that comes twice counts once.
    pub(super) fn new<'a>(
        node: &Node,
        names: impl IntoIterator<Item = &'a str>,
    ) -> Result<Self, GraphError> {
        let mut wanted: Vec<&str> = Vec::new();
        for name in names {
            if !wanted.contains(&name) {
                wanted.push(name);
            }
        }
        wanted.into_iter().map(|name| node.server(name)).collect::<Result<_, _>>().map(Self)
    }

    /// Answers what was asked since the last time.
    pub(super) fn answer(&self, mut answer: impl FnMut(&S::Request) -> S::Response) {
        for calls in &self.0 {
            while let Some(call) = calls.take() {
                let response = answer(&call.request);
                call.answer(response);
            }
        }
    }
}
