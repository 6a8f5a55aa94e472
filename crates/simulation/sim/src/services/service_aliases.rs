//! Services with several names.

use periplus_graph::{Calls, GraphError, Node};
use periplus_msgs::Service;

/// A service under its names in all generations of Gazebo.
pub(super) struct ServiceAliases<S>(Vec<Calls<S>>);

impl<S: Service> ServiceAliases<S> {
    /// Duplicate names are ignored.
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

    /// Answers requests since the last call.
    pub(super) fn answer(&self, mut answer: impl FnMut(&S::Request) -> S::Response) {
        for calls in &self.0 {
            while let Some(call) = calls.take() {
                let response = answer(&call.request);
                call.answer(response);
            }
        }
    }
}
